//! The solve of a problem with inequalities or bounds.
//!
//! Where the relaxation without them is within all limits, they may be of no effect: the problem is solved
//! without them first, by the methods for lattices and angle differences. A solution within the limits is
//! that of the whole problem, with the same bound. Else branch and bound searches ([`branch`](crate::branch)).
//! Flows in bidirected graphs are recognised before all that: [`network`](crate::network) solves them exactly.

use super::run::solve_unlimited;
use super::solution::{Counts, Seconds, Solution};
use super::verify::verify;
use crate::branch;
use crate::error::{Error, Result};
use crate::monitor::Monitor;
use crate::network;
use crate::problem::{Model, Problem};
use crate::proof::Derivation;
use crate::search::{LazyProblem, Options, SolveStatus, StoppedBy, Strategy, WarmStart, is_closed};

/// Limits may be missed by this, relative to the sizes of the terms.
const WITHIN: f64 = 1e-9;

/// Solves a problem with inequalities or bounds. `earlier` is the start of a warm start. `record` receives what a
/// proof is made from, if branch and bound searches, or the method for flows.
///
/// # Errors
/// Those of [`solve`](crate::solve()).
pub(super) fn solve_limited(
    problem: &Problem,
    model: &Model,
    options: &Options,
    earlier: &[f64],
    mut record: Option<&mut Derivation>,
    monitor: &mut Monitor,
) -> Result<Solution> {
    let found = match as_network(problem, model, options, record.as_deref_mut(), monitor)? {
        Some(found) => found,
        None => {
            if let Some(solution) = without_limits(problem, model, options, earlier, monitor)? {
                return Ok(solution);
            }
            let start = (options.warm_start != WarmStart::Off).then_some(earlier);
            branch::solve(problem, model, options, start, None, record, monitor)?
        }
    };
    conclude(problem, model, options, found, monitor)
}

/// Solves a problem to which a caller adds rows.
///
/// # Errors
/// Those of [`solve_with_lazy_rows`](crate::solve_with_lazy_rows()).
pub(super) fn solve_growing<'e>(
    lazy: &mut LazyProblem<'e>,
    model: &Model,
    options: &Options,
    monitor: &mut Monitor<'e>,
) -> Result<Solution> {
    let earlier = model.guess();
    let unlimited = without_limits(lazy.problem(), model, options, earlier, monitor)?;
    if let Some(solution) = unlimited
        && !lazy.cuts_off(&solution.values, solution.energy, monitor)
    {
        return Ok(solution);
    }
    monitor.check()?;
    let start = (options.warm_start != WarmStart::Off).then_some(earlier);
    let stated = lazy.problem().clone();
    let found = branch::solve(&stated, model, options, start, Some(lazy), None, monitor)?;
    conclude(lazy.problem(), model, options, found, monitor)
}

/// The solution that was found, measured on the problem as given.
///
/// # Errors
/// [`Error::NotFinite`].
pub(super) fn conclude(
    problem: &Problem,
    model: &Model,
    options: &Options,
    found: branch::Found,
    monitor: &Monitor,
) -> Result<Solution> {
    let searched = monitor.seconds();
    let verdict = verify(problem, &found.values)?;
    let is_integer = model.integer().contains(&true);
    let lower_bound = found.lower_bound.min(verdict.energy);
    let rounding = 1e-12 * verdict.energy.abs();
    let status = if options.strategy == Strategy::Relax && is_integer {
        SolveStatus::Relaxed
    } else if found.is_complete || is_closed(verdict.energy, lower_bound, rounding) {
        SolveStatus::Optimal
    } else {
        SolveStatus::unproved(found.stopped_by)
    };
    Ok(Solution {
        energy: verdict.energy,
        lower_bound: Some(lower_bound),
        status,
        complete: found.is_complete,
        stopped_by: found.stopped_by,
        work: found.work,
        counts: Counts {
            variables: model.variables(),
            integers: model.integer().iter().filter(|i| **i).count(),
            constraints: model.constraints().rows(),
            inequalities: problem.inequalities(),
            reduced_integers: found.integers,
            reduced_continuous: found.unknowns - found.integers,
            factor_nonzeros: 0,
        },
        seconds: Seconds {
            round: searched,
            total: monitor.seconds(),
            ..Seconds::default()
        },
        max_constraint_violation: verdict.constraint_violation,
        max_integrality_violation: verdict.integrality_violation,
        values: found.values,
    })
}

/// The solution of a flow in a bidirected graph, if the problem is one.
fn as_network(
    problem: &Problem,
    model: &Model,
    options: &Options,
    record: Option<&mut Derivation>,
    monitor: &mut Monitor,
) -> Result<Option<branch::Found>> {
    let is_exact = matches!(
        options.strategy,
        Strategy::Lattice | Strategy::Exact | Strategy::Auto
    );
    if !is_exact {
        return Ok(None);
    }
    let Some(optimum) = network::solve(problem, model, record, monitor)? else {
        return Ok(None);
    };
    let energy = verify(problem, &optimum.values)?.energy;
    monitor.improved(energy);
    monitor.raised(optimum.lower_bound.min(energy));
    Ok(Some(branch::Found {
        energy,
        lower_bound: optimum.lower_bound,
        is_complete: true,
        stopped_by: StoppedBy::Nothing,
        work: optimum.work,
        unknowns: optimum.values.len(),
        integers: optimum.values.len(),
        values: optimum.values,
    }))
}

/// The solution without inequalities and bounds, if it is within them.
fn without_limits(
    problem: &Problem,
    model: &Model,
    options: &Options,
    earlier: &[f64],
    monitor: &mut Monitor,
) -> Result<Option<Solution>> {
    let free = problem.without_limits();
    let within_limits = |options: &Options| -> Result<Option<Solution>> {
        let found = solve_unlimited(&free, model, options, earlier, &mut monitor.silent());
        let mut solution = match found {
            Ok(solution) => solution,
            Err(
                error @ (Error::Cancelled
                | Error::TimeLimit
                | Error::OutOfMemory { .. }
                | Error::Infeasible { .. }
                | Error::NoIntegerSolution { .. }),
            ) => return Err(error),
            Err(_) => return Ok(None),
        };
        let verdict = verify(problem, &solution.values)?;
        solution.max_constraint_violation = verdict.constraint_violation;
        solution.counts.inequalities = problem.inequalities();
        // A solution without a bound may be that of an objective which curves downwards.
        let is_bounded = solution.lower_bound.is_some_and(f64::is_finite);
        Ok((is_bounded && verdict.constraint_violation <= WITHIN).then_some(solution))
    };
    let relaxed = Options {
        strategy: Strategy::Relax,
        ..options.clone()
    };
    let Some(relaxation) = within_limits(&relaxed)? else {
        return Ok(None);
    };
    if options.strategy == Strategy::Relax || !model.integer().contains(&true) {
        return Ok(Some(relaxation));
    }
    let solution = within_limits(options)?;
    Ok(solution.filter(|solution| {
        solution.status == SolveStatus::Optimal || solution.stopped_by == StoppedBy::Nothing
    }))
}
