//! Adaptive greedy rounding: several integers at a time, with re-optimisation only as far as needed.
//!
//! The method is that of `bommes2012`, chapter 5, and `bommes2009`, section 3. Each pass rounds the
//! integers with the least deviations. It takes as many as have a sum of at most a threshold. Then it
//! re-optimises by Gauss-Seidel, starting from their neighbours. If that exceeds its budget, conjugate
//! gradients follow, and if these fail, a factorization.
//!
//! Large problems are first rounded in [regions](super::regions), several at a time. With few integers, or where
//! their Schur complement is small, exact greedy rounding takes no longer and is used instead, and
//! [coordinate descent](super::descend) follows.

use super::candidates::Candidates;
use super::descend::descend;
use super::greedy;
use super::regions::round_in_regions;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::linalg::{Effort, LocalSolve, Wave, conjugate_gradient, minimise_fixed};
use crate::monitor::{Phase, both, span};
use crate::search::{Factors, Options, Search};

/// Gauss-Seidel updates between two checks of the monitor.
pub(super) const UPDATES_AT_A_TIME: usize = 10_000;

/// So few integers are rounded exactly, whatever the size of their Schur complement.
const FEW: usize = 256;

/// The factor of so many unknowns is made beside what Gauss-Seidel needs.
const LARGE: usize = 1 << 14;

/// The most Gauss-Seidel updates of all passes, for each unknown, unless a single pass may make more.
/// Meshes of tens of thousands of faces take a few; where many passes each move much of the problem, there
/// would be no end.
pub(super) const UPDATES_PER_UNKNOWN: usize = 128;

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
/// If the caller wants the results so far, few and large passes round what is left. After [`UPDATES_PER_UNKNOWN`], and
/// where a callback ends the search, it offers the integers decided so far and rounds the others.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), the end of the call, and the errors of [`Search::offer`].
pub(crate) fn adaptive(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let _span = span("adaptive rounding");
    let integers = model.integers();
    let is_cheap = integers.len() <= FEW || factors.has_schur_factor(model);
    if integers.len() <= options.exact_integers && is_cheap {
        let rounded = greedy(model, factors, search)?;
        // One that was known before may be better, and yet end higher than what was rounded now.
        let known = search.incumbent_integers().filter(|best| *best != rounded);
        for start in [Some(rounded), known].into_iter().flatten() {
            if search.ends(0) {
                break;
            }
            descend(model, start, factors, search)?;
        }
        return Ok(());
    }
    let is_large = model.dim() >= LARGE && !factors.is_prepared();
    let (hessian, gradient) = (model.hessian(), model.gradient());
    let relaxed = search.relaxed().to_vec();
    let (prepared, solve) = both(
        is_large,
        || search.prepare(factors),
        || LocalSolve::new(hessian, gradient, &relaxed, integers),
    );
    prepared?;
    drop(relaxed);
    let mut passes = Passes {
        model,
        options,
        solve: solve?,
        wave: Wave::default(),
        left: integers.len(),
        global_steps: (GLOBAL_UNKNOWNS / model.dim().max(1)).max(1),
        updates: (UPDATES_PER_UNKNOWN * model.dim()).max(options.gauss_seidel_updates),
    };
    passes.in_regions(search);
    search.monitor.is_awaited()?;
    let mut candidates = Candidates::new(model.dim());
    for &i in integers {
        if let Some(value) = passes.undecided(i) {
            candidates.push(i, value);
        }
    }
    while passes.left > 0 && passes.updates > 0 {
        let done = 1.0 - passes.left as f64 / integers.len() as f64;
        if search.monitor.ends_at(Phase::Round, done) {
            search.monitor.is_awaited()?;
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
        let (solve, wave) = (&passes.solve, &mut passes.wave);
        solve.take_moved(wave, |i| candidates.push(i, solve.value(i)));
    }
    let nearest = |&i: &u32| model.nearest(i as usize, passes.solve.value(i));
    let rounded: Vec<f64> = integers.iter().map(nearest).collect();
    drop(passes);
    search.offer(factors, &rounded)?;
    Ok(())
}

/// The state of the passes.
struct Passes<'a> {
    model: &'a ReducedModel,
    options: &'a Options,
    solve: LocalSolve<'a>,
    wave: Wave,
    left: usize,
    /// The updates that are left.
    updates: usize,
    /// The systems that may still be solved.
    global_steps: usize,
}

