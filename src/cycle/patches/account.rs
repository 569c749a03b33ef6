//! The rounding errors of a proof: a lower bound on exact energies from computed ones.
//!
//! Let u be the unit roundoff and `gamma_k = k u / (1 - k u)` (`higham2002`, section 3.1). A computed
//! energy of charges is `sum over patches of d_S^2`, where d_S is a computed distance. It differs from
//! the exact energy in three ways:
//!
//! 1. The factor. The computed values `w = G^-1 c` of all patches together satisfy `(G + X) w = c` with
//!    `|X| <= gamma_k |G|` and `G G' = K + Y` with `|Y| <= gamma_k |G| |G'|` (`higham2002`, theorems 8.5
//!    and 10.3), where k is the largest number of entries in a row of G, and K is assembled with relative
//!    errors of its terms. So `|w|^2` is exact for a matrix `K + F`. The basis is that of a forest: with
//!    the weights D of the chords, `K = D^-1 + T W^-1 T'`, so `D^1/2 K D^1/2` has no eigenvalue below 1,
//!    and `|D^1/2 F D^1/2| <= 4 gamma sum_i D_ii K_ii =: relative`. So the exact energy is at least `(1 -
//!    relative) |w|^2`.
//! 2. The sums c. An error x of them moves `|w|` by at most `|D^1/2 x|`, up to the same factor.
//! 3. The distances. In a patch, `R z + M c` stands for `Q' w`. The error of `|R z + M c|` is bounded by the
//!    measured residuals of `M G = Q'`, `Q'Q = I` and `R = step M U`, and by gammas times bounds on `|z|` and
//!    `|c|`, which follow from the cap: with an energy below it, `|c_i| <= sqrt(K_ii cap)`.
//!
//! Besides, the coefficients of the problem differ from those of the angle differences by the tolerance of the
//! detection, relatively.
//!
//! The errors in 2 and 3 add up to `shift`, a distance. Charges whose energy exceeds the cap need no bound.

use super::local::{dot, inverse};
use super::tree::{PatchTree, System};
use crate::cycle::detect::TOLERANCE;
use crate::error::Result;
use crate::monitor::is_wanted_at;

/// Bounds on the errors of a tree, for all energies up to a cap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Account {
    relative: f64,
    shift: f64,
}

/// The bounds are computed with errors themselves, far below one part in a hundred.
const SAFETY: f64 = 1.01;

fn gamma(k: usize) -> f64 {
    let u = 0.5 * f64::EPSILON * k as f64;
    u / (1.0 - u)
}

impl Account {
    /// The errors of `tree` for energies up to `cap`. `offsets` bounds the error of `kappa`, as a distance.
    ///
    /// # Errors
    /// The end of the call.
    pub fn new(system: System, tree: &PatchTree, cap: f64, offsets: f64) -> Result<Self> {
        let basis = &tree.basis;
        let weight = |e: u32| system.graph.edges[e as usize].weight;
        let longest = (0..basis.len()).map(|i| basis.cycles.get(i).len());
        let longest = longest.max().unwrap_or(0);
        let diagonal: Vec<f64> = (0..basis.len())
            .map(|i| {
                basis
                    .cycles
                    .get(i)
                    .iter()
                    .map(|&(e, _)| 1.0 / weight(e))
                    .sum()
            })
            .collect();
        let chord: Vec<f64> = basis.chords.iter().map(|&e| weight(e)).collect();
        let mut entries = vec![0; basis.len()];
        for (at, front) in tree.fronts.iter().enumerate() {
            basis.own[at].clone().for_each(|i| entries[i] += front.own);
            front
                .above
                .iter()
                .for_each(|&i| entries[i as usize] += front.own);
        }
        let terms = entries.into_iter().max().unwrap_or(0) + longest + 8;
        let relative = SAFETY * 4.0 * (TOLERANCE + gamma(terms) * dot(&chord, &diagonal));
        let mut square = 0.0;
        for i in 0..basis.len() {
            let cycle = basis.cycles.get(i).iter();
            let size: f64 = cycle.map(|&(e, _)| system.kappa[e as usize].abs()).sum();
            let sum = 2.0 * size + (diagonal[i] * cap).sqrt();
            square += chord[i] * (gamma(longest + 4) * sum).powi(2);
        }
        let mut shift = offsets + SAFETY * square.sqrt();
        let mut distances = 0.0;
        for at in 0..tree.patches.len() {
            let own = basis.own[at].clone();
            let size = diagonal[own].iter().map(|d| (d * cap).sqrt()).collect();
            distances += distance_error(tree, at, size, cap)?.powi(2);
        }
        shift += SAFETY * distances.sqrt();
        Ok(Account { relative, shift })
    }

    /// The relative error of squared lengths.
    pub fn relative(&self) -> f64 {
        self.relative
    }

    /// The error of lengths besides.
    pub fn shift(&self) -> f64 {
        self.shift
    }

    /// A lower bound on the exact energy of all charges whose computed energy is at least `energy`.
    pub fn lower(&self, energy: f64) -> f64 {
        let distance = (energy.max(0.0).sqrt() - self.shift).max(0.0);
        (1.0 - self.relative).max(0.0) * distance * distance * (1.0 - 8.0 * f64::EPSILON)
    }

