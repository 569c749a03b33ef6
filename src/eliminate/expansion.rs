//! The affine map from the reduced unknowns back to the caller's.

use std::sync::Arc;

use crate::linalg::Sparse;

/// `x = T y + t`: `y` ranges over everything that the constraints allow.
///
/// Rows of `T` and `t` that belong to integer unknowns hold integers, and reach only integer
/// entries of `y`.
#[derive(Debug, Clone, PartialEq)]
pub struct Expansion {
    matrix: Arc<Sparse>,
    offset: Vec<f64>,
}

impl Expansion {
    pub(super) fn new(matrix: Arc<Sparse>, offset: Vec<f64>) -> Self {
        debug_assert_eq!(matrix.rows(), offset.len());
        Expansion { matrix, offset }
    }

    /// `T`, one row an unknown of the caller, one column a reduced unknown.
    pub fn matrix(&self) -> &Sparse {
        &self.matrix
    }

    /// `t`, one number an unknown of the caller.
    pub fn offset(&self) -> &[f64] {
        &self.offset
    }

    /// The caller's unknowns from the reduced ones.
    pub fn expand(&self, y: &[f64]) -> Vec<f64> {
        let mut x = self.matrix.mul(y);
        for (x, t) in x.iter_mut().zip(&self.offset) {
            *x += t;
        }
        x
    }

    /// A direction in the caller's unknowns from one in the reduced ones.
    pub fn expand_direction(&self, v: &[f64]) -> Vec<f64> {
        self.matrix.mul(v)
    }
}
