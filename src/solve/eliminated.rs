//! The solve of a problem after elimination: right sides, relaxation, search, expansion, verification.

use super::around::around_relaxation;
use super::candidate::Candidate;
use super::components::by_components;
use super::expand::expand;
use super::relax::Relaxation;
use super::solution::{Counts, Seconds, Solution};
use crate::eliminate::{Centre, Elimination, ReducedModel};
use crate::error::Result;
use crate::monitor::{Monitor, Phase, may_continue};
use crate::problem::{Model, Problem};
use crate::round;
use crate::search::{
    Factors, MadeAhead, Options, SolveStatus, StoppedBy, Strategy, WarmStart, of_relaxation,
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
        let decided = decide(self, reduced, options, monitor)?;
        self.conclude(reduced, decided, clock, monitor)
    }

    /// The reduced model for the current right sides, and the time when it was made.
    pub fn reduce(&mut self, monitor: &mut Monitor) -> Result<(ReducedModel, Clock)> {
        let _watch = monitor.watch();
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
        clock: &Clock,
        monitor: &mut Monitor,
    ) -> Result<Solution> {
        // What the caller throws away need not be verified.
        may_continue()?;
        let searched = monitor.seconds();
        let factored = self.factors.seconds() - clock.factored_before;

        let candidate = Candidate {
            values: found.values,
            energy: found.energy,
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
    /// The caller's unknowns.
    pub values: Vec<f64>,
    pub energy: f64,
    pub lower_bound: f64,
    pub status: SolveStatus,
    pub complete: bool,
    pub stopped_by: StoppedBy,
    /// Multiplications, including those of the relaxation.
    pub work: u64,
}

/// The model around the relaxation's minimiser, and the relaxation of this model, while a factor for the search is
/// made on other threads where that is worth while.
fn relaxation(
    of: &mut EliminatedProblem,
    reduced: &ReducedModel,
    options: &Options,
) -> Result<(Centre, Relaxation)> {
    let (strategy, ordering) = (options.strategy, options.ordering);
    if !of.factors.is_worth_making_ahead(reduced, strategy)? {
        return around_relaxation(of, reduced, strategy);
    }
    let task = || around_relaxation(of, reduced, strategy);
    let (around, ahead) = MadeAhead::during(reduced, ordering, task);
    let around = around?;
    of.factors.keep(ahead?);
    Ok(around)
}

/// The relaxation, and the search around its minimiser.
fn decide(
    of: &mut EliminatedProblem,
    reduced: &ReducedModel,
    options: &Options,
    monitor: &mut Monitor,
) -> Result<SearchResult> {
    monitor.progress(Phase::Factor, 0.0)?;
    // Before the search there is no result that could be kept.
    let watch = monitor.watch();
    let (centre, relaxation) = relaxation(of, reduced, options)?;
    drop(watch);
    let work = of_relaxation(reduced);
    let status = match options.strategy {
        _ if reduced.integers().is_empty() => Some(SolveStatus::Optimal),
        Strategy::Relax => Some(SolveStatus::Relaxed),
        _ => None,
    };
    if let Some(status) = status {
        return Ok(SearchResult {
            values: expand(&centre, of.model, options.strategy, &relaxation.point),
            energy: centre.model().energy(&relaxation.point).0,
            lower_bound: relaxation.lower_bound,
            complete: status == SolveStatus::Optimal,
            stopped_by: StoppedBy::Nothing,
            status,
            work,
        });
    }
    monitor.check()?;
    let start = match options.warm_start {
        WarmStart::Off => None,
        WarmStart::Offer | WarmStart::Keep => Some(start(of, reduced, centre.model())),
    };
    let found = by_components(of, &centre, relaxation, options, start, monitor)?;
    Ok(SearchResult {
        values: expand(&centre, of.model, options.strategy, &found.point),
        energy: found.energy,
        lower_bound: found.lower_bound,
        status: found.status,
        complete: found.complete,
        stopped_by: found.stopped_by,
        work: work + found.work,
    })
}

/// The integers of a warm start, as steps from the centre of `model`.
fn start(of: &EliminatedProblem, reduced: &ReducedModel, model: &ReducedModel) -> Vec<f64> {
    let point = of.elimination.restrict(reduced, of.earlier);
    let step = |&i: &u32| round::nearest(point[i as usize]) - model.origin(i as usize);
    model.integers().iter().map(step).collect()
}

fn counts(model: &Model, reduced: &ReducedModel, factors: &Factors) -> Counts {
    Counts {
        variables: model.variables(),
        integers: model.integer().iter().filter(|&&i| i).count(),
        constraints: model.constraints().rows(),
        inequalities: 0,
        reduced_integers: reduced.integers().len(),
        reduced_continuous: reduced.continuous().len(),
        factor_nonzeros: factors.entries(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::FieldProblem;
    use crate::mesh::shape::by_name;
    use crate::monitor::spawned;
    use crate::solve::solve;

    #[test]
    fn the_factor_that_the_search_needs_is_made_beside_the_relaxation() {
        let mesh = by_name("torus", 3_000).unwrap();
        let field = FieldProblem::new(&mesh, &[]).unwrap();
        let of = |strategy, threads| {
            let options = Options {
                strategy,
                threads,
                ..Options::default()
            };
            solve(field.problem(), &options).unwrap()
        };
        let one = of(Strategy::Adaptive, 1);
        let other = || {
            let two = of(Strategy::Adaptive, 2);
            assert_eq!(one.values(), two.values());
            assert_eq!(one.energy().to_bits(), two.energy().to_bits());
            assert!(two.seconds().factor <= two.seconds().total);
        };
        assert!(spawned(other) > 0);
        let relaxed = || drop(of(Strategy::Relax, 2));
        assert_eq!(spawned(relaxed), 0, "no search follows");
    }
}
