//! Fields of every symmetry that follow features, curvature and prescribed indices.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use roundel::field::{
    FieldOptions, FieldProblem, Guidance, OrientationField, PrescribedIndex, curvature_constraints,
    curvature_guides, feature_constraints,
};
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::{TriangleMesh, shape};
use roundel::{Options, Solution, solve};

fn noisy(name: &str, triangles: usize) -> TriangleMesh {
    let mesh = shape::by_name(name, triangles).unwrap();
    roundel::mesh::jitter(&mesh, 1e-3, 7).unwrap()
}

fn field(mesh: &TriangleMesh, options: &FieldOptions) -> (OrientationField, Solution) {
    let problem = FieldProblem::with_options(mesh, options).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    (problem.field(mesh, &solution).unwrap(), solution)
}

fn features(mesh: &TriangleMesh) -> FeatureGraph {
    let sharp = FeatureGraph::by_angle(mesh, FRAC_PI_4).unwrap();
    sharp.with(mesh, &FeatureGraph::boundary(mesh)).unwrap()
}

/// The angle between local edge `k` of a face and the nearest arm of its field.
fn off_edge(mesh: &TriangleMesh, field: &OrientationField, face: usize, k: usize) -> f64 {
    let arm = field.direction(mesh, face);
    let p = mesh.corner_positions(face);
    let edge: [f64; 3] = [0, 1, 2].map(|i| p[(k + 1) % 3][i] - p[k][i]);
    let length = edge.iter().map(|x| x * x).sum::<f64>().sqrt();
    let cos = (0..3).map(|i| arm[i] * edge[i]).sum::<f64>() / length;
    let angle = cos.clamp(-1.0, 1.0).acos();
    let step = TAU / f64::from(field.symmetry());
    (angle - step * (angle / step).round()).abs()
}

#[test]
fn crosses_beside_a_feature_or_the_boundary_lie_along_it() {
    for name in ["gear", "plane", "plate-with-holes", "disk"] {
        let mesh = noisy(name, 3_000);
        let features = features(&mesh);
        let options = FieldOptions {
            constraints: feature_constraints(&mesh, &features).unwrap(),
            ..FieldOptions::default()
        };
        let (field, _) = field(&mesh, &options);
        let mut followed = 0;
        for face in 0..mesh.face_count() {
            let sides = (0..3).filter(|&k| features.contains(mesh.edge_of(face, k)));
            let sides: Vec<usize> = sides.collect();
            for &k in &sides {
                let off = off_edge(&mesh, &field, face, k);
                match sides.len() {
                    1 => assert!(off < 1e-7, "{name}: face {face} is off by {off}"),
                    _ => assert!(off < FRAC_PI_4, "{name}: face {face} is off by {off}"),
                }
                followed += 1;
            }
        }
        assert!(followed > 100, "{name}: {followed}");
    }
}

/// A fan of thin triangles that fill `angle` around the origin; its rim closes it.
fn wedge(angle: f64, faces: usize) -> TriangleMesh {
    let mut vertices = vec![[0.0; 3]];
    for i in 0..=faces {
        let (sin, cos) = (angle * i as f64 / faces as f64).sin_cos();
        vertices.push([cos, sin, 0.0]);
    }
    let triangle = |i: usize| [0, i as u32 + 1, i as u32 + 2];
    TriangleMesh::new(vertices, (0..faces).map(triangle).collect()).unwrap()
}

#[test]
fn a_wedge_gets_the_nearest_number_of_quads_and_at_least_one() {
    for (degrees, faces, quads) in [(10, 1, 1), (10, 2, 1), (40, 3, 1), (60, 2, 1), (100, 1, 1)] {
        let mesh = wedge(f64::from(degrees).to_radians(), faces);
        // Only the two straight sides are features.
        let lines = [[0, 1], [0, faces + 1]];
        let features = FeatureGraph::from_lines(&mesh, &lines).unwrap();
        let options = FieldOptions {
            constraints: feature_constraints(&mesh, &features).unwrap(),
            ..FieldOptions::default()
        };
        let (field, _) = field(&mesh, &options);
        // Follow the arm nearest to the first side through the fan and count its quarter turns.
        let spin = |face: usize| {
            let d = field.direction(&mesh, face);
            d[1].atan2(d[0])
        };
        let start = spin(0) - FRAC_PI_2 * (spin(0) / FRAC_PI_2).round();
        let mut arm = start;
        for face in 1..faces {
            let e = (0..mesh.edge_count()).find(|&e| {
                let edge = mesh.edge(e);
                edge.second
                    .is_some_and(|(g, _)| [edge.first.0, g] == [face - 1, face])
            });
            let e = e.unwrap();
            let residual = field.angles()[face] - field.angles()[face - 1] - field.kappa()[e];
            arm += residual - FRAC_PI_2 * f64::from(field.period_jumps()[e]);
        }
        let last = f64::from(degrees).to_radians();
        let counted = ((last - arm) / FRAC_PI_2).round();
        assert_eq!(
            counted,
            f64::from(quads),
            "{degrees} degrees, {faces} faces"
        );
    }
}

