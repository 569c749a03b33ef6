//! Slopes that should be zero, and are rounding errors.
//!
//! Along an unknown without a bound and without curvature, a minorant must have a slope of exactly zero, or of the
//! sign that its bound allows. Multipliers and points in floats leave a small slope there. Small changes of
//! some of them mend that, in two steps:
//!
//! 1. slopes along unknowns with one bound get a small slope of the right sign, by equations solved in floats;
//! 2. slopes along unknowns without bounds become zero, by equations solved exactly, which makes fractions.
//!
//! Which numbers are changed is chosen in floats; what comes out is evaluated like any other certificate.

use super::exact::Exact;
use super::format::{Certificate, Number};
use super::minorant::{Minorant, PartObjective};
use super::problem::{ExactProblem, Limits, Side};

/// The largest systems that are solved in floats and exactly.
const LARGEST: usize = 400;
const LARGEST_EXACT: usize = 30;

/// The slope of the right sign, as a part of the largest term.
const LEAN: f64 = 1e-12;

/// A pivot below this part of the largest is a rounding error.
const NOTHING: f64 = 1e-9;

/// Rounds of the first step.
const ROUNDS: usize = 4;

/// What is changed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Change {
    /// The multiplier of the row at this place of the certificate.
    Multiplier(usize),
    /// The value of this unknown of the part.
    Value(usize),
}

/// Where a certificate is mended.
pub(super) struct Place<'a> {
    pub problem: &'a ExactProblem,
    pub limits: &'a Limits,
    pub part: &'a PartObjective,
}

impl Place<'_> {
    /// A certificate near the given one that has a minimum, and the minimum. Without an objective, the
    /// certificate's point has no values.
    pub fn mended(&self, given: &Certificate) -> Option<(Exact, Certificate)> {
        let mut certificate = given.clone();
        for _ in 0..ROUNDS {
            let Some(next) = self.leaned(&certificate) else {
                break;
            };
            certificate = next;
            if let Some(least) = self.least(&certificate) {
                return Some((least, certificate));
            }
        }
        for certificate in [&certificate, given] {
            if let Some(zeroed) = self.zeroed(certificate)
                && let Some(least) = self.least(&zeroed)
            {
                return Some((least, zeroed));
            }
        }
        None
    }

    fn minorant(&self, certificate: &Certificate) -> Option<Minorant> {
        let Place {
            problem,
            limits,
            part,
        } = *self;
        let minorant = if certificate.point.is_empty() {
            Minorant::of_rows(problem, limits, part, &certificate.multipliers)
        } else {
            Minorant::of(problem, limits, part, certificate)
        };
        minorant.ok()
    }

    fn least(&self, certificate: &Certificate) -> Option<Exact> {
        self.minorant(certificate)?
            .least(self.limits, self.part)
            .ok()
    }

    /// For each unknown without curvature that lacks a bound: its place in the part, and the sign of a slope that
    /// its other bound allows, or zero.
    fn open(&self, certificate: &Certificate) -> Vec<(usize, f64)> {
        let part = self.part;
        let has_objective = !certificate.point.is_empty();
        let of_unknown = |k: usize| {
            if has_objective && !part.curvature[k].is_zero() {
                return None;
            }
            let is_open = |side| self.limits.side(part.members[k], side).is_none();
            match (is_open(Side::Lower), is_open(Side::Upper)) {
                (false, false) => None,
                (true, true) => Some((k, 0.0)),
                (false, true) => Some((k, 1.0)),
                (true, false) => Some((k, -1.0)),
            }
        };
        (0..part.members.len()).filter_map(of_unknown).collect()
    }

    /// A certificate near the given one whose slopes have the right sign, up to rounding errors.
    fn leaned(&self, certificate: &Certificate) -> Option<Certificate> {
        let minorant = self.minorant(certificate)?;
        let columns = columns(self.problem, self.part, certificate);
        let mut largest = 0.0_f64;
        for ((_, by), (_, column)) in certificate.multipliers.iter().zip(&columns) {
            let by = by.exact()?.near();
            let sizes = column.iter().map(|(_, a)| (by * a.near()).abs());
            largest = sizes.fold(largest, f64::max);
        }
        let lean = LEAN * largest;
        let slope = |k: usize| minorant.slopes()[k].near();
        let mut wanted = self.open(certificate);
        wanted.retain(|&(k, sign)| sign == 0.0 || sign * slope(k) < 0.5 * lean);
        if wanted.is_empty() || wanted.len() > LARGEST {
            return None;
        }
        let places: Vec<usize> = wanted.iter().map(|(k, _)| *k).collect();
        let rows = matrix(&columns, &places, self.part.members.len());
        let rows = rows.iter().map(|row| row.iter().map(Exact::near).collect());
        let sides = wanted.iter().map(|&(k, sign)| sign * lean - slope(k));
        let solved = eliminate(rows.collect(), sides.collect());
        let mut leaned = certificate.clone();
        for (&column, change) in solved.columns.iter().zip(&solved.solution) {
            let number = changed(&mut leaned, columns[column].0);
            *number = Number::Float(number.exact()?.near() + change);
        }
        without_zeros(&mut leaned);
        Some(leaned)
    }

    /// A certificate near the given one whose slopes along unknowns without bounds are zero, as are those that
    /// have the wrong sign.
    fn zeroed(&self, certificate: &Certificate) -> Option<Certificate> {
        let minorant = self.minorant(certificate)?;
        let slopes = minorant.slopes();
        let mut wanted = self.open(certificate);
        wanted.retain(|&(k, sign)| sign == 0.0 || sign * slopes[k].near() < 0.0);
        if wanted.is_empty() || wanted.len() > LARGEST_EXACT {
            return None;
        }
        let columns = columns(self.problem, self.part, certificate);
        let places: Vec<usize> = wanted.iter().map(|(k, _)| *k).collect();
        let rows = matrix(&columns, &places, self.part.members.len());
        let floats = rows.iter().map(|row| row.iter().map(Exact::near).collect());
        let pivots = eliminate(floats.collect(), vec![0.0; wanted.len()]);
        let system = pivots.rows.iter().map(|&e| {
            let chosen = pivots.columns.iter().map(|&c| rows[e][c].clone());
            let mut row: Vec<Exact> = chosen.collect();
            row.push(-&slopes[places[e]]);
            row
        });
        let (changes, determinant) = solve(system.collect())?;
        let mut zeroed = certificate.clone();
        for (&column, change) in pivots.columns.iter().zip(&changes) {
            let number = changed(&mut zeroed, columns[column].0);
            let moved = &(&number.exact()? * &determinant) + change;
            let (above, below) = moved.ratio(&determinant);
            *number = Number::Fraction(above, below);
        }
        without_zeros(&mut zeroed);
        Some(zeroed)
    }
}

