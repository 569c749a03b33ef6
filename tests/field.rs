//! Orientation fields on procedural shapes: properties that hold on any mesh.

use roundel::field::{Constraint, FieldProblem, OrientationField, curvature_constraints};
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

const SHAPES: [&str; 8] = [
    "rounded-cube",
    "sphere",
    "torus",
    "genus-2",
    "genus-3",
    "gear",
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

#[test]
fn indices_are_quarters_that_sum_to_the_euler_characteristic() {
    for name in SHAPES {
        let mesh = shape(name, 1500);
        let constraints = curvature_constraints(&mesh, 0.1).unwrap();
        let (field, _) = field(&mesh, &constraints);
        let indices = field.vertex_indices(&mesh);
        let boundary = field.boundary_indices(&mesh);
        for (at, index) in indices.iter().chain(&boundary).enumerate() {
            let quarters = 4.0 * index;
            assert!(
                (quarters - quarters.round()).abs() < 4e-9,
                "{name} {at}: {index}"
            );
        }
        for (v, (a, b)) in indices.iter().zip(field.traced_indices(&mesh)).enumerate() {
            assert!((a - b).abs() < 1e-9, "{name}: vertex {v} has {a} or {b}");
        }
        let sum = field.index_sum(&mesh);
        let euler = mesh.euler_characteristic() as f64;
        assert!((sum - euler).abs() < 1e-6, "{name}: {sum}, not {euler}");
    }
}

#[test]
fn the_eight_corners_of_a_rounded_cube_are_irregular() {
    let mesh = shape::by_name("rounded-cube", 10_000).unwrap();
    let constraints = curvature_constraints(&mesh, 0.1).unwrap();
    let (field, _) = field(&mesh, &constraints);
    let indices = field.vertex_indices(&mesh);
    let irregular = field.irregular_vertices(&mesh);
    assert_eq!(irregular.len(), 8);
    for v in irregular {
        assert!((indices[v] - 0.25).abs() < 1e-9);
    }
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
