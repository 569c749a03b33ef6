//! Preconditioned conjugate gradients over the unknowns that are not held.
//!
//! The method of `hestenes1952`. The preconditioner is a factor of the whole matrix, restricted to the free
//! unknowns. It is exact while no unknown is held. Its error has a rank that grows with the number of held
//! unknowns, so a few held unknowns cost a few iterations.

use super::{RelaxedFactor, Sparse};
use crate::error::Result;

/// When conjugate gradients end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// The largest number of iterations.
    pub iterations: usize,
    /// The iteration ends when the estimated distance of every unknown from the minimiser is at most this.
    pub tolerance: f64,
}

/// Moves `point` towards the minimiser of `1/2 x'Ax + g'x` with the `held` unknowns kept. Returns whether the
/// iteration converged within its limits.
///
/// `lower` is the lower triangle of A, and `factor` is the factor of A. `go_on` is asked before each
/// iteration; if it returns false, the iteration ends and `point` keeps its current value.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn conjugate_gradient(
    lower: &Sparse,
    gradient: &[f64],
    factor: &RelaxedFactor,
    held: &[bool],
    point: &mut [f64],
    effort: Effort,
    mut go_on: impl FnMut() -> bool,
) -> Result<bool> {
    let free = |mut v: Vec<f64>| {
        for (v, held) in v.iter_mut().zip(held) {
            if *held {
                *v = 0.0;
            }
        }
        v
    };
    let precondition = |r: &[f64]| -> Result<Vec<f64>> {
        let mut z = r.to_vec();
        factor.solve(&mut z)?;
        Ok(free(z))
    };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let slope = lower.mul_symmetric(point);
    let mut r = free(slope.iter().zip(gradient).map(|(s, g)| -s - g).collect());
    let mut z = precondition(&r)?;
    let mut direction = z.clone();
    let mut rz = dot(&r, &z);
    for _ in 0..effort.iterations {
        if z.iter().all(|z| z.abs() <= effort.tolerance) {
            return Ok(true);
        }
        if !go_on() {
            return Ok(false);
        }
        let product = free(lower.mul_symmetric(&direction));
        let curvature = dot(&direction, &product);
        if curvature <= 0.0 || !curvature.is_finite() {
            return Ok(false);
        }
        let step = rz / curvature;
        for i in 0..point.len() {
            point[i] += step * direction[i];
            r[i] -= step * product[i];
        }
        z = precondition(&r)?;
        let next = dot(&r, &z);
        let keep = next / rz;
        rz = next;
        for (d, z) in direction.iter_mut().zip(&z) {
            *d = z + keep * *d;
        }
    }
    Ok(z.iter().all(|z| z.abs() <= effort.tolerance))
}

#[cfg(test)]
mod tests {
    use super::super::minimise_fixed;
    use super::*;

    #[test]
    fn few_held_unknowns_take_few_iterations() {
        let n = 60u32;
        let springs = (0..n - 1).flat_map(|i| [(i, i, 2.0), (i + 1, i + 1, 2.0), (i + 1, i, -2.0)]);
        let ground = (0..n).map(|i| (i, i, 0.01));
        let a = Sparse::from_triplets(60, 60, springs.chain(ground)).unwrap();
        let gradient: Vec<f64> = (0..60).map(|i| f64::from(i).sin()).collect();
        let factor = RelaxedFactor::new(&a, &[]).unwrap();
        let mut held = vec![false; 60];
        let mut point = vec![0.0; 60];
        for i in [3, 30, 55] {
            held[i] = true;
            point[i] = 2.0;
        }
        let expected = minimise_fixed(&a, &gradient, &held, &point).unwrap();
        let mut found = point.clone();
        let tolerance = 1e-9;
        let few = Effort {
            iterations: 5,
            tolerance,
        };
        let few =
            conjugate_gradient(&a, &gradient, &factor, &held, &mut found, few, || true).unwrap();
        assert!(few, "one iteration a held unknown, and one");
        for (x, y) in found.iter().zip(&expected) {
            assert!((x - y).abs() < 1e-8);
        }
        let none = Effort {
            iterations: 0,
            tolerance,
        };
        let none = conjugate_gradient(&a, &gradient, &factor, &held, &mut point, none, || true);
        assert!(!none.unwrap(), "no iteration, not converged");
    }
}
