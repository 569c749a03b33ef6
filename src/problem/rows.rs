//! Rows `a . x = r` as the caller gave them, in the order given.

use std::sync::Arc;

use super::check::{all_finite, finite, in_range, same_length};
use super::{Layout, MatrixRef};
use crate::error::{Error, Result};
use crate::linalg::Sparse;
use crate::linalg::sparse::reserve;

/// A growing list of sparse rows, each with a right side. The indices within a row are stored as given:
/// unsorted, with duplicates not yet summed. Copies share the entries until one of them gets more rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RowList {
    entries: Arc<Entries>,
    rhs: Vec<f64>,
}

/// The entries of all rows. Those of row `i` are `offsets[i]..offsets[i + 1]`.
#[derive(Debug, Clone, PartialEq)]
struct Entries {
    offsets: Vec<usize>,
    indices: Vec<u32>,
    values: Vec<f64>,
}

impl Default for Entries {
    fn default() -> Self {
        Entries {
            offsets: vec![0],
            indices: Vec::new(),
            values: Vec::new(),
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
        self.entries.indices.len()
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
        let of_all = &*self.entries;
        let range = of_all.offsets[i]..of_all.offsets[i + 1];
        of_all.indices[range.clone()]
            .iter()
            .zip(&of_all.values[range])
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
        let entries = self.reserve(1, indices.len())?;
        entries.indices.extend(indices.iter().map(|&i| i as u32));
        entries.values.extend_from_slice(coefficients);
        entries.offsets.push(entries.indices.len());
        self.rhs.push(rhs);
        Ok(self.rhs.len() - 1)
    }

    /// Appends the rows of a validated matrix and returns the number of the first.
    pub(super) fn append(&mut self, matrix: &MatrixRef, rhs: &[f64]) -> Result<usize> {
        let first = self.rhs.len();
        let entries = self.reserve(rhs.len(), matrix.indices.len())?;
        let base = entries.indices.len();
        match matrix.layout {
            Layout::Rows => {
                entries
                    .indices
                    .extend(matrix.indices.iter().map(|&j| j as u32));
                entries.values.extend_from_slice(matrix.values);
                let ends = matrix.offsets[1..].iter().map(|&end| base + end);
                entries.offsets.extend(ends);
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
                entries.offsets.extend_from_slice(&next[1..]);
                entries.indices.resize(base + matrix.indices.len(), 0);
                entries.values.resize(base + matrix.indices.len(), 0.0);
                for (i, j, v) in matrix.entries() {
                    let at = &mut next[i as usize];
                    entries.indices[*at] = j;
                    entries.values[*at] = v;
                    *at += 1;
                }
            }
        }
        self.rhs.extend_from_slice(rhs);
        Ok(first)
    }

    /// Makes room for this many more rows and entries, and returns the entries. Changes nothing if that fails.
    fn reserve(&mut self, rows: usize, more: usize) -> Result<&mut Entries> {
        let entries = Arc::make_mut(&mut self.entries);
        let reserved = self
            .rhs
            .try_reserve(rows)
            .and_then(|()| entries.offsets.try_reserve(rows))
            .and_then(|()| entries.indices.try_reserve(more))
            .and_then(|()| entries.values.try_reserve(more));
        match reserved {
            Ok(()) => Ok(entries),
            Err(_) => Err(Error::OutOfMemory { what: "the rows" }),
        }
    }

    /// The rows as a matrix of `cols` columns: sorted, duplicates summed.
    pub(super) fn to_sparse(&self, cols: usize) -> Result<Sparse> {
        let entries =
            (0..self.len()).flat_map(|i| self.row(i).map(move |(j, v)| (i as u32, j as u32, v)));
        Sparse::from_triplets(self.len(), cols, entries)
    }
}
