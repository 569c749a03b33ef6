//! Compressed sparse rows, the only sparse matrix type of the library.
//!
//! A symmetric matrix is stored as its lower triangle by rows. In memory that is its upper triangle by
//! columns, which is what faer's factorizations read. The constructors of faer's `SparseColMat` sort 128-bit
//! keys; on matrices of meshes that is several times slower than the counting sort below.

use crate::error::{Error, Result};
use crate::monitor::{
    collect_in_parts, for_each_part, in_parts, may_continue, may_continue_at, parts_of,
};

/// The least number of rows that are worth a thread.
const LEAST: usize = 1 << 14;

/// The least number of entries for each place of a matrix for which they are summed in a table of all places.
const DUPLICATES: usize = 2;

/// Rows with at most this many entries are sorted by insertion.
const SHORT: usize = 24;

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

    /// The rows of all matrices, which have the same number of columns, one below the other.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], and that of the first part that has one.
    pub(crate) fn stacked(parts: Vec<Result<Sparse>>) -> Result<Sparse> {
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_else(|| Ok(Sparse::zeros(0, 0)))?;
        for part in parts {
            let part = part?;
            let above = all.len();
            more(&mut all.offsets, part.rows())?;
            more(&mut all.indices, part.len())?;
            more(&mut all.values, part.len())?;
            all.offsets
                .extend(part.offsets[1..].iter().map(|at| above + at));
            all.indices.extend_from_slice(&part.indices);
            all.values.extend_from_slice(&part.values);
        }
        Ok(all)
    }

    /// A matrix from entries `(row, column, value)` in any order. Duplicates are summed in the order given.
    /// Indices must be in range.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], and the end of the call.
    pub fn from_triplets(
        rows: usize,
        cols: usize,
        entries: impl Iterator<Item = (u32, u32, f64)> + Clone,
    ) -> Result<Self> {
        // A stable counting sort by row, and a stable sort of each row by column.
        let mut offsets = vec![0usize; rows + 1];
        entries.clone().enumerate().try_for_each(|(k, (i, _, _))| {
            offsets[i as usize + 1] += 1;
            may_continue_at(k)
        })?;
        for i in 0..rows {
            offsets[i + 1] += offsets[i];
        }
        let count = offsets[rows];
        if count / DUPLICATES > rows.saturating_mul(cols) {
            return Self::from_many(rows, cols, entries);
        }
        let mut next = offsets.clone();
        let mut indices: Vec<u32> = reserve(count)?;
        indices.resize(count, 0);
        let mut values: Vec<f64> = reserve(count)?;
        values.resize(count, 0.0);
        entries.enumerate().try_for_each(|(k, (i, j, v))| {
            let at = &mut next[i as usize];
            indices[*at] = j;
            values[*at] = v;
            *at += 1;
            may_continue_at(k)
        })?;
        drop(next);
        may_continue()?;
        let mut result = Sparse {
            cols,
            offsets,
            indices,
            values,
        };
        result.sort_rows();
        may_continue()?;
        result.sum_duplicates()?;
        Ok(result)
    }

    /// The same from so many entries that a table of all places takes less memory than they do.
    fn from_many(
        rows: usize,
        cols: usize,
        entries: impl Iterator<Item = (u32, u32, f64)>,
    ) -> Result<Self> {
        let places = rows * cols;
        let mut sums: Vec<f64> = reserve(places)?;
        sums.resize(places, 0.0);
        let mut is_stored: Vec<bool> = reserve(places)?;
        is_stored.resize(places, false);
        entries.for_each(|(i, j, v)| {
            let at = i as usize * cols + j as usize;
            // The first is not added to zero: it may be -0.
            sums[at] = if is_stored[at] { sums[at] + v } else { v };
            is_stored[at] = true;
        });
        may_continue()?;
        let count = is_stored.iter().filter(|&&stored| stored).count();
        let mut offsets: Vec<usize> = reserve(rows + 1)?;
        let (mut indices, mut values): (Vec<u32>, Vec<f64>) = (reserve(count)?, reserve(count)?);
        offsets.push(0);
        for row in 0..rows {
            let stored = (0..cols).filter(|j| is_stored[row * cols + j]);
            stored.for_each(|j| {
                indices.push(j as u32);
                values.push(sums[row * cols + j]);
            });
            offsets.push(indices.len());
        }
        Ok(Sparse {
            cols,
            offsets,
            indices,
            values,
        })
    }

    /// Sorts each row by column. Entries of the same column keep their order.
    fn sort_rows(&mut self) {
        let offsets = &self.offsets;
        let mut rest = (&mut self.indices[..], &mut self.values[..]);
        let parts = parts_of(self.offsets.len() - 1, LEAST)
            .into_iter()
            .map(|rows| {
                let len = offsets[rows.end] - offsets[rows.start];
                let (indices, values) = std::mem::take(&mut rest);
                let (indices, other_indices) = indices.split_at_mut(len);
                let (values, other_values) = values.split_at_mut(len);
                rest = (other_indices, other_values);
                (rows, indices, values)
            });
        for_each_part(parts.collect(), |(rows, indices, values)| {
            let start = offsets[rows.start];
            let mut row: Vec<(u32, f64)> = Vec::new();
            for i in rows {
                let range = offsets[i] - start..offsets[i + 1] - start;
                sort_row(&mut indices[range.clone()], &mut values[range], &mut row);
            }
        });
    }

    fn sum_duplicates(&mut self) -> Result<()> {
        let mut kept = 0;
        let mut start = 0;
        for i in 0..self.rows() {
            may_continue_at(i)?;
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
        self.indices.shrink_to_fit();
        self.values.truncate(kept);
        self.values.shrink_to_fit();
        Ok(())
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
    pub fn row(
        &self,
        i: usize,
    ) -> impl ExactSizeIterator<Item = (usize, f64)> + DoubleEndedIterator + Clone + '_ {
        let range = self.offsets[i]..self.offsets[i + 1];
        self.indices[range.clone()]
            .iter()
            .zip(&self.values[range])
            .map(|(&j, &v)| (j as usize, v))
    }

    /// Entry `(i, i)` of a lower triangle: the last one of its row, or zero if it is not stored.
    pub fn diagonal(&self, i: usize) -> f64 {
        let row = self.offsets[i]..self.offsets[i + 1];
        match self.indices[row.clone()].last() {
            Some(&j) if j as usize == i => self.values[row.end - 1],
            _ => 0.0,
        }
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
        collect_in_parts(self.rows(), LEAST, |i| {
            self.row(i).map(|(j, v)| v * x[j]).sum()
        })
    }

    /// `A x` where `self` is the lower triangle of a symmetric `A`.
    pub fn mul_symmetric(&self, x: &[f64]) -> Vec<f64> {
        // By symmetry a row adds to entries of lower number. Those of another part get it after the rows of that part,
        // as they do where there is one part.
        let parts = in_parts(self.rows(), LEAST, |rows| {
            let start = rows.start;
            let (mut y, mut below) = (vec![0.0; rows.len()], Vec::new());
            for i in rows {
                let mut sum = 0.0;
                for (j, v) in self.row(i) {
                    sum += v * x[j];
                    match j.checked_sub(start) {
                        _ if i == j => {}
                        Some(at) => y[at] += v * x[i],
                        None => below.push((j as u32, v * x[i])),
                    }
                }
                y[i - start] += sum;
            }
            (y, below)
        });
        let mut all = Vec::with_capacity(self.rows());
        for (mut y, below) in parts {
            all.append(&mut y);
            for (j, term) in below {
                all[j as usize] += term;
            }
        }
        all
    }
}

