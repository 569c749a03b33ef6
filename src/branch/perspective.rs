//! The perspective reformulation of unknowns that a binary switches on.
//!
//! Where `l z <= x <= u z` with a binary `z`, and the objective is convex without `c x^2`, `x (1 - z) = 0` and
//! `z^2 = z` in all points with integers. So for any number `t`
//!
//! ```text
//! c x^2 = c x^2 + 2 c t (x - x z) + c t^2 (z^2 - z) = c (x - t z)^2 + c (2 t x - t^2 z)
//! ```
//!
//! there, and the right side is convex. Between integers it is at most the perspective `c x^2 / z`
//! (`frangioni2006`, `gunluk2010`), by `c z (1 - z) (x / z - t)^2`: the relaxation is that of the perspective where
//! `t = x / z` at its minimiser. The form keeps its unknowns and rows.
//!
//! The minimiser gives the next `t`: with the slope `r` that the rest of the problem gives to `x`, the multiplier of
//! the row of `z` left out, `c t^2 + r t` is least at `t = -r / 2 c` within `l` and `u`. Some rounds of that bring
//! the bound close to that of the perspective.

use std::collections::HashMap;

use super::dual_active_set::Active;
use super::form::Form;
use super::inverse::Inverse;
use super::relaxation::{Relaxation, Relaxed, regularization};
use super::shared::Shared;
use super::working_set::dot;
use crate::error::{Error, Result};
use crate::linalg::{Random, Sparse};
use crate::monitor::{Monitor, may_continue};

/// The largest number of rounds.
const ROUNDS: usize = 12;

/// Rounds end when the bound rises by less than this part of its rise so far.
const WORTH: f64 = 1e-3;

/// A smaller rise of the bound than this part of it is none.
const NOTHING: f64 = 1e-6;

/// What is added to `z^2 - z` relative to what the squares need, so that the sum is definite.
const MARGIN: f64 = 1e-4;

/// The squares of unknowns that Q couples are this part of the largest that leaves the rest semi-definite.
const PART: f64 = 0.9;

/// Rounds end where one takes this many times the iterations of the first one, or of this many: its nodes would take as
/// long.
const LONGER: u64 = 3;
const LEAST: u64 = 1000;

/// The largest number of coupled unknowns. Their binaries are coupled with them, and a node takes several times as
/// long: of portfolios, those of 50 and 100 assets gain, one of 200 takes twice the time.
const COUPLED: usize = 128;

/// Steps of power iteration.
const STEPS: usize = 100;

/// An unknown that is zero where its binary is.
#[derive(Debug, Clone, Copy)]
struct Link {
    unknown: u32,
    binary: u32,
    /// The rows that say so, for each side.
    rows: [Option<u32>; 2],
    /// `l` and `u`.
    ends: [f64; 2],
    /// `c`.
    weight: f64,
}

/// An unknown that a binary switches on, and what the objective has gained: `product (x - x z)` and
/// `square (z^2 - z)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Switched {
    pub unknown: u32,
    pub binary: u32,
    /// The rows that make the unknown zero where the binary is, for each side.
    pub rows: [Option<u32>; 2],
    pub product: f64,
    pub square: f64,
}

/// A form with the same energies at all points with integers.
pub(super) struct Reformulated {
    pub form: Form,
    pub switches: Vec<Switched>,
}

