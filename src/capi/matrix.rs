//! Sparse matrices in the caller's arrays, and rows added from them.

use super::failure::{Failure, Outcome};
use super::guard;
use super::input::{Index, indices, slice};
use super::output::optional;
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::error::Error;
use crate::problem::MatrixRef;
use crate::problem::{Layout, Problem};

/// What errors call the entries of a matrix.
const INDICES: &str = "matrix indices";
const VALUES: &str = "matrix values";

/// A matrix in the caller's arrays: where each column (or row) starts and ends, and the entries.
pub(super) struct Compressed<I> {
    layout: Layout,
    offset_count: usize,
    offsets: *const I,
    count: usize,
    minor: *const I,
    values: *const f64,
}

impl<I: Index> Compressed<I> {
    /// A matrix in compressed rows.
    pub(super) fn rows(
        offset_count: usize,
        offsets: *const I,
        count: usize,
        columns: *const I,
        values: *const f64,
    ) -> Self {
        Compressed {
            layout: Layout::Rows,
            offset_count,
            offsets,
            count,
            minor: columns,
            values,
        }
    }

    /// A matrix in compressed columns.
    pub(super) fn columns(
        offset_count: usize,
        offsets: *const I,
        count: usize,
        rows: *const I,
        values: *const f64,
    ) -> Self {
        Compressed {
            layout: Layout::Columns,
            ..Self::rows(offset_count, offsets, count, rows, values)
        }
    }

    /// Hands the matrix, whose row (or column) indices are below `bound`, to `body`.
    ///
    /// # Safety
    /// The arrays are as the caller of the entry says.
    pub(super) unsafe fn with<T>(
        &self,
        bound: usize,
        body: impl FnOnce(&MatrixRef) -> Outcome<T>,
    ) -> Outcome<T> {
        // An offset may equal the number of entries, and an array of no offsets has none to check.
        let end = self.count.saturating_add(1);
        // SAFETY: handed on.
        let (offsets, minor, values) = unsafe {
            (
                indices("matrix offsets", self.offsets, self.offset_count, end)?,
                indices(INDICES, self.minor, self.count, bound)?,
                slice(VALUES, self.values, self.count)?,
            )
        };
        let matrix = MatrixRef {
            layout: self.layout,
            offsets: &offsets,
            indices: &minor,
            values,
        };
        body(&matrix)
    }

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

/// An entry that adds the rows of a matrix, each with a right side, which errors call `what`. The
/// number of the first goes to `first`, which may be NULL; errors name the row at fault.
///
/// # Safety
/// `problem` is NULL or a live handle that nobody else uses, `first` NULL or a place for the number,
/// and the arrays are as the caller of the entry says.
pub(super) unsafe fn add_rows<I: Index>(
    problem: *mut roundel_problem,
    matrix: Compressed<I>,
    (what, rhs, row_count): (&'static str, *const f64, usize),
    first: *mut usize,
    add: impl FnOnce(&mut Problem, &MatrixRef, &[f64]) -> Outcome<usize>,
) -> roundel_status {
    let body = |value: &mut Problem| {
        let bound = match matrix.layout {
            Layout::Rows => value.variables(),
            Layout::Columns => row_count,
        };
        // SAFETY: handed on.
        unsafe {
            let rhs = slice(what, rhs, row_count)?;
            let first = optional("first", first)?;
            let added = matrix.with(bound, |m| add(value, m, rhs));
            let number = added.map_err(|failure| matrix.naming_row(failure))?;
            if let Some(first) = first {
                first.set(number);
            }
        }
        Ok(())
    };
    // SAFETY: handed on.
    unsafe { guard::write(problem, body) }
}
