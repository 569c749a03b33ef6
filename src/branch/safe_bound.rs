//! Lower bounds that rounding errors cannot make false.
//!
//! For any point `x` and any multipliers `mu` of the rows (positive for upper sides), convexity and the rows
//! give for all points `z` within the limits
//!
//! ```text
//! E(z) >= c - 1/2 x'Qx + r'z - sum_i mu_i side_i,    r = Qx + q + A' mu
//! ```
//!
//! and `r'z` is least at a corner of the box. The bound holds whatever errors `x` and `mu` have; near the
//! minimiser it is sharp. What is computed here is that bound minus its own rounding errors (`neumaier2004`
//! does the same for linear programs).

use super::dual_active_set::Active;
use super::form::{Form, Interval};
use super::inverse::Inverse;

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// A sum with the sum of the absolute values of its terms.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sized {
    pub sum: f64,
    pub size: f64,
    pub count: usize,
}

impl Sized {
    pub fn add(&mut self, term: f64) {
        self.sum += term;
        self.size += term.abs();
        self.count += 1;
    }

    /// A bound on the error of the sum. Each term may be a product of up to three numbers.
    pub fn error(&self) -> f64 {
        (self.count as f64 + 4.0) * UNIT * self.size * (1.0 + 1e-6)
    }
}

/// An unknown without a limit, in no definite block, counts as limited to this many times its value.
const FAR: f64 = 1e4;

/// Multipliers may miss each other by this part along an unknown without a limit.
const UNEVEN: f64 = 1e-7;

/// A multiplier below this part of the largest may be a rounding error.
const NEGLIGIBLE: f64 = 1e-9;

/// A slope beyond this part of the sizes of its terms, and ...
const SLOPED: f64 = 1e-2;

/// ... beyond this part of the sizes of the terms of any slope and of the pull of a proximal step to its centre, is no rest
/// that a method leaves.
const TINY: f64 = 1e-6;

/// Whether rows with these multipliers have no point within `limits`, or rows with all but negligible ones.
pub(super) fn is_contradiction(form: &Form, limits: &[Interval], rows: &[(u32, f64)]) -> bool {
    if have_no_point(form, limits, rows) {
        return true;
    }
    let largest = rows.iter().fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
    let mut most = rows.to_vec();
    most.retain(|(_, v)| v.abs() > NEGLIGIBLE * largest);
    most.len() < rows.len() && have_no_point(form, limits, &most)
}

/// Whether the least value of `r'z` within `limits`, with `r = A' mu`, is above what the sides of rows with these
/// multipliers `mu` allow.
fn have_no_point(form: &Form, limits: &[Interval], rows: &[(u32, f64)]) -> bool {
    let n = form.dim();
    let mut slopes: Vec<Sized> = vec![Sized::default(); n];
    let mut total = Sized::default();
    for &(row, multiplier) in rows {
        let Some(row) = (row as usize).checked_sub(n) else {
            continue;
        };
        let side = form.row_limits[row].side(multiplier);
        if !side.is_finite() {
            return false;
        }
        total.add(-multiplier * side);
        for (j, a) in form.rows.row(row) {
            slopes[j].add(multiplier * a);
        }
    }
    let mut lost = 0.0;
    for (slope, limits) in slopes.iter().zip(limits) {
        if slope.size == 0.0 {
            continue;
        }
        let error = slope.error();
        let finite = |side: f64| side.clamp(-FAR.max(limits.lower), FAR.max(-limits.upper));
        let side = limits.side(-slope.sum);
        let side = if side.is_finite() || slope.sum.abs() > UNEVEN * slope.size {
            side
        } else {
            finite(side)
        };
        if !side.is_finite() {
            return false;
        }
        total.add(slope.sum * side);
        lost += error * finite(limits.lower).abs().max(finite(limits.upper).abs());
    }
    total.sum - total.error() - lost > 0.0
}

