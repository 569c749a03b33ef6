//! Slopes that should be zero, and are rounding errors.
//!
//! Along an unknown without a bound and without curvature, a minorant must have a slope of exactly zero, or of the
//! sign that its bound allows. Multipliers and points in floats leave a small slope there. A small change of
//! some of them takes it away: the solution of a system of linear equations in exact numbers, hence fractions.
//! Which equations and which numbers are changed is chosen in floats; what comes out is evaluated like any
//! other certificate.

use super::exact::Exact;
use super::format::{Certificate, Number};
use super::minorant::{Minorant, PartObjective};
use super::problem::{ExactProblem, Limits, Side};

/// The largest system.
const LARGEST: usize = 60;

/// A slope below this part of the largest term is a rounding error.
const SMALL: f64 = 1e-6;

/// A pivot below this part of the largest is a rounding error.
const NOTHING: f64 = 1e-9;

/// What is changed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Change {
    /// The multiplier of the row at this place of the certificate.
    Multiplier(usize),
    /// The value of this unknown of the part.
    Value(usize),
}

/// A certificate near the given one whose slopes are zero where they have to be. Without an objective, the
/// certificate's point has no values.
pub(super) fn repaired(
    problem: &ExactProblem,
    limits: &Limits,
    part: &PartObjective,
    certificate: &Certificate,
    minorant: &Minorant,
) -> Option<Certificate> {
    let has_objective = !certificate.point.is_empty();
    let slopes = minorant.slopes();
    let columns = columns(problem, part, certificate);
    let mut largest = 0.0_f64;
    for (change, column) in &columns {
        let size = match change {
            Change::Multiplier(at) => certificate.multipliers[*at].1.exact()?.near().abs(),
            Change::Value(_) => 0.0,
        };
        let entries = column.iter().map(|(_, v)| size * v.near().abs());
        largest = entries.fold(largest, f64::max);
    }
    let wanted: Vec<usize> = (0..part.members.len())
        .filter(|&k| !has_objective || part.curvature[k].is_zero())
        .filter(|&k| {
            let is_open = |side| limits.side(part.members[k], side).is_none();
            let slope = slopes[k].near();
            match (is_open(Side::Lower), is_open(Side::Upper)) {
                (false, false) => false,
                (true, true) => true,
                (true, false) => slope > 0.0 || slope.abs() <= SMALL * largest,
                (false, true) => slope < 0.0 || slope.abs() <= SMALL * largest,
            }
        })
        .collect();
    if wanted.is_empty() || wanted.len() > LARGEST {
        return None;
    }
    let mut place = vec![usize::MAX; part.members.len()];
    for (at, &k) in wanted.iter().enumerate() {
        place[k] = at;
    }
    let mut matrix = vec![vec![Exact::zero(); columns.len()]; wanted.len()];
    for (c, (_, column)) in columns.iter().enumerate() {
        for (k, v) in column.iter().filter(|(k, _)| place[*k] != usize::MAX) {
            matrix[place[*k]][c] = v.clone();
        }
    }
    let (equations, chosen) = pivots(&matrix);
    let system = equations.iter().map(|&e| {
        let mut row: Vec<Exact> = chosen.iter().map(|&c| matrix[e][c].clone()).collect();
        row.push(-&slopes[wanted[e]]);
        row
    });
    let (changes, determinant) = solve(system.collect())?;
    let mut repaired = certificate.clone();
    for (&c, change) in chosen.iter().zip(&changes) {
        let number = match columns[c].0 {
            Change::Multiplier(at) => &mut repaired.multipliers[at].1,
            Change::Value(k) => &mut repaired.point[k],
        };
        let moved = &(&number.exact()? * &determinant) + change;
        let (above, below) = moved.ratio(&determinant);
        *number = Number::Fraction(above, below);
    }
    repaired
        .multipliers
        .retain(|(_, by)| by.exact().is_some_and(|by| !by.is_zero()));
    Some(repaired)
}

/// For each number that may change, what it adds to the slopes of the part.
fn columns(
    problem: &ExactProblem,
    part: &PartObjective,
    certificate: &Certificate,
) -> Vec<(Change, Vec<(usize, Exact)>)> {
    let mut columns = Vec::new();
    for (at, (row, _)) in certificate.multipliers.iter().enumerate() {
        let terms = problem.rows[*row as usize].terms.iter();
        let terms = terms.filter_map(|(j, a)| Some((part.place_of(*j)?, a.clone())));
        columns.push((Change::Multiplier(at), terms.collect()));
    }
    if certificate.point.is_empty() {
        return columns;
    }
    let first = columns.len();
    let values = (0..part.members.len()).map(|k| (Change::Value(k), Vec::new()));
    columns.extend(values);
    let mut add = |i: usize, j: usize, v: Exact| columns[first + i].1.push((j, v));
    for (i, j, v) in &part.quadratic {
        add(*i, *j, v.clone());
        if i != j {
            add(*j, *i, v.clone());
        }
    }
    for square in &part.squares {
        for (i, a) in &square.terms {
            let twice = (&square.weight * a).shifted(1);
            for (j, b) in &square.terms {
                add(*i, *j, &twice * b);
            }
        }
    }
    for (_, column) in &mut columns {
        column.sort_by_key(|(k, _)| *k);
        column.dedup_by(|next, sum| {
            let is_same = next.0 == sum.0;
            if is_same {
                sum.1 = &sum.1 + &next.1;
            }
            is_same
        });
    }
    columns
}

/// Rows and columns of the pivots of an elimination in floats.
fn pivots(matrix: &[Vec<Exact>]) -> (Vec<usize>, Vec<usize>) {
    let mut rows: Vec<Vec<f64>> = matrix
        .iter()
        .map(|row| row.iter().map(Exact::near).collect())
        .collect();
    let (mut equations, mut chosen) = (Vec::new(), Vec::new());
    let mut first = 0.0;
    loop {
        let mut best = (0.0, 0, 0);
        for (e, row) in rows.iter().enumerate() {
            for (c, v) in row.iter().enumerate() {
                if v.abs() > best.0 && !equations.contains(&e) && !chosen.contains(&c) {
                    best = (v.abs(), e, c);
                }
            }
        }
        let (size, equation, column) = best;
        if first == 0.0 {
            first = size;
        }
        if size <= NOTHING * first {
            return (equations, chosen);
        }
        equations.push(equation);
        chosen.push(column);
        let pivot = rows[equation].clone();
        for (e, row) in rows.iter_mut().enumerate() {
            if !equations.contains(&e) {
                let factor = row[column] / pivot[column];
                row.iter_mut().zip(&pivot).for_each(|(v, p)| *v -= factor * p);
            }
        }
    }
}

/// Solves a system whose last column is the right side. Returns the solution times the determinant, and the
/// determinant (`bareiss1968`).
fn solve(mut rows: Vec<Vec<Exact>>) -> Option<(Vec<Exact>, Exact)> {
    let n = rows.len();
    let mut before: Option<Exact> = None;
    for k in 0..n {
        let at = (k..n).find(|&i| !rows[i][k].is_zero())?;
        rows.swap(k, at);
        let pivot = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i == k {
                continue;
            }
            let factor = row[k].clone();
            for (v, p) in row.iter_mut().zip(&pivot) {
                let minor = &(&pivot[k] * v) - &(&factor * p);
                *v = match &before {
                    None => minor,
                    Some(divisor) => minor.quotient(divisor),
                };
            }
        }
        before = Some(pivot[k].clone());
    }
    let solution = rows.iter().map(|row| row[n].clone()).collect();
    Some((solution, before?))
}
