//! Adaptive greedy rounding: properties that hold for all its parameters, and tests that each part of
//! it is used.

use roundel::field::{FieldProblem, curvature_constraints};
use roundel::mesh::{TriangleMesh, shape};
use roundel::{Options, Problem, Solution, SolveStatus, Strategy, solve};

fn adaptive() -> Options {
    Options {
        strategy: Strategy::Adaptive,
        exact_integers: 0,
        ..Options::default()
    }
}

fn greedy(problem: &Problem) -> Solution {
    let options = Options {
        strategy: Strategy::Greedy,
        ..Options::default()
    };
    solve(problem, &options).unwrap()
}

fn mesh(name: &str, triangles: usize) -> TriangleMesh {
    let mesh = shape::by_name(name, triangles).unwrap();
    roundel::mesh::jitter(&mesh, 1e-3, 3).unwrap()
}

fn field(name: &str, triangles: usize) -> Problem {
    let mesh = mesh(name, triangles);
    let constraints = curvature_constraints(&mesh, 0.05).unwrap();
    FieldProblem::new(&mesh, &constraints)
        .unwrap()
        .problem()
        .clone()
}

#[test]
fn one_integer_at_a_time_to_a_tight_tolerance_is_exact_greedy() {
    for seed in 1..8 {
        let options = Options {
            rounding_threshold: 0.0,
            gauss_seidel_tolerance: 1e-13,
            gauss_seidel_updates: 100_000_000,
            ..adaptive()
        };
        for problem in [
            crate::common::orientation_field(6, seed).unwrap(),
            crate::common::parametrization(5, seed).unwrap(),
        ] {
            let exact = greedy(&problem).energy();
            let energy = solve(&problem, &options).unwrap().energy();
            assert!(
                (energy - exact).abs() < 1e-9 * exact.max(1.0),
                "{energy} {exact}"
            );
        }
    }
}

#[test]
fn conjugate_gradients_and_factorizations_alone_are_exact_greedy_too() {
    let without = |cg_iterations, exact_steps| Options {
        rounding_threshold: 0.0,
        gauss_seidel_updates: 0,
        cg_iterations,
        cg_tolerance: 1e-12,
        exact_steps,
        ..adaptive()
    };
    for seed in 1..8 {
        let problem = crate::common::parametrization(5, seed).unwrap();
        let exact = greedy(&problem).energy();
        for options in [without(200, false), without(0, true)] {
            let energy = solve(&problem, &options).unwrap().energy();
            assert!(
                (energy - exact).abs() < 1e-9 * exact.max(1.0),
                "{energy} {exact}"
            );
        }
    }
}

#[test]
fn few_integers_get_the_values_of_exact_greedy() {
    let problem = field("torus", 600);
    let options = Options {
        exact_integers: 1000,
        ..adaptive()
    };
    let (ours, theirs) = (solve(&problem, &options).unwrap(), greedy(&problem));
    assert_eq!(ours.values(), theirs.values());
}

#[test]
fn fields_come_close_to_exact_greedy_by_local_steps() {
    for name in ["rounded-cube", "torus", "genus-2", "gear"] {
        let problem = field(name, 4000);
        let ours = solve(&problem, &adaptive()).unwrap();
        let (exact, direct) = (greedy(&problem).energy(), direct(&problem).energy());
        assert!(
            ours.energy() <= 1.1 * exact,
            "{name}: {} {exact}",
            ours.energy()
        );
        assert!(
            ours.energy() <= direct,
            "{name}: {} {direct}",
            ours.energy()
        );
        assert_eq!(ours.max_integrality_violation(), 0.0);
        assert_eq!(ours.status(), SolveStatus::Feasible);
    }
}

fn direct(problem: &Problem) -> Solution {
    let options = Options {
        strategy: Strategy::Direct,
        ..Options::default()
    };
    solve(problem, &options).unwrap()
}

#[test]
fn the_parameter_sets_of_the_thesis_solve_their_problems() {
    let field = field("rounded-cube", 2000);
    let solution = solve(&field, &Options::orientation_field()).unwrap();
    assert!(solution.energy() <= direct(&field).energy());
    let map = crate::common::parametrization(12, 5).unwrap();
    let solution = solve(&map, &Options::parametrization()).unwrap();
    assert!(solution.max_constraint_violation() < 1e-9);
    assert!(solution.energy() >= solution.lower_bound().unwrap());
}
