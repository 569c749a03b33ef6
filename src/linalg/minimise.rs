//! A minimiser of a convex quadratic, or a direction that proves that there is none.

use super::{Cholesky, Sparse};
use crate::error::Result;
use crate::monitor::may_continue;

/// The quadratic is not convex if its curvature along some direction is below minus this. The direction is
/// scaled to a largest entry of one in the scaled unknowns.
pub const CURVATURE_TOLERANCE: f64 = 1e-9;

/// A slope along a direction without curvature counts as zero up to this, relative to the sum of the
/// absolute values of its terms. It is the accuracy to which the direction is known.
pub const SLOPE_TOLERANCE: f64 = 1e-9;

/// A sum this small, relative to the absolute values of its terms, has cancelled: it consists of rounding
/// errors.
pub const CANCELLED: f64 = 1e-12;

/// The number of vanished pivots that are examined for a bad direction, the most suspicious first.
const EXAMINED: usize = 16;

/// The result of minimising a quadratic.
#[derive(Debug, Clone, PartialEq)]
pub enum Minimum {
    /// A minimiser.
    At(Lowest),
    /// The quadratic falls without limit along this direction.
    Unbounded(Vec<f64>),
    /// The quadratic curves downwards along this direction.
    NotConvex(Vec<f64>),
}

/// A minimiser. Unknowns that the objective does not determine keep the guess.
#[derive(Debug, Clone, PartialEq)]
pub struct Lowest {
    /// The point.
    pub point: Vec<f64>,
    /// An estimate, `r' A^-1 r / 2` for the residual r, of the objective's excess over the minimum.
    pub excess: f64,
}

/// Minimises `1/2 x'Ax + g'x`, where `lower` is the lower triangle of `A` and `factor` its factor.
///
/// `rounding` gives the rounding error of each entry of `g`: where large terms cancel, their rounding error
/// must not count as a slope. It is called only if the result depends on it.
///
/// # Errors
/// Only for lack of memory and at the end of the call. Every other outcome is a [`Minimum`].
pub fn minimise(
    lower: &Sparse,
    gradient: &[f64],
    rounding: impl FnOnce() -> Vec<f64>,
    guess: &[f64],
    factor: &Cholesky,
) -> Result<Minimum> {
    let mut step = residual(lower, gradient, guess);
    may_continue()?;
    factor.solve(&mut step)?;
    may_continue()?;
    if !factor.null_unknowns().is_empty() {
        if let Some(direction) = downward_curvature(lower, factor)? {
            return Ok(Minimum::NotConvex(direction));
        }
        if let Some(direction) = endless_slope(gradient, rounding, &step, factor)? {
            return Ok(Minimum::Unbounded(direction));
        }
    }
    descend(lower, gradient, guess, &step, factor).map(Minimum::At)
}

/// As [`minimise`], for an objective that is known to be convex and bounded below. If it is so with all
/// unknowns free, it stays so when some of them are held at any values.
///
/// # Errors
/// For lack of memory.
pub fn minimise_bounded(
    lower: &Sparse,
    gradient: &[f64],
    guess: &[f64],
    factor: &Cholesky,
) -> Result<Vec<f64>> {
    let mut step = residual(lower, gradient, guess);
    may_continue()?;
    factor.solve(&mut step)?;
    may_continue()?;
    descend(lower, gradient, guess, &step, factor).map(|lowest| lowest.point)
}

/// Takes the first `step` from `guess` and refines the result.
fn descend(
    lower: &Sparse,
    gradient: &[f64],
    guess: &[f64],
    step: &[f64],
    factor: &Cholesky,
) -> Result<Lowest> {
    let mut point = guess.to_vec();
    for (x, s) in point.iter_mut().zip(step) {
        *x += s;
    }
    // One step of iterative refinement recovers the digits that an ill-conditioned factor loses.
    let r = residual(lower, gradient, &point);
    let mut step = r.clone();
    may_continue()?;
    factor.solve(&mut step)?;
    may_continue()?;
    let excess = 0.5 * r.iter().zip(&step).map(|(r, s)| r * s).sum::<f64>().abs();
    for (x, s) in point.iter_mut().zip(&step) {
        *x += s;
    }
    Ok(Lowest { point, excess })
}

/// Minus the gradient of `1/2 x'Ax + g'x` at `x`.
pub fn residual(lower: &Sparse, gradient: &[f64], x: &[f64]) -> Vec<f64> {
    let mut r = lower.mul_symmetric(x);
    for (r, g) in r.iter_mut().zip(gradient) {
        *r = -(*r + g);
    }
    r
}

