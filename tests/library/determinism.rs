//! The same input gives the same bits in every run and with any number of threads.

use roundel::field::{FieldProblem, curvature_constraints};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::{TriangleMesh, io, jitter, shape};
use roundel::quad::{QuadOptions, quadrangulate};
use roundel::{Monitor, Options, Problem, Solution, Strategy, solve};

fn problems() -> Vec<Problem> {
    let mut problems: Vec<Problem> = (1..4)
        .flat_map(|seed| {
            [
                crate::common::orientation_field(7, seed),
                crate::common::parametrization(6, seed),
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

/// The numbers of threads that are compared.
const THREADS: [usize; 6] = [1, 2, 3, 4, 8, 16];

/// The digests of field, map and quads of a mesh.
fn digests_of(mesh: &TriangleMesh, options: &QuadOptions, threads: usize) -> [u64; 6] {
    let mut options = options.clone();
    options.field.threads = threads;
    let made = quadrangulate(mesh, &options, Monitor::default).unwrap();
    let quads: Vec<f64> = made
        .quads
        .quads
        .as_flattened()
        .iter()
        .map(|&v| v.into())
        .collect();
    let faces = 0..mesh.face_count();
    let uv: Vec<[f64; 2]> = faces.flat_map(|face| made.untangled.map.uv(face)).collect();
    let bound = |solution: &Solution| solution.lower_bound().unwrap();
    [
        digest(made.field_solution.values()),
        digest(made.solution.values()),
        digest(&[bound(&made.field_solution), bound(&made.solution)]),
        digest(&uv.concat()),
        digest(&made.quads.vertices.concat()),
        digest(&quads),
    ]
}

#[test]
fn fields_maps_and_quads_have_the_same_bits_at_any_number_of_threads() {
    // Three fields are tried.
    let mesh = shape::by_name("genus-2", 12_000).unwrap();
    let digests = THREADS.map(|threads| digests_of(&mesh, &QuadOptions::default(), threads));
    assert!(digests.iter().all(|d| *d == digests[0]), "{digests:x?}");
}

/// The same over every shape, rough and smooth, small and large, by other strategies and ten times each, and over
/// the files of meshes in the folder `ROUNDEL_MESHES` if it is given:
/// `cargo test --release --test library -- determinism:: --ignored --nocapture at_length`.
#[test]
#[ignore = "takes an hour"]
fn fields_maps_and_quads_have_the_same_bits_at_length() {
    let mut meshes: Vec<(String, TriangleMesh)> = Vec::new();
    for (name, _) in shape::NAMES {
        let name = name.replace('N', "3");
        for (triangles, amount) in [(1_500, 0.0), (12_000, 0.05), (40_000, 0.1)] {
            let mesh = jitter(&shape::by_name(&name, triangles).unwrap(), amount, 3).unwrap();
            meshes.push((format!("{name} {triangles}"), mesh));
        }
    }
    for entry in std::env::var("ROUNDEL_MESHES")
        .iter()
        .flat_map(std::fs::read_dir)
        .flatten()
    {
        let path = entry.unwrap().path();
        if let Ok(mesh) = io::read(&path) {
            meshes.push((path.display().to_string(), mesh));
        }
    }
    for (name, mesh) in &meshes {
        for strategy in [Strategy::Auto, Strategy::Adaptive] {
            let mut options = QuadOptions::default();
            (options.field.strategy, options.map.strategy) = (strategy, strategy);
            let alone = digests_of(mesh, &options, 1);
            for round in 0..10 {
                for threads in THREADS {
                    let digests = digests_of(mesh, &options, threads);
                    let strategy = strategy.name();
                    assert_eq!(
                        digests, alone,
                        "{name}, {strategy}, {threads} threads, {round}"
                    );
                }
            }
        }
        println!("{name}");
    }
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