/// The bound for all points within `limits` and the rows' limits.
///
/// In a block where Q is definite and an unknown without a limit has a slope, the quadratic itself gives a
/// bound: `1/2 (z - x)'Q(z - x) + r'(z - x) >= -1/2 r'Q^-1 r`. Elsewhere an unknown without a limit that has more than
/// the rest of a slope leaves no bound, and one with less counts as limited to [`FAR`] times its value.
pub(super) fn safe_bound(
    form: &Form,
    inverse: &Inverse,
    limits: &[Interval],
    x: &[f64],
    active: &[Active],
) -> f64 {
    let n = form.dim();
    let mut slopes: Vec<Sized> = vec![Sized::default(); n];
    for (slope, &q) in slopes.iter_mut().zip(&form.gradient) {
        slope.add(q);
    }
    let mut total = Sized::default();
    total.add(form.constant);
    for (i, j, v) in form.hessian.entries() {
        let (i, j) = (i as usize, j as usize);
        slopes[i].add(v * x[j]);
        if i == j {
            total.add(-0.5 * v * x[i] * x[i]);
        } else {
            slopes[j].add(v * x[i]);
            total.add(-v * x[i] * x[j]);
        }
    }
    let mut held_at = vec![0.0; n];
    for held in active {
        let Some(row) = (held.row as usize).checked_sub(n) else {
            held_at[held.row as usize] = held.multiplier;
            continue;
        };
        let side = form.row_limits[row].side(held.multiplier);
        if held.multiplier == 0.0 || !side.is_finite() {
            continue;
        }
        total.add(-held.multiplier * side);
        for (j, a) in form.rows.row(row) {
            slopes[j].add(held.multiplier * a);
        }
    }
    let mut lost = 0.0;
    let mut is_done = vec![false; n];
    let is_open = |slope: &Sized, limits: Interval| {
        let error = slope.error();
        let open = |s: f64| s != 0.0 && !limits.side(-s).is_finite();
        open(slope.sum)
            || (slope.sum.abs() <= error && slope.size > 0.0 && limits.width().is_infinite())
    };
    for (members, block) in inverse.definite() {
        let slope = |j: u32| (&slopes[j as usize], limits[j as usize]);
        if !members.iter().any(|&j| is_open(slope(j).0, slope(j).1)) {
            continue;
        }
        // The active bounds become rows; what is left of the slopes is small.
        for &j in members {
            let j = j as usize;
            is_done[j] = true;
            let side = limits[j].side(held_at[j]);
            if held_at[j] != 0.0 && side.is_finite() {
                slopes[j].add(held_at[j]);
                total.add(-held_at[j] * side);
            }
            total.add(slopes[j].sum * x[j]);
            lost += slopes[j].error() * x[j].abs();
        }
        let part: Vec<f64> = members
            .iter()
            .map(|&j| slopes[j as usize].sum.abs() + slopes[j as usize].error())
            .collect();
        for (row, r) in block.chunks_exact(members.len()).zip(&part) {
            let product: f64 = row.iter().zip(&part).map(|(p, s)| p.abs() * s).sum();
            lost += product * r;
        }
    }
    let largest = slopes.iter().fold(0.0, |m: f64, slope| m.max(slope.size));
    for (j, (slope, limits)) in slopes.iter().zip(limits).enumerate() {
        if slope.size == 0.0 || is_done[j] {
            continue;
        }
        let error = slope.error();
        let far = FAR * x[j].abs().max(1.0);
        let finite = |side: f64| side.clamp(-far.max(limits.lower), far.max(-limits.upper));
        let (side, other) = (limits.side(-slope.sum), limits.side(slope.sum));
        let pull = inverse.added[j] * x[j].abs().max(1.0);
        let rest = (SLOPED * slope.size).max(TINY * largest.max(pull));
        if side.is_infinite() && slope.sum.abs() > rest {
            return f64::NEG_INFINITY;
        }
        let side = if side.is_finite() { side } else { finite(side) };
        let other = if other.is_finite() {
            other
        } else {
            finite(other)
        };
        total.add(slope.sum * side);
        lost += if slope.sum.abs() <= error {
            error * side.abs().max(other.abs())
        } else {
            error * side.abs()
        };
    }
    let bound = total.sum - (total.error() + lost * (1.0 + 1e-6));
    if bound.is_nan() {
        f64::NEG_INFINITY
    } else {
        bound
    }
}
