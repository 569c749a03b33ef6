//! The solution handle: values, energy, bound and violations.

use std::mem::offset_of;

use super::guard::{self, Guarded, object};
use super::input::slice_mut;
use super::output::Out;
use super::status::{roundel_solve_status, roundel_status, roundel_stopped_by};
use crate::error::Error;
use crate::solve::Solution;

/// A solution. Energy and violations are recomputed from the problem's own arrays.
pub struct roundel_solution(Guarded<Solution>);

object!(roundel_solution, Solution, "solution");

/// Sizes of a problem before and after elimination of its constraints.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct roundel_counts {
    /// Variables.
    pub variables: i64,
    /// Integer variables.
    pub integers: i64,
    /// Equality constraints.
    pub constraints: i64,
    /// Integer unknowns left after elimination.
    pub reduced_integers: i64,
    /// Continuous unknowns left after elimination.
    pub reduced_continuous: i64,
    /// Entries below the diagonal of the factor that the relaxation was solved with.
    pub factor_nonzeros: i64,
    /// Inequalities, which are two-sided rows.
    pub inequalities: i64,
    /// Zero; reserved.
    pub reserved: [i64; 9],
}

/// Wall-clock seconds by phase.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct roundel_seconds {
    /// Validation and elimination of the constraints.
    pub eliminate: f64,
    /// Orderings and factorizations.
    pub factor: f64,
    /// The search for integers.
    pub round: f64,
    /// All of the solve, verification included.
    pub total: f64,
    /// Zero; reserved.
    pub reserved: [f64; 12],
}

const _: () = {
    assert!(size_of::<roundel_counts>() == 128);
    assert!(offset_of!(roundel_counts, reduced_continuous) == 32);
    assert!(offset_of!(roundel_counts, inequalities) == 48);
    assert!(size_of::<roundel_seconds>() == 128);
    assert!(offset_of!(roundel_seconds, total) == 24);
};

/// Frees a solution. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_free(solution: *mut roundel_solution) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(solution) }
}

/// An entry that gives one number read off a solution.
///
/// # Safety
/// `solution` is NULL or a live handle, `out` NULL or a place for the number.
unsafe fn give<T>(
    solution: *const roundel_solution,
    what: &'static str,
    out: *mut T,
    read: impl FnOnce(&Solution) -> T,
) -> roundel_status {
    // SAFETY: handed on.
    unsafe {
        guard::read(solution, |s| {
            let out = Out::new(what, out)?;
            out.set(read(s));
            Ok(())
        })
    }
}

/// Gives the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_variable_count(
    solution: *const roundel_solution,
    variables: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(solution, "variables", variables, |s| s.values().len()) }
}

/// Copies the values, one a variable. `length` is the number of variables. Integer variables hold
/// exact integers, except after a relaxation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_values(
    solution: *const roundel_solution,
    values: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |s: &Solution| {
        if length != s.values().len() {
            Err(Error::LengthMismatch {
                what: "solution values",
                expected: s.values().len(),
                actual: length,
            })?;
        }
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { slice_mut("values", values, length) }?.copy_from_slice(s.values());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(solution, body) }
}

/// Gives the objective at the solution, in the caller's units.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_energy(
    solution: *const roundel_solution,
    energy: *mut f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(solution, "energy", energy, Solution::energy) }
}

/// An entry that gives a number that may be unknown, and whether it is known.
///
/// # Safety
/// As [`give`].
unsafe fn give_known(
    solution: *const roundel_solution,
    known: *mut i32,
    what: &'static str,
    out: *mut f64,
    unknown: f64,
    read: impl FnOnce(&Solution) -> Option<f64>,
) -> roundel_status {
    // SAFETY: handed on.
    unsafe {
        guard::read(solution, |s| {
            let (known, out) = (Out::new("known", known)?, Out::new(what, out)?);
            let value = read(s);
            known.set(value.is_some().into());
            out.set(value.unwrap_or(unknown));
            Ok(())
        })
    }
}

