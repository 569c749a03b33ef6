//! The same input gives the same bits in every run and with any number of threads.

mod common;

use roundel::field::{FieldProblem, curvature_constraints};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::{jitter, shape};
use roundel::quad::{QuadOptions, quadrangulate};
use roundel::{Monitor, Options, Problem, Strategy, solve};

fn problems() -> Vec<Problem> {
    let mut problems: Vec<Problem> = (1..4)
        .flat_map(|seed| {
            [
                common::orientation_field(7, seed),
                common::parametrization(6, seed),
            ]
        })
        .map(Result::unwrap)
        .collect();
    for name in ["torus", "rounded-cube"] {
        let mesh = jitter(&shape::by_name(name, 1_200).unwrap(), 1e-3, 3).unwrap();
        let constraints = curvature_constraints(&mesh, 0.05).unwrap();
        let problem = FieldProblem::new(&mesh, &constraints).unwrap();
        problems.push(problem.problem().clone());
        let solution = solve(problem.problem(), &Options::default()).unwrap();
        let field = problem.field(&mesh, &solution).unwrap();
        let map = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads: 100 }).unwrap();
        problems.push(map.problem().clone());
    }
    problems
}

/// The FNV-1a hash of the bits of all values.
fn digest(values: &[f64]) -> u64 {
    let bytes = values.iter().flat_map(|x| x.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[test]
fn every_strategy_gives_the_same_bits_at_any_number_of_threads() {
    let problems = problems();
    assert_eq!(problems.len(), 10);
    for (k, problem) in problems.iter().enumerate() {
        for strategy in Strategy::ALL {
            let digests = [1, 1, 2, 4].map(|threads| {
                let options = Options {
                    strategy,
                    threads,
                    exact_integers: 50,
                    nodes: 100_000,
                    ..Options::default()
                };
                digest(solve(problem, &options).unwrap().values())
            });
            let same = digests.iter().all(|d| *d == digests[0]);
            assert!(same, "problem {k}, {}: {digests:x?}", strategy.name());
        }
    }
}

#[test]
fn quads_have_the_same_bits_at_any_number_of_threads() {
    // Three fields are tried.
    let mesh = shape::by_name("genus-2", 12_000).unwrap();
    let digests = [1, 2, 3, 16].map(|threads| {
        let mut options = QuadOptions::default();
        options.field.threads = threads;
        let made = quadrangulate(&mesh, &options, Monitor::default).unwrap();
        digest(&made.quads.vertices.concat())
    });
    assert!(digests.iter().all(|d| *d == digests[0]), "{digests:x?}");
}

/// Adaptive rounding divides this field into regions, and threads share the factorizations of field and map. On a
/// smoother mesh, any order of rounding would end at the same integers.
#[test]
fn threads_that_share_one_large_problem_change_no_bit() {
    let mesh = jitter(&shape::by_name("genus-2", 40_000).unwrap(), 0.1, 3).unwrap();
    let made = |threads: usize| {
        let mut options = QuadOptions::default();
        options.field.threads = threads;
        let made = quadrangulate(&mesh, &options, Monitor::default).unwrap();
        assert!(made.refined.is_none());
        let solutions = [&made.field_solution, &made.solution].map(|solution| {
            let bounds = [solution.energy(), solution.lower_bound().unwrap()];
            [solution.values(), &bounds].map(digest)
        });
        let vertices = digest(&made.quads.vertices.concat());
        (solutions, vertices, made.quads.quads)
    };
    let alone = made(1);
    assert!(alone.2.len() > 500);
    for threads in [2, 3, 8] {
        assert!(made(threads) == alone, "{threads} threads");
    }
}
