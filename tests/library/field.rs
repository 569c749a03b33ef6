//! Orientation fields on procedural shapes: properties that hold on any mesh.

use roundel::field::{
    Constraint, FieldOptions, FieldProblem, OrientationField, curvature_constraints,
    feature_constraints,
};
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::{TriangleMesh, shape};
use roundel::{Options, Solution, solve};

fn shape(name: &str, triangles: usize) -> TriangleMesh {
    let mesh = shape::by_name(name, triangles).unwrap();
    roundel::mesh::jitter(&mesh, 1e-3, 7).unwrap()
}

fn field(mesh: &TriangleMesh, constraints: &[Constraint]) -> (OrientationField, Solution) {
    let problem = FieldProblem::new(mesh, constraints).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    (problem.field(mesh, &solution).unwrap(), solution)
}

const SHAPES: [&str; 9] = [
    "rounded-cube",
    "sphere",
    "torus",
    "genus-2",
    "genus-3",
    "gear",
    "plane",
    "disk",
    "plate-with-holes",
];

#[test]
fn the_energy_on_the_mesh_is_the_energy_of_the_solution() {
    for name in SHAPES {
        for fraction in [0.0, 0.1] {
            let mesh = shape(name, 1500);
            let constraints = curvature_constraints(&mesh, fraction).unwrap();
            let (field, solution) = field(&mesh, &constraints);
            let energy = field.energy(&mesh);
            let error = (energy - solution.energy()).abs();
            assert!(
                error <= 1e-9 * energy.max(1.0),
                "{name}: {energy} {error:e}"
            );
        }
    }
}

/// Indices are what their steps say, found in two ways, and sum to the Euler characteristic, all exactly.
fn assert_exact(name: &str, mesh: &TriangleMesh, field: &OrientationField) {
    let (steps, loops) = (
        field.vertex_index_steps(mesh),
        field.boundary_index_steps(mesh),
    );
    assert_eq!(loops.len(), mesh.boundary_loop_count(), "{name}");
    assert_eq!(field.traced_index_steps(mesh), steps, "{name}");
    let arms = f64::from(field.symmetry());
    let over = |steps: &[i32]| -> Vec<f64> { steps.iter().map(|&n| f64::from(n) / arms).collect() };
    assert_eq!(field.vertex_indices(mesh), over(&steps), "{name}");
    assert_eq!(field.traced_indices(mesh), over(&steps), "{name}");
    assert_eq!(field.boundary_indices(mesh), over(&loops), "{name}");
    let sum: i32 = steps.iter().chain(&loops).sum();
    let euler = mesh.euler_characteristic();
    assert_eq!(
        i64::from(sum),
        i64::from(field.symmetry()) * euler,
        "{name}"
    );
    assert_eq!(field.index_sum(mesh), euler as f64, "{name}");
    for v in (0..steps.len()).filter(|&v| mesh.is_boundary_vertex(v)) {
        assert_eq!(steps[v], 0, "{name}: vertex {v} of the boundary");
    }
}

#[test]
fn indices_are_quarters_that_sum_to_the_euler_characteristic() {
    for name in SHAPES {
        for jittered in [false, true] {
            let mesh = match jittered {
                true => shape(name, 700),
                false => shape::by_name(name, 700).unwrap(),
            };
            let constraints = curvature_constraints(&mesh, 0.1).unwrap();
            let (found, _) = field(&mesh, &constraints);
            assert_exact(name, &mesh, &found);
            // 4 k/4 is k again, without rounding.
            let quarters = found.vertex_indices(&mesh).into_iter().map(|i| 4.0 * i);
            assert!(quarters.into_iter().all(|k| k.fract() == 0.0), "{name}");

            let sharp = FeatureGraph::by_angle(&mesh, 0.7).unwrap();
            let features = sharp.with(&mesh, &FeatureGraph::boundary(&mesh)).unwrap();
            let constraints = feature_constraints(&mesh, &features).unwrap();
            let (found, _) = field(&mesh, &constraints);
            assert_exact(name, &mesh, &found);
        }
    }
}