    /// A computed energy that no charges exceed whose exact energy is at most `energy`. None if the errors
    /// are too large.
    pub fn upper(&self, energy: f64) -> Option<f64> {
        let distance = (energy.max(0.0) / (1.0 - self.relative)).sqrt() + self.shift;
        (self.relative < 0.1 && distance.is_finite())
            .then_some(distance * distance * (1.0 + 16.0 * f64::EPSILON))
    }
}

/// A bound on the difference between a computed distance of the patch and the length of its computed w.
/// `size` bounds what each own cycle sums up to.
fn distance_error(tree: &PatchTree, at: usize, mut size: Vec<f64>, cap: f64) -> Result<f64> {
    let (front, local) = (&tree.fronts[at], &tree.locals[at]);
    let n = local.own;
    let radius = cap.sqrt();
    // alpha, and what each of the two children sends.
    for (size, alpha) in size.iter_mut().zip(&local.alpha) {
        *size = alpha.abs() + 2.0 * *size;
    }
    let row = |a: &[f64], i: usize| a[i * n..(i + 1) * n].to_vec();
    let absolute = |a: &[f64]| -> Vec<f64> { a.iter().map(|v| v.abs()).collect() };
    let image: Vec<f64> = (0..n)
        .map(|i| dot(&absolute(&row(&local.map, i)), &size))
        .collect();
    let steps = steps_bound(local.own, &local.r, &image, radius)?;
    let mut square = 0.0;
    for i in 0..n {
        is_wanted_at(i, n)?;
        let own = row(&local.map, i);
        let reach = dot(&absolute(&row(&local.r, i)), &steps) + image[i];
        let mut error = gamma(2 * n + 16) * reach;
        for j in 0..n {
            let column = |k: usize| local.charges[k * n + j];
            let (mut sum, mut size) = (0.0, 0.0);
            for (k, m) in own.iter().enumerate() {
                sum += m * column(k);
                size += (m * column(k)).abs();
            }
            let off = (local.r[i * n + j] - local.step * sum).abs();
            error += (off + gamma(n + 4) * (local.step * size + off)) * steps[j];
        }
        square += error * error;
    }
    let rotation = rotation_error(n, &local.map, &front.diagonal)?;
    let substitution = gamma(n + 2) * condition(n, &front.diagonal)?;
    Ok(square.sqrt() + (rotation + substitution) * radius)
}

/// By coordinate: a bound on `|z|` for all z with `|R z + M c| <= radius`, where `image` bounds `|M c|`.
fn steps_bound(n: usize, r: &[f64], image: &[f64], radius: f64) -> Result<Vec<f64>> {
    // In the reverse order R is lower triangular. Twice its computed inverse covers the inverse's error
    // unless R is so ill-conditioned that the other terms are useless too.
    let reversed: Vec<f64> = (0..n * n)
        .map(|k| r[(n - 1 - k % n) * n + n - 1 - k / n])
        .collect();
    let inverse = inverse(&reversed, n)?;
    let reach: Vec<f64> = image.iter().map(|m| m + 2.0 * radius).collect();
    let bound = |i: usize| {
        let row = (0..n).map(|j| inverse[(n - 1 - j) * n + n - 1 - i].abs());
        1.0 + 2.0 * row.zip(&reach).map(|(v, m)| v * m).sum::<f64>()
    };
    Ok((0..n).map(bound).collect())
}

/// A bound on the relative difference between `|M G w|` and `|w|`.
fn rotation_error(n: usize, map: &[f64], lower: &[f64]) -> Result<f64> {
    let mut product = vec![0.0; n * n];
    let mut size: f64 = 0.0;
    for i in 0..n {
        is_wanted_at(i, n)?;
        for k in 0..n {
            let m = map[i * n + k];
            for j in 0..=k {
                let term = m * lower[k * n + j];
                product[i * n + j] += term;
                size += term.abs();
            }
        }
    }
    // The sum of the terms' sizes bounds the norm of all rounding errors of the product.
    let rounding = gamma(n + 2) * size;
    let mut square = 0.0;
    for i in 0..n {
        is_wanted_at(i, n)?;
        for j in 0..=i {
            let sum: f64 = (0..n)
                .map(|k| product[k * n + i] * product[k * n + j])
                .sum();
            let off = sum - if i == j { 1.0 } else { 0.0 };
            square += if i == j { off * off } else { 2.0 * off * off };
        }
    }
    Ok(square.sqrt() + (3.0 * rounding + gamma(n + 2)) * (n as f64 + 1.0))
}

/// The Frobenius norm of `|G^-1| |G|`.
fn condition(n: usize, lower: &[f64]) -> Result<f64> {
    let inverse = inverse(lower, n)?;
    let mut square = 0.0;
    for i in 0..n {
        is_wanted_at(i, n)?;
        let mut row = vec![0.0; n];
        for k in 0..=i {
            for j in 0..=k {
                row[j] += (inverse[i * n + k] * lower[k * n + j]).abs();
            }
        }
        square += dot(&row, &row);
    }
    Ok(square.sqrt())
}
