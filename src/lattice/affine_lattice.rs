//! A short basis and a near point of an affine lattice `{ x0 + K z : z integer }`, in exact integers.
//!
//! Eliminating equations between integers gives a basis of their solutions, whose entries may be as large
//! as the products of all coefficients. `aardal2000`, sections 2 and 3, reduce this basis by LLL. After
//! that, its vectors and the nearest solution are close to the shortest possible. K and x0 stay exact; only
//! the multiples are computed in floating point. Each round of the reduction starts from the exact vectors
//! and recovers the digits that the round before lost. The rounds end when nothing gets shorter.

use super::{Basis, Transform, lll};
use crate::error::{Error, Result};

/// The largest number of rounds of reduction, or of steps towards a point.
const ROUNDS: usize = 20;

/// The largest number of multiplications in a round of reduction. No lattice of tens of dimensions needs as
/// many.
const PATIENCE: u64 = 100_000_000;

/// A vector leaves the span of the vectors before it if at least this part of it is orthogonal to them.
const LEAVES: f64 = f64::EPSILON;

/// `x0 + K z`.
#[derive(Debug, Clone)]
pub struct AffineLattice {
    origin: Vec<i128>,
    /// Columns of K, linearly independent.
    basis: Vec<Vec<i128>>,
}

impl AffineLattice {
    /// The lattice with this origin and these basis vectors. All entries are whole numbers.
    pub fn new(origin: &[f64], basis: &[Vec<f64>]) -> Self {
        let whole = |v: &[f64]| v.iter().map(|&v| v as i128).collect();
        AffineLattice {
            origin: whole(origin),
            basis: basis.iter().map(|v| whole(v)).collect(),
        }
    }

    /// The largest absolute value of an entry.
    pub fn size(&self) -> f64 {
        let all = self.basis.iter().flatten().chain(&self.origin);
        all.map(|v| v.unsigned_abs()).max().unwrap_or(0) as f64
    }

    /// The number of coordinates z.
    pub fn dim(&self) -> usize {
        self.basis.len()
    }

    /// x0.
    pub fn origin(&self, i: usize) -> f64 {
        self.origin[i] as f64
    }

    /// Entry `i` of column `k` of K.
    pub fn entry(&self, i: usize, k: usize) -> f64 {
        self.basis[k][i] as f64
    }

    /// Reduces the basis.
    ///
    /// # Errors
    /// [`Error::Overflow`] if a number exceeds 126 bits.
    pub fn shorten(&mut self) -> Result<()> {
        let m = self.dim();
        for _ in 0..ROUNDS {
            let mut factor = vec![0.0; m * m];
            for (k, column) in self.orthogonal().1.iter().enumerate() {
                factor[k * m..][..=k].copy_from_slice(column);
            }
            let mut reduced = Basis::from_factor(m, factor, true);
            let mut left = PATIENCE;
            lll(&mut reduced, 1, &mut |spent| {
                left = left.saturating_sub(spent);
                left == 0
            })?;
            let before = self.length();
            self.basis = self.product(reduced.transform())?;
            if self.length() > 0.5 * before {
                break;
            }
        }
        Ok(())
    }

    /// Moves the origin to a point of the lattice near `target`.
    ///
    /// # Errors
    /// [`Error::Overflow`] if a number exceeds 126 bits.
    pub fn approach(&mut self, target: &[f64]) -> Result<()> {
        let (directions, factor) = self.orthogonal();
        for _ in 0..ROUNDS {
            let steps = self.steps(target, &directions, &factor, f64::round);
            if steps.iter().all(|z| *z == 0.0) {
                break;
            }
            for (column, z) in self.basis.iter().zip(steps) {
                for (x, v) in self.origin.iter_mut().zip(column) {
                    *x = add(*x, z as i128, *v)?;
                }
            }
        }
        Ok(())
    }

    /// The real coordinates of the point nearest to `x` in the span of the lattice.
    pub fn coordinates(&self, x: &[f64]) -> Vec<f64> {
        let (directions, factor) = self.orthogonal();
        self.steps(x, &directions, &factor, |z| z)
    }

    /// The point with coordinates `z`.
    pub fn point(&self, z: &[f64]) -> Vec<f64> {
        let entry = |i: usize| {
            let mut sum = crate::linalg::CompensatedSum::new(self.origin(i));
            for (k, z) in z.iter().enumerate() {
                sum.add_product(self.entry(i, k), *z);
            }
            sum.value()
        };
        (0..self.origin.len()).map(entry).collect()
    }

    /// The combination of basis vectors with coefficients `z`.
    pub fn direction(&self, z: &[f64]) -> Vec<f64> {
        let entry = |i: usize| {
            let terms = z.iter().enumerate();
            terms.map(|(k, z)| self.entry(i, k) * z).sum()
        };
        (0..self.origin.len()).map(entry).collect()
    }