/// The column of the inverse that belongs to null unknown `j`. If `A` is singular, this is a direction
/// without curvature.
fn null_direction(factor: &Cholesky, j: u32) -> Result<Vec<f64>> {
    let mut v = vec![0.0; factor.dim()];
    v[j as usize] = 1.0;
    factor.solve(&mut v)?;
    Ok(v)
}

/// A direction of negative curvature, if there is one: then some pivot that counted as zero is in fact
/// negative, or is zero with a column that is not zero.
///
/// With negative pivots `p_j` the factor is that of `A + sum_j (NULL_PIVOT - p_j) e_j e_j'`. The residual of
/// one solve with a random right side therefore shows all `p_j` at once.
fn downward_curvature(lower: &Sparse, factor: &Cholesky) -> Result<Option<Vec<f64>>> {
    let scale = factor.scale();
    let b: Vec<f64> = (0..factor.dim())
        .map(|i| pseudo_random(i) / scale[i])
        .collect();
    let mut s = b.clone();
    factor.solve(&mut s)?;
    may_continue()?;
    let product = lower.mul_symmetric(&s);
    let mut suspects: Vec<(f64, u32)> = factor
        .null_unknowns()
        .iter()
        .filter_map(|&j| {
            let i = j as usize;
            let (s, r) = (s[i] / scale[i], (b[i] - product[i]) * scale[i]);
            let pivot = super::cholesky::NULL_PIVOT - r / s;
            (pivot < -CURVATURE_TOLERANCE).then_some((pivot, j))
        })
        .collect();
    suspects.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let suspects = suspects.into_iter().map(|(_, j)| j).take(EXAMINED);
    let coupled = factor.coupled_unknowns().iter().copied().take(EXAMINED);
    let curves_down = |v: &[f64]| {
        let product = lower.mul_symmetric(v);
        let curvature: f64 = v.iter().zip(product).map(|(v, av)| v * av).sum();
        let largest = largest(v, scale);
        curvature < -CURVATURE_TOLERANCE * largest * largest
    };
    for j in suspects.chain(coupled) {
        let v = null_direction(factor, j)?;
        if curves_down(&v) {
            return Ok(Some(v));
        }
        let v = with_partner(factor, j, v)?;
        if curves_down(&v) {
            return Ok(Some(v));
        }
    }
    Ok(None)
}

/// The direction `v` of null unknown `j`, combined with the direction of the null unknown that `v` moves
/// most. A product of two unknowns without squares curves down as much as up. Either direction alone shows
/// only the square of the curvature that both show together.
fn with_partner(factor: &Cholesky, j: u32, mut v: Vec<f64>) -> Result<Vec<f64>> {
    let scale = factor.scale();
    v.iter_mut().for_each(|v| *v /= scale[j as usize]);
    let others = factor.null_unknowns().iter().filter(|&&i| i != j);
    let moved = |&i: &u32| v[i as usize] / scale[i as usize];
    let partner = others
        .copied()
        .max_by(|a, b| moved(a).abs().total_cmp(&moved(b).abs()));
    if let Some(i) = partner {
        let factor_of = moved(&i).signum() / scale[i as usize];
        let other = null_direction(factor, i)?;
        v.iter_mut()
            .zip(other)
            .for_each(|(v, w)| *v += factor_of * w);
    }
    Ok(v)
}

/// The largest absolute entry in the scaled unknowns.
fn largest(v: &[f64], scale: &[f64]) -> f64 {
    let scaled = v.iter().zip(scale).map(|(v, s)| (v / s).abs());
    scaled.fold(0.0, f64::max)
}

/// A direction without curvature along which the objective falls, if there is one. In that case the first
/// step has moved some null unknown.
fn endless_slope(
    gradient: &[f64],
    rounding: impl FnOnce() -> Vec<f64>,
    step: &[f64],
    factor: &Cholesky,
) -> Result<Option<Vec<f64>>> {
    let scale = factor.scale();
    let pull = |j: u32| (step[j as usize] / scale[j as usize]).abs();
    let mut suspects: Vec<u32> = factor.null_unknowns().to_vec();
    suspects.retain(|&j| pull(j) > 0.0);
    suspects.sort_by(|&a, &b| pull(b).total_cmp(&pull(a)).then(a.cmp(&b)));
    if suspects.is_empty() {
        return Ok(None);
    }
    let rounding = rounding();
    // The change of the objective when every scaled unknown has the same error.
    let steepest: f64 = gradient.iter().zip(scale).map(|(g, s)| (g * s).abs()).sum();
    for j in suspects.into_iter().take(EXAMINED) {
        let mut v = null_direction(factor, j)?;
        let terms = || v.iter().zip(gradient).map(|(v, g)| v * g);
        let slope: f64 = terms().sum();
        let size: f64 = terms().map(f64::abs).sum();
        let noise: f64 = v.iter().zip(&rounding).map(|(v, e)| (v * e).abs()).sum();
        let noise = noise + CANCELLED * largest(&v, scale) * steepest;
        if slope.abs() > SLOPE_TOLERANCE * size + noise {
            if slope > 0.0 {
                v.iter_mut().for_each(|v| *v = -*v);
            }
            return Ok(Some(v));
        }
    }
    Ok(None)
}

