//! Rows `a . x = r` as the caller gave them, in the order given.

use super::check::{all_finite, finite, in_range, same_length};
use super::{Layout, MatrixRef};
use crate::error::{Error, Result};
use crate::linalg::Sparse;
use crate::linalg::sparse::reserve;

/// A growing list of sparse rows, each with a right side. The indices within a row are stored as given:
/// unsorted, with duplicates not yet summed.
#[derive(Debug, Clone, PartialEq)]
pub struct RowList {
    offsets: Vec<usize>,
    indices: Vec<u32>,
    values: Vec<f64>,
    rhs: Vec<f64>,
}

impl Default for RowList {
    fn default() -> Self {
        RowList {
            offsets: vec![0],
            indices: Vec::new(),
            values: Vec::new(),
            rhs: Vec::new(),
        }
    }
}

impl RowList {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rhs.len()
    }

    /// Number of entries of all rows.
    pub(super) fn entries(&self) -> usize {
        self.indices.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rhs.is_empty()
    }

    /// The right sides, one for each row.
    pub fn rhs(&self) -> &[f64] {
        &self.rhs
    }

    /// Replaces the right sides, one for each row.
    pub(super) fn set_rhs(&mut self, what: &'static str, rhs: &[f64]) -> Result<()> {
        same_length(what, self.len(), rhs.len())?;
        all_finite(what, rhs)?;
        self.rhs.copy_from_slice(rhs);
        Ok(())
    }

    /// The entries `(variable, coefficient)` of row `i`, as given.
    pub fn row(&self, i: usize) -> impl ExactSizeIterator<Item = (usize, f64)> + Clone + '_ {
        let range = self.offsets[i]..self.offsets[i + 1];
        self.indices[range.clone()]
            .iter()
            .zip(&self.values[range])
            .map(|(&j, &v)| (j as usize, v))
    }

    pub(crate) fn push(
        &mut self,
        what: &'static str,
        variables: usize,
        indices: &[usize],
        coefficients: &[f64],
        rhs: f64,
    ) -> Result<usize> {
        same_length(what, indices.len(), coefficients.len())?;
        in_range(what, indices, variables)?;
        all_finite(what, coefficients)?;
        finite("right side", rhs)?;
        self.reserve(1, indices.len())?;
        self.indices.extend(indices.iter().map(|&i| i as u32));
        self.values.extend_from_slice(coefficients);
        self.offsets.push(self.indices.len());
        self.rhs.push(rhs);
        Ok(self.rhs.len() - 1)
    }

    /// Appends the rows of a validated matrix and returns the number of the first.
    pub(super) fn append(&mut self, matrix: &MatrixRef, rhs: &[f64]) -> Result<usize> {
        self.reserve(rhs.len(), matrix.indices.len())?;
        let (first, base) = (self.rhs.len(), self.indices.len());
        match matrix.layout {
            Layout::Rows => {
                self.indices
                    .extend(matrix.indices.iter().map(|&j| j as u32));
                self.values.extend_from_slice(matrix.values);
                let ends = matrix.offsets[1..].iter().map(|&end| base + end);
                self.offsets.extend(ends);
            }
            Layout::Columns => {
                // A counting sort by rows, which leaves each row in the order of the columns.
                let mut next: Vec<usize> = reserve(rhs.len() + 1)?;
                next.resize(rhs.len() + 1, base);
                for &i in matrix.indices {
                    next[i + 1] += 1;
                }
                for i in 0..rhs.len() {
                    next[i + 1] += next[i] - base;
                }
                self.offsets.extend_from_slice(&next[1..]);
                self.indices.resize(base + matrix.indices.len(), 0);
                self.values.resize(base + matrix.indices.len(), 0.0);
                for (i, j, v) in matrix.entries() {
                    let at = &mut next[i as usize];
                    self.indices[*at] = j;
                    self.values[*at] = v;
                    *at += 1;
                }
            }
        }
        self.rhs.extend_from_slice(rhs);
        Ok(first)
    }

    /// Makes room for this many more rows and entries. Changes nothing if that fails.
    fn reserve(&mut self, rows: usize, entries: usize) -> Result<()> {
        let reserved = self
            .offsets
            .try_reserve(rows)
            .and_then(|()| self.rhs.try_reserve(rows))
            .and_then(|()| self.indices.try_reserve(entries))
            .and_then(|()| self.values.try_reserve(entries));
        reserved.map_err(|_| Error::OutOfMemory { what: "the rows" })
    }

    /// The rows as a matrix of `cols` columns: sorted, duplicates summed.
    pub(super) fn to_sparse(&self, cols: usize) -> Result<Sparse> {
        let entries =
            (0..self.len()).flat_map(|i| self.row(i).map(move |(j, v)| (i as u32, j as u32, v)));
        Sparse::from_triplets(self.len(), cols, entries)
    }
}