#[test]
fn a_triangle_with_three_feature_edges_has_one_direction() {
    let mesh = wedge(1.0, 1);
    let features = FeatureGraph::boundary(&mesh);
    let constraints = feature_constraints(&mesh, &features).unwrap();
    assert_eq!(constraints.len(), 1);
}

#[test]
fn indices_are_multiples_of_one_over_n_and_sum_to_the_euler_characteristic() {
    for symmetry in [1, 2, 4, 6] {
        for name in [
            "sphere",
            "torus",
            "genus-2",
            "gear",
            "disk",
            "plate-with-holes",
        ] {
            let mesh = noisy(name, 900);
            let options = FieldOptions {
                symmetry,
                constraints: curvature_constraints(&mesh, 0.02).unwrap(),
                ..FieldOptions::default()
            };
            let (field, solution) = field(&mesh, &options);
            let energy = field.energy(&mesh);
            assert!((energy - solution.energy()).abs() < 1e-9 * energy.max(1.0));
            let vertices = field.vertex_index_steps(&mesh);
            let loops = field.boundary_index_steps(&mesh);
            let turns = [field.vertex_indices(&mesh), field.boundary_indices(&mesh)].concat();
            for (index, steps) in turns.into_iter().zip(vertices.iter().chain(&loops)) {
                assert_eq!(index, f64::from(*steps) / f64::from(symmetry), "{name}");
            }
            assert_eq!(field.traced_index_steps(&mesh), vertices, "{name}");
            let euler = mesh.euler_characteristic() as f64;
            assert_eq!(field.index_sum(&mesh), euler, "{name}, N = {symmetry}");
        }
    }
}

#[test]
fn prescribed_indices_are_reached_exactly() {
    for (name, symmetry) in [("sphere", 4), ("sphere", 1), ("torus", 6), ("genus-2", 2)] {
        let mesh = noisy(name, 2_000);
        let last = mesh.vertex_count() - 1;
        let steps = i32::from(symmetry) * mesh.euler_characteristic() as i32;
        // The whole sum at two vertices, and a pair elsewhere that cancels.
        let given = [(0, steps - 3), (last, 3), (last / 2, 1), (last / 3, -1)];
        let given = given.map(|(vertex, steps)| PrescribedIndex { vertex, steps });
        let options = FieldOptions {
            symmetry,
            indices: Some(given.to_vec()),
            ..FieldOptions::default()
        };
        let (field, solution) = field(&mesh, &options);
        let mut expected = vec![0; mesh.vertex_count()];
        for g in given {
            expected[g.vertex] = g.steps;
        }
        assert_eq!(field.vertex_index_steps(&mesh), expected, "{name}");
        let energy = field.energy(&mesh);
        assert!(
            (energy - solution.energy()).abs() < 1e-8 * energy.max(1.0),
            "{name}"
        );
    }
}

#[test]
fn the_boundary_index_completes_the_prescribed_indices() {
    let mesh = noisy("disk", 800);
    let inner = (0..mesh.vertex_count()).find(|&v| !mesh.is_boundary_vertex(v));
    let vertex = inner.unwrap();
    for steps in [0, 1, -2] {
        let options = FieldOptions {
            indices: Some(vec![PrescribedIndex { vertex, steps }]),
            ..FieldOptions::default()
        };
        let (field, _) = field(&mesh, &options);
        assert_eq!(field.boundary_index_steps(&mesh), [4 - steps]);
        assert_eq!(
            field.irregular_vertices(&mesh).len(),
            usize::from(steps != 0)
        );
    }
}

