//! The objective: quadratic, linear and constant terms.

use super::failure::{Failure, Outcome};
use super::guard;
use super::input::{Index, index, indices, slice};
use super::matrix::Compressed;
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::error::Error;
use crate::problem::{Problem, Triangle};

/// Which entries of a symmetric matrix are given.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_triangle {
    /// Both triangles, which must agree.
    ROUNDEL_TRIANGLE_FULL = 0,
    /// Only entries with row <= column, which stand for both.
    ROUNDEL_TRIANGLE_UPPER = 1,
    /// Only entries with row >= column, which stand for both.
    ROUNDEL_TRIANGLE_LOWER = 2,
}

fn triangle(number: i32) -> Outcome<Triangle> {
    const FULL: i32 = roundel_triangle::ROUNDEL_TRIANGLE_FULL as i32;
    const UPPER: i32 = roundel_triangle::ROUNDEL_TRIANGLE_UPPER as i32;
    const LOWER: i32 = roundel_triangle::ROUNDEL_TRIANGLE_LOWER as i32;
    match number {
        FULL => Ok(Triangle::Full),
        UPPER => Ok(Triangle::Upper),
        LOWER => Ok(Triangle::Lower),
        _ => Err(Failure::Library(Error::InvalidArgument {
            what: format!("triangle {number} is none of full (0), upper (1), lower (2)"),
            index: None,
        })),
    }
}

/// # Safety
/// The arrays are as the caller of the entry says.
unsafe fn add_triplets<I: Index>(
    problem: &mut Problem,
    number: i32,
    count: usize,
    rows: *const I,
    columns: *const I,
    values: *const f64,
) -> Outcome {
    let n = problem.variables();
    let triangle = triangle(number)?;
    // SAFETY: handed on.
    let (rows, columns, values) = unsafe {
        (
            indices("quadratic rows", rows, count, n)?,
            indices("quadratic columns", columns, count, n)?,
            slice("quadratic values", values, count)?,
        )
    };
    Ok(problem.add_quadratic_triplets(triangle, &rows, &columns, values)?)
}

/// # Safety
/// The arrays are as the caller of the entry says.
unsafe fn add_matrix<I: Index>(
    problem: *mut roundel_problem,
    number: i32,
    matrix: Compressed<I>,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let triangle = triangle(number)?;
        let n = value.variables();
        // SAFETY: handed on.
        unsafe { matrix.with(n, |m| Ok(value.add_quadratic_matrix(triangle, m)?)) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// Adds `count` entries to Q; the objective contains 1/2 x'Qx. The entries may be in any order;
/// duplicates are summed. `triangle` is a roundel_triangle.
///
/// Errors give the position of the entry at fault as their index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_quadratic_triplets(
    problem: *mut roundel_problem,
    triangle: i32,
    count: usize,
    rows: *const i32,
    columns: *const i32,
    values: *const f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and arrays of `count` entries, or NULL.
    unsafe {
        guard::write(problem, |value| {
            add_triplets(value, triangle, count, rows, columns, values)
        })
    }
}

/// roundel_problem_add_quadratic_triplets with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_quadratic_triplets_i64(
    problem: *mut roundel_problem,
    triangle: i32,
    count: usize,
    rows: *const i64,
    columns: *const i64,
    values: *const f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and arrays of `count` entries, or NULL.
    unsafe {
        guard::write(problem, |value| {
            add_triplets(value, triangle, count, rows, columns, values)
        })
    }
}

/// Adds a matrix in compressed columns to Q: the entries of column k are those from offsets[k] to
/// before offsets[k + 1]. `offset_count` is one more than the number of variables, `count` the
/// number of entries. Entries of a column may be in any order, duplicates are summed.
///
/// Errors give a position in the array at fault as their index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_quadratic_csc(
    problem: *mut roundel_problem,
    triangle: i32,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    rows: *const i32,
    values: *const f64,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, triangle, matrix) }
}

/// roundel_problem_add_quadratic_csc with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_quadratic_csc_i64(
    problem: *mut roundel_problem,
    triangle: i32,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    rows: *const i64,
    values: *const f64,
) -> roundel_status {
    let matrix = Compressed::columns(offset_count, offsets, count, rows, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, triangle, matrix) }
}

/// Adds a matrix in compressed rows to Q: the entries of row k are those from offsets[k] to
/// before offsets[k + 1]. `offset_count` is one more than the number of variables, `count` the
/// number of entries. Entries of a row may be in any order, duplicates are summed.
///
/// Errors give a position in the array at fault as their index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_quadratic_csr(
    problem: *mut roundel_problem,
    triangle: i32,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    columns: *const i32,
    values: *const f64,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, triangle, matrix) }
}

/// roundel_problem_add_quadratic_csr with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_quadratic_csr_i64(
    problem: *mut roundel_problem,
    triangle: i32,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    columns: *const i64,
    values: *const f64,
) -> roundel_status {
    let matrix = Compressed::rows(offset_count, offsets, count, columns, values);
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, triangle, matrix) }
}

/// Adds `values`, one a variable, to the linear term q. `length` is the number of variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_linear(
    problem: *mut roundel_problem,
    values: *const f64,
    length: usize,
) -> roundel_status {
    let body = |value: &mut Problem| {
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        let values = unsafe { slice("linear terms", values, length) }?;
        Ok(value.add_linear(values)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// Adds `coefficient` to the linear term of one variable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_linear_term(
    problem: *mut roundel_problem,
    variable: i64,
    coefficient: f64,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let variable = index("variable", variable, value.variables())?;
        Ok(value.add_linear_term(variable, coefficient)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

/// Adds `constant` to the objective.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_add_constant(
    problem: *mut roundel_problem,
    constant: f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, |value| Ok(value.add_constant(constant)?)) }
}
