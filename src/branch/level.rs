//! Directions along which the energy neither curves nor slopes, with whole numbers in integers.

use super::form::{Form, Interval};
use super::relaxation::{Relaxation, regularization};
use super::shared::Shared;
use crate::error::{Conflicting, Result};
use crate::linalg::{Cholesky, Sparse};

/// Unknowns and how far they move. None is zero.
pub(super) type Direction = Vec<(u32, f64)>;

/// A sum of so many terms is zero if rounding errors may be all there is: relative to the sum of their sizes.
const ROUNDING: f64 = 1e-13;

/// A number that is as close as this to a fraction is the fraction.
const CLOSE: f64 = 1e-8;

/// The largest denominator of a step, and the largest step of an integer.
const LARGEST: f64 = 1000.0;

/// Rows with more terms take no part in the null space, which keeps the matrix sparse.
const LONG: usize = 500;

/// The most directions of a basis.
const MOST: usize = 200;

/// Steps below this are none.
const NOTHING: f64 = 1e-6;

/// The multiples of a sum of directions that are rounded to whole numbers.
const MULTIPLES: u32 = 64;

/// Whether an unknown may move for ever.
pub(super) fn is_open(form: &Form, j: usize) -> bool {
    let sides = form.limits[j].and(form.boxes[j]);
    !has_two(sides)
}

fn has_two(sides: Interval) -> bool {
    sides.lower.is_finite() && sides.upper.is_finite()
}

/// A basis of the directions that move no unknown with a bound and change no row with a side, but for long rows.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the end of the call.
pub(super) fn forth_and_back(form: &Form) -> Result<Vec<Direction>> {
    let is_free = |j: usize| form.limits[j].and(form.boxes[j]) == Interval::ALL;
    let basis = basis(form, is_free, |sides| sides != Interval::ALL)?;
    let moves_integer = |d: &Direction| d.iter().any(|(j, _)| form.integer[*j as usize]);
    Ok(basis.into_iter().filter(moves_integer).collect())
}

/// Directions that may lead away from as many limits as one can, and to none. They are near each other: the first that
/// does so in exact numbers is the shortest.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the end of the call.
pub(super) fn away(form: &Form) -> Result<Vec<Direction>> {
    let one_sided = |sides: &Interval| *sides != Interval::ALL && !has_two(*sides);
    let bounds = form.limits.iter().zip(&form.boxes);
    let mut bounds = bounds.map(|(limits, own)| limits.and(*own));
    if !bounds.any(|b| one_sided(&b)) && !form.row_limits.iter().any(one_sided) {
        return Ok(Vec::new());
    }
    let basis = basis(form, |j| is_open(form, j), has_two)?;
    let steps = steps_away(form, &basis)?;
    let most = steps.iter().fold(0.0, |m: f64, y| m.max(y.abs()));
    let mut found: Vec<Direction> = Vec::new();
    for multiple in (1..=MULTIPLES).filter(|_| most > NOTHING) {
        let mut moves = vec![0.0; form.dim()];
        for (direction, y) in basis.iter().zip(&steps) {
            let steps = (y / most * f64::from(multiple)).round();
            direction
                .iter()
                .for_each(|&(j, d)| moves[j as usize] += steps * d);
        }
        let moved = (0..).zip(moves).filter(|(_, d)| *d != 0.0).collect();
        if found.last() != Some(&moved) {
            found.push(moved);
        }
    }
    Ok(found)
}

