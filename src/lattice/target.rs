//! The target of a closest-vector problem, in coordinates of a reduced basis.

use super::Basis;
use crate::error::{Error, Result};

/// Coordinates are rounded in floating point, which is exact up to this size.
const LARGEST: f64 = 9_007_199_254_740_992.0;

/// A point by its coordinates, each split into a whole number and a remainder of at most one half.
///
/// All further computations are relative to the whole part, where numbers are small. So no digits are lost
/// if the caller's coordinates are large.
#[derive(Debug, Clone)]
pub struct Target {
    /// The nearest whole coordinates, including the free ones.
    pub whole: Vec<i64>,
    /// The remainders of the coordinates that are not free.
    pub rest: Vec<f64>,
}

impl Target {
    /// The point that has `point` as its coordinates in the caller's basis: `y` with `U y = point`.
    ///
    /// # Errors
    /// [`Error::Overflow`](crate::Error::Overflow) for coordinates beyond 2^53.
    pub fn new(basis: &Basis, point: &[f64]) -> Result<Self> {
        let y = basis.coordinates(point);
        if let Some(i) = y.iter().position(|v| v.is_nan() || v.abs() > LARGEST) {
            return Err(Error::Overflow {
                what: "a coordinate of the lattice is beyond 2^53".into(),
                index: Some(i),
            });
        }
        let whole: Vec<i64> = y.iter().map(|v| v.round() as i64).collect();
        // Computed again relative to the whole part, where the remainder of the point is small.
        let reached = basis.transform().apply(&whole)?;
        let left: Vec<f64> = point
            .iter()
            .zip(&reached)
            .map(|(p, &r)| p - r as f64)
            .collect();
        let mut rest = basis.coordinates(&left);
        rest.truncate(basis.rank());
        Ok(Target { whole, rest })
    }

    /// The caller's integers of the lattice point at `z` from the whole part.
    ///
    /// # Errors
    /// [`Error::Overflow`] beyond 64 bits.
    pub fn integers(&self, basis: &Basis, z: &[i64]) -> Result<Vec<i64>> {
        let mut all = self.whole.clone();
        for (a, z) in all.iter_mut().zip(z) {
            *a += z;
        }
        basis.transform().apply(&all)
    }

    /// The steps from the whole part to the lattice point with these integers.
    ///
    /// # Errors
    /// [`Error::Overflow`] beyond 64 bits.
    pub fn steps(&self, basis: &Basis, integers: &[i64]) -> Result<Vec<i64>> {
        let all = basis.whole_coordinates(integers)?;
        let steps = all.iter().zip(&self.whole).map(|(a, w)| a - w);
        Ok(steps.take(basis.rank()).collect())
    }

    /// The squared distance of the target from the lattice point at `z` from the whole part.
    pub fn distance(&self, basis: &Basis, z: &[i64]) -> f64 {
        let m = basis.rank();
        let offset = |j: usize| self.rest[j] - z[j] as f64;
        let row = |i: usize| (i..m).map(|j| basis.r(i, j) * offset(j)).sum::<f64>();
        (0..m).map(|i| row(i).powi(2)).sum()
    }
}
