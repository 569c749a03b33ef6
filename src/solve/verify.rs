//! Energy and violations from the caller's own arrays.
//!
//! This shares nothing with the solver: it reads the problem as it was given, term by term and
//! row by row, before duplicates are summed or rows squared into Q.

use crate::Problem;
use crate::linalg::CompensatedSum;

/// What a point is worth, measured on the problem as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Verdict {
    pub energy: f64,
    pub constraint_violation: f64,
    pub integrality_violation: f64,
}

/// Measures `x`.
pub(crate) fn verify(problem: &Problem, x: &[f64]) -> Verdict {
    Verdict {
        energy: energy(problem, x),
        constraint_violation: constraint_violation(problem, x),
        integrality_violation: integrality_violation(problem, x),
    }
}

fn energy(problem: &Problem, x: &[f64]) -> f64 {
    let mut sum = CompensatedSum::new(problem.constant());
    for (q, x) in problem.linear().iter().zip(x) {
        sum.add_product(*q, *x);
    }
    for &(i, j, v) in problem.quadratic() {
        let half = if i == j { 0.5 } else { 1.0 };
        sum.add_product(half * v * x[i as usize], x[j as usize]);
    }
    let (rows, weights) = problem.least_squares();
    for (k, w) in weights.iter().enumerate() {
        let mut residual = CompensatedSum::new(-rows.rhs()[k]);
        for (j, a) in rows.row(k) {
            residual.add_product(a, x[j]);
        }
        let residual = residual.value();
        sum.add_product(w * residual, residual);
    }
    sum.value()
}

/// The largest `|c . x - d| / max(1, sum_j |c_j x_j|)`; a pin counts as a constraint.
fn constraint_violation(problem: &Problem, x: &[f64]) -> f64 {
    let rows = problem.constraint_rows();
    let mut worst: f64 = 0.0;
    for k in 0..rows.len() {
        let mut difference = CompensatedSum::new(-rows.rhs()[k]);
        let mut size = 0.0;
        for (j, c) in rows.row(k) {
            difference.add_product(c, x[j]);
            size += (c * x[j]).abs();
        }
        worst = worst.max(difference.value().abs() / f64::max(1.0, size));
    }
    for (pin, x) in problem.pins().iter().zip(x) {
        if let Some(value) = pin {
            worst = worst.max((x - value).abs() / value.abs().max(1.0));
        }
    }
    worst
}

fn integrality_violation(problem: &Problem, x: &[f64]) -> f64 {
    let integers = problem.integers().iter().zip(x).filter(|(i, _)| **i);
    integers
        .map(|(_, x)| (x - x.round()).abs())
        .fold(0.0, f64::max)
}