/// How far to go along each direction of a basis to get away from as many limits as one can: a linear program with an
/// unknown between zero and one for each limit, which is at most what the limit changes by.
fn steps_away(form: &Form, basis: &[Direction]) -> Result<Vec<f64>> {
    let mut limits = Vec::new();
    for j in 0..form.dim() {
        limits.push((vec![(j as u32, 1.0)], form.limits[j].and(form.boxes[j])));
    }
    for (i, &sides) in form.row_limits.iter().enumerate() {
        let terms = form.rows.row(i).map(|(j, a)| (j as u32, a));
        limits.push((terms.collect(), sides));
    }
    let mut columns = vec![Vec::new(); limits.len()];
    for (k, direction) in basis.iter().enumerate() {
        let mut moves = vec![0.0; form.dim()];
        direction.iter().for_each(|&(j, d)| moves[j as usize] = d);
        for (column, (terms, sides)) in columns.iter_mut().zip(&limits) {
            let change = match *sides {
                Interval::ALL => 0.0,
                _ => change(terms, &moves),
            };
            if change != 0.0 {
                column.push((k as u32, change));
            }
        }
    }
    let kept = columns.into_iter().zip(limits);
    let kept = kept.filter(|(column, _)| !column.is_empty());
    let kept: Vec<(Direction, Interval)> =
        kept.map(|(column, (_, sides))| (column, sides)).collect();
    let (steps, count) = (basis.len(), kept.len());
    let mut entries = Vec::new();
    for (i, (column, sides)) in kept.iter().enumerate() {
        let (sign, i) = (if sides.lower.is_finite() { 1.0 } else { -1.0 }, i as u32);
        entries.extend(column.iter().map(|&(k, change)| (i, k, sign * change)));
        entries.push((i, steps as u32 + i, -1.0));
    }
    let n = steps + count;
    let sides = |lower, upper| Interval { lower, upper };
    let mut bounds = vec![sides(-LARGEST, LARGEST); steps];
    bounds.extend(kept.iter().map(|(_, own)| match has_two(*own) {
        true => sides(0.0, 0.0),
        false => sides(0.0, 1.0),
    }));
    let row_limits = kept.iter().map(|(_, own)| match has_two(*own) {
        true => sides(0.0, 0.0),
        false => sides(0.0, f64::INFINITY),
    });
    let program = Form {
        hessian: Sparse::from_triplets(n, n, std::iter::empty())?,
        gradient: (0..n).map(|j| if j < steps { 0.0 } else { -1.0 }).collect(),
        constant: 0.0,
        rows: Sparse::from_triplets(count, n, entries.into_iter())?,
        row_limits: row_limits.collect(),
        origins: (0..count).map(Conflicting::Inequality).collect(),
        limits: bounds.clone(),
        boxes: bounds,
        integer: vec![false; n],
    };
    let shared = Shared::new(&program, &regularization(&program))?;
    let mut relaxation = Relaxation::new(&program, &shared);
    relaxation.solve(f64::INFINITY, &program.boxes);
    Ok(relaxation.solver.point()[..steps].to_vec())
}

/// A basis of the directions of movable unknowns in which neither the slope nor a row that counts changes, but for long
/// ones.
fn basis(
    form: &Form,
    is_movable: impl Fn(usize) -> bool,
    counts: impl Fn(Interval) -> bool,
) -> Result<Vec<Direction>> {
    let movable = (0..form.dim()).filter(|&j| is_movable(j));
    let movable: Vec<u32> = movable.map(|j| j as u32).collect();
    let mut place = vec![u32::MAX; form.dim()];
    for (k, &j) in (0..).zip(&movable) {
        place[j as usize] = k;
    }
    let at = |j: u32| Some(place[j as usize]).filter(|&k| k != u32::MAX);
    let diagonal = (0..movable.len() as u32).map(|k| (k, k, 0.0));
    let mut entries: Vec<(u32, u32, f64)> = diagonal.collect();
    let curved = form.hessian.entries();
    entries.extend(curved.filter_map(|(i, j, v)| Some((at(i)?, at(j)?, v))));
    let largest = entries.iter().fold(0.0, |m: f64, (_, _, v)| m.max(v.abs()));
    let weight = if largest > 0.0 { largest } else { 1.0 };
    let slope: Direction = (0..).zip(form.gradient.iter().copied()).collect();
    let rows = (0..form.rows.rows()).filter(|&i| counts(form.row_limits[i]));
    let rows = rows.map(|i| form.rows.row(i).map(|(j, a)| (j as u32, a)).collect());
    for row in std::iter::once(slope).chain(rows) {
        let terms = row.iter().filter(|(_, a)| *a != 0.0);
        let terms = terms.filter_map(|&(j, a)| Some((at(j)?, a)));
        let terms: Direction = terms.collect();
        let size = terms.iter().fold(0.0, |m: f64, (_, a)| m.max(a.abs()));
        if terms.len() > LONG {
            continue;
        }
        for &(i, a) in &terms {
            let below = terms.iter().filter(|(j, _)| *j <= i);
            entries.extend(below.map(|&(j, b)| (i, j, weight * (a / size) * (b / size))));
        }
    }
    let matrix = Sparse::from_triplets(movable.len(), movable.len(), entries.into_iter())?;
    let factor = Cholesky::new(&matrix)?;
    let mut directions = Vec::new();
    for &k in factor.null_unknowns().iter().take(MOST) {
        let mut v = vec![0.0; movable.len()];
        v[k as usize] = 1.0;
        factor.solve(&mut v)?;
        let by = 1.0 / v[k as usize];
        let moved = v.iter().zip(&movable).map(|(v, &j)| (j, v * by));
        directions.extend(whole(form, moved.collect()));
    }
    Ok(directions)
}

