//! Mixed-integer rounding: rows that all points with integers satisfy, and the minimiser of a relaxation does not.
//!
//! An equation of the form
//!
//! ```text
//! sum_j c_j x_j + sum_i c_i r_i = 0,    r = Ax,
//! ```
//!
//! a sum of rows, is an inequality `sum_j a_j z_j + sum_k h_k s_k <= b` in the distances `z` of integers and `s` of
//! reals from one of their limits, which are not negative. For each scale `d > 0` it implies
//!
//! ```text
//! sum_j (floor(a_j / d) + max(0, f_j - f) / (1 - f)) z_j + sum_k min(0, h_k) / (d (1 - f)) s_k <= floor(b / d)
//! ```
//!
//! where `f` is the fraction of `b / d` and `f_j` that of `a_j / d` (`nemhauser1990`). The sums of rows, the limits
//! and the scales are those of `marchand2001`: reals between their limits are eliminated one after the other, by rows
//! of one integer and this real first, and each coefficient of an integer between its limits is tried as the scale.
//!
//! All roundings are towards weaker rows (`cook2009`).

use super::form::{Form, Interval};
use super::safe_bound::Sized;
use crate::linalg::Sparse;

/// A sum of this many rows gets no more, but for those of one integer and one real.
const SUMMED: usize = 6;

/// The largest number of unknowns of a sum.
const LARGEST: usize = 500;

/// Fractions of right sides that are used: others leave coefficients that differ by large factors.
const FRACTIONS: std::ops::Range<f64> = 0.02..0.98;

/// The best scale is also tried divided by these.
const DIVISORS: [f64; 3] = [2.0, 4.0, 8.0];

/// The largest number of scales that are tried.
const SCALES: usize = 8;

/// A distance from a limit below this is none.
const CLOSE: f64 = 1e-6;

/// A row is given if the minimiser is this far from it.
const FAR: f64 = 1e-3;

/// The largest ratio of two coefficients of a row.
const RATIO: f64 = 1e6;

/// The row `sum_j a_j x_j <= side`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cut {
    pub row: Vec<(u32, f64)>,
    pub side: f64,
    /// How far the minimiser is from it.
    pub distance: f64,
    pub split: Split,
}

/// Why a cut holds: `terms . x` is an integer, at most `at` or at least one more, and in both cases the cut is at most
/// a sum of that and of rows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Split {
    pub terms: Vec<(u32, f64)>,
    pub at: f64,
    /// The multiples of the two cases.
    pub by: [f64; 2],
    /// Rows of the form with their multipliers in both cases; positive ones hold upper sides.
    pub rows: Vec<(u32, [f64; 2])>,
}

/// Makes rows that cut off the minimiser of a relaxation.
#[derive(Debug)]
pub(super) struct Rounding<'a> {
    form: &'a Form,
    columns: Sparse,
    /// What limits each unknown, and each row's value.
    limits: Vec<Interval>,
    /// The minimiser, and the values of the rows there.
    values: Vec<f64>,
    /// The sums of coefficients in an equation, and which are not zero.
    sums: Vec<Sized>,
    touched: Vec<u32>,
    /// Multiplications so far.
    pub work: u64,
}

/// A term `coefficient * distance`, where the distance of an unknown, or a row's value, from one of its limits has a
/// value at the minimiser.
#[derive(Debug, Clone, Copy)]
struct Term {
    of: u32,
    is_integer: bool,
    is_from_upper: bool,
    coefficient: f64,
    distance: f64,
}

impl<'a> Rounding<'a> {
    /// `point` is the minimiser.
    pub fn new(form: &'a Form, point: &[f64]) -> Self {
        let (n, rows) = (form.dim(), form.rows.rows());
        let limits = (0..n).map(|j| match form.integer[j] {
            true => form.limits[j].of_integers(),
            false => form.limits[j].and(form.boxes[j]),
        });
        let mut limits: Vec<Interval> = limits.collect();
        let mut values = point.to_vec();
        values.extend(form.rows.mul(point));
        for (i, sides) in form.row_limits.iter().enumerate() {
            let activity = activity(form.rows.row(i), &limits);
            limits.push(activity.and(*sides));
        }
        Rounding {
            form,
            columns: form.rows.transpose(),
            limits,
            values,
            sums: vec![Sized::default(); n + rows],
            touched: Vec::new(),
            work: 0,
        }
    }