/// A form with the same energies at all points with integers and a larger bound, if some unknowns are linked to
/// binaries and the bound rises.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::NotConvex`](crate::Error::NotConvex), the end of the
/// call.
pub(super) fn strengthened(form: &Form, monitor: &mut Monitor) -> Result<Option<Reformulated>> {
    let links = links(form)?;
    if links.is_empty() {
        return Ok(None);
    }
    let _watch = monitor.watch_search();
    let mut slopes = vec![0.0; links.len()];
    let mut first = None;
    let mut best: Option<(f64, Reformulated)> = None;
    let mut active: Vec<Active> = Vec::new();
    let mut most = u64::MAX;
    for round in 0..ROUNDS {
        if monitor.ends() {
            break;
        }
        let next = reformulated(form, &links, &slopes)?;
        let of = &next.form;
        let shared = match Shared::new(of, &regularization(of)) {
            // By rounding errors.
            Err(Error::NotConvex { .. }) => break,
            shared => shared?,
        };
        let mut relaxation = Relaxation::new(of, &shared);
        relaxation.start_from(&active);
        relaxation.most = relaxation.most.min(most);
        let Relaxed::Solved { bound } = relaxation.solve(f64::INFINITY, &of.boxes) else {
            break;
        };
        slopes = next_slopes(form, &links, relaxation.solver.point(), relaxation.active());
        active = relaxation.active().to_vec();
        if first.is_none() {
            most = LONGER * relaxation.solver.iterations.max(LEAST);
        }
        let start = *first.get_or_insert(bound);
        let before = best.as_ref().map_or(start, |(best, _)| *best);
        if best.is_none() || bound > before {
            best = Some((bound, next));
        }
        let rise = bound - start;
        if round > 0 && (rise <= NOTHING * start.abs() || bound - before < WORTH * rise) {
            break;
        }
    }
    let start = first.unwrap_or(f64::NEG_INFINITY);
    let next = best.filter(|(bound, _)| *bound > start + NOTHING * start.abs());
    Ok(next.map(|(_, next)| next))
}

/// The unknowns that are zero where a binary is, with squares of their own.
fn links(form: &Form) -> Result<Vec<Link>> {
    let mut found: HashMap<(u32, u32), Link> = HashMap::new();
    for (i, sides) in form.row_limits.iter().enumerate() {
        let row: Vec<(usize, f64)> = form.rows.row(i).collect();
        let &[first, second] = &row[..] else {
            continue;
        };
        for [(x, a), (z, b)] in [[first, second], [second, first]] {
            if x == z || !form.is_binary(z) || form.limits[x].is_point() {
                continue;
            }
            let end = -b / a;
            let above = if a > 0.0 { sides.upper } else { sides.lower };
            let below = if a > 0.0 { sides.lower } else { sides.upper };
            let limits = form.limits[x];
            let link = found.entry((x as u32, z as u32)).or_insert(Link {
                unknown: x as u32,
                binary: z as u32,
                rows: [None; 2],
                ends: [limits.lower, limits.upper],
                weight: 0.0,
            });
            if above == 0.0 {
                link.rows[1] = Some(i as u32);
                link.ends[1] = link.ends[1].min(end);
            }
            if below == 0.0 {
                link.rows[0] = Some(i as u32);
                link.ends[0] = link.ends[0].max(end);
            }
        }
    }
    let is_linked = |link: &Link| {
        let limits = form.limits[link.unknown as usize];
        let zero_above = link.rows[1].is_some() || limits.upper <= 0.0;
        let zero_below = link.rows[0].is_some() || limits.lower >= 0.0;
        zero_above && zero_below && link.ends[0] <= link.ends[1]
    };
    let mut links: Vec<Link> = found.into_values().filter(is_linked).collect();
    links.sort_unstable_by_key(|link| (link.unknown, link.binary));
    links.dedup_by_key(|link| link.unknown);
    if links.is_empty() {
        return Ok(links);
    }
    let squares = squares(form)?;
    for link in &mut links {
        link.weight = squares[link.unknown as usize];
    }
    links.retain(|link| link.weight > 0.0);
    Ok(links)
}

/// `c` for each unknown, such that Q without these squares is still semi-definite; zero where Q is singular, and
/// where it couples many unknowns.
///
/// Where Q couples unknowns, the squares are a part of its diagonal (`frangioni2006`): with `d` the least eigenvalue
/// of Q after its diagonal is scaled to 1, `Q - d diag(Q)` is semi-definite.
fn squares(form: &Form) -> Result<Vec<f64>> {
    let inverse = Inverse::new(&form.hessian, &regularization(form))?;
    let mut diagonal = vec![0.0; form.dim()];
    for (i, _, v) in form.hessian.entries().filter(|(i, j, _)| i == j) {
        diagonal[i as usize] = v;
    }
    let mut squares = vec![0.0; form.dim()];
    for (members, block) in inverse.definite() {
        let scales: Vec<f64> = members
            .iter()
            .map(|&j| diagonal[j as usize].sqrt())
            .collect();
        let part = match members.len() {
            1 => 1.0,
            size if size > COUPLED => 0.0,
            _ => PART / largest_eigenvalue(block, &scales),
        };
        for &j in members {
            squares[j as usize] = 0.5 * part * diagonal[j as usize];
        }
        may_continue()?;
    }
    Ok(squares)
}

