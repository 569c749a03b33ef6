//! What holds of the lattice strategies on problems of both families.

use std::cell::RefCell;

use super::common;
use roundel::{Event, Flow, Monitor, Options, Problem, SolveStatus, Strategy, solve, solve_with};

fn with(strategy: Strategy) -> Options {
    Options {
        strategy,
        ..Options::default()
    }
}

fn energy(problem: &Problem, strategy: Strategy) -> f64 {
    solve(problem, &with(strategy)).unwrap().energy()
}

#[test]
fn a_proved_optimum_is_below_every_other_strategy() {
    for seed in 1..6 {
        for problem in [
            common::orientation_field(4, seed).unwrap(),
            common::parametrization(6, seed).unwrap(),
        ] {
            let exact = solve(&problem, &with(Strategy::Exact)).unwrap();
            assert_eq!(exact.status(), SolveStatus::Optimal);
            for other in [
                Strategy::Direct,
                Strategy::Greedy,
                Strategy::Lattice,
                Strategy::Auto,
            ] {
                let other = energy(&problem, other);
                assert!(exact.energy() <= other + 1e-9 * other.max(1.0));
            }
        }
    }
}

#[test]
fn a_budget_that_ends_leaves_a_true_bound() {
    let problem = common::orientation_field(7, 3).unwrap();
    let best = solve(&problem, &with(Strategy::Exact)).unwrap();
    assert_eq!(best.status(), SolveStatus::Optimal);
    let mut last = f64::NEG_INFINITY;
    for nodes in [0, 100, 20_000, 300_000] {
        let options = Options {
            nodes,
            ..with(Strategy::Exact)
        };
        let solution = solve(&problem, &options).unwrap();
        let bound = solution.lower_bound().unwrap();
        assert!(bound <= best.energy() && bound >= last, "{bound} {last}");
        assert!(solution.energy() >= best.energy() - 1e-9);
        last = bound;
    }
}

#[test]
fn a_wanted_gap_ends_the_proof_early() {
    let problem = common::orientation_field(7, 3).unwrap();
    let options = Options {
        gap: 0.1,
        ..with(Strategy::Exact)
    };
    let solution = solve(&problem, &options).unwrap();
    assert!(solution.gap().unwrap() <= 0.1);
    assert_eq!(solution.status(), SolveStatus::Feasible);
}

#[test]
fn events_never_lose_ground_and_cancelling_keeps_the_best() {
    let problem = common::orientation_field(9, 2).unwrap();
    let seen = RefCell::new((f64::INFINITY, f64::NEG_INFINITY));
    let watch = |event: &Event| {
        let mut seen = seen.borrow_mut();
        assert!(event.energy <= seen.0 && event.lower_bound >= seen.1);
        assert!(event.lower_bound <= event.energy);
        *seen = (event.energy, event.lower_bound);
        if event.lower_bound > 0.0 && event.gap < 0.5 {
            return Flow::Cancel;
        }
        Flow::Continue
    };
    let monitor = Monitor::default().on_event(watch);
    let solution = solve_with(&problem, &with(Strategy::Exact), monitor).unwrap();
    assert_eq!(solution.status(), SolveStatus::Cancelled);
    assert!((solution.energy() - seen.borrow().0).abs() < 1e-9);
}

#[test]
fn more_integers_than_a_dense_lattice_holds_are_rounded_adaptively() {
    let problem = common::orientation_field(6, 1).unwrap();
    for strategy in [Strategy::Lattice, Strategy::Exact, Strategy::Auto] {
        let options = Options {
            dense_integers: 3,
            ..with(strategy)
        };
        let solution = solve(&problem, &options).unwrap();
        assert_eq!(solution.energy(), energy(&problem, Strategy::Adaptive));
    }
}