impl Passes<'_> {
    /// The value of an integer that has not been rounded yet.
    fn undecided(&self, unknown: u32) -> Option<f64> {
        (!self.solve.is_fixed(unknown)).then(|| self.solve.value(unknown))
    }

    fn round(&mut self, unknown: u32) {
        let nearest = self
            .model
            .nearest(unknown as usize, self.solve.value(unknown));
        self.solve.fix(unknown, nearest, &mut self.wave);
        self.left -= 1;
    }

    /// Rounds what is left in a few large passes.
    fn finish(&mut self, candidates: &mut Candidates) {
        let tolerance = HASTY_TOLERANCE * self.options.gauss_seidel_tolerance;
        let mut budget = HASTY_UPDATES * self.model.dim();
        while self.left > 0 && budget > 0 {
            // The pass that the caller interrupted comes first.
            budget -= self
                .solve
                .relax(&mut self.wave, tolerance, budget, |_| true);
            let (solve, wave) = (&self.solve, &mut self.wave);
            solve.take_moved(wave, |i| candidates.push(i, solve.value(i)));
            let threshold = HASTE * self.left as f64;
            let threshold = self.options.rounding_threshold.max(threshold);
            for i in candidates.take(threshold, |i| self.undecided(i)) {
                self.round(i);
            }
        }
    }

    /// Rounds what can be rounded in regions of a large problem.
    fn in_regions(&mut self, search: &mut Search) {
        let rounded = round_in_regions(self.model, self.options, &self.solve, search.monitor);
        self.left -= rounded.count;
        self.updates = self.updates.saturating_sub(rounded.updates);
        self.wave = rounded.wave;
        self.relax(self.updates, search);
        self.solve.take_moved(&mut self.wave, |_| {});
    }

    /// Re-optimises locally by so many updates at most. Returns whether the search goes on.
    fn relax(&mut self, mut budget: usize, search: &mut Search) -> bool {
        let tolerance = self.options.gauss_seidel_tolerance;
        while budget > 0 && !self.wave.is_settled() {
            let most = budget.min(UPDATES_AT_A_TIME);
            let made = self.solve.relax(&mut self.wave, tolerance, most, |_| true);
            budget -= made;
            self.updates = self.updates.saturating_sub(made);
            if search.monitor.ends() {
                return false;
            }
        }
        true
    }

    /// Re-optimises locally, then iteratively, then exactly.
    fn reoptimise(&mut self, factors: &mut Factors, search: &mut Search) -> Result<()> {
        let options = self.options;
        if !self.relax(options.gauss_seidel_updates, search) {
            return Ok(());
        }
        if self.wave.is_settled() || self.global_steps == 0 {
            return Ok(());
        }
        self.global_steps -= 1;
        let mut point = self.solve.point();
        let all = 0..self.model.dim() as u32;
        let fixed: Vec<bool> = all.map(|i| self.solve.is_fixed(i)).collect();
        let converged = conjugate_gradient(
            self.model.hessian(),
            self.model.gradient(),
            factors.relaxed(self.model)?,
            &fixed,
            &mut point,
            Effort {
                iterations: options.cg_iterations,
                tolerance: options.cg_tolerance,
            },
            || !search.monitor.ends(),
        )?;
        if !converged && options.exact_steps && !search.monitor.ends() {
            let (hessian, gradient) = (self.model.hessian(), self.model.gradient());
            point = minimise_fixed(hessian, gradient, &fixed, &point)?;
        }
        self.solve.settle_at(&point, &mut self.wave);
        Ok(())
    }
}
