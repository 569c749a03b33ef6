//! What ends a search before it is complete, and the status that follows from it.

mod common;

use std::time::Duration;

use common::orientation_field;
use roundel::field::{FieldOptions, solve_field};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::shape;
use roundel::monitor::EventKind;
use roundel::quad::solve_fold_free;
use roundel::untangle::UntangleOptions;
use roundel::{
    Event, Flow, Monitor, Options, Problem, Solution, SolveStatus, StoppedBy, Strategy, solve,
    solve_with,
};

fn with(strategy: Strategy) -> Options {
    Options {
        strategy,
        ..Options::default()
    }
}

fn ended(solution: &Solution) -> (SolveStatus, bool, StoppedBy) {
    let (status, stopped_by) = (solution.status(), solution.stopped_by());
    (status, solution.is_complete(), stopped_by)
}

/// Its proof takes thousands of nodes.
fn field() -> Problem {
    orientation_field(7, 3).unwrap()
}

#[test]
fn a_proof_that_has_visited_everything_is_complete() {
    let solution = solve(&field(), &with(Strategy::Exact)).unwrap();
    let expected = (SolveStatus::Optimal, true, StoppedBy::Nothing);
    assert_eq!(ended(&solution), expected);
}

#[test]
fn a_problem_without_integers_is_complete() {
    let mut problem = Problem::new(2).unwrap();
    problem
        .add_least_squares(&[0, 1], &[1.0, -1.0], 0.3, 1.0)
        .unwrap();
    problem.add_constraint(&[0], &[2.0], 1.0).unwrap();
    for strategy in Strategy::ALL {
        let solution = solve(&problem, &with(strategy)).unwrap();
        let expected = (SolveStatus::Optimal, true, StoppedBy::Nothing);
        assert_eq!(ended(&solution), expected, "{strategy:?}");
    }
}

#[test]
fn a_rounding_is_stopped_by_nothing() {
    for strategy in [Strategy::Direct, Strategy::Greedy, Strategy::Lattice] {
        let solution = solve(&field(), &with(strategy)).unwrap();
        let expected = (SolveStatus::Feasible, false, StoppedBy::Nothing);
        assert_eq!(ended(&solution), expected, "{strategy:?}");
    }
}

#[test]
fn a_gap_that_was_asked_for_stops_nothing() {
    let options = Options {
        gap: 0.1,
        ..with(Strategy::Exact)
    };
    let solution = solve(&field(), &options).unwrap();
    let expected = (SolveStatus::Feasible, false, StoppedBy::Nothing);
    assert_eq!(ended(&solution), expected);
}

#[test]
fn nodes_that_the_caller_set_are_a_limit() {
    let options = Options {
        nodes: 100,
        ..with(Strategy::Exact)
    };
    let solution = solve(&field(), &options).unwrap();
    let expected = (SolveStatus::Limit, false, StoppedBy::Nodes);
    assert_eq!(ended(&solution), expected);
}

/// The proof of this map is given up after thirty million nodes, which nobody asked for.
#[test]
fn a_limit_of_nodes_of_the_librarys_own_is_a_budget() {
    let mesh = shape::by_name("genus-5", 1_500).unwrap();
    let follow = FieldOptions::default();
    let quick = with(Strategy::Adaptive);
    let (field, _) = solve_field(&mesh, &follow, &quick, Monitor::default).unwrap();
    let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions::default()).unwrap();
    let effort = UntangleOptions {
        rounds: 0,
        refinements: 0,
        ..UntangleOptions::default()
    };
    let ended_with = |options: &Options| {
        let made = solve_fold_free(&mesh, &problem, options, &effort, Monitor::default);
        ended(&made.unwrap().solution)
    };
    let expected = (SolveStatus::Feasible, false, StoppedBy::Budget);
    assert_eq!(ended_with(&Options::default()), expected);
    let asked = Options {
        nodes: 10_000,
        ..Options::default()
    };
    let expected = (SolveStatus::Limit, false, StoppedBy::Nodes);
    assert_eq!(ended_with(&asked), expected);
}

#[test]
fn a_time_limit_stops_by_time() {
    let options = Options {
        time_limit: 2.0,
        ..with(Strategy::Exact)
    };
    let monitor = Monitor::default().on_event(|event: &Event| {
        if event.kind == EventKind::Improved {
            let left = options.time_limit - event.seconds;
            std::thread::sleep(Duration::from_secs_f64(left.max(0.0)));
        }
        Flow::Continue
    });
    let solution = solve_with(&field(), &options, monitor).unwrap();
    let expected = (SolveStatus::Limit, false, StoppedBy::Time);
    assert_eq!(ended(&solution), expected);
}

#[test]
fn a_cancel_stops_by_cancel() {
    let monitor = Monitor::default().on_event(|event: &Event| match event.kind {
        EventKind::Improved => Flow::Cancel,
        _ => Flow::Continue,
    });
    let solution = solve_with(&field(), &with(Strategy::Exact), monitor).unwrap();
    let expected = (SolveStatus::Cancelled, false, StoppedBy::Cancel);
    assert_eq!(ended(&solution), expected);
}

/// So many integers that the work of `auto` does not reach for a proof.
#[test]
fn the_work_of_auto_is_a_budget() {
    let mut problem = common::loosely_coupled(600).unwrap();
    // A weak coupling of distant unknowns keeps the search from short cuts.
    for i in 0..300 {
        let (row, wanted) = ([i, (i * 7 + 300) % 600], 0.3);
        problem
            .add_least_squares(&row, &[0.9, 1.1], wanted, 1.0)
            .unwrap();
    }
    let solution = solve(&problem, &with(Strategy::Auto)).unwrap();
    let expected = (SolveStatus::Feasible, false, StoppedBy::Budget);
    assert_eq!(ended(&solution), expected);
}
