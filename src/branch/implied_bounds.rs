//! Bounds of real unknowns that choices imply.
//!
//! Where a binary `b` is 1, the rows may bound a real unknown `y` more than its limits do: a row that `b` switches on,
//! or its sum with another row that cancels all its reals but one. Where at most one of the binaries `b_k` is 1, and
//! each implies `y >= m_k`,
//!
//! ```text
//! y >= l + sum_k (m_k - l) b_k
//! ```
//!
//! holds at all points with integers, with `l` the lower limit of `y` (`savelsbergh1994`, implications; over a choice
//! the rows of single binaries become one). In layouts, where rectangles are left or right of, above or below each
//! other by rows with large constants, these rows say how far apart that makes their centres.
//!
//! All roundings are towards weaker rows.

use std::collections::{BTreeMap, HashSet};

use super::form::{AtLeast, Form, Interval};
use super::interior;
use super::relaxation::{Relaxation, Relaxed, regularization};
use super::shared::Shared;
use crate::error::Result;
use crate::monitor::Monitor;

/// The largest number of reals of a row that a binary switches on.
const REALS: usize = 4;

/// Rows are added if the bound rises by this part of it.
const WORTH: f64 = 1e-3;

/// A bound is better than another one by this much, relative to their sizes, or it is none.
const BETTER: f64 = 1e-6;

/// Four units in the last place, for the few roundings of a coefficient.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The row `sum_j a_j x_j <= side`.
#[derive(Debug, Clone)]
struct Half {
    reals: Vec<(u32, f64)>,
    /// The only integer, a binary.
    binary: Option<(u32, f64)>,
    side: f64,
}

/// `sign * y` for a real unknown y.
type Signed = (u32, bool);

/// The least values that binaries imply where they are 1, and whether a row of the form says so.
type Implied = BTreeMap<Signed, BTreeMap<u32, (f64, bool)>>;

/// A form with rows that choices imply, if it has such rows and they raise its bound.
///
/// # Errors
/// [`Error::OutOfMemory`], [`Error::NotConvex`].
pub(super) fn strengthened(form: &Form, monitor: &mut Monitor) -> Result<Option<Form>> {
    let rows = rows(form);
    if rows.is_empty() {
        return Ok(None);
    }
    let _watch = monitor.watch_search();
    let next = form.with_rows(&rows)?;
    if interior::is_for(&next) && !interior::is_for(form) {
        // Nodes would take longer than before.
        return Ok(None);
    }
    let (before, after) = (root_bound(form)?, root_bound(&next)?);
    let is_better = after > before + WORTH * before.abs();
    Ok(is_better.then_some(next))
}

/// The bound of the relaxation.
fn root_bound(form: &Form) -> Result<f64> {
    let shared = Shared::new(form, &regularization(form))?;
    let mut relaxation = Relaxation::new(form, &shared);
    Ok(match relaxation.solve(f64::INFINITY, &form.boxes) {
        Relaxed::Solved { bound } | Relaxed::Cutoff { bound } | Relaxed::Stopped { bound } => bound,
        Relaxed::Unbounded(_) | Relaxed::Infeasible(_) => f64::NEG_INFINITY,
    })
}

/// The rows that choices imply.
fn rows(form: &Form) -> Vec<AtLeast> {
    let implied = implied(form);
    let choices = choices(form);
    let mut choices_of: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (k, choice) in choices.iter().enumerate() {
        choice
            .iter()
            .for_each(|&b| choices_of.entry(b).or_default().push(k));
    }
    let mut rows = Vec::new();
    for (&(y, is_upper), binaries) in &implied {
        let least = least(form, (y, is_upper));
        let sign = if is_upper { -1.0 } else { 1.0 };
        let mut seen: HashSet<Vec<u32>> = HashSet::new();
        let of = binaries.keys().flat_map(|b| match choices_of.get(b) {
            Some(choices_of) => choices_of.iter().map(|&k| choices[k].clone()).collect(),
            None => vec![vec![*b]],
        });
        for choice in of {
            let terms = choice.iter().filter_map(|b| Some((*b, *binaries.get(b)?)));
            let terms: Vec<(u32, (f64, bool))> = terms.collect();
            let members = terms.iter().map(|(b, _)| *b).collect();
            if !seen.insert(members) || matches!(terms[..], [(_, (_, true))]) {
                continue;
            }
            let rise = |m: f64| -((m - least) * (1.0 - ROUNDING));
            let binaries = terms.iter().map(|&(b, (m, _))| (b, rise(m)));
            rows.push((std::iter::once((y, sign)).chain(binaries).collect(), least));
        }
    }
    rows
}

/// The least value of an unknown with a sign within the limits.
fn least(form: &Form, (y, is_upper): Signed) -> f64 {
    let limits = form.boxes[y as usize];
    match is_upper {
        true => -limits.upper,
        false => limits.lower,
    }
}

