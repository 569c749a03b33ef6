//! Rows `a . x = r` as the caller gave them, in the order given.

use std::sync::Arc;

use super::check::{all_finite, finite, in_range, same_length};
use super::shared::own;
use super::{Layout, MatrixRef};
use crate::error::Result;
use crate::linalg::Sparse;
use crate::linalg::sparse::reserve;

/// What memory is asked for.
const WHAT: &str = "the rows";

/// A growing list of sparse rows, each with a right side. The indices within a row are stored as given:
/// unsorted, with duplicates not yet summed. Copies share what none of them changes.
#[derive(Debug, Clone, PartialEq)]
pub struct RowList {
    /// The entries of row `i` are `offsets[i]..offsets[i + 1]`.
    offsets: Arc<Vec<usize>>,
    indices: Arc<Vec<u32>>,
    values: Arc<Vec<f64>>,
    rhs: Arc<Vec<f64>>,
}

impl Default for RowList {
    fn default() -> Self {
        RowList {
            offsets: Arc::new(vec![0]),
            indices: Arc::default(),
            values: Arc::default(),
            rhs: Arc::default(),
        }
    }
}

/// The lists of rows that may be changed.
struct Own<'a> {
    offsets: &'a mut Vec<usize>,
    indices: &'a mut Vec<u32>,
    values: &'a mut Vec<f64>,
    rhs: &'a mut Vec<f64>,
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
        own(&mut self.rhs, 0, WHAT)?.copy_from_slice(rhs);
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
        let own = self.own(1, indices.len())?;
        own.indices.extend(indices.iter().map(|&i| i as u32));
        own.values.extend_from_slice(coefficients);
        own.offsets.push(own.indices.len());
        own.rhs.push(rhs);
        Ok(own.rhs.len() - 1)
    }

    /// Appends the rows of a validated matrix and returns the number of the first.
    pub(super) fn append(&mut self, matrix: &MatrixRef, rhs: &[f64]) -> Result<usize> {
        let own = self.own(rhs.len(), matrix.indices.len())?;
        let (first, base) = (own.rhs.len(), own.indices.len());
        match matrix.layout {
            Layout::Rows => {
                own.indices.extend(matrix.indices.iter().map(|&j| j as u32));
                own.values.extend_from_slice(matrix.values);
                let ends = matrix.offsets[1..].iter().map(|&end| base + end);
                own.offsets.extend(ends);
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
                own.offsets.extend_from_slice(&next[1..]);
                own.indices.resize(base + matrix.indices.len(), 0);
                own.values.resize(base + matrix.indices.len(), 0.0);
                for (i, j, v) in matrix.entries() {
                    let at = &mut next[i as usize];
                    own.indices[*at] = j;
                    own.values[*at] = v;
                    *at += 1;
                }
            }
        }
        own.rhs.extend_from_slice(rhs);
        Ok(first)
    }

    /// The lists with room for this many more rows and entries. Changes nothing if that fails.
    fn own(&mut self, rows: usize, entries: usize) -> Result<Own<'_>> {
        Ok(Own {
            offsets: own(&mut self.offsets, rows, WHAT)?,
            indices: own(&mut self.indices, entries, WHAT)?,
            values: own(&mut self.values, entries, WHAT)?,
            rhs: own(&mut self.rhs, rows, WHAT)?,
        })
    }

    /// The rows as a matrix of `cols` columns: sorted, duplicates summed.
    pub(super) fn to_sparse(&self, cols: usize) -> Result<Sparse> {
        let entries =
            (0..self.len()).flat_map(|i| self.row(i).map(move |(j, v)| (i as u32, j as u32, v)));
        Sparse::from_triplets(self.len(), cols, entries)
    }
}