    /// The cuts from sums that begin with a row: the first sums on each side of which one cuts the minimiser off.
    pub fn separate(&mut self, row: usize, cuts: &mut Vec<Cut>) {
        self.clear();
        self.add(row, 1.0);
        let mut used = vec![row];
        loop {
            if !self.eliminate_linked(&mut used) {
                return;
            }
            let before = cuts.len();
            for sign in [1.0, -1.0] {
                cuts.extend(self.cut(sign));
            }
            if cuts.len() > before || used.len() >= SUMMED || !self.eliminate_next(&mut used) {
                return;
            }
        }
    }

    fn clear(&mut self) {
        for v in self.touched.drain(..) {
            self.sums[v as usize] = Sized::default();
        }
    }

    fn add_term(&mut self, v: usize, term: f64) {
        if self.sums[v].count == 0 {
            self.touched.push(v as u32);
        }
        self.sums[v].add(term);
    }

    /// Adds a multiple of `a_i x - r_i = 0`.
    fn add(&mut self, row: usize, factor: f64) {
        let form = self.form;
        for (j, a) in form.rows.row(row) {
            self.add_term(j, factor * a);
        }
        self.add_term(form.dim() + row, -factor);
        self.work += form.rows.row(row).len() as u64;
    }

    /// Adds the multiple of a row that takes an unknown out.
    fn eliminate(&mut self, unknown: usize, row: usize, a: f64) {
        self.add(row, -self.sums[unknown].sum / a);
    }

    /// Whether an unknown is real and in the equation, by more than rounding errors.
    fn is_real(&self, v: usize) -> bool {
        let sum = &self.sums[v];
        v < self.form.dim() && !self.form.integer[v] && sum.sum.abs() > sum.error()
    }

    /// How far the minimiser is from the nearest limit of an unknown or a row.
    fn distance(&self, v: usize) -> f64 {
        let (limits, x) = (self.limits[v], self.values[v]);
        (x - limits.lower).min(limits.upper - x).max(0.0)
    }

    /// Takes reals out by the rows of one integer and them, where these are closer to the minimiser than the limits
    /// are. Returns whether the equation is not too large.
    fn eliminate_linked(&mut self, used: &mut Vec<usize>) -> bool {
        let form = self.form;
        let mut at = 0;
        while at < self.touched.len() && at < LARGEST {
            let x = self.touched[at] as usize;
            at += 1;
            if !self.is_real(x) {
                continue;
            }
            let is_link = |(i, a): (usize, f64)| {
                let mut others = form.rows.row(i).filter(|&(j, _)| j != x);
                let (z, _) = others.next()?;
                let is_one = others.next().is_none() && form.integer[z] && !used.contains(&i);
                is_one.then(|| (self.distance(form.dim() + i) / a.abs(), i, a))
            };
            let rows = self.columns.row(x);
            let looked_at = rows.len() as u64;
            let links = rows.filter_map(is_link);
            let nearest = links.min_by(|a, b| a.0.total_cmp(&b.0));
            self.work += looked_at;
            if let Some((distance, row, a)) = nearest
                && distance <= self.distance(x) + CLOSE
            {
                used.push(row);
                self.eliminate(x, row, a);
            }
        }
        at < LARGEST
    }

    /// Takes the real out that is farthest from its limits, by the row that is closest to one of its sides. Returns
    /// whether there is one.
    fn eliminate_next(&mut self, used: &mut Vec<usize>) -> bool {
        let form = self.form;
        let reals = self.touched.iter().map(|&v| v as usize);
        let reals = reals.filter(|&v| self.is_real(v) && self.distance(v) > CLOSE);
        let mut reals: Vec<usize> = reals.collect();
        reals.sort_by(|&a, &b| {
            self.distance(b)
                .total_cmp(&self.distance(a))
                .then(a.cmp(&b))
        });
        for x in reals {
            let rows = self.columns.row(x).filter(|(i, _)| !used.contains(i));
            let rows = rows.filter(|&(i, _)| form.rows.row(i).len() <= LARGEST);
            let rows = rows.map(|(i, a)| {
                let slack = self.distance(form.dim() + i) / a.abs();
                let slack = if slack > CLOSE { slack } else { 0.0 };
                (slack, form.rows.row(i).len(), i, a)
            });
            let nearest = rows.min_by(|a, b| {
                let order = a.0.total_cmp(&b.0);
                order.then((a.1, a.2).cmp(&(b.1, b.2)))
            });
            if let Some((slack, _, row, a)) = nearest
                && slack <= self.distance(x)
            {
                used.push(row);
                self.eliminate(x, row, a);
                return true;
            }
        }
        false
    }

