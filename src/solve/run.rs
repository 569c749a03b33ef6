//! One solve from beginning to end: validation, elimination, and the solve of the reduced problem.

use super::Solution;
use super::eliminated::EliminatedProblem;
use super::limited::{solve_growing, solve_limited};
use super::reformulate::solve_reformulated;
use crate::eliminate::Elimination;
use crate::error::Result;
use crate::monitor::{Flow, Monitor, may_continue, watch_memory, with_threads};
use crate::problem::{Model, Problem};
use crate::search::{Candidate, Factors, LazyProblem, LazyRows, Options};

/// Solves `problem`, without a monitor.
///
/// # Errors
/// Every kind of [`Error`](crate::Error): bad input, contradictory constraints, an objective that is
/// unbounded or not convex, and a limit before a first solution.
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

/// Solves `problem` together with rows that `callback` adds during the search, because there are too many to give
/// them all before it.
///
/// The callback sees each point that could become the solution, and the minimiser of each relaxation that is not
/// integer. It adds rows with [`LazyRows::add`]. A point that they cut off is never a solution. The rows hold for
/// the rest of the solve, and the solution is optimal among all points that the problem and these rows allow. What
/// the callback adds must not depend on the order of its calls: a row that cuts off a point which was accepted
/// before is an error.
///
/// # Errors
/// The errors of [`solve_with`], and [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a row that
/// cuts off a point which was accepted before. Errors give the rows numbers after those of the problem's
/// inequalities.
pub fn solve_with_lazy_rows(
    problem: &Problem,
    options: &Options,
    monitor: Monitor,
    mut callback: impl FnMut(&Candidate, &mut LazyRows) -> Flow,
) -> Result<Solution> {
    let _memory = watch_memory(problem.size());
    let mut lazy = LazyProblem::new(problem.clone(), &mut callback);
    let mut monitor = monitor;
    with_threads(options.threads, || {
        let model = begin(problem, options, &mut monitor)?;
        solve_growing(&mut lazy, &model, options, &mut monitor)
    })
}

/// Starts the clock of a solve and validates the problem.
pub(super) fn begin(problem: &Problem, options: &Options, monitor: &mut Monitor) -> Result<Model> {
    monitor.start(options.time_limit);
    monitor.check()?;
    let _watch = monitor.watch();
    may_continue()?;
    let model = Model::new(problem)?;
    tell_of_ignored_hint(&model, monitor);
    Ok(model)
}

fn solve_alone(problem: &Problem, options: &Options, mut monitor: Monitor) -> Result<Solution> {
    let model = begin(problem, options, &mut monitor)?;
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
        None => problem.search(reduced, &clock, options, monitor),
    }
}
