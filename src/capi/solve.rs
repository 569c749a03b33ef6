//! The solve of a problem.

use super::event::{monitor as watched_by, roundel_monitor};
use super::guard;
use super::options::roundel_options;
use super::output::Out;
use super::problem::roundel_problem;
use super::solution::roundel_solution;
use super::status::roundel_status;
use crate::problem::Problem;
use crate::search::Options;

/// Solves a problem. `options` may be NULL for the default options. `monitor` receives progress and every
/// better solution, and may cancel; it may be NULL. On success `solution` is a new handle, to be freed
/// with roundel_solution_free.
///
/// The problem is not changed. It may be solved again, as it is or after changes: a pinned variable,
/// another guess, more terms or constraints. Several threads may solve it at once.
///
/// Apart from bad input, fails with ROUNDEL_ERROR_INFEASIBLE, ROUNDEL_ERROR_NO_INTEGER_SOLUTION,
/// ROUNDEL_ERROR_UNBOUNDED and ROUNDEL_ERROR_NOT_CONVEX. Fails with ROUNDEL_ERROR_CANCELLED or
/// ROUNDEL_ERROR_TIME_LIMIT, and with inequalities or bounds ROUNDEL_ERROR_SEARCH_LIMIT, if it ends before a first
/// solution is found.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_solve(
    problem: *const roundel_problem,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    solution: *mut *mut roundel_solution,
) -> roundel_status {
    let body = |problem: &Problem| {
        let default = Options::default();
        // SAFETY: the caller gives a live handle or NULL, a monitor as its members say or NULL,
        // and a place for the solution or NULL.
        let (options, monitor, out) = unsafe {
            (
                guard::value_or(options, &default)?,
                watched_by(monitor)?,
                Out::new("solution", solution)?,
            )
        };
        let found = crate::solve::solve_with(problem, options, monitor)?;
        out.set(guard::handle(found));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}
