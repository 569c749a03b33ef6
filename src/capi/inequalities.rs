//! The inequalities, which are two-sided rows, one by one or as a matrix.

use super::guard;
use super::input::{Index, indices, slice};
use super::matrix::{Compressed, add_rows};
use super::output::{Out, optional};
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::problem::{MatrixRef, Problem};

/// Adds the inequality lower <= sum_k coefficients[k] x[indices[k]] <= upper. A side that does not limit is
/// infinite (INFINITY or -INFINITY of math.h). Inequalities are numbered from 0 in the order given, apart from
/// the constraints, and errors name them by that number. The number goes to `row`, which may be NULL.
/// Duplicate indices are summed.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a lower side above the upper side, or a side that is NaN.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_inequality(
    problem: *mut roundel_problem,
    count: usize,
    indices: *const i32,
    coefficients: *const f64,
    lower: f64,
    upper: f64,
    row: *mut usize,
) -> roundel_status {
    let body = |value: &mut Problem| {
        // SAFETY: the caller gives arrays of `count` entries and a place for the number, or NULL.
        let (at, coefficients, row) = unsafe {
            (
                self::indices("inequality", indices, count, value.variables())?,
                slice("inequality coefficients", coefficients, count)?,
                optional("row", row)?,
            )
        };
        let number = value.add_inequality(&at, coefficients, lower, upper)?;
        if let Some(row) = row {
            row.set(number);
        }
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
    row_count: usize,
    lower: *const f64,
    upper: *const f64,
    first: *mut usize,
) -> roundel_status {
    let add = |problem: &mut Problem, matrix: &MatrixRef, lower: &[f64]| {
        // SAFETY: handed on.
        let upper = unsafe { slice("inequality upper sides", upper, row_count) }?;
        Ok(problem.add_inequality_matrix(matrix, lower, upper)?)
    };
    let lower = ("inequality lower sides", lower, row_count);
    // SAFETY: handed on.
    unsafe { add_rows(problem, matrix, lower, first, add) }
}

/// Adds the inequalities lower <= G x <= upper, one for each row of G. G is given in compressed rows: the
/// entries of row k are those from offsets[k] to before offsets[k + 1]. `offset_count` is one more than
/// `row_count`, the number of inequalities and of the sides of each kind, and `count` is the number of entries.
/// Entries of a row may be in any order; duplicates are summed. The number of the first new inequality is
/// written to `first`, which may be NULL.
///
/// Errors give a position in the array at fault as their index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_inequalities_csr(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    columns: *const i32,
    values: *const f64,
    row_count: usize,
    lower: *const f64,
    upper: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, lower, upper, first) }
}

/// roundel_problem_add_inequalities_csr with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_inequalities_csr_i64(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    columns: *const i64,
    values: *const f64,
    row_count: usize,
    lower: *const f64,
    upper: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, lower, upper, first) }
}

/// Adds the inequalities lower <= G x <= upper, one for each row of G. G is given in compressed columns: the
/// entries of column k are those from offsets[k] to before offsets[k + 1]. `offset_count` is one more than the
/// number of variables, `count` is the number of entries, and `row_count` the number of inequalities and of
/// the sides of each kind. Entries of a column may be in any order; duplicates are summed. The number of the
/// first new inequality is written to `first`, which may be NULL.
///
/// Errors give a position in the array at fault as their index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_inequalities_csc(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    rows: *const i32,
    values: *const f64,
    row_count: usize,
    lower: *const f64,
    upper: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, lower, upper, first) }
}

/// roundel_problem_add_inequalities_csc with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_inequalities_csc_i64(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    rows: *const i64,
    values: *const f64,
    row_count: usize,
    lower: *const f64,
    upper: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, lower, upper, first) }
}

/// Gives the number of inequalities added so far, which is the number of the next one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_inequality_count(
    problem: *const roundel_problem,
    inequalities: *mut usize,
) -> roundel_status {
    let body = |value: &Problem| {
        // SAFETY: the caller gives a place for the number, or NULL.
        unsafe { Out::new("inequalities", inequalities) }?.set(value.inequalities());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}
