//! The factors of a reduced model, each made on first use, or ahead of it on another thread, and kept.
//!
//! If there are few integers, one [`SchurFactor`] serves every purpose. Otherwise there are three factors:
//! a supernodal one for the relaxation, a simplicial one in which greedy rounding fixes unknowns, and one
//! of the continuous block for offers of integers.

use std::time::Instant;

use super::Strategy;
use crate::eliminate::{Component, Part, ReducedModel, parts};
use crate::error::Result;
use crate::linalg::{
    Analysis, Cholesky, Ldl, Minimum, Ordering, RelaxedFactor, SchurFactor, Sparse, coupling,
    minimise, minimise_bounded, principal_submatrix, residual,
};
use crate::monitor::{allowed_threads, both, may_continue};

/// The least number of unknowns for which a factor gets a thread of its own.
const WORTH_A_THREAD: usize = 4_096;

/// The most unknowns for which it is made beside the relaxation: both factors are then in memory at the same time.
const MOST_AHEAD: usize = 1 << 20;

/// The factors of one reduced model.
#[derive(Debug, Default)]
pub(crate) struct Factors {
    relaxed: Option<RelaxedFactor>,
    /// The number of entries below the diagonal of that factor, once it has been made.
    relaxed_entries: Option<usize>,
    continuous: Option<ContinuousBlock>,
    /// The factor in its original state, if it is kept.
    updatable: Option<Ldl>,
    ordering: Ordering,
    /// Whether a search follows also where no integers are decided.
    is_searched: bool,
    keep: bool,
    schur_factor: Option<SchurFactor>,
    /// The order and the pattern of that factor, until it is made.
    schur_analysis: Option<Analysis>,
    /// The parts of the model that are searched apart, once they are known; none if all integers are in one component.
    parts: Option<Vec<Part>>,
    /// By component: its own factors.
    components: Vec<Factors>,
    seconds: f64,
}

/// A factor in which unknowns can be fixed. It is that of the Schur complement of the integers if that is
/// the cheapest, otherwise that of the whole reduced Hessian.
#[derive(Debug)]
pub(crate) struct UpdatableFactor {
    pub ldl: Ldl,
    /// The reduced unknowns of this factor.
    pub unknowns: Vec<u32>,
    /// The places of the integers among these unknowns.
    pub integers: Vec<u32>,
}

/// The block of the Hessian for the continuous unknowns, with the integers given.
#[derive(Debug)]
struct ContinuousBlock {
    /// The lower triangle of the continuous block.
    hessian: Sparse,
    /// One row for each continuous unknown, one column for each integer.
    coupling: Sparse,
    factor: Cholesky,
}

/// The components of a model, and the factors of the large continuous blocks among them, made before the search asks
/// for them.
pub(crate) struct MadeAhead {
    parts: Vec<Part>,
    /// Each with the number of its component. Without components it is that of the whole model.
    blocks: Vec<(usize, ContinuousBlock)>,
    /// The seconds from the end of the other task to that of the factorization.
    waited: f64,
}

impl MadeAhead {
    /// Does a task, and makes what the search in `model` needs on other threads meanwhile.
    pub fn during<T>(
        model: &ReducedModel,
        ordering: Ordering,
        task: impl FnOnce() -> T,
    ) -> (T, Result<Self>) {
        let ahead = || Self::new(model, ordering);
        let ((done, ended), ahead) = both(true, || (task(), Instant::now()), ahead);
        let waited = ended.elapsed().as_secs_f64();
        (done, ahead.map(|ahead| MadeAhead { waited, ..ahead }))
    }

    fn new(model: &ReducedModel, ordering: Ordering) -> Result<Self> {
        let parts = parts(model)?;
        let whole = (model.hessian(), model.continuous(), model.integers());
        let systems: Vec<_> = match parts.is_empty() {
            true => vec![whole],
            false => parts
                .iter()
                .map(|part| (part.hessian(), part.continuous(), part.integers()))
                .collect(),
        };
        let mut blocks = Vec::new();
        for (k, (hessian, continuous, integers)) in systems.into_iter().enumerate() {
            let is_used = !is_schur_factor_cheapest(hessian, integers, ordering);
            if is_used && hessian.rows() >= WORTH_A_THREAD {
                let block = ContinuousBlock::new(hessian, continuous, integers, ordering)?;
                blocks.push((k, block));
            }
        }
        Ok(MadeAhead {
            parts,
            blocks,
            waited: 0.0,
        })
    }
}

