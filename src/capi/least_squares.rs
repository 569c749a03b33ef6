//! Least-squares rows, one by one or as a matrix.

use super::error::Failure;
use super::guard;
use super::input::{Index, indices, slice};
use super::objective::{Compressed, INDICES, VALUES};
use super::output::optional;
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::{Error, Layout, Problem};

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
/// The arrays are as the caller of the entry says.
unsafe fn add_matrix<I: Index>(
    problem: *mut roundel_problem,
    matrix: Compressed<I>,
    row_count: usize,
    rhs: *const f64,
    weights: *const f64,
    first: *mut usize,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let bound = match matrix.layout {
            Layout::Rows => value.variables(),
            Layout::Columns => row_count,
        };
        // SAFETY: handed on.
        unsafe {
            let rhs = slice("least-squares right sides", rhs, row_count)?;
            let weights = match weights.is_null() {
                true => None,
                false => Some(slice("least-squares weights", weights, row_count)?),
            };
            let first = optional("first", first)?;
            let added = matrix.with(bound, |m| value.add_least_squares_matrix(m, rhs, weights));
            let number = added.map_err(|failure| matrix.naming_row(failure))?;
            if let Some(first) = first {
                first.set(number);
            }
        }
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(problem, body) }
}

impl<I: Index> Compressed<I> {
    /// A failure of an entry with the row that it is in.
    ///
    /// # Safety
    /// As [`with`](Self::with).
    unsafe fn naming_row(&self, failure: Failure) -> Failure {
        let Failure::Library(error) = failure else {
            return failure;
        };
        let position = match error {
            Error::IndexOutOfRange { what, position, .. }
                if what == INDICES && self.layout == Layout::Rows =>
            {
                position
            }
            Error::NotFinite { what, position } if what == VALUES => position,
            _ => return Failure::Library(error),
        };
        // SAFETY: handed on.
        let row = unsafe { self.row_of(position) };
        match row {
            Some(row) => Failure::InRow { row, error },
            None => Failure::Library(error),
        }
    }

    /// The row of an entry, if the arrays say so.
    ///
    /// # Safety
    /// As [`with`](Self::with).
    unsafe fn row_of(&self, position: usize) -> Option<usize> {
        match self.layout {
            Layout::Rows => {
                let end = self.count.saturating_add(1);
                // SAFETY: handed on.
                let offsets = unsafe { indices("", self.offsets, self.offset_count, end) }.ok()?;
                let is_here = |ends: &[usize]| ends[0] <= position && position < ends[1];
                offsets.windows(2).position(is_here)
            }
            Layout::Columns => {
                // SAFETY: handed on.
                let rows = unsafe { indices("", self.minor, self.count, usize::MAX) }.ok()?;
                rows.get(position).copied()
            }
        }
    }
}

/// Adds sum_i weights[i] ((A x)_i - rhs[i])^2 to the objective, one term a row of A, which is given
/// in compressed rows: the entries of row i are those from offsets[i] to before offsets[i + 1].
/// `offset_count` is one more than `row_count`, `count` the number of entries. Entries of a row may
/// be in any order, duplicates are summed. `weights` may be NULL: all are 1 then. The number of the
/// first new row goes to `first`, which may be NULL. After an error nothing has been added.
///
/// Errors give a position in the array at fault as their index; the message names the row too.
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
    let matrix = Compressed {
        layout: Layout::Rows,
        offset_count,
        offsets,
        count,
        minor: columns,
        values,
    };
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
    let matrix = Compressed {
        layout: Layout::Rows,
        offset_count,
        offsets,
        count,
        minor: columns,
        values,
    };
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
    let matrix = Compressed {
        layout: Layout::Columns,
        offset_count,
        offsets,
        count,
        minor: rows,
        values,
    };
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
    let matrix = Compressed {
        layout: Layout::Columns,
        offset_count,
        offsets,
        count,
        minor: rows,
        values,
    };
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe { add_matrix(problem, matrix, row_count, rhs, weights, first) }
}
