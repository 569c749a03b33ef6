//! One solve from beginning to end: validate, eliminate, relax, search, expand, verify.

use super::claim::Claim;
use super::relax::{Relaxation, relax};
use super::solution::{Counts, Seconds, Solution};
use crate::eliminate::{Elimination, ReducedModel};
use crate::monitor::Monitor;
use crate::monitor::Phase;
use crate::search::Factors;
use crate::search::Search;
use crate::search::of_relaxation;
use crate::search::{Options, SolveStatus, Strategy, WarmStart};
use crate::{Error, Model, Problem, Result, round};

/// Solves `problem`, watched by nobody.
///
/// # Errors
/// Everything that [`Error`](crate::Error) names: bad input, contradictory constraints, an
/// objective that is unbounded or not convex, out of time before a first solution.
pub fn solve(problem: &Problem, options: &Options) -> Result<Solution> {
    solve_with(problem, options, Monitor::default())
}

/// Solves `problem` under the eyes of `monitor`, which hears of progress and of every better
/// solution, and may cancel.
///
/// # Errors
/// As [`solve`], and [`Error::Cancelled`](crate::Error::Cancelled) when cancelled before a first
/// solution was found.
pub fn solve_with(problem: &Problem, options: &Options, mut monitor: Monitor) -> Result<Solution> {
    monitor.start(options.time_limit);
    monitor.check()?;
    let model = Model::new(problem)?;
    tell_of_ignored_hint(&model, &mut monitor);
    let prepared = Prepared {
        problem,
        model: &model,
        elimination: &Elimination::new(&model, options.ordering, &mut monitor)?,
        factors: &mut Factors::new(options.ordering),
        earlier: model.guess(),
    };
    prepared.solve(options, &mut monitor)
}

pub(super) fn tell_of_ignored_hint(model: &Model, monitor: &mut Monitor) {
    if let Some(cycle) = model.ignored_hint() {
        monitor.log(&format!(
            "cycle hint ignored: unknowns of cycle {cycle} do not cancel"
        ));
    }
}

/// A problem with all that does not depend on its right sides.
pub(super) struct Prepared<'a> {
    pub problem: &'a Problem,
    pub model: &'a Model,
    pub elimination: &'a Elimination,
    pub factors: &'a mut Factors,
    /// Where a warm start begins, in the caller's unknowns.
    pub earlier: &'a [f64],
}

impl Prepared<'_> {
    /// Right sides, relaxation, search, expansion, verification; in short steps where that is called for.
    pub fn solve(mut self, options: &Options, monitor: &mut Monitor) -> Result<Solution> {
        let (reduced, clock) = self.reduce(monitor)?;
        match self.solve_reformulated(&reduced, options, monitor)? {
            Some(solution) => Ok(solution),
            None => self.search(&reduced, &clock, options, monitor),
        }
    }

    /// As [`solve`](Self::solve), in the unknowns that the elimination leaves.
    pub(super) fn solve_as_it_is(
        mut self,
        options: &Options,
        monitor: &mut Monitor,
    ) -> Result<Solution> {
        let (reduced, clock) = self.reduce(monitor)?;
        self.search(&reduced, &clock, options, monitor)
    }

    fn search(
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

    /// The reduced model for the right sides as they are, and when that was.
    pub(super) fn reduce(&mut self, monitor: &mut Monitor) -> Result<(ReducedModel, Clock)> {
        let reduced = self.elimination.reduce(self.model, monitor)?;
        let clock = Clock {
            eliminated: monitor.seconds(),
            factored_before: self.factors.seconds(),
        };
        Ok((reduced, clock))
    }

    /// Expansion and verification.
    pub(super) fn conclude(
        &mut self,
        reduced: &ReducedModel,
        found: Decided,
        strategy: Strategy,
        clock: &Clock,
        monitor: &mut Monitor,
    ) -> Result<Solution> {
        let searched = monitor.seconds();
        let factored = self.factors.seconds() - clock.factored_before;

        let claim = Claim {
            values: expand(reduced, self.model, strategy, &found.point),
            lower_bound: found.lower_bound,
            status: found.status,
            decided: !reduced.integers().is_empty(),
        };
        let (claim, verdict) = claim.verified(self.problem)?;
        Ok(Solution {
            values: claim.values,
            energy: verdict.energy,
            lower_bound: Some(claim.lower_bound),
            status: claim.status,
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

/// Seconds when the search began.
pub(super) struct Clock {
    eliminated: f64,
    factored_before: f64,
}

/// How a search ended.
pub(super) struct Decided {
    /// In reduced unknowns.
    pub point: Vec<f64>,
    pub lower_bound: f64,
    pub status: SolveStatus,
    /// Multiplications, those of the relaxation included.
    pub work: u64,
}

fn decide(
    model: &Model,
    reduced: &ReducedModel,
    options: &Options,
    start: Option<Vec<f64>>,
    factors: &mut Factors,
    monitor: &mut Monitor,
) -> Result<Decided> {
    monitor.progress(Phase::Factor, 0.0)?;
    let relaxation = relax(model, reduced, options.strategy, factors)?;
    let work = of_relaxation(reduced);
    let relaxed = |status: SolveStatus, relaxation: Relaxation| Decided {
        point: relaxation.point,
        lower_bound: relaxation.lower_bound,
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
    // Nothing is better than what is optimal already.
    let done = search.status() == SolveStatus::Optimal || options.warm_start == WarmStart::Keep;
    if !done {
        match super::choose::search(model, reduced, options, factors, &mut search) {
            // Whatever ended the search, what was found stays.
            Err(Error::Cancelled | Error::TimeLimit) if search.best().is_some() => {}
            other => other?,
        }
    }
    let (lower_bound, status) = (search.lower_bound(), search.status());
    let work = work + search.work.spent();
    Ok(Decided {
        point: search.into_best()?.point,
        lower_bound,
        status,
        work,
    })
}

/// The caller's unknowns; pins and integers exact to the last bit.
fn expand(reduced: &ReducedModel, model: &Model, strategy: Strategy, point: &[f64]) -> Vec<f64> {
    let mut values = reduced.expansion().expand(point);
    for (i, x) in values.iter_mut().enumerate() {
        if let Some(pin) = model.pinned()[i] {
            *x = pin;
        } else if model.integer()[i] && strategy != Strategy::Relax {
            *x = x.round();
        }
        // No minus zero in anybody's output.
        *x += 0.0;
    }
    values
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