    /// Nearest plane from the origin towards `target`. The multiples are rounded if `whole`.
    fn steps(
        &self,
        target: &[f64],
        directions: &[Vec<f64>],
        factor: &[Vec<f64>],
        whole: impl Fn(f64) -> f64,
    ) -> Vec<f64> {
        let mut rest: Vec<f64> = (target.iter().zip(&self.origin))
            .map(|(t, o)| t - *o as f64)
            .collect();
        let mut steps = vec![0.0; self.dim()];
        for k in (0..self.dim()).rev() {
            steps[k] = whole(dot(&rest, &directions[k]) / factor[k][k]);
            for (rest, v) in rest.iter_mut().zip(&self.basis[k]) {
                *rest -= steps[k] * *v as f64;
            }
        }
        steps
    }

    /// Orthonormal directions, and the columns of the basis in these directions down to the diagonal. This
    /// is the Gram-Schmidt process with each step done twice, which is enough.
    fn orthogonal(&self) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let mut directions: Vec<Vec<f64>> = Vec::with_capacity(self.dim());
        let mut factor = Vec::with_capacity(self.dim());
        for column in &self.basis {
            let mut v: Vec<f64> = column.iter().map(|&v| v as f64).collect();
            let whole = dot(&v, &v).sqrt();
            let mut entries = vec![0.0; directions.len() + 1];
            for _ in 0..2 {
                for (d, entry) in directions.iter().zip(&mut entries) {
                    let along = dot(&v, d);
                    *entry += along;
                    v.iter_mut().zip(d).for_each(|(v, d)| *v -= along * d);
                }
            }
            let left = dot(&v, &v).sqrt();
            if let Some(last) = entries.last_mut() {
                *last = left.max(LEAVES * whole);
            }
            if left > 0.0 {
                v.iter_mut().for_each(|v| *v /= left);
            }
            directions.push(v);
            factor.push(entries);
        }
        (directions, factor)
    }

    /// The sum of the squared lengths.
    fn length(&self) -> f64 {
        self.basis
            .iter()
            .flatten()
            .map(|&v| (v as f64).powi(2))
            .sum()
    }

    fn product(&self, by: &Transform) -> Result<Vec<Vec<i128>>> {
        let column = |k: usize| {
            let mut sum = vec![0; self.origin.len()];
            for (j, column) in self.basis.iter().enumerate() {
                let factor = by.at(j, k);
                for (sum, v) in sum.iter_mut().zip(column) {
                    *sum = add(*sum, factor, *v)?;
                }
            }
            Ok(sum)
        };
        (0..self.dim()).map(column).collect()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `a + b c`.
fn add(a: i128, b: i128, c: i128) -> Result<i128> {
    let product = b.checked_mul(c);
    product
        .and_then(|p| a.checked_add(p))
        .ok_or_else(|| Error::Overflow {
            what: "an integer of the lattice is too large".into(),
            index: None,
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The solutions of `3 x0 + 5 x1 - 7 x2 = 4`, with a very long basis and a distant origin.
    fn far_and_long() -> AffineLattice {
        let (a, b) = ([5.0, -3.0, 0.0], [4.0, -1.0, 1.0]);
        let mix = |p: f64, q: f64| (0..3).map(|i| p * a[i] + q * b[i]).collect::<Vec<f64>>();
        // Consecutive Fibonacci numbers, so the determinant is 1.
        let basis = [mix(832_040.0, 514_229.0), mix(514_229.0, 317_811.0)];
        let far = mix(1e12, -7e11);
        AffineLattice::new(&[far[0] + 3.0, far[1] - 1.0, far[2]], &basis)
    }

    #[test]
    fn basis_and_origin_become_short_and_stay_solutions() {
        let mut affine = far_and_long();
        affine.shorten().unwrap();
        affine.approach(&[0.0; 3]).unwrap();
        assert!(affine.size() <= 4.0, "{affine:?}");
        let value = |x: &[i128]| 3 * x[0] + 5 * x[1] - 7 * x[2];
        assert_eq!(value(&affine.origin), 4);
        assert!(affine.basis.iter().all(|v| value(v) == 0));
        // The lattice is the same: the volume of its cell is the length of the row.
        let (a, b) = (&affine.basis[0], &affine.basis[1]);
        let cross = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
        let cell = [cross(1, 2), cross(2, 0), cross(0, 1)];
        assert!(cell == [3, 5, -7] || cell == [-3, -5, 7], "{cell:?}");
    }

    #[test]
    fn points_have_the_coordinates_that_make_them() {
        let mut affine = far_and_long();
        affine.shorten().unwrap();
        affine.approach(&[100.0, 0.0, 50.0]).unwrap();
        let z = [3.0, -11.0];
        let back = affine.coordinates(&affine.point(&z));
        assert!(
            back.iter().zip(z).all(|(a, b)| (a - b).abs() < 1e-9),
            "{back:?}"
        );
        let step = affine.direction(&z);
        let (from, to) = (affine.point(&[0.0; 2]), affine.point(&z));
        assert!((0..3).all(|i| from[i] + step[i] == to[i]));
    }
}
