//! The caller's matrices: compressed columns or rows, one triangle or both.

use super::check::{all_finite, same_length};
use crate::error::{Error, Result};
use crate::linalg::Sparse;
use crate::linalg::sparse::reserve;

/// The largest difference of two mirrored entries of a full symmetric matrix, relative to the larger.
pub(super) const SYMMETRY_TOLERANCE: f64 = 1e-9;

/// The triangles of a symmetric matrix that are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Triangle {
    /// Both triangles, which must agree.
    Full,
    /// Only entries with row <= column.
    Upper,
    /// Only entries with row >= column.
    Lower,
}

/// Whether a compressed matrix is stored column by column (CSC) or row by row (CSR).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// CSC: SciPy's `csc_matrix`, Eigen's default.
    Columns,
    /// CSR: SciPy's `csr_matrix`, Eigen's `RowMajor`.
    Rows,
}

/// A compressed sparse matrix in the caller's arrays.
///
/// The entries of column (or row) `k` are `offsets[k]..offsets[k + 1]` of `indices` and `values`. They may be
/// in any order, and duplicates are summed.
#[derive(Debug, Clone, Copy)]
pub struct MatrixRef<'a> {
    /// Columns or rows.
    pub layout: Layout,
    /// The start of each column (or row) and the end of the last. The first is 0, and they do not decrease.
    pub offsets: &'a [usize],
    /// Row (or column) of each entry.
    pub indices: &'a [usize],
    /// Value of each entry.
    pub values: &'a [f64],
}

impl MatrixRef<'_> {
    pub(super) fn validate(&self, what: &'static str, rows: usize, cols: usize) -> Result<()> {
        let (major, minor) = match self.layout {
            Layout::Columns => (cols, rows),
            Layout::Rows => (rows, cols),
        };
        same_length("matrix offsets", major + 1, self.offsets.len())?;
        same_length("matrix values", self.indices.len(), self.values.len())?;
        let decreases = |k: usize| self.offsets[k] > self.offsets[k + 1];
        if self.offsets[0] != 0 || (0..major).any(decreases) {
            let at = (0..major).find(|&k| decreases(k)).map_or(0, |k| k + 1);
            return Err(Error::InvalidArgument {
                what: format!(
                    "{what} matrix: offset {at} is {}, which does not start at 0 and grow",
                    self.offsets[at]
                ),
                index: Some(at),
            });
        }
        same_length("matrix indices", self.offsets[major], self.indices.len())?;
        super::check::in_range("matrix indices", self.indices, minor)?;
        all_finite("matrix values", self.values)
    }

    /// All entries `(row, column, value)`.
    pub(super) fn entries(&self) -> impl Iterator<Item = (u32, u32, f64)> + Clone + '_ {
        let by_columns = self.layout == Layout::Columns;
        self.offsets.windows(2).enumerate().flat_map(move |(k, w)| {
            let range = w[0]..w[1];
            let pairs = self.indices[range.clone()].iter().zip(&self.values[range]);
            pairs.map(move |(&i, &v)| {
                if by_columns {
                    (i as u32, k as u32, v)
                } else {
                    (k as u32, i as u32, v)
                }
            })
        })
    }
}

/// The lower triangle of the symmetric matrix that `entries` describe.
pub(super) fn lower_triangle(
    triangle: Triangle,
    size: usize,
    entries: impl Iterator<Item = (u32, u32, f64)> + Clone,
) -> Result<Vec<(u32, u32, f64)>> {
    if triangle == Triangle::Full {
        check_symmetry(&Sparse::from_triplets(size, size, entries.clone())?)?;
        let mut lower = reserve(entries.clone().filter(|&(i, j, _)| i >= j).count())?;
        lower.extend(entries.filter(|&(i, j, _)| i >= j));
        return Ok(lower);
    }
    let mirrored = triangle == Triangle::Upper;
    let mut lower = reserve(entries.clone().count())?;
    for (position, (i, j, v)) in entries.enumerate() {
        let (i, j) = if mirrored { (j, i) } else { (i, j) };
        if i < j {
            return Err(Error::InvalidArgument {
                what: format!(
                    "quadratic entry {position} is not in the {} triangle",
                    if mirrored { "upper" } else { "lower" }
                ),
                index: Some(position),
            });
        }
        lower.push((i, j, v));
    }
    Ok(lower)
}

fn check_symmetry(a: &Sparse) -> Result<()> {
    let mirror = a.transpose();
    for i in 0..a.rows() {
        let mut theirs = mirror.row(i).peekable();
        for (j, v) in a.row(i) {
            while theirs.next_if(|&(k, w)| k < j && w == 0.0).is_some() {}
            let w = match theirs.peek() {
                Some(&(k, w)) if k == j => {
                    theirs.next();
                    w
                }
                Some(&(k, w)) if k < j => return Err(asymmetric(i, k, 0.0, w)),
                _ => 0.0,
            };
            if (v - w).abs() > SYMMETRY_TOLERANCE * v.abs().max(w.abs()) {
                return Err(asymmetric(i, j, v, w));
            }
        }
        if let Some((k, w)) = theirs.find(|&(_, w)| w != 0.0) {
            return Err(asymmetric(i, k, 0.0, w));
        }
    }
    Ok(())
}

fn asymmetric(i: usize, j: usize, v: f64, w: f64) -> Error {
    Error::InvalidArgument {
        what: format!(
            "the full quadratic matrix is not symmetric: ({i}, {j}) is {v}, ({j}, {i}) is {w}"
        ),
        index: Some(i),
    }
}