impl Factors {
    /// No factor yet. Each one will be made in this order.
    pub fn new(ordering: Ordering) -> Self {
        Factors {
            ordering,
            ..Factors::default()
        }
    }

    /// As [`new`](Self::new), but a copy of each factor that a solve uses up is kept for the next solve.
    pub fn kept(ordering: Ordering) -> Self {
        Factors {
            keep: true,
            ..Factors::new(ordering)
        }
    }

    /// No factor yet, to be made and kept as these.
    pub fn anew(&self) -> Self {
        Factors {
            keep: self.keep,
            ..Factors::new(self.ordering)
        }
    }

    /// From now on, relaxations are solved with the factors of the search that follows.
    pub fn expect_search(&mut self) {
        self.is_searched = true;
    }

    /// The factors of component `k` of the model.
    pub fn of_component(&mut self, k: usize) -> &mut Factors {
        while self.components.len() <= k {
            let next = self.anew();
            self.components.push(next);
        }
        &mut self.components[k]
    }

    /// The number of entries below the diagonal of the relaxation's factor, if it has been made.
    pub fn entries(&self) -> usize {
        let schur_factor = self.schur_factor.as_ref();
        let of_schur_factor = || schur_factor.map_or(0, |j| j.whole().entries());
        self.relaxed_entries.unwrap_or_else(of_schur_factor)
    }

    /// The seconds spent in factorizations so far.
    pub fn seconds(&self) -> f64 {
        self.seconds + self.components.iter().map(Factors::seconds).sum::<f64>()
    }

    /// The factor of the whole reduced Hessian, with all integers real.
    pub fn relaxed(&mut self, model: &ReducedModel) -> Result<&RelaxedFactor> {
        let factor = match self.relaxed.take() {
            Some(factor) => factor,
            None => timed(&mut self.seconds, || {
                RelaxedFactor::ordered(model.hessian(), model.integers(), self.ordering)
            })?,
        };
        self.relaxed_entries = Some(factor.entries());
        Ok(self.relaxed.insert(factor))
    }

    /// Frees the factor of the relaxation, which has been solved, unless factors are kept.
    pub fn free_relaxed(&mut self) {
        if !self.keep {
            self.relaxed = None;
        }
    }

    /// Whether what the search needs later is worth a thread of its own while the relaxation is solved.
    pub fn is_worth_making_ahead(&self, model: &ReducedModel, strategy: Strategy) -> bool {
        let is_large = (WORTH_A_THREAD..=MOST_AHEAD).contains(&model.dim());
        let is_worth_it = allowed_threads() > 1 && is_large;
        let has_block = |factors: &Factors| factors.continuous.is_some();
        let is_known = has_block(self) || self.components.iter().any(has_block);
        let is_used = self.is_searched(strategy) && !model.integers().is_empty();
        is_worth_it
            && is_used
            && self.relaxed.is_none()
            && !is_known
            && !self.has_schur_factor(model)
    }

    /// The components of the model, or none if all its integers are in one.
    pub fn split(&mut self, model: &ReducedModel) -> Result<Vec<Component>> {
        let parts = match self.parts.take() {
            Some(parts) => parts,
            None => parts(model)?,
        };
        let components = parts.iter().map(|part| part.of(model)).collect();
        if self.keep {
            self.parts = Some(parts);
        }
        Ok(components)
    }

    /// Keeps what was [made ahead](MadeAhead::during).
    pub fn keep(&mut self, ahead: MadeAhead) {
        self.seconds += ahead.waited;
        for (k, block) in ahead.blocks {
            let of = match ahead.parts.is_empty() {
                true => &mut *self,
                false => self.of_component(k),
            };
            of.continuous = Some(block);
        }
        self.parts = Some(ahead.parts);
    }

