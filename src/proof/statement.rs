//! The statement of a caller's problem.

use super::format::{Equation, Inequality, Square, Statement, Terms};
use crate::problem::{Problem, RowList};

impl Statement {
    /// The problem in all that its solutions depend on: all but the initial guess and the hints.
    pub fn of(problem: &Problem) -> Self {
        let n = problem.variables();
        let numbered = |values: &[f64]| -> Terms {
            let all = (0..).zip(values.iter().copied());
            all.filter(|&(_, v)| v != 0.0).collect()
        };
        let (squares, weights) = problem.least_squares();
        let square = |(k, &weight): (usize, &f64)| Square {
            weight,
            rhs: squares.rhs()[k],
            terms: terms(squares, k),
        };
        let equalities = problem.constraint_rows();
        let equation = |k: usize| Equation {
            rhs: equalities.rhs()[k],
            terms: terms(equalities, k),
        };
        let two_sided = problem.inequality_rows();
        let inequality = |k: usize| Inequality {
            lower: side(two_sided.lower()[k]),
            upper: side(two_sided.upper()[k]),
            terms: two_sided.row(k).map(|(j, a)| (j as u32, a)).collect(),
        };
        let bounds = (0..n).filter_map(|j| {
            let (lower, upper) = problem.limits_of(j);
            let limits = lower.is_finite() || upper.is_finite();
            limits.then(|| (j as u32, side(lower), side(upper)))
        });
        let integers = (0..n).filter(|&j| problem.integers()[j]);
        let pins = (0..).zip(problem.pins().iter());
        Statement {
            variables: n,
            quadratic: problem.quadratic().to_vec(),
            linear: numbered(problem.linear()),
            constant: problem.constant(),
            least_squares: weights.iter().enumerate().map(square).collect(),
            constraints: (0..equalities.len()).map(equation).collect(),
            inequalities: (0..two_sided.len()).map(inequality).collect(),
            bounds: bounds.collect(),
            integers: integers.map(|j| j as u32).collect(),
            pins: pins.filter_map(|(j, pin)| Some((j, (*pin)?))).collect(),
        }
    }
}

fn terms(rows: &RowList, k: usize) -> Terms {
    rows.row(k).map(|(j, a)| (j as u32, a)).collect()
}

/// A side, or nothing where it does not limit.
fn side(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