#[test]
fn impossible_prescribed_indices_are_refused() {
    let mesh = noisy("sphere", 500);
    let refused = |given: &[(usize, i32)]| {
        let given = given
            .iter()
            .map(|&(vertex, steps)| PrescribedIndex { vertex, steps });
        let options = FieldOptions {
            indices: Some(given.collect()),
            ..FieldOptions::default()
        };
        let error = FieldProblem::with_options(&mesh, &options).unwrap_err();
        (error.code(), error.index())
    };
    assert_eq!(refused(&[]), ("invalid_argument", None));
    assert_eq!(refused(&[(0, 7)]), ("invalid_argument", None));
    assert_eq!(
        refused(&[(0, 4), (1, 2), (0, 2)]),
        ("invalid_argument", Some(2))
    );
    let far = mesh.vertex_count();
    assert_eq!(
        refused(&[(0, 8), (far, 0)]),
        ("index_out_of_range", Some(1))
    );
    let disk = noisy("disk", 500);
    let rim = (0..).find(|&v| disk.is_boundary_vertex(v)).unwrap();
    let options = FieldOptions {
        indices: Some(vec![PrescribedIndex {
            vertex: rim,
            steps: 1,
        }]),
        ..FieldOptions::default()
    };
    let error = FieldProblem::with_options(&disk, &options).unwrap_err();
    assert_eq!((error.code(), error.index()), ("invalid_argument", Some(0)));
}

#[test]
fn guides_act_by_their_weight_and_their_part_of_the_energy_is_reported() {
    let mesh = noisy("torus", 1_200);
    let mut last = f64::INFINITY;
    for weight in [0.01, 1.0, 100.0] {
        let options = FieldOptions {
            guides: curvature_guides(&mesh, weight).unwrap(),
            ..FieldOptions::default()
        };
        let (field, solution) = field(&mesh, &options);
        let (smooth, guided) = (field.energy(&mesh), field.guide_energy(&options.guides));
        let error = (smooth + guided - solution.energy()).abs();
        assert!(error < 1e-9 * solution.energy().max(1.0), "{error:e}");
        let off: f64 = options
            .guides
            .iter()
            .map(|g| (field.angles()[g.face] - g.angle).powi(2))
            .sum();
        assert!(off < last, "weight {weight}: {off}");
        last = off;
    }
}

#[test]
fn the_influence_of_curvature_does_not_depend_on_the_scale_of_the_mesh() {
    let mesh = noisy("gear", 1_000);
    let large = mesh
        .vertices()
        .iter()
        .map(|p| p.map(|x| 1000.0 * x))
        .collect();
    let large = TriangleMesh::new(large, mesh.triangles().to_vec()).unwrap();
    let [small, large] = [&mesh, &large].map(|m| curvature_guides(m, 0.5).unwrap());
    for (a, b) in small.iter().zip(&large) {
        assert!((a.weight - b.weight).abs() < 1e-6 * a.weight.max(1e-6));
    }
    assert!(curvature_guides(&mesh, -1.0).is_err());
    assert!(curvature_guides(&mesh, f64::NAN).is_err());
}

#[test]
fn bad_field_options_are_refused_with_their_position() {
    use roundel::field::Guide;
    let mesh = noisy("torus", 300);
    let refused = |change: &dyn Fn(&mut FieldOptions)| {
        let mut options = FieldOptions::default();
        change(&mut options);
        let error = FieldProblem::with_options(&mesh, &options).unwrap_err();
        (error.code(), error.index())
    };
    for symmetry in [0, 3, 5, 8] {
        let found = refused(&|o| o.symmetry = symmetry);
        assert_eq!(found, ("invalid_argument", None));
    }
    let guides = |list: &[(usize, f64, f64)]| {
        let list = list.iter().map(|&(face, angle, weight)| Guide {
            face,
            angle,
            weight,
        });
        let list: Vec<Guide> = list.collect();
        refused(&|o| o.guides = list.clone())
    };
    let far = mesh.face_count();
    assert_eq!(
        guides(&[(0, 0.0, 1.0), (far, 0.0, 1.0)]),
        ("index_out_of_range", Some(1))
    );
    assert_eq!(guides(&[(0, f64::NAN, 1.0)]), ("not_finite", Some(0)));
    assert_eq!(guides(&[(0, 0.0, f64::INFINITY)]), ("not_finite", Some(0)));
    assert_eq!(
        guides(&[(0, 0.0, 1.0), (1, 0.0, -1.0)]),
        ("invalid_argument", Some(1))
    );
    assert_eq!(
        guides(&[(2, PI, 1.0), (2, PI, 1.0)]),
        ("invalid_argument", Some(1))
    );
}

