//! The affine map from the reduced unknowns back to the caller's.

use std::sync::Arc;

use crate::linalg::Sparse;

/// The affine map `x = T y + t`, whose values are exactly the solutions of the constraints.
///
/// The rows of `T` and `t` of integer unknowns hold integers and refer to integer entries of `y` only.
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

    /// The matrix `T`: one row for each of the caller's unknowns, one column for each reduced unknown.
    pub fn matrix(&self) -> &Sparse {
        &self.matrix
    }

    pub(super) fn shared_matrix(&self) -> &Arc<Sparse> {
        &self.matrix
    }

    /// The offset `t`, one number for each of the caller's unknowns.
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
