//! Multiple rounding as published: the limits of its parameters, and the elimination that it uses.

use roundel::Ordering;
use roundel::{Options, Problem, SolveStatus, Strategy, solve};

fn multiple() -> Options {
    Options {
        strategy: Strategy::Multiple,
        ordering: Ordering::LargestPivot,
        ..Options::default()
    }
}

fn with(strategy: Strategy) -> Options {
    Options {
        strategy,
        ..multiple()
    }
}

fn energy(problem: &Problem, options: &Options) -> f64 {
    let solution = solve(problem, options).unwrap();
    assert_eq!(solution.status(), SolveStatus::Feasible);
    assert!(solution.max_constraint_violation() < 1e-9);
    assert_eq!(solution.max_integrality_violation(), 0.0);
    solution.energy()
}

fn assert_same(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9 * a.abs().max(1.0), "{a} {b}");
}

#[test]
fn one_integer_at_a_time_with_exact_steps_is_exact_greedy() {
    let local = Options {
        rounding_threshold: 0.0,
        gauss_seidel_tolerance: 1e-13,
        gauss_seidel_updates: 1_000_000_000,
        ..multiple()
    };
    let iterative = Options {
        gauss_seidel_updates: 0,
        cg_iterations: 1000,
        cg_tolerance: 1e-12,
        exact_steps: false,
        ..local.clone()
    };
    let factored = Options {
        cg_iterations: 0,
        exact_steps: true,
        ..iterative.clone()
    };
    for seed in 1..6 {
        let problem = crate::common::parametrization(5, seed).unwrap();
        let exact = energy(&problem, &with(Strategy::Greedy));
        for options in [&local, &iterative, &factored] {
            assert_same(energy(&problem, options), exact);
        }
    }
}

#[test]
fn without_steps_in_between_it_is_direct_rounding() {
    let deaf = Options {
        gauss_seidel_updates: 0,
        cg_iterations: 0,
        exact_steps: false,
        ..multiple()
    };
    for seed in 1..6 {
        let problem = crate::common::parametrization(6, seed).unwrap();
        assert_same(
            energy(&problem, &deaf),
            energy(&problem, &with(Strategy::Direct)),
        );
    }
}

#[test]
fn every_parameter_set_gives_an_energy_above_the_relaxation() {
    for seed in 1..6 {
        let problem = crate::common::orientation_field(8, seed).unwrap();
        let optimum = solve(&problem, &with(Strategy::Relax)).unwrap().energy();
        for updates in [0, 5, 100_000] {
            let options = Options {
                gauss_seidel_updates: updates,
                ..multiple()
            };
            assert!(energy(&problem, &options) >= optimum - 1e-9);
        }
    }
}
