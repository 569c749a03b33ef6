//! An objective in other units is the same problem: multiplied by a power of two, which is exact, it has the
//! same integers, status and gap.

use crate::common::{weighted_orientation_field, weighted_parametrization};
use roundel::{Options, Problem, Solution, SolveStatus, Strategy, solve};

const STRATEGIES: [Strategy; 6] = [
    Strategy::Direct,
    Strategy::Greedy,
    Strategy::Adaptive,
    Strategy::Lattice,
    Strategy::Exact,
    Strategy::Auto,
];

fn solved(problem: &Problem, strategy: Strategy) -> Solution {
    let options = Options {
        strategy,
        // Passes instead of exact steps, also with few integers.
        exact_integers: 10,
        ..Options::default()
    };
    solve(problem, &options).unwrap()
}

/// What must not depend on the scale, and the energy as a multiple of it.
fn unscaled(solution: &Solution, scale: f64) -> impl PartialEq + std::fmt::Debug + use<> {
    (
        solution.values().to_vec(),
        solution.status(),
        solution.is_complete(),
        solution.stopped_by(),
        solution.gap(),
        solution.energy() / scale,
    )
}

fn hold(strategies: &[Strategy], problem: impl Fn(f64) -> Problem) {
    for &strategy in strategies {
        let plain = unscaled(&solved(&problem(1.0), strategy), 1.0);
        for scale in [2f64.powi(-40), 2.0, 2f64.powi(40)] {
            let scaled = unscaled(&solved(&problem(scale), strategy), scale);
            assert_eq!(scaled, plain, "{strategy:?} at {scale:e}");
        }
    }
}

#[test]
fn fields_have_the_same_solution_at_every_scale() {
    for (side, seed) in [(4, 1), (5, 2)] {
        hold(&STRATEGIES, |scale| {
            weighted_orientation_field(side, seed, scale).unwrap()
        });
    }
    // The proof of this one takes a minute.
    hold(&STRATEGIES[..4], |scale| {
        weighted_orientation_field(12, 3, scale).unwrap()
    });
}

#[test]
fn maps_have_the_same_solution_at_every_scale() {
    for seed in 1..4 {
        hold(&STRATEGIES, |scale| {
            weighted_parametrization(6, seed, scale).unwrap()
        });
    }
}

/// (x + y - 0.9)^2 + (x - y)^2 / 10: both integers are rounded from 0.45 to 0, and (1, 0) is seven times better.
#[test]
fn rounding_is_not_called_optimal_because_all_energies_are_small() {
    for scale in [1.0, 1e-10, 1e-100] {
        let mut problem = Problem::new(2).unwrap();
        problem
            .add_least_squares(&[0, 1], &[1.0, 1.0], 0.9, scale)
            .unwrap();
        problem
            .add_least_squares(&[0, 1], &[1.0, -1.0], 0.0, 0.1 * scale)
            .unwrap();
        problem.set_integers(&[0, 1]).unwrap();
        let exact = solved(&problem, Strategy::Exact);
        assert_eq!(exact.status(), SolveStatus::Optimal);
        assert!(exact.is_complete());
        let direct = solved(&problem, Strategy::Direct);
        assert!(direct.energy() > 1.5 * exact.energy(), "{direct:?}");
        assert_eq!(direct.status(), SolveStatus::Feasible);
    }
}
