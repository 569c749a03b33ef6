//! The unknowns: integer variables, bounds, pinned variables, and the point where undecided ones stay.

use super::failure::Outcome;
use super::guard;
use super::input::{index, indices, slice};
use super::output::{copy_numbers, places};
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

/// Makes variables binary: integer, with the bounds 0 and 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_set_binaries(
    problem: *mut roundel_problem,
    count: usize,
    variables: *const i32,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let n = value.variables();
        // SAFETY: the caller gives an array of `count` indices, or NULL.
        let at = unsafe { indices("binary variables", variables, count, n) }?;
        Ok(value.set_binaries(&at)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// Sets the bounds lower[k] <= x[variables[k]] <= upper[k]. They replace earlier bounds of these variables;
/// a variable has none until they are set. A bound that does not limit is infinite (INFINITY or -INFINITY
/// of math.h). `count` is the length of the three arrays.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a lower bound above the upper bound, or a bound that is NaN;
/// the index is the position in the arrays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_set_bounds(
    problem: *mut roundel_problem,
    count: usize,
    variables: *const i32,
    lower: *const f64,
    upper: *const f64,
) -> roundel_status {
    let body = |value: &mut Problem| {
        // SAFETY: the caller gives arrays of `count` entries, or NULL.
        let (at, lower, upper) =
            unsafe { bounds(value.variables(), count, variables, lower, upper) }?;
        Ok(value.set_bounds(&at, lower, upper)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// The caller's bounds of some of `total` variables.
///
/// # Safety
/// The arrays are NULL or have `count` entries.
pub(super) unsafe fn bounds<'a>(
    total: usize,
    count: usize,
    variables: *const i32,
    lower: *const f64,
    upper: *const f64,
) -> Outcome<(Vec<usize>, &'a [f64], &'a [f64])> {
    // SAFETY: handed on.
    unsafe {
        Ok((
            indices("bounded variables", variables, count, total)?,
            slice("lower bounds", lower, count)?,
            slice("upper bounds", upper, count)?,
        ))
    }
}

/// Copies the bounds of all variables, infinite where there is none. `length` is the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_bounds(
    problem: *const roundel_problem,
    lower: *mut f64,
    upper: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |value: &Problem| {
        let all = 0..value.variables();
        let bounds = |variable| value.limits_of(variable);
        // SAFETY: the caller gives two arrays of `length` numbers, or NULL.
        unsafe {
            places("upper bounds", all.len(), upper, length)?;
            copy_numbers(
                "lower bounds",
                all.clone().map(|i| bounds(i).0),
                lower,
                length,
            )?;
            copy_numbers("upper bounds", all.map(|i| bounds(i).1), upper, length)
        }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
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