    /// Whether a search follows.
    fn is_searched(&self, strategy: Strategy) -> bool {
        strategy != Strategy::Relax || self.is_searched
    }

    /// Makes the order and the pattern of the factor that the relaxation needs, if that is the one with the integers
    /// last.
    pub fn analyse(&mut self, model: &ReducedModel, strategy: Strategy) -> Result<()> {
        let is_needed = self.is_searched(strategy) && self.has_schur_factor(model);
        if is_needed && self.schur_factor.is_none() && self.schur_analysis.is_none() {
            let made = timed(&mut self.seconds, || {
                SchurFactor::analyse(model.hessian(), model.continuous(), model.integers())
            })?;
            self.schur_analysis = Some(made);
        }
        Ok(())
    }

    /// Minimises the objective with all integers real, with a factor that `strategy` needs as well.
    pub fn minimise(
        &mut self,
        model: &ReducedModel,
        strategy: Strategy,
        rounding: impl FnOnce() -> Vec<f64>,
    ) -> Result<Minimum> {
        let (gradient, guess) = (model.gradient(), model.guess());
        if self.is_searched(strategy) && self.has_schur_factor(model) {
            let factor = self.schur_factor(model)?.whole();
            return minimise(model.hessian(), gradient, rounding, guess, factor);
        }
        self.relaxed(model)?.minimise(gradient, rounding, guess)
    }

    /// A direction in which the computed Hessian has no curvature, a combination of all of them, and
    /// the smallest pivot that did not vanish. None if the Hessian is definite.
    pub fn null_direction(
        &mut self,
        model: &ReducedModel,
        strategy: Strategy,
    ) -> Result<Option<(Vec<f64>, f64)>> {
        if self.is_searched(strategy) && self.has_schur_factor(model) {
            return self.schur_factor(model)?.whole().null_direction();
        }
        self.relaxed(model)?.null_direction()
    }

    /// A factor in which unknowns can be fixed. The caller owns it, since fixing unknowns uses it up. None
    /// if `go_on` stopped the factorization.
    pub fn updatable(
        &mut self,
        model: &ReducedModel,
        go_on: impl FnMut() -> bool,
    ) -> Result<Option<UpdatableFactor>> {
        if self.has_schur_factor(model) {
            let (r, _) = self.schur_block(model)?;
            return Ok(Some(UpdatableFactor {
                ldl: Ldl::dense(r, model.integers().len()),
                unknowns: model.integers().to_vec(),
                integers: (0..model.integers().len() as u32).collect(),
            }));
        }
        let (keep, ordering) = (self.keep, self.ordering);
        let kept = &mut self.updatable;
        let ldl = timed(&mut self.seconds, || {
            if let Some(ldl) = kept {
                return Ok(Some(ldl.clone()));
            }
            let order = ordering.order(model.hessian())?;
            let made = Ldl::new_while(model.hessian(), &order, go_on)?;
            if keep {
                kept.clone_from(&made);
            }
            Ok(made)
        })?;
        Ok(ldl.map(|ldl| UpdatableFactor {
            ldl,
            unknowns: (0..model.dim() as u32).collect(),
            integers: model.integers().to_vec(),
        }))
    }

    /// The Schur complement of the integers as `R'R`: the upper triangular `R` by columns, and whether all
    /// pivots are nonzero. A zero pivot makes its row zero.
    pub fn schur_block(&mut self, model: &ReducedModel) -> Result<(&[f64], bool)> {
        Ok(self.schur_factor(model)?.schur())
    }

    /// Whether a single factor with the integers last is the cheapest choice: the block of the integers has
    /// fewer entries than the model.
    pub fn has_schur_factor(&self, model: &ReducedModel) -> bool {
        is_schur_factor_cheapest(model.hessian(), model.integers(), self.ordering)
    }