/// The direction, times the least number that makes the steps of integers whole.
fn whole(form: &Form, direction: Direction) -> Option<Direction> {
    let is_integer = |j: u32| form.integer[j as usize];
    let mut denominator = 1.0;
    for &(_, d) in direction.iter().filter(|(j, _)| is_integer(*j)) {
        denominator *= fraction(d * denominator)?.1;
    }
    let mut moved = Vec::new();
    for (j, d) in direction {
        let d = match fraction(d * denominator) {
            Some((numerator, of)) => numerator / of,
            None => d * denominator,
        };
        if is_integer(j) && d.abs() > LARGEST {
            return None;
        }
        if d != 0.0 {
            moved.push((j, d));
        }
    }
    Some(moved)
}

/// The fraction with a small denominator that a number is.
fn fraction(x: f64) -> Option<(f64, f64)> {
    let (mut last, mut now) = ((1.0, 0.0), (x.floor(), 1.0));
    let mut rest = x - x.floor();
    while now.1 <= LARGEST {
        if (x - now.0 / now.1).abs() <= CLOSE {
            return Some(now);
        }
        let part = (1.0 / rest).floor();
        let next = (part * now.0 + last.0, part * now.1 + last.1);
        (last, now) = (now, next);
        rest = 1.0 / rest - part;
    }
    None
}

/// A sum, which is zero if it is no more than rounding errors.
pub(super) fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    let (sum, size) = terms.fold((0.0, 0.0), |(s, m): (f64, f64), t| (s + t, m + t.abs()));
    match sum.abs() > ROUNDING * size {
        true => sum,
        false => 0.0,
    }
}

/// The change of a sum of terms along a direction of all unknowns, or its value at a point.
pub(super) fn change(terms: &Direction, moves: &[f64]) -> f64 {
    sum(terms.iter().map(|&(j, a)| a * moves[j as usize]))
}

/// Whether the energy neither curves nor slopes along a direction.
pub(super) fn is_level(form: &Form, direction: &Direction) -> bool {
    let mut moves = vec![0.0; form.dim()];
    direction.iter().for_each(|&(j, d)| moves[j as usize] = d);
    let mut curved = vec![(0.0, 0.0_f64); form.dim()];
    let mut add = |i: u32, term: f64| {
        let (sum, size) = &mut curved[i as usize];
        (*sum, *size) = (*sum + term, *size + term.abs());
    };
    for (i, j, v) in form.hessian.entries() {
        add(i, v * moves[j as usize]);
        if i != j {
            add(j, v * moves[i as usize]);
        }
    }
    let slope = form.gradient.iter().zip(&moves).map(|(q, d)| q * d);
    let is_flat = |(sum, size): &(f64, f64)| sum.abs() <= ROUNDING * size;
    curved.iter().all(is_flat) && sum(slope) == 0.0
}

#[cfg(test)]
#[path = "level_tests.rs"]
mod tests;