/// Gives a lower bound on the energy of every integer solution. `known` becomes 1, or 0 if there is no
/// bound; the bound is then minus infinity.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_lower_bound(
    solution: *const roundel_solution,
    known: *mut i32,
    lower_bound: *mut f64,
) -> roundel_status {
    const UNKNOWN: f64 = f64::NEG_INFINITY;
    // SAFETY: the caller gives a live handle and places for the numbers, or NULL.
    unsafe {
        give_known(
            solution,
            known,
            "lower bound",
            lower_bound,
            UNKNOWN,
            Solution::lower_bound,
        )
    }
}

/// Gives (energy - lower_bound) / |energy|: 0 where they are equal, and infinite for an energy of 0 above
/// the bound. `known` becomes 1, or 0 if there is no bound; the gap is then infinite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_gap(
    solution: *const roundel_solution,
    known: *mut i32,
    gap: *mut f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and places for the numbers, or NULL.
    unsafe { give_known(solution, known, "gap", gap, f64::INFINITY, Solution::gap) }
}

/// Gives how the solve ended.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_status(
    solution: *const roundel_solution,
    status: *mut roundel_solve_status,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(solution, "status", status, |s| s.status().into()) }
}

/// Gives 1 if the search has visited everything that could be better, else 0. It is 1 for problems without
/// integers. A solution can be optimal without that, if a bound proves it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_is_complete(
    solution: *const roundel_solution,
    complete: *mut i32,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(solution, "complete", complete, |s| s.is_complete().into()) }
}

/// Gives why the search ended before it was complete.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_stopped_by(
    solution: *const roundel_solution,
    stopped_by: *mut roundel_stopped_by,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe {
        give(solution, "stopped by", stopped_by, |s| {
            s.stopped_by().into()
        })
    }
}

/// Gives the sizes of the problem before and after elimination.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_counts(
    solution: *const roundel_solution,
    counts: *mut roundel_counts,
) -> roundel_status {
    let read = |s: &Solution| {
        let c = s.counts();
        // Counts are of things in memory, far below 2^63.
        let [
            variables,
            integers,
            constraints,
            reduced_integers,
            reduced_continuous,
            factor_nonzeros,
            inequalities,
        ] = [
            c.variables,
            c.integers,
            c.constraints,
            c.reduced_integers,
            c.reduced_continuous,
            c.factor_nonzeros,
            c.inequalities,
        ]
        .map(|n| n as i64);
        roundel_counts {
            variables,
            integers,
            constraints,
            reduced_integers,
            reduced_continuous,
            factor_nonzeros,
            inequalities,
            reserved: [0; 9],
        }
    };
    // SAFETY: the caller gives a live handle and a place for the numbers, or NULL.
    unsafe { give(solution, "counts", counts, read) }
}

/// Gives the wall-clock seconds that the solve took, by phase.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_seconds(
    solution: *const roundel_solution,
    seconds: *mut roundel_seconds,
) -> roundel_status {
    let read = |s: &Solution| {
        let t = s.seconds();
        roundel_seconds {
            eliminate: t.eliminate,
            factor: t.factor,
            round: t.round,
            total: t.total,
            reserved: [0.0; 12],
        }
    };
    // SAFETY: the caller gives a live handle and a place for the numbers, or NULL.
    unsafe { give(solution, "seconds", seconds, read) }
}

/// Gives the largest |c . x - d| / max(1, sum_j |c_j x_j|) over the constraints, and the largest
/// distance of an integer variable from an integer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_solution_violations(
    solution: *const roundel_solution,
    constraint: *mut f64,
    integrality: *mut f64,
) -> roundel_status {
    let body = |s: &Solution| {
        // SAFETY: the caller gives places for the numbers, or NULL.
        let (constraint, integrality) = unsafe {
            (
                Out::new("constraint violation", constraint)?,
                Out::new("integrality violation", integrality)?,
            )
        };
        constraint.set(s.max_constraint_violation());
        integrality.set(s.max_integrality_violation());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(solution, body) }
}