    /// The factor of the whole reduced Hessian with the integers last.
    fn schur_factor(&mut self, model: &ReducedModel) -> Result<&SchurFactor> {
        let factor = match self.schur_factor.take() {
            Some(factor) => factor,
            None => timed(&mut self.seconds, || {
                let (hessian, integers) = (model.hessian(), model.integers());
                match self.schur_analysis.take() {
                    Some(analysis) => SchurFactor::with(&analysis, hessian, integers.len()),
                    None => SchurFactor::new(hessian, model.continuous(), integers),
                }
            })?,
        };
        Ok(self.schur_factor.insert(factor))
    }

    /// The Schur factor, if it is the cheapest and all its pivots are nonzero. Then it solves for the
    /// continuous unknowns as well.
    fn definite_schur_factor(&mut self, model: &ReducedModel) -> Result<Option<&SchurFactor>> {
        if !self.has_schur_factor(model) {
            return Ok(None);
        }
        let factor = self.schur_factor(model)?;
        Ok(factor.is_definite().then_some(factor))
    }

    /// Whether the factor that [`follow`](Self::follow) needs has been made.
    pub fn is_prepared(&self) -> bool {
        let schur_factor = self.schur_factor.as_ref();
        self.continuous.is_some() || schur_factor.is_some_and(SchurFactor::is_definite)
    }

    /// Makes the factor that [`follow`](Self::follow) needs.
    pub fn prepare(&mut self, model: &ReducedModel) -> Result<()> {
        if self.definite_schur_factor(model)?.is_none() {
            self.continuous(model)?;
        }
        Ok(())
    }

    /// Solves `A_cc x_c = b_c` in place. The entries of integers stay as they are.
    pub fn solve_continuous(&mut self, model: &ReducedModel, b: &mut [f64]) -> Result<()> {
        if let Some(schur_factor) = self.definite_schur_factor(model)? {
            return schur_factor.solve_continuous(b);
        }
        let block = self.continuous(model)?;
        let of_continuous = model.continuous().iter().map(|&i| b[i as usize]);
        let mut part: Vec<f64> = of_continuous.collect();
        block.factor.solve(&mut part)?;
        for (&i, x) in model.continuous().iter().zip(part) {
            b[i as usize] = x;
        }
        Ok(())
    }

    /// Minimises over the continuous unknowns, starting from `point`, with the integers of `point`. The
    /// relaxation must have a minimum.
    pub fn follow(&mut self, model: &ReducedModel, point: &[f64]) -> Result<Vec<f64>> {
        if let Some(schur_factor) = self.definite_schur_factor(model)? {
            return follow_by_schur_factor(model, schur_factor, point);
        }
        self.continuous(model)?.follow(model, point)
    }

    /// The continuous block and its factor.
    fn continuous(&mut self, model: &ReducedModel) -> Result<&ContinuousBlock> {
        let block = match self.continuous.take() {
            Some(block) => block,
            None => timed(&mut self.seconds, || {
                let (continuous, integers) = (model.continuous(), model.integers());
                ContinuousBlock::new(model.hessian(), continuous, integers, self.ordering)
            })?,
        };
        Ok(self.continuous.insert(block))
    }
}

impl ContinuousBlock {
    fn new(
        whole: &Sparse,
        continuous: &[u32],
        integers: &[u32],
        ordering: Ordering,
    ) -> Result<Self> {
        let hessian = principal_submatrix(whole, continuous)?;
        may_continue()?;
        let coupling = coupling(whole, continuous, integers)?;
        may_continue()?;
        let factor = Cholesky::ordered(&hessian, ordering)?;
        Ok(ContinuousBlock {
            hessian,
            coupling,
            factor,
        })
    }

    fn follow(&self, model: &ReducedModel, point: &[f64]) -> Result<Vec<f64>> {
        let of = |unknowns: &[u32], v: &[f64]| -> Vec<f64> {
            unknowns.iter().map(|&i| v[i as usize]).collect()
        };
        let mut gradient = of(model.continuous(), model.gradient());
        let pull = self.coupling.mul(&of(model.integers(), point));
        for (g, p) in gradient.iter_mut().zip(pull) {
            *g += p;
        }
        let start = of(model.continuous(), point);
        let best = minimise_bounded(&self.hessian, &gradient, &start, &self.factor)?;
        let mut whole = point.to_vec();
        for (&i, x) in model.continuous().iter().zip(best) {
            whole[i as usize] = x;
        }
        Ok(whole)
    }
}

