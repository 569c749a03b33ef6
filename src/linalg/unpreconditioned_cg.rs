//! Conjugate gradients without a preconditioner, which stop at a tolerance of the residual.
//!
//! The method of `hestenes1952`. [`conjugate_gradient`] needs fewer iterations, but `bommes2012`, chapter 5,
//! iterates this method between two roundings and stops before convergence. Its decisions therefore depend on
//! the intermediate points, which only the same iteration reproduces.
//!
//! [`conjugate_gradient`]: super::conjugate_gradient

use super::{Effort, Sparse};

/// Moves `point` towards the minimiser of `1/2 x'Hx + g'x` with the `held` unknowns kept. Returns whether the
/// residual fell to the tolerance within the allowed number of iterations.
///
/// `lower` is the lower triangle of H. The residual is that of `A x = b` with `A = H / 2`, in the Euclidean
/// norm. `go_on` is asked before each iteration; if it returns false, the iteration ends and `point` keeps
/// its current value.
pub fn unpreconditioned_conjugate_gradient(
    lower: &Sparse,
    gradient: &[f64],
    held: &[bool],
    point: &mut [f64],
    effort: Effort,
    mut go_on: impl FnMut() -> bool,
) -> bool {
    let free = |mut v: Vec<f64>| {
        for (v, _) in v.iter_mut().zip(held).filter(|(_, held)| **held) {
            *v = 0.0;
        }
        v
    };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let slope = lower.mul_symmetric(point);
    let mut r = free(slope.iter().zip(gradient).map(|(s, g)| -s - g).collect());
    let mut direction = r.clone();
    let mut rr = dot(&r, &r);
    let near = |rr: f64| 0.5 * rr.sqrt() <= effort.tolerance;
    for _ in 0..effort.iterations {
        if near(rr) || !go_on() {
            break;
        }
        let product = free(lower.mul_symmetric(&direction));
        let curvature = dot(&direction, &product);
        if curvature <= 0.0 || !curvature.is_finite() {
            break;
        }
        let step = rr / curvature;
        for i in 0..point.len() {
            point[i] += step * direction[i];
            r[i] -= step * product[i];
        }
        let next = dot(&r, &r);
        let keep = next / rr;
        rr = next;
        for (d, r) in direction.iter_mut().zip(&r) {
            *d = r + keep * *d;
        }
    }
    near(rr)
}

#[cfg(test)]
mod tests {
    use super::super::minimise_fixed;
    use super::*;

    #[test]
    fn as_many_iterations_as_free_unknowns_reach_the_minimiser() {
        let n = 12u32;
        let springs = (0..n - 1).flat_map(|i| [(i, i, 2.0), (i + 1, i + 1, 2.0), (i + 1, i, -2.0)]);
        let ground = (0..n).map(|i| (i, i, 0.5 + 0.1 * f64::from(i)));
        let a = Sparse::from_triplets(12, 12, springs.chain(ground)).unwrap();
        let gradient: Vec<f64> = (0..n).map(|i| f64::from(i).sin()).collect();
        let held: Vec<bool> = (0..n).map(|i| i % 5 == 3).collect();
        let start: Vec<f64> = (0..n).map(|i| f64::from(i % 3)).collect();
        let expected = minimise_fixed(&a, &gradient, &held, &start).unwrap();
        let run = |iterations| {
            let tolerance = 1e-9;
            let effort = Effort {
                iterations,
                tolerance,
            };
            let mut point = start.clone();
            let near = unpreconditioned_conjugate_gradient(
                &a,
                &gradient,
                &held,
                &mut point,
                effort,
                || true,
            );
            (near, point)
        };
        let (near, point) = run(10);
        assert!(near);
        for (x, y) in point.iter().zip(&expected) {
            assert!((x - y).abs() < 1e-8);
        }
        assert!(!run(2).0, "two iterations are not enough");
        assert_eq!(run(0), (false, start.clone()));
    }
}
