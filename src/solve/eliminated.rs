//! The solve of a problem after elimination: right sides, relaxation, search, expansion, verification.

use super::candidate::Candidate;
use super::dispatch;
use super::expand::expand;
use super::relax::{Relaxation, relax};
use super::solution::{Counts, Seconds, Solution};
use crate::eliminate::{Elimination, ReducedModel};
use crate::error::{Error, Result};
use crate::monitor::{Monitor, Phase};
use crate::problem::{Model, Problem};
use crate::round;
use crate::search::{
    Factors, Options, Search, SolveStatus, StoppedBy, Strategy, WarmStart, of_relaxation,
};

/// A problem with all results that do not depend on its right sides.
pub(super) struct EliminatedProblem<'a> {
    pub problem: &'a Problem,
    pub model: &'a Model,
    pub elimination: &'a Elimination,
    pub factors: &'a mut Factors,
    /// The start of a warm start, in the caller's unknowns.
    pub earlier: &'a [f64],
}

impl EliminatedProblem<'_> {
    /// Relaxation, search, expansion and verification.
    pub fn search(
        &mut self,
        reduced: &ReducedModel,
        clock: &Clock,
        options: &Options,
        monitor: &mut Monitor,
    ) -> Result<Solution> {
        let start = match options.warm_start {
            WarmStart::Off => None,
            WarmStart::Offer | WarmStart::Keep => {
                let point = self.elimination.restrict(reduced, self.earlier);
                let integers = reduced.integers().iter();
                Some(
                    integers
                        .map(|&i| round::nearest(point[i as usize]))
                        .collect(),
                )
            }
        };
        let decided = decide(self.model, reduced, options, start, self.factors, monitor)?;
        self.conclude(reduced, decided, options.strategy, clock, monitor)
    }

    /// The reduced model for the current right sides, and the time when it was made.
    pub fn reduce(&mut self, monitor: &mut Monitor) -> Result<(ReducedModel, Clock)> {
        let reduced = self.elimination.reduce(self.model, monitor)?;
        let clock = Clock {
            eliminated: monitor.seconds(),
            factored_before: self.factors.seconds(),
        };
        Ok((reduced, clock))
    }

    /// Expansion and verification.
    pub fn conclude(
        &mut self,
        reduced: &ReducedModel,
        found: SearchResult,
        strategy: Strategy,
        clock: &Clock,
        monitor: &mut Monitor,
    ) -> Result<Solution> {
        let searched = monitor.seconds();
        let factored = self.factors.seconds() - clock.factored_before;

        let candidate = Candidate {
            values: expand(reduced, self.model, strategy, &found.point),
            energy: reduced.energy(&found.point).0,
            lower_bound: found.lower_bound,
            status: found.status,
            complete: found.complete,
            stopped_by: found.stopped_by,
            has_integers: !reduced.integers().is_empty(),
        };
        let (candidate, verdict) = candidate.verified(self.problem)?;
        Ok(Solution {
            values: candidate.values,
            energy: verdict.energy,
            lower_bound: Some(candidate.lower_bound),
            status: candidate.status,
            complete: candidate.complete,
            stopped_by: candidate.stopped_by,
            work: found.work,
            counts: counts(self.model, reduced, self.factors),
            seconds: Seconds {
                eliminate: clock.eliminated,
                factor: factored,
                round: searched - clock.eliminated - factored,
                total: monitor.seconds(),
            },
            max_constraint_violation: verdict.constraint_violation,
            max_integrality_violation: verdict.integrality_violation,
        })
    }
}

/// The seconds before the search.
pub(super) struct Clock {
    eliminated: f64,
    factored_before: f64,
}

/// The result of a search.
pub(super) struct SearchResult {
    /// In reduced unknowns.
    pub point: Vec<f64>,
    pub lower_bound: f64,
    pub status: SolveStatus,
    pub complete: bool,
    pub stopped_by: StoppedBy,
    /// Multiplications, including those of the relaxation.
    pub work: u64,
}

fn decide(
    model: &Model,
    reduced: &ReducedModel,
    options: &Options,
    start: Option<Vec<f64>>,
    factors: &mut Factors,
    monitor: &mut Monitor,
) -> Result<SearchResult> {
    monitor.progress(Phase::Factor, 0.0)?;
    let relaxation = relax(model, reduced, options.strategy, factors)?;
    let work = of_relaxation(reduced);
    let relaxed = |status: SolveStatus, relaxation: Relaxation| SearchResult {
        point: relaxation.point,
        lower_bound: relaxation.lower_bound,
        complete: status == SolveStatus::Optimal,
        stopped_by: StoppedBy::Nothing,
        status,
        work,
    };
    if reduced.integers().is_empty() {
        return Ok(relaxed(SolveStatus::Optimal, relaxation));
    }
    if options.strategy == Strategy::Relax {
        return Ok(relaxed(SolveStatus::Relaxed, relaxation));
    }
    monitor.check()?;
    let mut search = Search::new(reduced, relaxation.point, relaxation.lower_bound, monitor);
    if let Some(integers) = start {
        search.offer(factors, &integers)?;
    }
    // An optimal solution cannot be improved.
    let done = search.status() == SolveStatus::Optimal || options.warm_start == WarmStart::Keep;
    if !done {
        match dispatch::search(model, reduced, options, factors, &mut search) {
            // If the search was stopped, the best solution so far is kept.
            Err(Error::Cancelled | Error::TimeLimit) if search.best().is_some() => {}
            Err(Error::OutOfMemory { .. }) if search.best().is_some() => {
                search.stop_by(StoppedBy::Memory);
            }
            other => other?,
        }
    }
    let (lower_bound, status) = (search.lower_bound(), search.status());
    let (complete, stopped_by) = (search.is_complete(), search.stopped_by());
    let work = work + search.work.spent();
    Ok(SearchResult {
        point: search.into_best()?.point,
        lower_bound,
        status,
        complete,
        stopped_by,
        work,
    })
}

fn counts(model: &Model, reduced: &ReducedModel, factors: &Factors) -> Counts {
    Counts {
        variables: model.variables(),
        integers: model.integer().iter().filter(|&&i| i).count(),
        constraints: model.constraints().rows(),
        reduced_integers: reduced.integers().len(),
        reduced_continuous: reduced.continuous().len(),
        factor_nonzeros: factors.entries(),
    }
}