/// [`Factors::has_schur_factor`] for a Hessian and the integers among its unknowns.
fn is_schur_factor_cheapest(hessian: &Sparse, integers: &[u32], ordering: Ordering) -> bool {
    let m = integers.len();
    ordering == Ordering::FillReducing && m * m <= hessian.len()
}

/// [`Factors::follow`] with the leading part of a definite factor and one step of refinement, as in
/// [`minimise_bounded`].
fn follow_by_schur_factor(
    model: &ReducedModel,
    schur_factor: &SchurFactor,
    point: &[f64],
) -> Result<Vec<f64>> {
    let mut point = point.to_vec();
    for _ in 0..2 {
        may_continue()?;
        let mut step = residual(model.hessian(), model.gradient(), &point);
        may_continue()?;
        schur_factor.solve_continuous(&mut step)?;
        for &i in model.continuous() {
            point[i as usize] += step[i as usize];
        }
    }
    Ok(point)
}

/// Calls `make` and adds its time to `seconds`.
fn timed<T>(seconds: &mut f64, make: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let made = make();
    *seconds += started.elapsed().as_secs_f64();
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eliminate::eliminate;
    use crate::monitor::Monitor;
    use crate::problem::{Model, Problem};

    #[test]
    fn the_factor_of_a_relaxation_is_freed_where_it_is_not_kept() {
        let mut problem = Problem::new(3).unwrap();
        for i in 0..3 {
            problem
                .add_least_squares(&[i, (i + 1) % 3], &[1.0, -0.5], 0.3, 1.0)
                .unwrap();
        }
        let model = Model::new(&problem).unwrap();
        let reduced = eliminate(&model, &mut Monitor::default()).unwrap();
        for (made, is_kept) in [(Factors::new as fn(_) -> _, false), (Factors::kept, true)] {
            let mut factors: Factors = made(Ordering::FillReducing).anew();
            let before = factors.relaxed(&reduced).unwrap().entries();
            assert_eq!(before, 3);
            factors.free_relaxed();
            assert_eq!(factors.relaxed.is_some(), is_kept);
            assert_eq!(factors.entries(), before);
            assert!(factors.relaxed(&reduced).is_ok(), "it is made again");
        }
    }

    #[test]
    fn a_pattern_that_was_analysed_serves_the_factor_that_a_relaxation_needs() {
        let mut problem = Problem::new(30).unwrap();
        for i in 1..30 {
            let spring = [i - 1, i];
            problem
                .add_least_squares(&spring, &[1.0, -1.0], 0.3, 1.0)
                .unwrap();
        }
        problem.add_least_squares(&[0], &[1.0], 0.0, 1.0).unwrap();
        problem.set_integers(&[4, 17]).unwrap();
        let model = Model::new(&problem).unwrap();
        let reduced = eliminate(&model, &mut Monitor::default()).unwrap();
        let mut factors = Factors::kept(Ordering::FillReducing);
        factors.analyse(&reduced, Strategy::Relax).unwrap();
        assert!(factors.schur_analysis.is_none(), "nothing is searched");
        factors.expect_search();
        factors.analyse(&reduced, Strategy::Relax).unwrap();
        assert!(factors.schur_analysis.is_some());
        let minimum = factors
            .minimise(&reduced, Strategy::Relax, Vec::new)
            .unwrap();
        assert!(factors.schur_analysis.is_none() && factors.schur_factor.is_some());
        let mut others = Factors::kept(Ordering::FillReducing);
        others.expect_search();
        let expected = others
            .minimise(&reduced, Strategy::Relax, Vec::new)
            .unwrap();
        assert_eq!(minimum, expected);
        factors.analyse(&reduced, Strategy::Relax).unwrap();
        assert!(factors.schur_analysis.is_none(), "the factor is there");
    }
}
