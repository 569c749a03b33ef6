//! The equality constraints, one by one or as a matrix.

use super::guard;
use super::input::{Index, indices, slice};
use super::matrix::{Compressed, add_rows};
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::problem::Problem;

/// Adds the constraint sum_k coefficients[k] x[indices[k]] = rhs. Constraints are numbered from 0
/// in the order given, and errors name them by that number. Duplicate indices are summed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_constraint(
    problem: *mut roundel_problem,
    count: usize,
    indices: *const i32,
    coefficients: *const f64,
    rhs: f64,
) -> roundel_status {
    let body = |value: &mut Problem| {
        // SAFETY: the caller gives arrays of `count` entries, or NULL.
        let (at, coefficients) = unsafe {
            (
                self::indices("constraint", indices, count, value.variables())?,
                slice("constraint coefficients", coefficients, count)?,
            )
        };
        value.add_constraint(&at, coefficients, rhs)?;
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// # Safety
/// As the callers of the entries below say.
unsafe fn add_matrix<I: Index>(
    problem: *mut roundel_problem,
    matrix: Compressed<I>,
    constraint_count: usize,
    rhs: *const f64,
    first: *mut usize,
) -> roundel_status {
    let rhs = ("constraint right sides", rhs, constraint_count);
    // SAFETY: handed on.
    unsafe {
        add_rows(problem, matrix, rhs, first, |problem, matrix, rhs| {
            Ok(problem.add_constraint_matrix(matrix, rhs)?)
        })
    }
}

/// Adds the constraints C x = rhs, one for each row of C. C is given in compressed rows: the entries of
/// row k are those from offsets[k] to before offsets[k + 1]. `offset_count` is one more than the number
/// of constraints, and `count` is the number of entries. Entries of a row may be in any order; duplicates
/// are summed. The number of the first new constraint is written to `first`, which may be NULL.
///
/// Errors give a position in the array at fault as their index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_constraints_csr(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    columns: *const i32,
    values: *const f64,
    constraint_count: usize,
    rhs: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, constraint_count, rhs, first) }
}

/// roundel_problem_add_constraints_csr with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_constraints_csr_i64(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    columns: *const i64,
    values: *const f64,
    constraint_count: usize,
    rhs: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, constraint_count, rhs, first) }
}

/// Adds the constraints C x = rhs, one for each row of C. C is given in compressed columns: the entries
/// of column k are those from offsets[k] to before offsets[k + 1]. `offset_count` is one more than the
/// number of variables, and `count` is the number of entries. Entries of a column may be in any order;
/// duplicates are summed. The number of the first new constraint is written to `first`, which may be
/// NULL.
///
/// Errors give a position in the array at fault as their index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_constraints_csc(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    rows: *const i32,
    values: *const f64,
    constraint_count: usize,
    rhs: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, constraint_count, rhs, first) }
}

/// roundel_problem_add_constraints_csc with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_constraints_csc_i64(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    rows: *const i64,
    values: *const f64,
    constraint_count: usize,
    rhs: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, constraint_count, rhs, first) }
}
