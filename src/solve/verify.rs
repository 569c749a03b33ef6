//! Verification: energy and violations, computed from the caller's own arrays.
//!
//! It reads the caller's problem term by term and row by row, before duplicates are summed or rows are squared
//! into Q, and in twice the working precision ([`Objective`]).

use crate::error::{Error, Result};
use crate::linalg::CompensatedSum;
use crate::monitor::in_blocks;
use crate::problem::{Objective, Problem};

/// The energy and the violations of a point, measured on the caller's problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// The objective, in the caller's units.
    pub energy: f64,
    /// The largest `v / max(1, sum_j |c_j x_j|)`, where `v` is the distance of `c . x` from the right side of
    /// a constraint, or from the interval of a two-sided row. Pins and bounds count as rows of one term.
    pub constraint_violation: f64,
    /// The largest distance of an integer unknown from an integer.
    pub integrality_violation: f64,
}

/// Measures the point `x`. It may come from this library, another solver or a file.
///
/// # Errors
/// [`Error::LengthMismatch`] unless there is one value for each unknown, and [`Error::NotFinite`].
pub fn verify(problem: &Problem, x: &[f64]) -> Result<Verdict> {
    if x.len() != problem.variables() {
        return Err(Error::LengthMismatch {
            what: "the values of the unknowns",
            expected: problem.variables(),
            actual: x.len(),
        });
    }
    if let Some(position) = x.iter().position(|x| !x.is_finite()) {
        return Err(Error::NotFinite {
            what: "the values of the unknowns",
            position,
        });
    }
    Ok(Verdict {
        energy: Objective(problem).energy(|i| x[i].into()).value.high,
        constraint_violation: constraint_violation(problem, x),
        integrality_violation: integrality_violation(problem, x),
    })
}

/// The largest of the values of all numbers below `count`, which are not negative.
fn largest(count: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    let blocks = in_blocks(count, |block| block.map(&value).fold(0.0, f64::max));
    blocks.into_iter().fold(0.0, f64::max)
}

fn constraint_violation(problem: &Problem, x: &[f64]) -> f64 {
    let rows = problem.constraint_rows();
    let equalities = largest(rows.len(), |k| {
        let mut difference = CompensatedSum::new(-rows.rhs()[k]);
        let mut size = 0.0;
        for (j, c) in rows.row(k) {
            difference.add_product(c, x[j]);
            size += (c * x[j]).abs();
        }
        difference.value().abs() / f64::max(1.0, size)
    });
    let rows = problem.inequality_rows();
    let inequalities = largest(rows.len(), |k| {
        let size: f64 = rows.row(k).map(|(j, c)| (c * x[j]).abs()).sum();
        let above = |side: f64| {
            let mut difference = CompensatedSum::new(-side);
            rows.row(k)
                .for_each(|(j, c)| difference.add_product(c, x[j]));
            difference.value()
        };
        outside(rows.lower()[k], rows.upper()[k], above) / f64::max(1.0, size)
    });
    let pins = problem.pins();
    let single = largest(x.len(), |j| {
        let (lower, upper) = problem.limits_of(j);
        let bounds = outside(lower, upper, |side| x[j] - side) / x[j].abs().max(1.0);
        match pins[j] {
            Some(value) => bounds.max((x[j] - value).abs() / value.abs().max(1.0)),
            None => bounds,
        }
    });
    equalities.max(inequalities).max(single)
}

/// How far a value is outside an interval. `above(side)` is the value minus `side`.
fn outside(lower: f64, upper: f64, above: impl Fn(f64) -> f64) -> f64 {
    let below = if lower.is_finite() {
        -above(lower)
    } else {
        0.0
    };
    let over = if upper.is_finite() { above(upper) } else { 0.0 };
    below.max(over).max(0.0)
}

fn integrality_violation(problem: &Problem, x: &[f64]) -> f64 {
    let integers = problem.integers();
    largest(x.len(), |j| match integers[j] {
        true => (x[j] - x[j].round()).abs(),
        false => 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{spawned, with_threads};

    /// `(x0 - x1)^2 + x1 x1 / 2 - x0 + 1`, `x0 + 2 x1 = 3`, x2 pinned to 4, x1 an integer.
    fn problem() -> Result<Problem> {
        let mut problem = Problem::new(3)?;
        problem.add_least_squares(&[0, 1], &[1.0, -1.0], 0.0, 1.0)?;
        problem.add_quadratic_triplets(crate::problem::Triangle::Lower, &[1], &[1], &[1.0])?;
        problem.add_linear(&[-1.0, 0.0, 0.0])?;
        problem.add_constant(1.0)?;
        problem.add_constraint(&[0, 1], &[1.0, 2.0], 3.0)?;
        problem.pin(2, 4.0)?;
        problem.set_integers(&[1])?;
        Ok(problem)
    }

    #[test]
    fn any_point_is_measured_on_the_problem_as_given() {
        let verdict = verify(&problem().unwrap(), &[2.0, 1.25, 3.0]).unwrap();
        assert_eq!(verdict.energy, 0.5625 + 0.78125 - 2.0 + 1.0);
        // The row is violated by 1.5 relative to 4.5, the pin by 1 relative to 4.
        assert!((verdict.constraint_violation - 1.5 / 4.5).abs() < 1e-15);
        assert_eq!(verdict.integrality_violation, 0.25);
    }

    #[test]
    fn rows_of_two_sides_and_bounds_are_measured_from_their_nearer_side() {
        let mut problem = problem().unwrap();
        let none = f64::INFINITY;
        problem
            .add_inequality(&[0, 1], &[1.0, -1.0], -none, -1.0)
            .unwrap();
        let violation = |problem: &Problem| verify(problem, &[1.0, 1.0, 4.0]).unwrap();
        // 1 - 1 is above -1 by 1, relative to 2.
        assert_eq!(violation(&problem).constraint_violation, 0.5);
        problem.set_bounds(&[1], &[4.0], &[none]).unwrap();
        assert_eq!(violation(&problem).constraint_violation, 3.0);
    }

    #[test]
    fn the_worst_of_many_rows_may_be_anywhere() {
        let count = 50_000;
        for worst in [0, 20_000, count - 1] {
            let mut problem = Problem::new(count).unwrap();
            problem.set_integers(&[worst]).unwrap();
            for i in 0..count {
                problem.add_constraint(&[i], &[1.0], 0.0).unwrap();
            }
            let mut x = vec![0.125; count];
            x[worst] = -0.25;
            let mut verdict = None;
            let verified = || verdict = Some(verify(&problem, &x).unwrap());
            assert!(spawned(|| with_threads(2, verified)) > 0);
            let verdict = verdict.unwrap();
            assert_eq!(verdict.constraint_violation, 0.25);
            assert_eq!(verdict.integrality_violation, 0.25);
        }
    }

    #[test]
    fn what_is_no_point_is_refused() {
        let problem = problem().unwrap();
        let short = verify(&problem, &[1.0, 1.0]);
        assert!(matches!(short, Err(Error::LengthMismatch { .. })));
        let error = verify(&problem, &[1.0, 1.0, f64::NAN]).unwrap_err();
        assert_eq!((error.code(), error.index()), ("not_finite", Some(2)));
    }
}