/// Sorts the entries of a row by column. Entries of the same column keep their order. `row` is room for a long row.
fn sort_row(indices: &mut [u32], values: &mut [f64], row: &mut Vec<(u32, f64)>) {
    if indices.len() <= SHORT {
        for k in 1..indices.len() {
            let (j, v) = (indices[k], values[k]);
            let mut at = k;
            while at > 0 && indices[at - 1] > j {
                (indices[at], values[at]) = (indices[at - 1], values[at - 1]);
                at -= 1;
            }
            (indices[at], values[at]) = (j, v);
        }
    } else if !indices.is_sorted() {
        row.clear();
        row.extend(indices.iter().copied().zip(values.iter().copied()));
        row.sort_by_key(|&(j, _)| j);
        for ((index, value), &(j, v)) in indices.iter_mut().zip(values).zip(row.iter()) {
            (*index, *value) = (j, v);
        }
    }
}

/// An empty vector with room for `len` elements.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub(crate) fn reserve<T>(len: usize) -> Result<Vec<T>> {
    let mut v = Vec::new();
    more(&mut v, len)?;
    Ok(v)
}

/// Makes room for `len` more elements.
fn more<T>(v: &mut Vec<T>, len: usize) -> Result<()> {
    v.try_reserve_exact(len).map_err(|_| Error::OutOfMemory {
        what: "a sparse matrix",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn duplicates_are_summed_and_rows_sorted() {
        let entries = [(1, 2, 1.0), (0, 1, 2.0), (1, 0, 3.0), (1, 2, 4.0)];
        let a = Sparse::from_triplets(2, 3, entries.into_iter()).unwrap();
        assert_eq!(a.row(0).collect::<Vec<_>>(), [(1, 2.0)]);
        assert_eq!(a.row(1).collect::<Vec<_>>(), [(0, 3.0), (2, 5.0)]);
    }

    #[test]
    fn long_rows_are_sorted_as_short_ones_are() {
        // Sums whose terms must be added in the order given: 1 is lost beside 2^60, and 2^60 - 2^60 is not.
        let row = |i: u32| {
            let terms = [2f64.powi(60), 1.0, -(2f64.powi(60))].into_iter();
            let columns = move |v| (0..7 + 40 * i).rev().map(move |j| (i, j, v));
            terms.flat_map(columns)
        };
        let a = Sparse::from_triplets(3, 100, (0..3).flat_map(row)).unwrap();
        for i in 0..3 {
            let expected: Vec<_> = (0..7 + 40 * i).map(|j| (j, 0.0)).collect();
            assert_eq!(a.row(i).collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn many_entries_are_summed_as_few_are() {
        let entry = |k: u32| {
            (
                k * 7 % 5,
                k * 3 % 4,
                f64::from(k).sin() * 10f64.powi(k as i32 % 17),
            )
        };
        // The place (1, 2) has no entry.
        let some = |&(i, j, _): &(u32, u32, f64)| (i, j) != (1, 2);
        let many: Vec<_> = (0..400).map(entry).filter(some).collect();
        let few = Sparse::from_triplets(500, 400, many.iter().copied()).unwrap();
        let found = Sparse::from_triplets(5, 4, many.iter().copied()).unwrap();
        assert_eq!(found.len(), 19);
        for i in 0..5 {
            assert_eq!(
                found.row(i).collect::<Vec<_>>(),
                few.row(i).collect::<Vec<_>>()
            );
        }
        let zero = Sparse::from_triplets(1, 1, (0..9).map(|_| (0, 0, -0.0))).unwrap();
        assert_eq!(zero.values()[0].to_bits(), (-0.0f64).to_bits());
    }

    #[test]
    fn any_number_of_threads_sorts_alike() {
        let n = 3 * LEAST as u32;
        let entries = (0..4 * n).map(|k| (k % n, k.wrapping_mul(2_654_435_761) % n, f64::from(k)));
        let one = with_threads(1, || {
            Sparse::from_triplets(n as usize, n as usize, entries.clone())
        });
        let started = spawned(|| {
            let three = || Sparse::from_triplets(n as usize, n as usize, entries);
            assert_eq!(with_threads(3, three), one);
        });
        assert_eq!(started, 2);
    }

    #[test]
    fn any_number_of_threads_gives_products_the_same_bits() {
        // Each row has entries near the diagonal and far before it, and all rows have one with the first unknown.
        let n = 3 * LEAST as u32;
        let row = |i: u32| [(i, 0), (i, i), (i, i - i % 2), (i, i / 3)];
        let entries = (1..n)
            .flat_map(row)
            .map(|(i, j)| (i, j, f64::from(i).sin()));
        let a = Sparse::from_triplets(n as usize, n as usize, entries).unwrap();
        let x: Vec<f64> = (0..n).map(|i| f64::from(i).cos()).collect();
        // The textbook's product, row after row.
        let mut expected = vec![0.0; x.len()];
        for i in 0..x.len() {
            let own: f64 = a.row(i).map(|(j, v)| v * x[j]).sum();
            expected[i] += own;
            for (j, v) in a.row(i).filter(|&(j, _)| j < i) {
                expected[j] += v * x[i];
            }
        }
        let products = || (a.mul_symmetric(&x), a.mul(&x));
        let one = with_threads(1, products);
        assert!(one.0 == expected);
        for threads in [2, 3] {
            let started = spawned(|| assert!(with_threads(threads, products) == one));
            assert_eq!(started, 2 * (threads - 1));
        }
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
