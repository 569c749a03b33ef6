//! Orchestration: options, budgets, progress and cancel, the search, the solution.

mod monitor;
mod options;
pub mod replay;
mod solution;
mod status;

pub use monitor::{CancelToken, Event, EventKind, Flow, Monitor, Phase};
pub use options::{OPTIONS, OptionInfo, OptionKind, OptionValue, Options, Strategy};
pub use solution::{Counts, Seconds, Solution};
pub use status::SolveStatus;

use crate::{Problem, Result};

/// Solves `problem`.
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
pub fn solve_with(problem: &Problem, options: &Options, monitor: Monitor) -> Result<Solution> {
    let _ = (problem, options, monitor);
    unimplemented!()
}
