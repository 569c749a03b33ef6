//! One solve from beginning to end: validation, elimination, and the solve of the reduced problem.

use super::Solution;
use super::eliminated::EliminatedProblem;
use super::limited::solve_limited;
use super::reformulate::solve_reformulated;
use crate::eliminate::Elimination;
use crate::error::Result;
use crate::monitor::{Monitor, may_continue, watch_memory, with_threads};
use crate::problem::{Model, Problem};
use crate::search::{Factors, Options};

/// Solves `problem`, without a monitor.
///
/// # Errors
/// Every kind of [`Error`](crate::Error): bad input, contradictory constraints, an objective that is
/// unbounded or not convex, and the time limit before a first solution.
pub fn solve(problem: &Problem, options: &Options) -> Result<Solution> {
    solve_with(problem, options, Monitor::default())
}

/// Solves `problem`. The `monitor` receives the progress and every better solution, and may cancel the
/// solve.
///
/// # Errors
/// The errors of [`solve`], and [`Error::Cancelled`](crate::Error::Cancelled) if the solve was cancelled
/// before a first solution.
pub fn solve_with(problem: &Problem, options: &Options, monitor: Monitor) -> Result<Solution> {
    let _memory = watch_memory(problem.size());
    with_threads(options.threads, || solve_alone(problem, options, monitor))
}

fn solve_alone(problem: &Problem, options: &Options, mut monitor: Monitor) -> Result<Solution> {
    monitor.start(options.time_limit);
    monitor.check()?;
    let watch = monitor.watch();
    may_continue()?;
    let model = Model::new(problem)?;
    tell_of_ignored_hint(&model, &mut monitor);
    drop(watch);
    if problem.is_limited() {
        solve_limited(problem, &model, options, model.guess(), None, &mut monitor)
    } else {
        solve_unlimited(problem, &model, options, model.guess(), &mut monitor)
    }
}

/// Solves a problem without its inequalities and bounds. `earlier` is the start of a warm start.
pub(super) fn solve_unlimited(
    problem: &Problem,
    model: &Model,
    options: &Options,
    earlier: &[f64],
    monitor: &mut Monitor,
) -> Result<Solution> {
    let watch = monitor.watch();
    let elimination = Elimination::new(model, options.ordering, monitor)?;
    drop(watch);
    let eliminated = EliminatedProblem {
        problem,
        model,
        elimination: &elimination,
        factors: &mut Factors::new(options.ordering),
        earlier,
    };
    solve_eliminated(eliminated, options, monitor)
}

pub(super) fn tell_of_ignored_hint(model: &Model, monitor: &mut Monitor) {
    if let Some(cycle) = model.ignored_hint() {
        monitor.log(&format!(
            "cycle hint ignored: unknowns of cycle {cycle} do not cancel"
        ));
    }
}

/// Solves a problem after the elimination of its constraints, reformulated if that is better.
pub(super) fn solve_eliminated(
    mut problem: EliminatedProblem,
    options: &Options,
    monitor: &mut Monitor,
) -> Result<Solution> {
    let (reduced, clock) = problem.reduce(monitor)?;
    match solve_reformulated(&problem, &reduced, options, monitor)? {
        Some(solution) => Ok(solution),
        None => problem.search(&reduced, &clock, options, monitor),
    }
}