#[test]
fn sixths_of_a_turn_are_rounded_once() {
    let mesh = shape("genus-2", 900);
    for symmetry in [1, 2, 6] {
        let options = FieldOptions {
            symmetry,
            ..FieldOptions::default()
        };
        let problem = FieldProblem::with_options(&mesh, &options).unwrap();
        let solution = solve(problem.problem(), &Options::default()).unwrap();
        let field = problem.field(&mesh, &solution).unwrap();
        assert_exact("genus-2", &mesh, &field);
    }
}

#[test]
fn every_irregular_vertex_of_a_gear_turns_by_a_quarter() {
    let mesh = shape::by_name("gear", 3_000).unwrap();
    let features = FeatureGraph::by_angle(&mesh, 40f64.to_radians()).unwrap();
    let constraints = feature_constraints(&mesh, &features).unwrap();
    let (field, _) = field(&mesh, &constraints);
    let indices = field.vertex_indices(&mesh);
    let count = |index: f64| indices.iter().filter(|&&i| i == index).count();
    let irregular = field.irregular_vertices(&mesh).len();
    assert_eq!(irregular, 96);
    assert_eq!(count(0.25), count(-0.25));
    assert_eq!(count(0.25) + count(-0.25), irregular);
}

#[test]
fn the_eight_corners_of_a_rounded_cube_are_irregular() {
    let mesh = shape::by_name("rounded-cube", 10_000).unwrap();
    let constraints = curvature_constraints(&mesh, 0.1).unwrap();
    let (field, _) = field(&mesh, &constraints);
    let steps = field.vertex_index_steps(&mesh);
    let irregular = field.irregular_vertices(&mesh);
    assert_eq!(irregular.len(), 8);
    assert!(irregular.into_iter().all(|v| steps[v] == 1));
}

#[test]
fn constrained_faces_keep_their_direction() {
    let mesh = shape("torus", 800);
    let constraints = [(3, 0.4), (100, -1.0), (101, 2.0)];
    let constraints = constraints.map(|(face, angle)| Constraint { face, angle });
    let (field, _) = field(&mesh, &constraints);
    for c in constraints {
        assert_eq!(field.angles()[c.face], c.angle);
        assert!(field.constrained()[c.face]);
    }
}

#[test]
fn invalid_constraints_are_refused_with_their_position() {
    let mesh = shape("torus", 800);
    let refused = |constraints: &[(usize, f64)]| {
        let constraints = constraints.iter();
        let constraints = constraints.map(|&(face, angle)| Constraint { face, angle });
        let constraints: Vec<_> = constraints.collect();
        FieldProblem::new(&mesh, &constraints).unwrap_err()
    };
    let error = refused(&[(0, 0.0), (mesh.face_count(), 0.0)]);
    assert_eq!(
        (error.code(), error.index()),
        ("index_out_of_range", Some(1))
    );
    let error = refused(&[(0, f64::NAN)]);
    assert_eq!((error.code(), error.index()), ("not_finite", Some(0)));
    let error = refused(&[(5, 0.0), (6, 0.0), (5, 1.0)]);
    assert_eq!((error.code(), error.index()), ("invalid_argument", Some(2)));
    assert!(curvature_constraints(&mesh, 1.5).is_err());
    assert!(curvature_constraints(&mesh, f64::NAN).is_err());
}

#[test]
fn rings_around_vertices_form_a_valid_cycle_hint() {
    for name in SHAPES {
        let mesh = shape(name, 600);
        let problem = FieldProblem::new(&mesh, &curvature_constraints(&mesh, 0.05).unwrap());
        let model = roundel::Model::new(problem.unwrap().problem()).unwrap();
        assert_eq!(model.ignored_hint(), None, "{name}");
        assert!(!model.cycles().is_empty(), "{name}");
    }
}