fn changed(certificate: &mut Certificate, change: Change) -> &mut Number {
    match change {
        Change::Multiplier(at) => &mut certificate.multipliers[at].1,
        Change::Value(k) => &mut certificate.point[k],
    }
}

fn without_zeros(certificate: &mut Certificate) {
    let is_some = |by: &Number| by.exact().is_some_and(|by| !by.is_zero());
    certificate.multipliers.retain(|(_, by)| is_some(by));
}

/// The rows of these unknowns, of `members` ones, in a matrix of all columns.
fn matrix(columns: &[Column], wanted: &[usize], members: usize) -> Vec<Vec<Exact>> {
    let mut place = vec![usize::MAX; members];
    for (at, &k) in wanted.iter().enumerate() {
        place[k] = at;
    }
    let mut matrix = vec![vec![Exact::zero(); columns.len()]; wanted.len()];
    for (c, (_, column)) in columns.iter().enumerate() {
        for (k, v) in column.iter().filter(|(k, _)| place[*k] != usize::MAX) {
            matrix[place[*k]][c] = v.clone();
        }
    }
    matrix
}

/// A number that may change, and what it adds to the slopes of the part.
type Column = (Change, Vec<(usize, Exact)>);

/// All numbers that may change: the multipliers in their order, then the values.
fn columns(problem: &ExactProblem, part: &PartObjective, certificate: &Certificate) -> Vec<Column> {
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

/// The pivots of an elimination in floats, and the solution of its equations, one number for each column.
struct Eliminated {
    rows: Vec<usize>,
    columns: Vec<usize>,
    solution: Vec<f64>,
}

/// Eliminates with the largest pivots. Equations that depend on others are left out.
fn eliminate(mut matrix: Vec<Vec<f64>>, mut sides: Vec<f64>) -> Eliminated {
    let width = matrix.first().map_or(0, Vec::len);
    let (mut is_row, mut is_column) = (vec![false; matrix.len()], vec![false; width]);
    let (mut rows, mut columns) = (Vec::new(), Vec::new());
    let mut first = 0.0;
    loop {
        let mut best = (0.0, 0, 0);
        for (i, row) in matrix.iter().enumerate().filter(|(i, _)| !is_row[*i]) {
            for (c, v) in row.iter().enumerate() {
                if v.abs() > best.0 && !is_column[c] {
                    best = (v.abs(), i, c);
                }
            }
        }
        let (size, at, column) = best;
        if rows.is_empty() {
            first = size;
        }
        if size <= NOTHING * first {
            break;
        }
        (is_row[at], is_column[column]) = (true, true);
        rows.push(at);
        columns.push(column);
        let (pivot, side) = (matrix[at].clone(), sides[at]);
        for (i, row) in matrix.iter_mut().enumerate() {
            let factor = row[column] / pivot[column];
            if !is_row[i] && factor != 0.0 {
                sides[i] -= factor * side;
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(v, p)| *v -= factor * p);
            }
        }
    }
    let mut solution = vec![0.0; rows.len()];
    for k in (0..rows.len()).rev() {
        let row = &matrix[rows[k]];
        let later = (k + 1..rows.len()).map(|l| row[columns[l]] * solution[l]);
        solution[k] = (sides[rows[k]] - later.sum::<f64>()) / row[columns[k]];
    }
    Eliminated {
        rows,
        columns,
        solution,
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