/// The sets of binaries of which at most one is 1.
fn choices(form: &Form) -> Vec<Vec<u32>> {
    let choice = |(i, sides): (usize, &Interval)| {
        let mut row = form.rows.row(i);
        let (_, first) = row.clone().next()?;
        let is_one = match first > 0.0 {
            true => sides.upper == first,
            false => sides.lower == first,
        };
        let is_choice =
            is_one && row.len() > 1 && row.all(|(j, a)| a == first && form.is_binary(j));
        is_choice.then(|| form.rows.row(i).map(|(j, _)| j as u32).collect())
    };
    form.row_limits
        .iter()
        .enumerate()
        .filter_map(choice)
        .collect()
}

/// The least values that binaries imply, as far as they are better than the limits.
fn implied(form: &Form) -> Implied {
    let halves: Vec<Half> = (0..form.rows.rows())
        .flat_map(|i| halves(form, i))
        .collect();
    let mut with: Vec<Vec<u32>> = vec![Vec::new(); form.dim()];
    for (k, half) in halves
        .iter()
        .enumerate()
        .filter(|(_, half)| half.binary.is_none())
    {
        half.reals
            .iter()
            .for_each(|(j, _)| with[*j as usize].push(k as u32));
    }
    let mut implied = Implied::new();
    for half in &halves {
        let Some((b, a)) = half.binary else {
            continue;
        };
        if half.reals.len() > REALS {
            continue;
        }
        let mut add = |reals: &[(u32, f64)], side: f64, size: f64, is_given: bool| {
            let &[(y, c)] = reals else {
                return;
            };
            // `c y + a b <= side`, and so `-c y >= a - side` where b is 1.
            let lost = ROUNDING * (a.abs() + size);
            let value = ((a - side) - lost) / c.abs();
            let value = value - ROUNDING * value.abs();
            let signed = (y, c > 0.0);
            let limit = least(form, signed);
            if limit.is_finite() && value > limit + BETTER * limit.abs().max(1.0) {
                let best = implied
                    .entry(signed)
                    .or_default()
                    .entry(b)
                    .or_insert((value, is_given));
                if value > best.0 {
                    *best = (value, is_given);
                }
            }
        };
        add(&half.reals, half.side, half.side.abs(), true);
        for &(x, a) in &half.reals {
            for &k in &with[x as usize] {
                let other = &halves[k as usize];
                if let Some((reals, factor)) = combined(&half.reals, &other.reals, (x, a)) {
                    let added = factor * other.side;
                    let size = half.side.abs() + added.abs();
                    add(&reals, half.side + added, size, false);
                }
            }
        }
    }
    implied
}

/// The sides of a row whose integers are one binary or none.
fn halves(form: &Form, i: usize) -> Vec<Half> {
    let sides = form.row_limits[i];
    let mut integers = form.rows.row(i).filter(|&(j, _)| form.integer[j]);
    let binary = integers.next();
    if integers.next().is_some() || binary.is_some_and(|(j, _)| !form.is_binary(j)) {
        return Vec::new();
    }
    let of = |sign: f64, side: f64| Half {
        reals: form
            .rows
            .row(i)
            .filter(|&(j, _)| !form.integer[j])
            .map(|(j, a)| (j as u32, sign * a))
            .collect(),
        binary: binary.map(|(j, a)| (j as u32, sign * a)),
        side,
    };
    let halves = [of(1.0, sides.upper), of(-1.0, -sides.lower)];
    halves
        .into_iter()
        .filter(|half| half.side.is_finite())
        .collect()
}

/// `first + factor * second` and the factor, which is positive, if x and all other terms but one cancel exactly.
fn combined(
    first: &[(u32, f64)],
    second: &[(u32, f64)],
    (x, a): (u32, f64),
) -> Option<(Vec<(u32, f64)>, f64)> {
    let at = |row: &[(u32, f64)], j: u32| {
        let found = row.binary_search_by_key(&j, |(j, _)| *j);
        found.map_or(0.0, |at| row[at].1)
    };
    let factor = -a / at(second, x);
    if !factor.is_finite() || factor <= 0.0 || second.len() > first.len() + 1 {
        return None;
    }
    let own = first
        .iter()
        .map(|&(j, v)| (j, at(second, j).mul_add(factor, v)));
    let others = second.iter().filter(|(j, _)| at(first, *j) == 0.0);
    let others = others.map(|&(j, v)| (j, v * factor));
    let left: Vec<(u32, f64)> = own.chain(others).filter(|(_, v)| *v != 0.0).collect();
    (left.len() == 1).then_some((left, factor))
}

#[cfg(test)]
#[path = "implied_bounds_tests.rs"]
pub(super) mod tests;
