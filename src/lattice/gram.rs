//! A symmetric positive semi-definite matrix of scalar products, and its triangular factor.
//!
//! The columns of the factor are a basis of the lattice, up to a rotation, which changes no distance. A
//! pivot at or below [`RANK_TOLERANCE`] times its diagonal entry counts as zero, and its row is set to
//! zero: the vector depends on the vectors before it. A pivot that cancels is about 1e-15 of its diagonal
//! entry, from rounding. At a condition number of 1e8, a pivot that does not cancel is about 1e-8 of it.

use crate::error::{Error, Result};

/// A pivot at or below this part of its diagonal entry counts as zero, or below 128 units for each dimension
/// if that is less.
pub const RANK_TOLERANCE: f64 = 1e-12;

/// A dense symmetric matrix by columns, which are also its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Gram {
    dim: usize,
    values: Vec<f64>,
}

impl Gram {
    /// The matrix with these `dim * dim` entries. Only the lower triangle is read.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`], [`Error::NotFinite`].
    pub fn new(dim: usize, values: Vec<f64>) -> Result<Self> {
        if values.len() != dim * dim {
            return Err(Error::LengthMismatch {
                what: "a Gram matrix",
                expected: dim * dim,
                actual: values.len(),
            });
        }
        if let Some(position) = values.iter().position(|v| !v.is_finite()) {
            return Err(Error::NotFinite {
                what: "a Gram matrix",
                position,
            });
        }
        Ok(Gram { dim, values })
    }

    /// Number of rows.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// The entry in row `i`, column `j`.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        let (high, low) = (i.max(j), i.min(j));
        self.values[low * self.dim + high]
    }

    /// `v' G v`.
    #[cfg(test)]
    pub fn square(&self, v: &[f64]) -> f64 {
        let row = |i: usize| (0..self.dim).map(|j| self.at(i, j) * v[j]).sum::<f64>();
        (0..self.dim).map(|i| v[i] * row(i)).sum()
    }

    /// A solution of `G x = b`, zero where a pivot vanishes.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let n = self.dim;
        let (r, _) = self.factor();
        let mut x = b.to_vec();
        for j in 0..n {
            let column = &r[j * n..=j * n + j];
            let sum: f64 = column[..j].iter().zip(&x).map(|(r, x)| r * x).sum();
            x[j] = divide(x[j] - sum, column[j]);
        }
        for j in (0..n).rev() {
            let column = &r[j * n..=j * n + j];
            x[j] = divide(x[j], column[j]);
            let own = x[j];
            x.iter_mut()
                .zip(&column[..j])
                .for_each(|(x, r)| *x -= r * own);
        }
        x
    }

    /// The upper triangular factor R by columns, with `R'R = G`, and whether all pivots are nonzero.
    ///
    /// This is Cholesky by rows of R. A zero pivot makes its row zero.
    pub fn factor(&self) -> (Vec<f64>, bool) {
        let n = self.dim;
        let mut r = vec![0.0; n * n];
        let mut full = true;
        let tolerance = RANK_TOLERANCE.min(128.0 * f64::EPSILON * n as f64);
        for j in 0..n {
            for i in 0..j {
                let (left, right) = r.split_at_mut(j * n);
                let (a, b) = (&left[i * n..i * n + i + 1], &mut right[..n]);
                let sum: f64 = a[..i].iter().zip(&b[..i]).map(|(a, b)| a * b).sum();
                b[i] = divide(self.at(i, j) - sum, a[i]);
            }
            let column = &mut r[j * n..j * n + j + 1];
            let pivot = self.at(j, j) - column[..j].iter().map(|v| v * v).sum::<f64>();
            if pivot > tolerance * self.at(j, j) {
                column[j] = pivot.sqrt();
            } else {
                full = false;
            }
        }
        (r, full)
    }
}

/// The quotient, or zero if the pivot is zero.
fn divide(value: f64, pivot: f64) -> f64 {
    if pivot == 0.0 { 0.0 } else { value / pivot }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factor_squares_to_the_matrix_also_where_vectors_depend() {
        // Columns (1, 0), (2, 1), (1, 1), (0, 3).
        let b = [[1.0, 0.0], [2.0, 1.0], [1.0, 1.0], [0.0, 3.0]];
        let dot = |i: usize, j: usize| b[i][0] * b[j][0] + b[i][1] * b[j][1];
        let values = (0..16).map(|k| dot(k / 4, k % 4)).collect();
        let (r, full) = Gram::new(4, values).unwrap().factor();
        assert!(!full);
        for i in 0..4 {
            for j in 0..4 {
                let product: f64 = (0..4).map(|k| r[4 * i + k] * r[4 * j + k]).sum();
                assert!((product - dot(i, j)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn a_wrong_size_and_a_nan_are_refused() {
        assert!(Gram::new(2, vec![1.0; 3]).is_err());
        let nan = Gram::new(1, vec![f64::NAN]).unwrap_err();
        assert_eq!(nan.index(), Some(0));
    }
}
