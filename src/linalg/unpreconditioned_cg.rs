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
/// `rows` is all of H. The residual is that of `A x = b` with `A = H / 2`, in the Euclidean norm. `go_on` is asked
/// before each iteration; if it returns false, the iteration ends and `point` keeps its current value.
pub fn unpreconditioned_conjugate_gradient(
    rows: &Sparse,
    gradient: &[f64],
    held: &[bool],
    point: &mut [f64],
    effort: Effort,
    mut go_on: impl FnMut() -> bool,
) -> bool {
    let product_with = |i: usize, x: &[f64]| {
        let terms = rows.row(i);
        terms.fold(0.0, |sum, (j, v)| sum + v * x[j])
    };
    let mut r: Vec<f64> = (0..point.len())
        .map(|i| match held[i] {
            true => 0.0,
            false => -product_with(i, point) - gradient[i],
        })
        .collect();
    let mut direction = r.clone();
    let mut product = vec![0.0; point.len()];
    let mut rr: f64 = r.iter().map(|r| r * r).sum();
    let near = |rr: f64| 0.5 * rr.sqrt() <= effort.tolerance;
    for _ in 0..effort.iterations {
        if near(rr) || !go_on() {
            break;
        }
        let mut curvature = 0.0;
        for i in (0..point.len()).filter(|&i| !held[i]) {
            product[i] = product_with(i, &direction);
            curvature += direction[i] * product[i];
        }
        if curvature <= 0.0 || !curvature.is_finite() {
            break;
        }
        let step = rr / curvature;
        let mut next = 0.0;
        for i in 0..point.len() {
            point[i] += step * direction[i];
            r[i] -= step * product[i];
            next += r[i] * r[i];
        }
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
        let upper = a.entries().filter(|(i, j, _)| i != j);
        let both = a.entries().chain(upper.map(|(i, j, v)| (j, i, v)));
        let rows = Sparse::from_triplets(12, 12, both).unwrap();
        let run = |iterations| {
            let tolerance = 1e-9;
            let effort = Effort {
                iterations,
                tolerance,
            };
            let mut point = start.clone();
            let near = unpreconditioned_conjugate_gradient(
                &rows,
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
