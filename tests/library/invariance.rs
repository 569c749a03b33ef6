//! The least energy does not depend on how a problem is written down: not on the order of variables and
//! rows, nor on the units of rows, nor on redundant rows.

use proptest::collection::vec;
use proptest::prelude::*;
use roundel::{Options, Problem, SolveStatus, Strategy as Decide, solve};

/// Integers and halves, so that changing units by powers of two is exact.
#[derive(Debug, Clone)]
struct Given {
    /// Coefficients and right side of each least-squares row.
    squares: Vec<(Vec<i8>, i8)>,
    /// Coefficients of each constraint. The right sides are those that `point` satisfies.
    constraints: Vec<Vec<i8>>,
    point: Vec<i8>,
    integers: Vec<bool>,
}

const SIZE: usize = 5;

fn given() -> impl Strategy<Value = Given> {
    let row = || vec(-3i8..=3, SIZE);
    (
        vec((row(), -9i8..=9), 3..8),
        vec(row(), 0..3),
        vec(-4i8..=4, SIZE),
        vec(any::<bool>(), SIZE),
    )
        .prop_map(|(squares, constraints, point, integers)| Given {
            squares,
            constraints,
            point,
            integers,
        })
}

/// One way to write down the problem.
struct Writing {
    /// The place at which variable k is written.
    order: Vec<usize>,
    /// The factor by which constraint k is multiplied.
    units: Vec<f64>,
    /// Whether the sum of all constraints is added as one more.
    sum: bool,
    /// Whether the rows come in the opposite order.
    reversed: bool,
}

impl Writing {
    fn plain(given: &Given) -> Self {
        Writing {
            order: (0..SIZE).collect(),
            units: vec![1.0; given.constraints.len()],
            sum: false,
            reversed: false,
        }
    }

    fn problem(&self, given: &Given) -> Problem {
        let mut problem = Problem::new(SIZE).unwrap();
        let real = |row: &[i8], unit: f64| -> Vec<f64> {
            row.iter().map(|&a| unit * f64::from(a) / 2.0).collect()
        };
        let at = |row: &[f64]| -> f64 {
            let terms = row.iter().zip(&given.point).map(|(a, &x)| a * f64::from(x));
            terms.sum()
        };
        let mut squares: Vec<_> = given.squares.iter().collect();
        let mut constraints: Vec<_> = given.constraints.iter().zip(&self.units).collect();
        if self.reversed {
            squares.reverse();
            constraints.reverse();
        }
        for (row, rhs) in squares {
            let row = real(row, 1.0);
            let rhs = f64::from(*rhs) / 4.0;
            problem
                .add_least_squares(&self.order, &row, rhs, 1.0)
                .unwrap();
        }
        // A small square of every variable makes sure that a minimiser exists.
        for k in 0..SIZE {
            problem.add_least_squares(&[k], &[0.25], 0.0, 1.0).unwrap();
        }
        let mut sum = vec![0.0; SIZE];
        for (row, &unit) in constraints {
            let row = real(row, unit);
            sum.iter_mut().zip(&row).for_each(|(s, a)| *s += a);
            problem.add_constraint(&self.order, &row, at(&row)).unwrap();
        }
        if self.sum {
            problem.add_constraint(&self.order, &sum, at(&sum)).unwrap();
        }
        let places = self.order.iter().zip(&given.integers);
        let integers: Vec<usize> = places.filter(|(_, is)| **is).map(|(&k, _)| k).collect();
        problem.set_integers(&integers).unwrap();
        problem
    }
}

fn least(problem: &Problem) -> f64 {
    let options = Options {
        strategy: Decide::Exact,
        ..Options::default()
    };
    let solution = solve(problem, &options).unwrap();
    assert_eq!(solution.status(), SolveStatus::Optimal);
    solution.energy()
}

fn same(given: &Given, other: &Writing) -> Result<(), TestCaseError> {
    let (one, two) = (
        least(&Writing::plain(given).problem(given)),
        least(&other.problem(given)),
    );
    prop_assert!(
        (one - two).abs() <= 1e-9 * one.abs().max(1.0),
        "{one} and {two}"
    );
    Ok(())
}

proptest! {
    #[test]
    fn the_order_of_variables_does_not_matter(
        given in given(),
        order in Just((0..SIZE).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        same(&given, &Writing { order, ..Writing::plain(&given) })?;
    }

    #[test]
    fn the_order_of_rows_does_not_matter(given in given()) {
        same(&given, &Writing { reversed: true, ..Writing::plain(&given) })?;
    }

    #[test]
    fn the_units_of_constraints_do_not_matter(given in given(), powers in vec(-6i32..=6, 3)) {
        let units = powers.iter().map(|&p| -(2f64.powi(p))).take(given.constraints.len());
        same(&given, &Writing { units: units.collect(), ..Writing::plain(&given) })?;
    }

    #[test]
    fn a_redundant_constraint_does_not_matter(given in given()) {
        same(&given, &Writing { sum: true, ..Writing::plain(&given) })?;
    }
}
