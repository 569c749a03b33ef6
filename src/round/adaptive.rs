//! Adaptive greedy rounding: several integers at a time, with re-optimisation only as far as needed.
//!
//! The method is that of `bommes2012`, chapter 5, and `bommes2009`, section 3. Each pass rounds the
//! integers with the least deviations. It takes as many as have a sum of at most a threshold. Then it
//! re-optimises by Gauss-Seidel, starting from their neighbours. If that exceeds its budget, conjugate
//! gradients follow, and if these fail, a factorization.
//!
//! With few integers, exact greedy rounding is faster and is used instead.

use super::candidates::Candidates;
use super::greedy;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::linalg::{Effort, LocalSolve, conjugate_gradient, minimise_fixed};
use crate::monitor::Phase;
use crate::search::{Factors, Options, Search};

/// Gauss-Seidel updates between two checks of the monitor.
const UPDATES_AT_A_TIME: usize = 10_000;

/// The most Gauss-Seidel updates of all passes, for each unknown, unless a single pass may make more.
/// Meshes of tens of thousands of faces take a few; where many passes each move much of the problem, there
/// would be no end.
const UPDATES_PER_UNKNOWN: usize = 128;

/// The most unknowns of all systems that conjugate gradients and factorizations solve, unless it is one system.
/// A factorization takes as long as a hundred updates an unknown. After that, passes go on from values that
/// Gauss-Seidel has not brought to rest.
const GLOBAL_UNKNOWNS: usize = 1 << 18;

/// Where the caller wants a result, what is left is rounded in passes whose deviations may sum up to this for
/// each integer left, ...
const HASTE: f64 = 0.003;

/// ... with this many times the tolerance, ...
const HASTY_TOLERANCE: f64 = 10.0;

/// ... and this many updates for each unknown in all. A field of 200,000 faces then gets twice as many irregular
/// vertices, for a tenth of the updates. Rounding the relaxation once gives it fifty times as many, and rounding
/// the map of that field takes minutes.
const HASTY_UPDATES: usize = 20;

/// Rounds by passes.
///
/// If the caller wants a result, few and large passes round what is left. If it has to stop for another reason,
/// or after [`UPDATES_PER_UNKNOWN`], it offers the integers decided so far and rounds the others.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the errors of [`Search::offer`].
pub(crate) fn adaptive(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let integers = model.integers();
    if integers.len() <= options.exact_integers {
        return greedy(model, factors, search);
    }
    search.prepare(factors)?;
    let mut passes = Passes {
        model,
        options,
        solve: LocalSolve::new(
            model.hessian(),
            model.gradient(),
            search.relaxed(),
            integers,
        )?,
        fixed: vec![false; model.dim()],
        left: integers.len(),
        global_steps: (GLOBAL_UNKNOWNS / model.dim().max(1)).max(1),
        updates: (UPDATES_PER_UNKNOWN * model.dim()).max(options.gauss_seidel_updates),
    };
    let mut candidates = Candidates::new(model.dim());
    for &i in integers {
        candidates.push(i, search.relaxed()[i as usize]);
    }
    while passes.left > 0 && passes.updates > 0 {
        let done = 1.0 - passes.left as f64 / integers.len() as f64;
        if search.monitor.ends_at(Phase::Round, done) {
            if search.monitor.finishes() {
                passes.finish(&mut candidates);
            }
            break;
        }
        let batch = candidates.take(options.rounding_threshold, |i| passes.undecided(i));
        for &i in &batch {
            passes.round(i);
        }
        passes.reoptimise(factors, search)?;
        for i in passes.solve.take_moved() {
            candidates.push(i, passes.solve.value(i));
        }
    }
    let nearest = |&i: &u32| model.nearest(i as usize, passes.solve.value(i));
    let rounded: Vec<f64> = integers.iter().map(nearest).collect();
    search.offer(factors, &rounded)?;
    Ok(())
}

/// The state of the passes.
struct Passes<'a> {
    model: &'a ReducedModel,
    options: &'a Options,
    solve: LocalSolve<'a>,
    fixed: Vec<bool>,
    left: usize,
    /// The updates that are left.
    updates: usize,
    /// The systems that may still be solved.
    global_steps: usize,
}

impl Passes<'_> {
    /// The value of an integer that has not been rounded yet.
    fn undecided(&self, unknown: u32) -> Option<f64> {
        let i = unknown as usize;
        (!self.fixed[i]).then(|| self.solve.value(unknown))
    }

    fn round(&mut self, unknown: u32) {
        let value = self.solve.value(unknown);
        self.solve
            .fix(unknown, self.model.nearest(unknown as usize, value));
        self.fixed[unknown as usize] = true;
        self.left -= 1;
    }

    /// Rounds what is left in a few large passes.
    fn finish(&mut self, candidates: &mut Candidates) {
        let tolerance = HASTY_TOLERANCE * self.options.gauss_seidel_tolerance;
        let mut budget = HASTY_UPDATES * self.fixed.len();
        while self.left > 0 && budget > 0 {
            // The pass that the caller interrupted comes first.
            budget -= self.solve.relax(tolerance, budget);
            for i in self.solve.take_moved() {
                candidates.push(i, self.solve.value(i));
            }
            let threshold = HASTE * self.left as f64;
            let threshold = self.options.rounding_threshold.max(threshold);
            for i in candidates.take(threshold, |i| self.undecided(i)) {
                self.round(i);
            }
        }
    }

    /// Re-optimises locally, then iteratively, then exactly.
    fn reoptimise(&mut self, factors: &mut Factors, search: &mut Search) -> Result<()> {
        let options = self.options;
        let mut budget = options.gauss_seidel_updates;
        while budget > 0 && !self.solve.is_settled() {
            let tolerance = options.gauss_seidel_tolerance;
            let made = self.solve.relax(tolerance, budget.min(UPDATES_AT_A_TIME));
            budget -= made;
            self.updates = self.updates.saturating_sub(made);
            if search.monitor.ends() {
                return Ok(());
            }
        }
        if self.solve.is_settled() || self.global_steps == 0 {
            return Ok(());
        }
        self.global_steps -= 1;
        let mut point = self.solve.point();
        let converged = conjugate_gradient(
            self.model.hessian(),
            self.model.gradient(),
            factors.relaxed(self.model)?,
            &self.fixed,
            &mut point,
            Effort {
                iterations: options.cg_iterations,
                tolerance: options.cg_tolerance,
            },
            || !search.monitor.ends(),
        )?;
        if !converged && options.exact_steps && !search.monitor.ends() {
            let (hessian, gradient) = (self.model.hessian(), self.model.gradient());
            point = minimise_fixed(hessian, gradient, &self.fixed, &point)?;
        }
        self.solve.settle_at(&point);
        Ok(())
    }
}