    /// The cut that the equation, times 1 or -1 and with `<=`, implies, if the minimiser is far enough from it.
    fn cut(&mut self, sign: f64) -> Option<Cut> {
        self.touched.sort_unstable();
        let sums = self.touched.iter().map(|&v| {
            let sum = self.sums[v as usize];
            let signed = Sized {
                sum: sign * sum.sum,
                ..sum
            };
            (v, signed)
        });
        let (row, side) = weakened(sums, Sized::default(), &self.limits)?;
        let (mut terms, mut side) = self.distances(&row, side)?;
        self.work += 10 * terms.len() as u64;
        let scale = best_scale(&terms, side)?;
        let (mut rounded, mut right) = rounded(&terms, side, scale)?;
        let mut best = efficacy(&rounded, right);
        // The other limits of integers that are between theirs.
        for k in 0..terms.len() {
            let Some(next) = self.with_other_limit(&terms, side, k) else {
                continue;
            };
            let Some((own, own_right)) = self::rounded(&next.0, next.1, scale) else {
                continue;
            };
            let reached = efficacy(&own, own_right);
            if reached > best + CLOSE {
                (best, rounded, right) = (reached, own, own_right);
                (terms, side) = next;
            }
        }
        (best > 0.0).then(|| self.in_unknowns(&rounded, right, (&terms, side, scale)))?
    }

    /// An inequality in the distances from the limits that are closest to the minimiser.
    fn distances(&self, row: &[(u32, f64)], side: f64) -> Option<(Vec<Term>, f64)> {
        let mut terms = Vec::with_capacity(row.len());
        let mut right = Sized::default();
        right.add(side);
        for &(v, c) in row {
            let (limits, x) = (self.limits[v as usize], self.values[v as usize]);
            let is_from_upper = limits.upper - x < x - limits.lower;
            let limit = if is_from_upper {
                limits.upper
            } else {
                limits.lower
            };
            if !limit.is_finite() {
                return None;
            }
            right.add(-c * limit);
            terms.push(Term {
                of: v,
                is_integer: self.form.integer.get(v as usize).is_some_and(|is| *is),
                is_from_upper,
                coefficient: if is_from_upper { -c } else { c },
                distance: (x - limit).abs(),
            });
        }
        Some((terms, right.sum + right.error()))
    }

    /// The inequality in the distance of one integer from its other limit, if the minimiser is between them.
    fn with_other_limit(&self, terms: &[Term], side: f64, k: usize) -> Option<(Vec<Term>, f64)> {
        let term = terms[k];
        let limits = self.limits[term.of as usize];
        let width = limits.width();
        if !term.is_integer || term.distance <= CLOSE || !width.is_finite() {
            return None;
        }
        let mut right = Sized::default();
        right.add(side);
        right.add(-term.coefficient * width);
        let mut terms = terms.to_vec();
        terms[k] = Term {
            is_from_upper: !term.is_from_upper,
            coefficient: -term.coefficient,
            distance: width - term.distance,
            ..term
        };
        Some((terms, right.sum + right.error()))
    }

