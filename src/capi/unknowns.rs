//! The unknowns: integer variables, pinned variables, and the point where undecided ones stay.

use super::guard;
use super::input::{index, indices, slice};
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::problem::Problem;

/// Makes variables integer. Naming one twice is no error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_set_integers(
    problem: *mut roundel_problem,
    count: usize,
    variables: *const i32,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let n = value.variables();
        // SAFETY: the caller gives an array of `count` indices, or NULL.
        let at = unsafe { indices("integer variables", variables, count, n) }?;
        Ok(value.set_integers(&at)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// Fixes one variable to a value; an integer variable must be given an integer by the time of the
/// solve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_pin(
    problem: *mut roundel_problem,
    variable: i64,
    pinned_value: f64,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let variable = index("variable", variable, value.variables())?;
        Ok(value.pin(variable, pinned_value)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// Frees a pinned variable again; one that is free stays so.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_unpin(
    problem: *mut roundel_problem,
    variable: i64,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let variable = index("variable", variable, value.variables())?;
        Ok(value.unpin(variable)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// Sets the point that variables keep to where the objective does not decide them (zero unless
/// set), one value a variable. `length` is the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_set_guess(
    problem: *mut roundel_problem,
    values: *const f64,
    length: usize,
) -> roundel_status {
    let body = |value: &mut Problem| {
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        let values = unsafe { slice("initial guess", values, length) }?;
        Ok(value.set_guess(values)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}
