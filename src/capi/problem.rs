//! The problem handle: made, copied, measured, freed.

use super::failure::Failure;
use super::guard::{self, Guarded, boundary, object};
use super::output::Out;
use super::status::roundel_status;
use crate::problem::Problem;

/// A mixed-integer quadratic problem under construction: minimise
/// 1/2 x'Qx + q'x + c + sum_k w_k (a_k . x - r_k)^2 subject to
/// C x = d, l_G <= G x <= u_G, l <= x <= u, x_i integer for i in I.
///
/// Parts may be given in any order and any number of times: terms add up. A call that fails
/// changes nothing. A problem may be changed and solved again after a solve.
pub struct roundel_problem(Guarded<Problem>);

object!(roundel_problem, Problem, "problem");

/// Makes a problem of `variables` unknowns with objective zero, no constraint and no integers.
///
/// Fails with ROUNDEL_ERROR_EMPTY for no variables, ROUNDEL_ERROR_OVERFLOW beyond 2^31 - 1 of
/// them, ROUNDEL_ERROR_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_new(
    variables: usize,
    problem: *mut *mut roundel_problem,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("problem", problem) }?;
        out.set(guard::handle(Problem::new(variables)?));
        Ok(())
    })
}

/// Frees a problem. NULL is allowed, and so is a handle that was given up.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_free(problem: *mut roundel_problem) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(problem) }
}

/// Makes an independent copy of a problem.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_clone(
    problem: *const roundel_problem,
    copy: *mut *mut roundel_problem,
) -> roundel_status {
    let body = |value: &Problem| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("copy", copy) }?;
        out.set(guard::handle(value.clone()));
        Ok::<(), Failure>(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Gives the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_variable_count(
    problem: *const roundel_problem,
    variables: *mut usize,
) -> roundel_status {
    let body = |value: &Problem| {
        // SAFETY: the caller gives a place for the number, or NULL.
        unsafe { Out::new("variables", variables) }?.set(value.variables());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Gives the number of constraints added so far, which is the number of the next one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_constraint_count(
    problem: *const roundel_problem,
    constraints: *mut usize,
) -> roundel_status {
    let body = |value: &Problem| {
        // SAFETY: the caller gives a place for the number, or NULL.
        unsafe { Out::new("constraints", constraints) }?.set(value.constraints());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}
