//! Compressed sparse rows, the only sparse matrix type of the library.
//!
//! A symmetric matrix is stored as its lower triangle by rows. In memory that is its upper triangle by
//! columns, which is what faer's factorizations read. The constructors of faer's `SparseColMat` sort 128-bit
//! keys; on matrices of meshes that is several times slower than the counting sort below.

use crate::error::{Error, Result};

/// A sparse matrix by rows. The columns of row `i` are `indices[offsets[i]..offsets[i + 1]]`, increasing and
/// without repetition.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sparse {
    cols: usize,
    offsets: Vec<usize>,
    indices: Vec<u32>,
    values: Vec<f64>,
}

impl Sparse {
    /// A matrix of `rows` by `cols` zeros.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Sparse {
            cols,
            offsets: vec![0; rows + 1],
            indices: Vec::new(),
            values: Vec::new(),
        }
    }

    /// A matrix from its parts, which must already be compressed, sorted and within range.
    pub(crate) fn from_parts(
        cols: usize,
        offsets: Vec<usize>,
        indices: Vec<u32>,
        values: Vec<f64>,
    ) -> Self {
        debug_assert_eq!(offsets.last(), Some(&indices.len()));
        debug_assert_eq!(indices.len(), values.len());
        Sparse {
            cols,
            offsets,
            indices,
            values,
        }
    }

    /// A matrix from entries `(row, column, value)` in any order. Duplicates are summed in the order given.
    /// Indices must be in range.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn from_triplets(
        rows: usize,
        cols: usize,
        entries: impl Iterator<Item = (u32, u32, f64)> + Clone,
    ) -> Result<Self> {
        // Two stable counting sorts, first by column and then by row, leave each row sorted.
        let mut by_col = vec![0usize; cols + 1];
        let mut count = 0usize;
        for (_, j, _) in entries.clone() {
            by_col[j as usize + 1] += 1;
            count += 1;
        }
        for j in 0..cols {
            by_col[j + 1] += by_col[j];
        }
        let mut sorted: Vec<(u32, u32, f64)> = reserve(count)?;
        sorted.resize(count, (0, 0, 0.0));
        let mut offsets = vec![0usize; rows + 1];
        for (i, j, v) in entries {
            let at = &mut by_col[j as usize];
            sorted[*at] = (i, j, v);
            *at += 1;
            offsets[i as usize + 1] += 1;
        }
        for i in 0..rows {
            offsets[i + 1] += offsets[i];
        }
        let mut next = offsets.clone();
        let mut indices: Vec<u32> = reserve(count)?;
        indices.resize(count, 0);
        let mut values: Vec<f64> = reserve(count)?;
        values.resize(count, 0.0);
        for (i, j, v) in sorted {
            let at = &mut next[i as usize];
            indices[*at] = j;
            values[*at] = v;
            *at += 1;
        }
        let mut result = Sparse {
            cols,
            offsets,
            indices,
            values,
        };
        result.sum_duplicates();
        Ok(result)
    }

    fn sum_duplicates(&mut self) {
        let mut kept = 0;
        let mut start = 0;
        for i in 0..self.rows() {
            let end = self.offsets[i + 1];
            let first = kept;
            for k in start..end {
                if kept > first && self.indices[kept - 1] == self.indices[k] {
                    self.values[kept - 1] += self.values[k];
                } else {
                    self.indices[kept] = self.indices[k];
                    self.values[kept] = self.values[k];
                    kept += 1;
                }
            }
            start = end;
            self.offsets[i + 1] = kept;
        }
        self.indices.truncate(kept);
        self.values.truncate(kept);
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Number of columns.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// Number of stored entries.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Whether no entry is stored.
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// The start of each row, and the end of the last row.
    pub fn offsets(&self) -> &[usize] {
        &self.offsets
    }

    /// The columns of all entries, row after row.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The values of all entries, row after row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values of all entries, for changes in place.
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The entries `(column, value)` of row `i`.
    pub fn row(&self, i: usize) -> impl ExactSizeIterator<Item = (usize, f64)> + Clone + '_ {
        let range = self.offsets[i]..self.offsets[i + 1];
        self.indices[range.clone()]
            .iter()
            .zip(&self.values[range])
            .map(|(&j, &v)| (j as usize, v))
    }

    /// All entries `(row, column, value)`, row after row.
    pub fn entries(&self) -> impl Iterator<Item = (u32, u32, f64)> + Clone + '_ {
        (0..self.rows()).flat_map(move |i| self.row(i).map(move |(j, v)| (i as u32, j as u32, v)))
    }

    /// The same matrix by columns.
    pub fn transpose(&self) -> Self {
        let mut offsets = vec![0usize; self.cols + 1];
        for &j in &self.indices {
            offsets[j as usize + 1] += 1;
        }
        for j in 0..self.cols {
            offsets[j + 1] += offsets[j];
        }
        let mut next = offsets.clone();
        let mut indices = vec![0; self.len()];
        let mut values = vec![0.0; self.len()];
        for i in 0..self.rows() {
            for (j, v) in self.row(i) {
                indices[next[j]] = i as u32;
                values[next[j]] = v;
                next[j] += 1;
            }
        }
        Sparse {
            cols: self.rows(),
            offsets,
            indices,
            values,
        }
    }

    /// `A x`.
    pub fn mul(&self, x: &[f64]) -> Vec<f64> {
        (0..self.rows())
            .map(|i| self.row(i).map(|(j, v)| v * x[j]).sum())
            .collect()
    }

    /// `A x` where `self` is the lower triangle of a symmetric `A`.
    pub fn mul_symmetric(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.rows()];
        for i in 0..self.rows() {
            let mut sum = 0.0;
            for (j, v) in self.row(i) {
                sum += v * x[j];
                if j != i {
                    y[j] += v * x[i];
                }
            }
            y[i] += sum;
        }
        y
    }
}

/// An empty vector with room for `len` elements.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub(crate) fn reserve<T>(len: usize) -> Result<Vec<T>> {
    let mut v = Vec::new();
    v.try_reserve_exact(len).map_err(|_| Error::OutOfMemory {
        what: "a sparse matrix",
    })?;
    Ok(v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn duplicates_are_summed_and_rows_sorted() {
        let entries = [(1, 2, 1.0), (0, 1, 2.0), (1, 0, 3.0), (1, 2, 4.0)];
        let a = Sparse::from_triplets(2, 3, entries.into_iter()).unwrap();
        assert_eq!(a.row(0).collect::<Vec<_>>(), [(1, 2.0)]);
        assert_eq!(a.row(1).collect::<Vec<_>>(), [(0, 3.0), (2, 5.0)]);
    }

    #[test]
    fn transposing_twice_changes_nothing() {
        let entries = [(0, 2, 1.0), (2, 0, 2.0), (2, 2, 3.0), (1, 1, 4.0)];
        let a = Sparse::from_triplets(3, 3, entries.into_iter()).unwrap();
        assert_eq!(a.transpose().transpose(), a);
    }

    #[test]
    fn a_symmetric_product_sees_both_triangles() {
        let lower = [(0, 0, 2.0), (1, 0, -1.0), (1, 1, 3.0)];
        let a = Sparse::from_triplets(2, 2, lower.into_iter()).unwrap();
        assert_eq!(a.mul_symmetric(&[1.0, 2.0]), [0.0, 5.0]);
    }
}
