//! One factor of the whole matrix, with continuous unknowns first and integers last.
//!
//! The whole factor solves for all unknowns. Its leading part solves for the continuous unknowns while the
//! integers are held. Its trailing block is the factor of the Schur complement on the integers: the quadratic
//! form in the integers that remains after minimisation over the continuous unknowns (`golub2013`, section
//! 4.2). The complement itself is never formed, so no accuracy is lost by squaring.
//!
//! The continuous unknowns are in the minimum-degree order of their own block. The integers become a dense block in any
//! order. This factor is therefore efficient if there are few integers.

use super::{Analysis, Cholesky, Sparse, minimum_degree, principal_submatrix};
use crate::error::Result;
use crate::monitor::may_continue;

/// The factor and its trailing block.
#[derive(Debug)]
pub struct SchurFactor {
    factor: Cholesky,
    integers: usize,
    trailing: Vec<f64>,
    full: bool,
}

impl SchurFactor {
    /// Factors the matrix with lower triangle `lower`, whose unknowns are either `continuous` or `integers`.
    ///
    /// # Errors
    /// As [`Cholesky::new`].
    pub fn new(lower: &Sparse, continuous: &[u32], integers: &[u32]) -> Result<Self> {
        let analysis = Self::analyse(lower, continuous, integers)?;
        Self::with(&analysis, lower, integers.len())
    }

    /// The order of elimination and the pattern of the factor, for all matrices of this pattern.
    ///
    /// # Errors
    /// As [`Cholesky::new`].
    pub fn analyse(lower: &Sparse, continuous: &[u32], integers: &[u32]) -> Result<Analysis> {
        let block = principal_submatrix(lower, continuous)?;
        let order = minimum_degree(&block)?;
        may_continue()?;
        let unknowns = order.into_iter().map(|k| continuous[k as usize]);
        let order = unknowns.chain(integers.iter().copied()).collect();
        Analysis::in_order(lower, order)
    }

    /// As [`new`](Self::new), for a matrix with the pattern that was [analysed](Self::analyse) and so many integers.
    ///
    /// # Errors
    /// As [`Cholesky::new`].
    pub fn with(analysis: &Analysis, lower: &Sparse, integers: usize) -> Result<Self> {
        let factor = Cholesky::with(analysis, lower)?;
        let (trailing, full) = factor.trailing_factor(integers)?;
        Ok(SchurFactor {
            factor,
            integers,
            trailing,
            full,
        })
    }

    /// The factor of the whole matrix.
    pub fn whole(&self) -> &Cholesky {
        &self.factor
    }

    /// The upper triangular `R`, by columns, where `R'R` is the Schur complement on the integers, and whether
    /// all pivots are positive. A vanished pivot leaves a zero row.
    pub fn schur(&self) -> (&[f64], bool) {
        (&self.trailing, self.full)
    }

    /// Whether no pivot vanished.
    pub fn is_definite(&self) -> bool {
        self.factor.null_unknowns().is_empty()
    }

    /// Solves `A_cc x_c = b_c` in place. The entries of integers are neither read nor changed. The factor
    /// must be [definite](Self::is_definite).
    ///
    /// # Errors
    /// The end of the call.
    pub fn solve_continuous(&self, b: &mut [f64]) -> Result<()> {
        self.factor.solve_leading(b, self.integers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grounded chain of springs with some springs that span several unknowns.
    fn springs(n: u32) -> Sparse {
        let ends = (0..n).flat_map(|i| [(i, (i + 1) % n), (i, (i * 7 + 3) % n)]);
        let entries = ends.filter(|(i, j)| i != j).flat_map(|(i, j)| {
            let k = 1.0 + f64::from(i % 5);
            [(i, i, k), (j, j, k), (i.max(j), i.min(j), -k)]
        });
        let ground = (0..n).map(|i| (i, i, 0.01));
        Sparse::from_triplets(n as usize, n as usize, entries.chain(ground)).unwrap()
    }

    #[test]
    fn one_factor_solves_the_whole_and_the_continuous_part() {
        let a = springs(60);
        let is_integer = |i: &u32| i.is_multiple_of(4);
        let (integers, continuous): (Vec<u32>, Vec<u32>) = (0..60).partition(is_integer);
        let schur_factor = SchurFactor::new(&a, &continuous, &integers).unwrap();
        assert!(schur_factor.is_definite());
        let x: Vec<f64> = (0..60).map(|i| f64::from(i).sin()).collect();
        let mut b = a.mul_symmetric(&x);
        schur_factor.whole().solve(&mut b).unwrap();
        for (b, x) in b.iter().zip(&x) {
            assert!((b - x).abs() < 1e-10, "{b} {x}");
        }
        let mut held = x.clone();
        integers.iter().for_each(|&i| held[i as usize] = 0.0);
        let mut b = a.mul_symmetric(&held);
        integers.iter().for_each(|&i| b[i as usize] = 77.0);
        schur_factor.solve_continuous(&mut b).unwrap();
        for &i in &continuous {
            let (b, x) = (b[i as usize], x[i as usize]);
            assert!((b - x).abs() < 1e-10, "{b} {x}");
        }
        assert!(integers.iter().all(|&i| b[i as usize] == 77.0));
    }

    #[test]
    fn the_trailing_block_is_the_factor_of_what_the_integers_see() {
        let a = springs(40);
        let (integers, continuous): (Vec<u32>, Vec<u32>) = (0..40).partition(|&i| i % 8 == 1);
        let schur_factor = SchurFactor::new(&a, &continuous, &integers).unwrap();
        let (r, full) = schur_factor.schur();
        assert!(full);
        let m = integers.len();
        for (k, &i) in integers.iter().enumerate() {
            // Column k of the complement is the force at the integers when integer k moves by one.
            let mut x = vec![0.0; 40];
            x[i as usize] = 1.0;
            let mut follow: Vec<f64> = a.mul_symmetric(&x).iter().map(|f| -f).collect();
            schur_factor.solve_continuous(&mut follow).unwrap();
            continuous
                .iter()
                .for_each(|&c| x[c as usize] = follow[c as usize]);
            let force = a.mul_symmetric(&x);
            for (l, &j) in integers.iter().enumerate() {
                let product: f64 = (0..m).map(|q| r[k * m + q] * r[l * m + q]).sum();
                assert!((product - force[j as usize]).abs() < 1e-10);
            }
        }
    }
}
