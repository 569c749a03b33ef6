//! Least-squares rows, one by one or as a matrix.

use super::guard;
use super::input::{Index, indices, slice};
use super::matrix::{Compressed, add_rows};
use super::output::optional;
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::problem::MatrixRef;
use crate::problem::Problem;

/// Adds weight * (sum_k coefficients[k] x[indices[k]] - rhs)^2 to the objective, without a factor
/// of 1/2. The row itself is kept, and its number goes to `row`, which may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_least_squares(
    problem: *mut roundel_problem,
    count: usize,
    indices: *const i32,
    coefficients: *const f64,
    rhs: f64,
    weight: f64,
    row: *mut usize,
) -> roundel_status {
    let body = |value: &mut Problem| {
        const WHAT: &str = "least-squares row";
        // SAFETY: the caller gives arrays of `count` entries and a place for the number, or NULL.
        let (at, coefficients, row) = unsafe {
            (
                self::indices(WHAT, indices, count, value.variables())?,
                slice("least-squares coefficients", coefficients, count)?,
                optional("row", row)?,
            )
        };
        let number = value.add_least_squares(&at, coefficients, rhs, weight)?;
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
    rhs: *const f64,
    weights: *const f64,
    first: *mut usize,
) -> roundel_status {
    let add = |problem: &mut Problem, matrix: &MatrixRef, rhs: &[f64]| {
        let weights = match weights.is_null() {
            true => None,
            // SAFETY: handed on.
            false => Some(unsafe { slice("least-squares weights", weights, row_count) }?),
        };
        Ok(problem.add_least_squares_matrix(matrix, rhs, weights)?)
    };
    let rhs = ("least-squares right sides", rhs, row_count);
    // SAFETY: handed on.
    unsafe { add_rows(problem, matrix, rhs, first, add) }
}

/// Adds sum_i weights[i] ((A x)_i - rhs[i])^2 to the objective, one term for each row of A. A is given in
/// compressed rows: the entries of row i are those from offsets[i] to before offsets[i + 1].
/// `offset_count` is one more than `row_count`, and `count` is the number of entries. Entries of a row
/// may be in any order; duplicates are summed. `weights` may be NULL: then all are 1. The number of the
/// first new row is written to `first`, which may be NULL. A failure adds nothing.
///
/// Errors give a position in the array at fault as their index; the message also names the row.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_least_squares_csr(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    columns: *const i32,
    values: *const f64,
    row_count: usize,
    rhs: *const f64,
    weights: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, rhs, weights, first) }
}

/// roundel_problem_add_least_squares_csr with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_least_squares_csr_i64(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    columns: *const i64,
    values: *const f64,
    row_count: usize,
    rhs: *const f64,
    weights: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, rhs, weights, first) }
}

/// The same of A in compressed columns: the entries of column k are those from offsets[k] to before
/// offsets[k + 1]. `offset_count` is one more than the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_least_squares_csc(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    rows: *const i32,
    values: *const f64,
    row_count: usize,
    rhs: *const f64,
    weights: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, rhs, weights, first) }
}

/// roundel_problem_add_least_squares_csc with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_least_squares_csc_i64(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    rows: *const i64,
    values: *const f64,
    row_count: usize,
    rhs: *const f64,
    weights: *const f64,
    first: *mut usize,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, rhs, weights, first) }
}
