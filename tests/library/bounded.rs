//! Unbounded objectives are recognised, and bounded ones are never called unbounded: rounding errors of
//! large terms that cancel do not count as a slope.

use proptest::prelude::*;
use roundel::{Error, Options, Problem, Strategy as Rounding, solve};

/// Squares of the differences along a cycle of `rhs.len()` unknowns, each with its own integer. The
/// energy does not depend on the sum of the unknowns.
fn cycle(rhs: &[f64], turn: f64) -> Problem {
    let n = rhs.len();
    let mut problem = Problem::new(2 * n).unwrap();
    for (k, &r) in rhs.iter().enumerate() {
        let at = [k, (k + 1) % n, n + k];
        problem
            .add_least_squares(&at, &[1.0, -1.0, turn], r, 1.0)
            .unwrap();
    }
    let integers: Vec<usize> = (n..2 * n).collect();
    problem.set_integers(&integers).unwrap();
    problem
}

fn rounding() -> impl Iterator<Item = Options> {
    let strategies = [
        Rounding::Relax,
        Rounding::Direct,
        Rounding::Greedy,
        Rounding::Adaptive,
        Rounding::Lattice,
        Rounding::Auto,
    ];
    strategies.into_iter().map(|strategy| Options {
        strategy,
        ..Options::default()
    })
}

proptest! {
    #[test]
    fn an_objective_with_right_sides_of_any_size_has_a_minimum(
        rhs in prop::collection::vec((-1.0..1.0, -3..10), 3..12),
        turn in 0.1..2.0,
    ) {
        let rhs: Vec<f64> = rhs.iter().map(|&(r, e)| r * 10f64.powi(e)).collect();
        let problem = cycle(&rhs, turn);
        for options in rounding() {
            let found = solve(&problem, &options);
            prop_assert!(found.is_ok(), "{:?}: {}", options.strategy, found.unwrap_err());
        }
    }

    #[test]
    fn an_objective_with_large_constraint_right_sides_has_a_minimum(
        rhs in prop::collection::vec(-1.0..1.0, 3..8),
        apart in (-1.0..1.0, 0..9),
    ) {
        let mut problem = cycle(&rhs, 0.7);
        let apart = apart.0 * 10f64.powi(apart.1);
        problem.add_constraint(&[0, 1], &[1.0, -1.0], apart).unwrap();
        for options in rounding() {
            let found = solve(&problem, &options);
            prop_assert!(found.is_ok(), "{:?}: {}", options.strategy, found.unwrap_err());
        }
    }

    #[test]
    fn a_small_slope_beside_large_right_sides_is_found(
        rhs in prop::collection::vec((-1.0..1.0, -3..4), 3..12),
        slope in prop_oneof![-1.0..-1e-3, 1e-3..1.0],
    ) {
        let rhs: Vec<f64> = rhs.iter().map(|&(r, e)| r * 10f64.powi(e)).collect();
        let mut problem = cycle(&rhs, 0.7);
        let mut q = vec![0.0; problem.variables()];
        q[0] = slope;
        problem.add_linear(&q).unwrap();
        for options in rounding() {
            let error = solve(&problem, &options).unwrap_err();
            let Error::Unbounded { direction, .. } = &error else {
                panic!("{error}");
            };
            prop_assert!(direction[0] * slope < 0.0, "downhill");
        }
    }
}

/// A regression test: compared with the first right side, the other two are below rounding errors.
#[test]
fn an_objective_with_one_right_side_of_1e10_has_a_minimum() {
    let problem = cycle(&[1e10, 0.3, 0.1], 0.5);
    for options in rounding() {
        assert!(solve(&problem, &options).is_ok(), "{:?}", options.strategy);
    }
}