#[test]
fn given_directions_override_features_and_features_override_curvature() {
    let mesh = noisy("gear", 1_500);
    let sharp = FeatureGraph::by_angle(&mesh, FRAC_PI_4).unwrap();
    let beside = feature_constraints(&mesh, &sharp).unwrap();
    let given = roundel::field::Constraint {
        face: beside[0].face,
        angle: beside[0].angle + 0.3,
    };
    let guidance = Guidance {
        constraints: vec![given],
        constrain_curvature: 1.0,
        curvature_weight: 1.0,
        feature_angle: Some(FRAC_PI_4),
        ..Guidance::default()
    };
    let features = guidance.features(&mesh).unwrap();
    assert_eq!(features, sharp);
    let options = guidance.field_options(&mesh, &features).unwrap();
    let angle = |face: usize| {
        let found = options.constraints.iter().filter(|c| c.face == face);
        let angles: Vec<f64> = found.map(|c| c.angle).collect();
        assert_eq!(angles.len(), 1, "{face}");
        angles[0]
    };
    assert_eq!(angle(given.face), given.angle);
    for c in &beside[1..] {
        assert_eq!(angle(c.face), c.angle);
    }
    let curved = curvature_constraints(&mesh, 1.0).unwrap();
    let plain = curved
        .iter()
        .filter(|c| beside.iter().all(|b| b.face != c.face));
    assert!(plain.clone().count() > 100);
    for c in plain {
        assert_eq!(angle(c.face), c.angle);
    }
    assert_eq!(options.guides.len(), mesh.face_count());
}

#[test]
fn the_boundary_is_followed_unless_it_is_free_or_the_symmetry_is_one() {
    let mesh = noisy("disk", 400);
    let edges = |guidance: &Guidance| guidance.features(&mesh).unwrap().edges().count();
    let rim = FeatureGraph::boundary(&mesh).edges().count();
    let mut guidance = Guidance::default();
    assert_eq!(edges(&guidance), rim);
    guidance.align_boundary = false;
    assert_eq!(edges(&guidance), 0);
    let single = Guidance {
        symmetry: 1,
        ..Guidance::default()
    };
    assert_eq!(edges(&single), 0);
    let sharp = FeatureGraph::boundary(&mesh);
    let error = single.field_options(&mesh, &sharp).unwrap_err();
    assert_eq!(error.code(), "invalid_argument");
    for symmetry in [2, 6] {
        let guidance = Guidance {
            symmetry,
            ..Guidance::default()
        };
        let features = guidance.features(&mesh).unwrap();
        let options = guidance.field_options(&mesh, &features).unwrap();
        let (field, _) = field(&mesh, &options);
        for e in features.edges() {
            let (face, k) = mesh.edge(e).first;
            assert!(off_edge(&mesh, &field, face, k) < 1e-7, "{symmetry}: {e}");
        }
    }
}

#[test]
fn a_guidance_file_is_read_and_its_bad_lines_are_named() {
    let mesh = shape::by_name("plane", 50).unwrap();
    let [a, b, c] = mesh.corners(0);
    let mut guidance = Guidance::default();
    let text = format!(
        "# guidance\n\ndirection 3 1 1 0\ndirection 4 0 2 0 0.5 # soft\nedge {a} {b}\nindex {c} -1\n"
    );
    guidance.parse(&mesh, &text).unwrap();
    assert_eq!(
        (guidance.constraints[0].face, guidance.guides[0].face),
        (3, 4)
    );
    assert_eq!(guidance.guides[0].weight, 0.5);
    assert_eq!(guidance.feature_lines, [[a, b]]);
    let given = PrescribedIndex {
        vertex: c,
        steps: -1,
    };
    assert_eq!(guidance.indices, Some(vec![given]));
    let before = guidance.clone();
    let (faces, vertices) = (mesh.face_count(), mesh.vertex_count());
    for wrong in [
        "direction 3 1 1".into(),
        "direction 3 1 1 nan".into(),
        "direction 3 0 0 1".into(),
        "direction 3 1 0 0 -1".into(),
        format!("direction {faces} 1 0 0"),
        format!("edge 0 {}", vertices - 1),
        format!("edge 0 {vertices}"),
        "index 0 1/4".into(),
        "corner 3".into(),
    ] {
        let error = guidance.parse(&mesh, &format!("edge {a} {b}\n{wrong}\n"));
        let error = error.unwrap_err();
        assert_eq!((error.code(), error.line()), ("parse", Some(2)), "{wrong}");
        assert_eq!(guidance, before, "{wrong}");
    }
}