    /// The row in the unknowns, scaled by a power of two, if the minimiser is far enough from it. `before` are the terms,
    /// the side and the scale that were rounded.
    fn in_unknowns(
        &mut self,
        terms: &[Term],
        right: f64,
        before: (&[Term], f64, f64),
    ) -> Option<Cut> {
        let form = self.form;
        let n = form.dim();
        let mut side = Sized::default();
        side.add(right);
        let kept = std::mem::take(&mut self.touched);
        let sums: Vec<Sized> = kept.iter().map(|&v| self.sums[v as usize]).collect();
        kept.iter()
            .for_each(|&v| self.sums[v as usize] = Sized::default());
        for term in terms {
            let v = term.of as usize;
            let (limit, c) = match term.is_from_upper {
                true => (self.limits[v].upper, -term.coefficient),
                false => (self.limits[v].lower, term.coefficient),
            };
            side.add(c * limit);
            match v.checked_sub(n) {
                None => self.add_term(v, c),
                Some(row) => {
                    for (j, a) in form.rows.row(row) {
                        self.add_term(j, c * a);
                    }
                }
            }
        }
        self.touched.sort_unstable();
        let found = self.touched.iter().map(|&v| (v, self.sums[v as usize]));
        let found = weakened(found, side, &self.limits);
        self.clear();
        for (&v, sum) in kept.iter().zip(sums) {
            self.sums[v as usize] = sum;
        }
        self.touched = kept;
        let (mut row, mut side) = found?;
        let sizes = row.iter().map(|(_, a)| a.abs());
        let largest = sizes.clone().fold(0.0, f64::max);
        let smallest = sizes.fold(f64::INFINITY, f64::min);
        if row.is_empty() || largest > RATIO * smallest || !side.is_finite() {
            return None;
        }
        let scale = largest.log2().round().exp2();
        row.iter_mut().for_each(|(_, a)| *a /= scale);
        side /= scale;
        let taken: f64 = row.iter().map(|&(j, a)| a * self.values[j as usize]).sum();
        let len = row.iter().map(|(_, a)| a * a).sum::<f64>().sqrt();
        let distance = (taken - side) / len;
        (distance > FAR).then(|| Cut {
            row,
            side,
            distance,
            split: self.split(before, scale),
        })
    }

    /// Why the cut holds that was made of these terms, and then divided by `divisor`.
    ///
    /// With the names of the module, integers are split by `sum_j p_j z_j`, where `p_j` is `a_j / d` rounded down, or up
    /// where its fraction is larger than `f`. In the first case, the reals with a negative coefficient hold the cut, in
    /// the second one, the others and `f / (1 - f)` times the case.
    fn split(&self, (terms, side, scale): (&[Term], f64, f64), divisor: f64) -> Split {
        let n = self.form.dim();
        let right = side / scale;
        let fraction = right - right.floor();
        let rest = 1.0 - fraction;
        let mut split = Split {
            terms: Vec::new(),
            at: right.floor(),
            by: [1.0, fraction / rest].map(|by| by / divisor),
            rows: Vec::new(),
        };
        for term in terms {
            let v = term.of as usize;
            let (limits, a) = (self.limits[v], term.coefficient / scale);
            let (limit, sign) = match term.is_from_upper {
                true => (limits.upper, -1.0),
                false => (limits.lower, 1.0),
            };
            if term.is_integer {
                let down = a.floor();
                let p = if a - down > fraction {
                    down + 1.0
                } else {
                    down
                };
                split.terms.push((term.of, sign * p));
                split.at += sign * p * limit;
            } else if let Some(row) = v.checked_sub(n) {
                let sides = self.form.row_limits[row];
                let own = if term.is_from_upper {
                    sides.upper
                } else {
                    sides.lower
                };
                // Other limits follow from those of the unknowns.
                if limit == own {
                    let held = [(-a).max(0.0), a.max(0.0)];
                    let by = held.map(|held| -sign * held / (rest * divisor));
                    split.rows.push((row as u32, by));
                }
            }
        }
        split.terms.retain(|(_, p)| *p != 0.0);
        split
    }
}

/// The values that a row takes within the limits of its unknowns.
fn activity(row: impl Iterator<Item = (usize, f64)>, limits: &[Interval]) -> Interval {
    let [mut least, mut most] = [Sized::default(); 2];
    for (j, a) in row {
        let ends = [a * limits[j].lower, a * limits[j].upper];
        least.add(ends[0].min(ends[1]));
        most.add(ends[0].max(ends[1]));
    }
    Interval {
        lower: if least.sum.is_finite() {
            least.sum - least.error()
        } else {
            f64::NEG_INFINITY
        },
        upper: if most.sum.is_finite() {
            most.sum + most.error()
        } else {
            f64::INFINITY
        },
    }
}

