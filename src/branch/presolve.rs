//! What can be decided before the search: fixed unknowns, rows that always hold, independent parts.
//!
//! Rows of one unknown become bounds. Bounds are tightened through rows; those of integers become the
//! problem's own, those of real unknowns only serve bounds on the energy, because a row and a bound that say
//! the same make the active rows dependent. Rows of integers with integer coefficients are divided by their
//! greatest common divisor, and their sides are rounded.

use super::form::{Form, Interval};
use super::propagate::Propagator;
use crate::error::Result;
use crate::linalg::{DisjointSets, Sparse};
use crate::proof::Step;

/// Rounds of tightening at the root.
const ROUNDS: usize = 20;

/// Largest coefficient that counts as an integer.
const LARGEST: f64 = 1e9;

/// A part of a problem that is independent of the others.
#[derive(Debug)]
pub(super) struct Part {
    pub form: Form,
    /// The unknowns of the whole.
    pub members: Vec<u32>,
}

impl Part {
    /// Number of integers.
    pub fn integers(&self) -> usize {
        self.form.integer.iter().filter(|i| **i).count()
    }
}

/// A problem after the decisions that need no search.
#[derive(Debug)]
pub(super) struct Presolved {
    /// Values of the unknowns that are in no part.
    pub values: Vec<f64>,
    pub parts: Vec<Part>,
    /// The energy of the unknowns that are in no part.
    pub constant: f64,
}

/// Why a problem has no point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contradiction {
    /// The row cannot be satisfied within the bounds.
    Row(usize),
    /// The unknown has no value within its bounds.
    Unknown(usize),
}

/// Decides what needs no search. All unknowns that are not fixed form one part if rows may yet join any of them.
/// `steps` receives the changes of bounds, for a proof.
///
/// # Errors
/// The outer error is the end of the call; the inner one is why there is no point.
pub(super) fn presolve(
    mut form: Form,
    is_one_part: bool,
    steps: &mut Option<Vec<Step>>,
) -> Result<std::result::Result<Presolved, Contradiction>> {
    round_rows(&mut form, 0, steps);
    if let Err(contradiction) = tighten(&mut form, steps) {
        return Ok(Err(contradiction));
    }
    let n = form.dim();
    let is_free: Vec<bool> = form.limits.iter().map(|l| !l.is_point()).collect();
    let values: Vec<f64> = form
        .limits
        .iter()
        .map(|l| if l.is_point() { l.lower } else { 0.0 })
        .collect();
    let mut sets = DisjointSets::new(n);
    for (i, j, _) in form.hessian.entries() {
        if is_free[i as usize] && is_free[j as usize] {
            sets.join(i as usize, j as usize);
        }
    }
    let rows: Vec<usize> = (0..form.rows.rows())
        .filter(|&i| !always(&form, i))
        .collect();
    for &i in &rows {
        let free: Vec<usize> = form
            .rows
            .row(i)
            .map(|(j, _)| j)
            .filter(|&j| is_free[j])
            .collect();
        for pair in free.windows(2) {
            sets.join(pair[0], pair[1]);
        }
    }
    if is_one_part {
        let free: Vec<usize> = (0..n).filter(|&j| is_free[j]).collect();
        for pair in free.windows(2) {
            sets.join(pair[0], pair[1]);
        }
    }
    let mut part_of = vec![usize::MAX; n];
    let mut members: Vec<Vec<u32>> = Vec::new();
    for j in (0..n).filter(|&j| is_free[j]) {
        let root = sets.root(j);
        if part_of[root] == usize::MAX {
            part_of[root] = members.len();
            members.push(Vec::new());
        }
        part_of[j] = part_of[root];
        members[part_of[j]].push(j as u32);
    }
    if is_one_part && members.is_empty() {
        members.push(Vec::new());
    }
    let mut rows_of: Vec<Vec<u32>> = vec![Vec::new(); members.len()];
    for &i in &rows {
        if let Some((j, _)) = form.rows.row(i).find(|&(j, _)| is_free[j]) {
            rows_of[part_of[j]].push(i as u32);
        }
    }
    // The slopes that fixed unknowns give to the others.
    let curved = form.hessian.mul_symmetric(&values);
    let slopes: Vec<f64> = form
        .gradient
        .iter()
        .zip(&curved)
        .map(|(q, c)| q + c)
        .collect();
    let parts = members.into_iter().zip(rows_of);
    let parts = parts.map(|(members, rows)| part(&form, &values, &slopes, members, rows));
    Ok(Ok(Presolved {
        constant: form.energy(&values),
        parts: parts.collect::<Result<_>>()?,
        values,
    }))
}