/// A fixed sequence of numbers of size [1/2, 1) with random signs (Weyl's sequence of the golden ratio).
fn pseudo_random(i: usize) -> f64 {
    let bits = (i as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let size = 0.5 + (bits >> 12) as f64 / (1u64 << 53) as f64;
    if bits.count_ones().is_multiple_of(2) {
        size
    } else {
        -size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solve(lower: &[(u32, u32, f64)], gradient: &[f64], guess: &[f64]) -> Minimum {
        let n = gradient.len();
        let a = Sparse::from_triplets(n, n, lower.iter().copied()).unwrap();
        let factor = Cholesky::new(&a).unwrap();
        minimise(&a, gradient, || vec![0.0; n], guess, &factor).unwrap()
    }

    #[test]
    fn unknowns_that_do_not_matter_stay_at_the_guess() {
        // (x0 - x1 - 1)^2 determines only the difference of x0 and x1, and does not contain x2.
        let a = [(0, 0, 2.0), (1, 0, -2.0), (1, 1, 2.0), (2, 2, 0.0)];
        let Minimum::At(Lowest { point, .. }) = solve(&a, &[-2.0, 2.0, 0.0], &[5.0, 5.0, 7.0])
        else {
            panic!()
        };
        assert!((point[0] - point[1] - 1.0).abs() < 1e-12);
        assert!(point[0] == 5.0 || point[1] == 5.0);
        assert_eq!(point[2], 7.0);
    }

    #[test]
    fn a_slope_without_curvature_is_unbounded() {
        let a = [(0, 0, 2.0), (1, 0, -2.0), (1, 1, 2.0)];
        let Minimum::Unbounded(v) = solve(&a, &[-2.0, 1.0], &[0.0, 0.0]) else {
            panic!()
        };
        assert!((v[0] - v[1]).abs() < 1e-12, "no curvature");
        assert!(-2.0 * v[0] + v[1] < 0.0, "downhill");
    }

    #[test]
    fn what_is_left_of_larger_terms_is_no_slope() {
        let a = Sparse::from_triplets(2, 2, [(0, 0, 2.0), (1, 0, -2.0), (1, 1, 2.0)].into_iter());
        let a = a.unwrap();
        let factor = Cholesky::new(&a).unwrap();
        let run = |rounding: f64| {
            let gradient = [1e-16, 0.0];
            minimise(&a, &gradient, || vec![rounding; 2], &[0.0; 2], &factor).unwrap()
        };
        assert!(matches!(run(0.0), Minimum::Unbounded(_)));
        assert!(matches!(run(1e-15), Minimum::At(_)));
    }

    #[test]
    fn negative_curvature_is_found_wherever_it_hides() {
        for a in [
            vec![(0, 0, -1.0), (1, 1, 1.0)],
            vec![(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)],
            vec![(0, 0, 0.0), (1, 0, 1.0), (1, 1, 0.0)],
            vec![(0, 0, 0.0), (1, 0, 0.5), (1, 1, 106.0)],
            vec![
                (0, 0, 1.0),
                (1, 0, 2e-5),
                (1, 1, 1.0),
                (2, 1, 1.0),
                (2, 2, 1.0),
                (3, 0, 1.0),
                (3, 3, 1.0),
            ],
        ] {
            let n = 1 + a.iter().map(|e| e.0).max().unwrap() as usize;
            let Minimum::NotConvex(v) = solve(&a, &vec![0.0; n], &vec![0.0; n]) else {
                panic!("{a:?}")
            };
            let m = Sparse::from_triplets(n, n, a.iter().copied()).unwrap();
            let curvature: f64 = v.iter().zip(m.mul_symmetric(&v)).map(|(v, w)| v * w).sum();
            assert!(curvature < 0.0, "{a:?}: {v:?}");
        }
    }

    #[test]
    fn a_scale_of_1e8_between_unknowns_is_no_semi_definiteness() {
        let a = [(0, 0, 1e8), (1, 0, 0.5), (1, 1, 1e-8)];
        let Minimum::At(Lowest { point, .. }) = solve(&a, &[1.0, 0.0], &[0.0, 0.0]) else {
            panic!()
        };
        // Exact: determinant 1 - 0.25.
        assert!((point[0] + 1e-8 / 0.75).abs() < 1e-20);
        assert!((point[1] - 0.5 / 0.75).abs() < 1e-12);
    }
}
