//! Properties of the lattice strategies on problems of both families (fields and maps).

use std::cell::{Cell, RefCell};
use std::time::Instant;

use super::common;
use roundel::field::{FieldProblem, curvature_constraints};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::{jitter, shape};
use roundel::monitor::EventKind;
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
fn the_bound_is_valid_when_the_budget_ends() {
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
fn a_requested_gap_ends_the_proof_early() {
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
fn events_never_get_worse_and_cancelling_keeps_the_best() {
    let problem = common::orientation_field(9, 2).unwrap();
    let seen = RefCell::new((f64::INFINITY, f64::NEG_INFINITY));
    let raised = Cell::new(0);
    let watch = |event: &Event| {
        let mut seen = seen.borrow_mut();
        assert!(event.energy <= seen.0 && event.lower_bound >= seen.1);
        assert!(event.lower_bound <= event.energy);
        if event.kind == EventKind::Raised {
            assert!(event.lower_bound > seen.1);
            let gap = (event.energy - event.lower_bound) / event.energy;
            assert!((event.gap - gap).abs() < 1e-12);
            raised.set(raised.get() + 1);
        }
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
    assert!(raised.get() > 0);
}

#[test]
fn more_integers_than_a_dense_lattice_holds_are_rounded_adaptively() {
    let problem = common::parametrization(6, 1).unwrap();
    for strategy in [Strategy::Lattice, Strategy::Exact, Strategy::Auto] {
        let options = Options {
            dense_integers: 3,
            ..with(strategy)
        };
        let solution = solve(&problem, &options).unwrap();
        assert_eq!(solution.energy(), energy(&problem, Strategy::Adaptive));
    }
}

/// A seamless map of a jittered body of genus 5 with 1,088 triangles. It has 100 integers or a few less,
/// depending on the cones of the field.
fn map_of_a_hundred_integers() -> Problem {
    let mesh = shape::by_name("genus-5", 1_000).unwrap();
    let mesh = jitter(&mesh, 0.2, 4).unwrap();
    let constraints = curvature_constraints(&mesh, 0.02).unwrap();
    let problem = FieldProblem::new(&mesh, &constraints).unwrap();
    let solution = solve(problem.problem(), &with(Strategy::Lattice)).unwrap();
    let field = problem.field(&mesh, &solution).unwrap();
    let map = SeamlessProblem::new(&mesh, &field, &SeamlessOptions::default()).unwrap();
    map.problem().clone()
}

/// Measured on one core of a machine of 2026: 22 s.
#[test]
#[ignore = "minutes"]
fn a_hundred_integers_are_proved_within_twenty_minutes() {
    let started = Instant::now();
    let solution = solve(&map_of_a_hundred_integers(), &with(Strategy::Exact)).unwrap();
    assert!((90..=110).contains(&solution.counts().reduced_integers));
    assert_eq!(solution.status(), SolveStatus::Optimal);
    assert!(started.elapsed().as_secs_f64() < 1_200.0);
}

#[test]
fn the_work_of_auto_is_a_bounded_multiple_of_that_of_the_relaxation() {
    let mesh = shape::by_name("genus-3", 600).unwrap();
    let mesh = jitter(&mesh, 0.2, 1).unwrap();
    let field = FieldProblem::new(&mesh, &curvature_constraints(&mesh, 0.05).unwrap()).unwrap();
    let solved = solve(field.problem(), &with(Strategy::Auto)).unwrap();
    let directions = field.field(&mesh, &solved).unwrap();
    let map = SeamlessProblem::new(&mesh, &directions, &SeamlessOptions::default()).unwrap();
    for problem in [
        field.problem(),
        map.problem(),
        &common::orientation_field(7, 3).unwrap(),
        &common::orientation_field(20, 3).unwrap(),
        &common::parametrization(24, 7).unwrap(),
    ] {
        let relaxation = solve(problem, &with(Strategy::Relax)).unwrap().work();
        let auto = solve(problem, &with(Strategy::Auto)).unwrap().work();
        // What the documentation of `Strategy::Auto` gives, with the bound of angle differences, and one more
        // step of the search.
        let limit = 1_000 * relaxation + 1_000_000_000;
        assert!(relaxation > 0 && auto > relaxation, "{relaxation} {auto}");
        assert!(auto <= relaxation + limit + limit / 20, "{auto} {limit}");
        assert_eq!(auto, solve(problem, &with(Strategy::Auto)).unwrap().work());
    }
}