/// Rounds the sides of rows of integers, from row `first` on, to multiples of the greatest common divisor of
/// their coefficients.
pub(super) fn round_rows(form: &mut Form, first: usize, steps: &mut Option<Vec<Step>>) {
    for i in first..form.rows.rows() {
        let is_integer =
            |(j, a): (usize, f64)| form.integer[j] && a == a.trunc() && a.abs() <= LARGEST;
        if form.rows.row(i).len() == 0 || !form.rows.row(i).all(is_integer) {
            continue;
        }
        let divisor = form.rows.row(i).fold(0, |g, (_, a)| gcd(g, a.abs() as u64)) as f64;
        let sides = form.row_limits[i];
        if sides.is_point() && (sides.lower / divisor).fract() == 0.0 {
            continue;
        }
        let rounded = sides.of_multiples(divisor);
        if let Some(steps) = steps {
            if rounded.lower > sides.lower {
                steps.push(Step::RowLower(i as u32, rounded.lower));
            }
            if rounded.upper < sides.upper {
                steps.push(Step::RowUpper(i as u32, rounded.upper));
            }
        }
        form.row_limits[i] = rounded;
    }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Tightens the bounds.
fn tighten(
    form: &mut Form,
    steps: &mut Option<Vec<Step>>,
) -> std::result::Result<(), Contradiction> {
    for (i, sides) in form.row_limits.iter().enumerate() {
        let mut row = form.rows.row(i);
        let holds_nothing = sides.lower > 0.0 || sides.upper < 0.0;
        if sides.is_empty() || (row.len() == 0 && holds_nothing) {
            return Err(Contradiction::Row(i));
        }
        if let (Some((j, a)), 1) = (row.next(), form.rows.row(i).len()) {
            let (mut lower, mut upper) = (sides.lower / a, sides.upper / a);
            if a < 0.0 {
                (lower, upper) = (upper, lower);
            }
            let implied = Interval { lower, upper };
            if let Some(steps) = steps {
                let implied = match form.integer[j] {
                    true => implied.of_integers(),
                    false => implied,
                };
                let ends = [
                    Step::Lower(i as u32, j as u32, implied.lower),
                    Step::Upper(i as u32, j as u32, implied.upper),
                ];
                steps.extend(ends);
            }
            form.limits[j] = form.limits[j].and(implied);
        }
    }
    for (j, limits) in form.limits.iter_mut().enumerate() {
        if form.integer[j] {
            *limits = limits.of_integers();
        }
        if limits.is_empty() {
            return Err(Contradiction::Unknown(j));
        }
    }
    let mut boxes = form.limits.clone();
    let mut propagator = Propagator::new(form);
    propagator.steps = steps.take();
    let changed = propagator.all(form, &mut boxes, true, ROUNDS);
    *steps = propagator.steps;
    if let Err(row) = changed {
        return Err(Contradiction::Row(row));
    }
    for (j, limits) in form.limits.iter_mut().enumerate() {
        if form.integer[j] {
            *limits = boxes[j];
        }
    }
    form.boxes = boxes;
    Ok(())
}

/// Whether a row holds for all points within the bounds, with room for rounding errors.
fn always(form: &Form, row: usize) -> bool {
    let sides = form.row_limits[row];
    let (mut least, mut most, mut size) = (0.0, 0.0, 0.0_f64);
    for (j, a) in form.rows.row(row) {
        let ends = [a * form.limits[j].lower, a * form.limits[j].upper];
        least += ends[0].min(ends[1]);
        most += ends[0].max(ends[1]);
        size += ends[0].abs().max(ends[1].abs());
    }
    if form.rows.row(row).len() == 1 {
        return true;
    }
    let room = if size.is_finite() { 1e-12 * size } else { 0.0 };
    // Where all terms are fixed, the row was found to hold.
    let fixed = form.rows.row(row).all(|(j, _)| form.limits[j].is_point());
    let above = sides.upper == f64::INFINITY || most + room <= sides.upper;
    let below = sides.lower == f64::NEG_INFINITY || least - room >= sides.lower;
    fixed || (above && below)
}

/// The form of the unknowns `members`, with the others at `values`.
pub(super) fn part(
    form: &Form,
    values: &[f64],
    slopes: &[f64],
    members: Vec<u32>,
    rows: Vec<u32>,
) -> Result<Part> {
    let mut place = vec![u32::MAX; form.dim()];
    for (k, &j) in members.iter().enumerate() {
        place[j as usize] = k as u32;
    }
    let at = |j: usize| place[j];
    let entries = members.iter().flat_map(|&i| {
        let row = form.hessian.row(i as usize);
        row.map(move |(j, v)| (at(i as usize), at(j), v))
    });
    let entries = entries.filter(|&(_, j, _)| j != u32::MAX);
    let hessian = Sparse::from_triplets(members.len(), members.len(), entries)?;
    let entries = rows.iter().enumerate().flat_map(|(k, &i)| {
        let row = form.rows.row(i as usize);
        row.map(move |(j, v)| (k as u32, at(j), v))
    });
    let entries = entries.filter(|&(_, j, _)| j != u32::MAX);
    let matrix = Sparse::from_triplets(rows.len(), members.len(), entries)?;
    let row_limits = rows.iter().map(|&i| {
        let fixed: f64 = form.rows.row(i as usize).map(|(j, a)| a * values[j]).sum();
        let sides = form.row_limits[i as usize];
        Interval {
            lower: sides.lower - fixed,
            upper: sides.upper - fixed,
        }
    });
    let pick = |of: &[Interval]| members.iter().map(|&j| of[j as usize]).collect();
    Ok(Part {
        form: Form {
            hessian,
            gradient: members.iter().map(|&j| slopes[j as usize]).collect(),
            constant: 0.0,
            rows: matrix,
            row_limits: row_limits.collect(),
            origins: rows.iter().map(|&i| form.origins[i as usize]).collect(),
            limits: pick(&form.limits),
            boxes: pick(&form.boxes),
            integer: members.iter().map(|&j| form.integer[j as usize]).collect(),
        },
        members,
    })
}
