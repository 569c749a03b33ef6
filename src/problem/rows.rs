//! Rows `a . x = r` as the caller gave them, in the order given.

use super::check::{all_finite, finite, in_range, same_length};
use super::{Layout, MatrixRef};
use crate::Result;
use crate::linalg::Sparse;

/// A growing list of sparse rows with a right side each. Indices within a row are as given:
/// unsorted, duplicates not yet summed.
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

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rhs.is_empty()
    }

    /// The right sides, one a row.
    pub fn rhs(&self) -> &[f64] {
        &self.rhs
    }

    /// The entries `(variable, coefficient)` of row `i`, as given.
    pub fn row(&self, i: usize) -> impl ExactSizeIterator<Item = (usize, f64)> + Clone + '_ {
        let range = self.offsets[i]..self.offsets[i + 1];
        self.indices[range.clone()]
            .iter()
            .zip(&self.values[range])
            .map(|(&j, &v)| (j as usize, v))
    }

    pub(super) fn push(
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
        self.indices.extend(indices.iter().map(|&i| i as u32));
        self.values.extend_from_slice(coefficients);
        self.offsets.push(self.indices.len());
        self.rhs.push(rhs);
        Ok(self.rhs.len() - 1)
    }

    /// Appends the rows of a validated matrix and returns the first one's number.
    pub(super) fn append(&mut self, matrix: &MatrixRef, rhs: &[f64]) -> usize {
        let first = self.rhs.len();
        let mut push_row = |row: &mut dyn Iterator<Item = (u32, f64)>| {
            for (j, v) in row {
                self.indices.push(j);
                self.values.push(v);
            }
            self.offsets.push(self.indices.len());
        };
        match matrix.layout {
            Layout::Rows => {
                for w in matrix.offsets.windows(2) {
                    let range = w[0]..w[1];
                    let indices = matrix.indices[range.clone()].iter().map(|&j| j as u32);
                    push_row(&mut indices.zip(matrix.values[range].iter().copied()));
                }
            }
            Layout::Columns => {
                let mut by_row: Vec<Vec<(u32, f64)>> = vec![Vec::new(); rhs.len()];
                for (i, j, v) in matrix.entries() {
                    by_row[i as usize].push((j, v));
                }
                for row in by_row {
                    push_row(&mut row.into_iter());
                }
            }
        }
        self.rhs.extend_from_slice(rhs);
        first
    }

    /// The rows as a matrix of `cols` columns: sorted, duplicates summed.
    pub(super) fn to_sparse(&self, cols: usize) -> Result<Sparse> {
        let entries =
            (0..self.len()).flat_map(|i| self.row(i).map(move |(j, v)| (i as u32, j as u32, v)));
        Sparse::from_triplets(self.len(), cols, entries)
    }
}