/// The largest eigenvalue of `S B S`, with a diagonal S, by power iteration; a little less than it.
fn largest_eigenvalue(block: &[f64], scales: &[f64]) -> f64 {
    let size = scales.len();
    let mut random = Random::new(1);
    let mut v: Vec<f64> = (0..size).map(|_| random.symmetric()).collect();
    let mut value = 0.0;
    for _ in 0..STEPS {
        let len = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let scaled: Vec<f64> = v.iter().zip(scales).map(|(x, s)| x * s / len).collect();
        let rows = block.chunks_exact(size).zip(scales);
        v = rows.map(|(row, s)| s * dot(row, &scaled)).collect();
        value = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    }
    value
}

/// The form with `2 c t (x - x z) + c t^2 (z^2 - z)` added for each link.
fn reformulated(form: &Form, links: &[Link], slopes: &[f64]) -> Result<Reformulated> {
    let mut next = form.clone();
    let mut switches = Vec::new();
    let mut entries: Vec<(u32, u32, f64)> = form.hessian.entries().collect();
    let mut of_binaries: Vec<f64> = vec![0.0; form.dim()];
    let mut lost = 0.0;
    // The numbers that are added may be any, if those of products and of linear terms are the same.
    for (link, t) in links.iter().zip(slopes) {
        if *t == 0.0 {
            continue;
        }
        let (x, z) = (link.unknown as usize, link.binary as usize);
        let a = link.weight * t;
        let (sum, error) = two_sum(next.gradient[x], 2.0 * a);
        next.gradient[x] = sum;
        lost += error.abs() * link.ends[0].abs().max(link.ends[1].abs());
        entries.push((
            link.unknown.max(link.binary),
            link.unknown.min(link.binary),
            -2.0 * a,
        ));
        let square = a * t * (1.0 + MARGIN);
        of_binaries[z] += square;
        switches.push(Switched {
            unknown: link.unknown,
            binary: link.binary,
            rows: link.rows,
            product: 2.0 * a,
            square,
        });
    }
    for (z, &b) in of_binaries.iter().enumerate().filter(|(_, b)| **b > 0.0) {
        let (sum, error) = two_sum(next.gradient[z], -b);
        next.gradient[z] = sum;
        let before = form.hessian.row(z).find(|&(j, _)| j == z);
        let (_, square) = two_sum(before.map_or(0.0, |(_, v)| v), 2.0 * b);
        lost += error.abs() + square.abs();
        entries.push((z as u32, z as u32, 2.0 * b));
    }
    next.hessian = Sparse::from_triplets(form.dim(), form.dim(), entries.into_iter())?;
    // No point has more energy than before.
    next.constant -= 2.0 * lost;
    Ok(Reformulated {
        form: next,
        switches,
    })
}

/// `t` for the next round, from the minimiser of the last one and the multipliers of its rows.
fn next_slopes(form: &Form, links: &[Link], point: &[f64], active: &[Active]) -> Vec<f64> {
    let n = form.dim();
    let mut multipliers = vec![0.0; form.rows.rows()];
    for held in active {
        if let Some(row) = (held.row as usize).checked_sub(n) {
            multipliers[row] = held.multiplier;
        }
    }
    let curved = form.hessian.mul_symmetric(point);
    let slopes = form.gradient.iter().zip(curved).map(|(q, c)| q + c);
    let mut slopes: Vec<f64> = slopes.collect();
    for (i, j, a) in form.rows.entries() {
        slopes[j as usize] += multipliers[i as usize] * a;
    }
    let next = |link: &Link| {
        let own: f64 = link
            .rows
            .iter()
            .flatten()
            .map(|&row| {
                let mut entries = form.rows.row(row as usize);
                let a = entries
                    .find(|&(j, _)| j == link.unknown as usize)
                    .map_or(0.0, |(_, a)| a);
                multipliers[row as usize] * a
            })
            .sum();
        let x = point[link.unknown as usize];
        let rest = slopes[link.unknown as usize] - own - 2.0 * link.weight * x;
        let t = (-rest / (2.0 * link.weight))
            .max(link.ends[0])
            .min(link.ends[1]);
        if t.is_finite() { t } else { x }
    };
    links.iter().map(next).collect()
}

/// The rounded sum, and what rounding took away.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

#[cfg(test)]
#[path = "perspective_tests.rs"]
mod tests;
