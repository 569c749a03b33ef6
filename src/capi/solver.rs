//! The solver handle: one problem, solved again and again with other right sides and pins.

use super::event::{monitor as watched_by, roundel_monitor};
use super::failure::Outcome;
use super::guard::{self, Guarded, object};
use super::input::{index, slice};
use super::options::roundel_options;
use super::output::Out;
use super::problem::roundel_problem;
use super::solution::roundel_solution;
use super::status::roundel_status;
use super::unknowns::bounds;
use crate::error::Result;
use crate::problem::Problem;
use crate::search::Options;
use crate::solve::Solver;

/// A problem whose matrices and integers are fixed, for many solves.
///
/// Elimination, orderings and factors are kept. The first solve costs as much as roundel_problem_solve; a
/// solve with other linear terms, right sides or pinned values costs a fraction of that. Pinning or
/// releasing a variable that is in no constraint keeps the elimination; otherwise the elimination is
/// repeated. The solution is that of roundel_problem_solve for the same data, except that a warm start
/// (option "warm_start") may improve it.
///
/// A solve that fails changes nothing: the data stay as they were set, and the solver can be used
/// with them or with others.
pub struct roundel_solver(Guarded<Solver>);

object!(roundel_solver, Solver, "solver");

/// Makes a solver for a copy of a problem. To be freed with roundel_solver_free.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for an integer variable pinned to a fraction,
/// ROUNDEL_ERROR_OVERFLOW, ROUNDEL_ERROR_OUT_OF_MEMORY. The first solve reports all other errors.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_new(
    problem: *const roundel_problem,
    solver: *mut *mut roundel_solver,
) -> roundel_status {
    let body = |value: &Problem| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("solver", solver) }?;
        out.set(guard::handle(Solver::new(value)?));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Frees a solver. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_free(solver: *mut roundel_solver) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(solver) }
}

/// An entry that hands an array of numbers to the solver.
///
/// # Safety
/// `solver` is NULL or a live handle that nobody else uses, `values` NULL or an array of `length`.
unsafe fn set(
    solver: *mut roundel_solver,
    what: &'static str,
    values: *const f64,
    length: usize,
    set: fn(&mut Solver, &[f64]) -> Result<()>,
) -> roundel_status {
    // SAFETY: handed on.
    unsafe {
        guard::write(solver, |value| {
            Ok(set(value, slice(what, values, length)?)?)
        })
    }
}

/// Replaces the linear term q, one value a variable. What least-squares rows add to it is not
/// touched. `length` is the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_set_linear(
    solver: *mut roundel_solver,
    values: *const f64,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { set(solver, "linear terms", values, length, Solver::set_linear) }
}

/// Replaces the right sides of the constraints, one for each constraint, in the order in which they were
/// added. The next solve checks whether they are feasible.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_set_constraint_right_sides(
    solver: *mut roundel_solver,
    values: *const f64,
    length: usize,
) -> roundel_status {
    const WHAT: &str = "constraint right sides";
    let change = Solver::set_constraint_right_sides;
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { set(solver, WHAT, values, length, change) }
}

/// Replaces the right sides of the least-squares rows, one a row, in the order in which they were
/// added.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_set_least_squares_right_sides(
    solver: *mut roundel_solver,
    values: *const f64,
    length: usize,
) -> roundel_status {
    const WHAT: &str = "least-squares right sides";
    let change = Solver::set_least_squares_right_sides;
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { set(solver, WHAT, values, length, change) }
}

/// Replaces the sides of the inequalities, one lower and one upper side for each, in the order in which they
/// were added. `length` is the number of inequalities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_set_inequality_sides(
    solver: *mut roundel_solver,
    lower: *const f64,
    upper: *const f64,
    length: usize,
) -> roundel_status {
    let body = |value: &mut Solver| {
        // SAFETY: the caller gives arrays of `length` numbers, or NULL.
        let (lower, upper) = unsafe {
            (
                slice("inequality lower sides", lower, length)?,
                slice("inequality upper sides", upper, length)?,
            )
        };
        Ok(value.set_inequality_sides(lower, upper)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(solver, body) }
}

/// Sets the bounds lower[k] <= x[variables[k]] <= upper[k]; see roundel_problem_set_bounds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_set_bounds(
    solver: *mut roundel_solver,
    count: usize,
    variables: *const i32,
    lower: *const f64,
    upper: *const f64,
) -> roundel_status {
    let body = |value: &mut Solver| {
        let total = value.problem().variables();
        // SAFETY: the caller gives arrays of `count` entries, or NULL.
        let (at, lower, upper) = unsafe { bounds(total, count, variables, lower, upper) }?;
        Ok(value.set_bounds(&at, lower, upper)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(solver, body) }
}

/// Sets the point that variables keep to where the objective does not decide them, one value a
/// variable. A warm start begins there, until a solution is found.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_set_guess(
    solver: *mut roundel_solver,
    values: *const f64,
    length: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { set(solver, "initial guess", values, length, Solver::set_guess) }
}

/// Fixes one variable to a value; an integer variable must be given an integer by the time of the
/// solve. One that is pinned already gets another value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_pin(
    solver: *mut roundel_solver,
    variable: i64,
    pinned_value: f64,
) -> roundel_status {
    let body = |value: &mut Solver| {
        let variable = index("variable", variable, value.problem().variables())?;
        Ok(value.pin(variable, pinned_value)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(solver, body) }
}

/// Releases a pinned variable; one that is free stays so.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_unpin(
    solver: *mut roundel_solver,
    variable: i64,
) -> roundel_status {
    let body = |value: &mut Solver| {
        let variable = index("variable", variable, value.problem().variables())?;
        Ok(value.unpin(variable)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(solver, body) }
}

/// Solves the problem as it stands. `options` may be NULL for the default options, `monitor` for
/// none; its callback must not use the solver. On success `solution` is a new handle, to be freed
/// with roundel_solution_free. Fails as roundel_problem_solve does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solver_solve(
    solver: *mut roundel_solver,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    solution: *mut *mut roundel_solution,
) -> roundel_status {
    let body = |solver: &mut Solver| -> Outcome {
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
        let found = solver.solve_with(options, monitor)?;
        out.set(guard::handle(found));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(solver, body) }
}