/// The inequality `sum <= side` without the rounding errors of its coefficients, if limits allow that.
fn weakened(
    sums: impl Iterator<Item = (u32, Sized)>,
    side: Sized,
    limits: &[Interval],
) -> Option<(Vec<(u32, f64)>, f64)> {
    let mut row = Vec::new();
    let mut lost = 0.0;
    for (v, sum) in sums {
        let (limits, error) = (limits[v as usize], sum.error());
        let is_zero = sum.sum.abs() <= error;
        if limits.width().is_finite() {
            let missing = if is_zero {
                sum.sum.abs() + error
            } else {
                error
            };
            lost += missing * limits.lower.abs().max(limits.upper.abs());
            if !is_zero {
                row.push((v, sum.sum));
            }
        } else if is_zero {
            return None;
        } else if limits.lower.is_finite() {
            lost += 2.0 * error * (-limits.lower).max(0.0);
            row.push((v, sum.sum - error));
        } else if limits.upper.is_finite() {
            lost += 2.0 * error * limits.upper.max(0.0);
            row.push((v, sum.sum + error));
        } else {
            return None;
        }
    }
    Some((row, side.sum + side.error() + lost * (1.0 + 1e-6)))
}

/// The scale whose rounding cuts the minimiser off farthest.
fn best_scale(terms: &[Term], side: f64) -> Option<f64> {
    let between = terms
        .iter()
        .filter(|term| term.is_integer && term.distance > CLOSE);
    let mut scales: Vec<f64> = between.map(|term| term.coefficient.abs()).collect();
    scales.sort_by(|a, b| b.total_cmp(a));
    scales.dedup_by(|a, b| (*a - *b).abs() <= CLOSE * *b);
    scales.retain(|scale| *scale > 0.0);
    let of = |scale: f64| {
        let (terms, right) = rounded(terms, side, scale)?;
        Some((efficacy(&terms, right), scale))
    };
    let farther = |best: Option<(f64, f64)>, next: (f64, f64)| match best {
        Some(best) if best.0 >= next.0 => Some(best),
        _ => Some(next),
    };
    let found = scales.iter().take(SCALES).filter_map(|&scale| of(scale));
    let (_, scale) = found.fold(None, farther)?;
    let all = std::iter::once(1.0).chain(DIVISORS);
    let found = all.filter_map(|divisor| of(scale / divisor));
    found.fold(None, farther).map(|(_, scale)| scale)
}

/// The inequality after rounding with a scale, and its side.
fn rounded(terms: &[Term], side: f64, scale: f64) -> Option<(Vec<Term>, f64)> {
    let unit = f64::EPSILON;
    let right = side / scale;
    let right = right + unit * right.abs();
    let fraction = right - right.floor();
    if !FRACTIONS.contains(&fraction) || right.abs() > 1e9 {
        return None;
    }
    let rest = 1.0 - fraction;
    let next = terms.iter().filter_map(|term| {
        let a = term.coefficient / scale;
        let coefficient = if term.is_integer {
            let a = a - unit * a.abs();
            let rise = (a - a.floor() - fraction).max(0.0) / rest;
            a.floor() + rise - 8.0 * unit * (a.abs() + 1.0) / (rest * rest)
        } else {
            a.min(0.0) / rest * (1.0 + 8.0 * unit / rest)
        };
        let next = Term {
            coefficient,
            ..*term
        };
        (coefficient != 0.0).then_some(next)
    });
    Some((next.collect(), right.floor()))
}

/// How far the minimiser is from an inequality, in the distances from limits.
fn efficacy(terms: &[Term], side: f64) -> f64 {
    let taken: f64 = terms
        .iter()
        .map(|term| term.coefficient * term.distance)
        .sum();
    let between = terms.iter().filter(|term| term.distance > CLOSE);
    let square: f64 = between.map(|term| term.coefficient.powi(2)).sum();
    (taken - side) / square.sqrt().max(CLOSE)
}

#[cfg(test)]
#[path = "mir_tests.rs"]
mod tests;
