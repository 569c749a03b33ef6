//! Maps whose features lie on isolines, and the sizes of their quads.

use std::f64::consts::{FRAC_PI_4, PI};

use roundel::field::{
    FieldOptions, FieldProblem, Guidance, OrientationField, PrescribedIndex, feature_constraints,
};
use roundel::map::{SeamlessMap, SeamlessOptions, SeamlessProblem, Sizing};
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::{TriangleMesh, shape};
use roundel::{Options, Solver, solve};

fn features(mesh: &TriangleMesh) -> FeatureGraph {
    let sharp = FeatureGraph::by_angle(mesh, FRAC_PI_4).unwrap();
    sharp.with(mesh, &FeatureGraph::boundary(mesh)).unwrap()
}

fn field(mesh: &TriangleMesh, features: &FeatureGraph) -> OrientationField {
    let options = FieldOptions {
        constraints: feature_constraints(mesh, features).unwrap(),
        ..FieldOptions::default()
    };
    let problem = FieldProblem::with_options(mesh, &options).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    problem.field(mesh, &solution).unwrap()
}

fn map(mesh: &TriangleMesh, problem: &SeamlessProblem) -> SeamlessMap {
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    problem.map(mesh, &solution).unwrap()
}

/// Feature edges of which some face has an end off the integer isoline, by however little.
fn off_isolines(mesh: &TriangleMesh, map: &SeamlessMap, features: &FeatureGraph) -> Vec<usize> {
    let lies = |(face, k): (usize, usize)| {
        let uv = map.uv(face);
        let [a, b] = [uv[k], uv[(k + 1) % 3]];
        (0..2).any(|axis| a[axis] == b[axis] && a[axis].fract() == 0.0)
    };
    let off = |&e: &usize| {
        let edge = mesh.edge(e);
        !lies(edge.first) || !edge.second.is_none_or(lies)
    };
    features.edges().filter(off).collect()
}

#[test]
fn every_feature_edge_lies_exactly_on_an_integer_isoline() {
    for (name, triangles) in [("gear", 4_000), ("plate-with-holes", 2_000), ("plane", 400)] {
        let mesh = shape::by_name(name, triangles).unwrap();
        let mesh = roundel::mesh::jitter(&mesh, 1e-3, 7).unwrap();
        let features = features(&mesh);
        assert!(features.edges().count() > 40, "{name}");
        let field = field(&mesh, &features);
        let sizing = Sizing::Quads(triangles / 4);
        let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &features).unwrap();
        let map = map(&mesh, &problem);
        let off = off_isolines(&mesh, &map, &features);
        assert!(off.is_empty(), "{name}: {off:?}");
        // Without the constraint, hardly any edge lies on an isoline.
        let plain = SeamlessOptions {
            quads: triangles / 4,
        };
        let plain = SeamlessProblem::new(&mesh, &field, &plain).unwrap();
        let plain = self::map(&mesh, &plain);
        let off = off_isolines(&mesh, &plain, &features).len();
        assert!(2 * off > features.edges().count(), "{name}: {off}");
    }
}

#[test]
fn corners_of_features_are_integer_points() {
    let mesh = shape::by_name("gear", 3_000).unwrap();
    let features = features(&mesh);
    let field = field(&mesh, &features);
    let sizing = Sizing::EdgeLength(0.1);
    let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &features).unwrap();
    let map = map(&mesh, &problem);
    assert!(features.corners().len() >= 48);
    for &corner in features.corners() {
        for (face, k) in mesh.ring(corner) {
            let [u, v] = map.uv(face)[k];
            assert!(u.fract() == 0.0 && v.fract() == 0.0, "{corner}: {u}, {v}");
        }
    }
}

/// The length of the gradients of u and v in a face.
fn gradients(mesh: &TriangleMesh, map: &SeamlessMap, face: usize) -> [f64; 2] {
    let uv = map.uv(face);
    let frame = mesh.frame(face);
    let p = mesh.corner_positions(face);
    let flat = |k: usize| {
        let d: [f64; 3] = [0, 1, 2].map(|i| p[k][i] - p[0][i]);
        frame.map(|axis| (0..3).map(|i| axis[i] * d[i]).sum::<f64>())
    };
    let ([a, b], [c, d]) = (flat(1), flat(2));
    let det = a * d - b * c;
    [0, 1].map(|axis| {
        let (x, y) = (uv[1][axis] - uv[0][axis], uv[2][axis] - uv[0][axis]);
        ((d * x - b * y) / det).hypot((a * y - c * x) / det)
    })
}

#[test]
fn an_edge_length_is_the_reciprocal_of_the_gradients() {
    let mesh = shape::by_name("plane", 300).unwrap();
    let none = FeatureGraph::none(&mesh);
    let field = field(&mesh, &FeatureGraph::boundary(&mesh));
    for sizes in [[0.125, 0.125], [0.1, 0.3]] {
        // Turn the pairs so that u and v mean the same directions of space in every face.
        let turned = (0..mesh.face_count()).map(|face| {
            let d = field.direction(&mesh, face);
            if d[0].abs() > d[1].abs() {
                sizes
            } else {
                [sizes[1], sizes[0]]
            }
        });
        let sizing = Sizing::Lengths(turned.collect());
        let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &none).unwrap();
        let map = map(&mesh, &problem);
        assert!(map.energy() < 1e-16, "{:e}", map.energy());
        for face in 0..mesh.face_count() {
            let mut found = gradients(&mesh, &map, face);
            found.sort_by(f64::total_cmp);
            let mut expected = sizes.map(|s| 1.0 / s);
            expected.sort_by(f64::total_cmp);
            for (a, b) in found.into_iter().zip(expected) {
                assert!((a - b).abs() < 1e-7 * b, "{found:?} {expected:?}");
            }
        }
        if sizes[0] == sizes[1] {
            let sizing = Sizing::EdgeLength(sizes[0]);
            let same = SeamlessProblem::with_features(&mesh, &field, &sizing, &none).unwrap();
            assert_eq!(self::map(&mesh, &same).corner_uvs(), map.corner_uvs());
        }
    }
}

#[test]
fn quads_follow_a_graded_size_from_end_to_end() {
    let mesh = shape::by_name("plane", 3_000).unwrap();
    let [low, high] = mesh.bounding_box();
    let graph = FeatureGraph::boundary(&mesh);
    let field = field(&mesh, &graph);
    let size = |x: f64| 0.05 * (1.0 + 2.0 * (x - low[0]) / (high[0] - low[0]));
    let lengths = (0..mesh.face_count()).map(|f| {
        let along = size(mesh.face_centroid(f)[0]);
        // Graded along x alone, which needs no cone.
        let d = field.direction(&mesh, f);
        if d[0].abs() > d[1].abs() {
            [along, 0.1]
        } else {
            [0.1, along]
        }
    });
    let sizing = Sizing::Lengths(lengths.collect());
    let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &graph).unwrap();
    let map = map(&mesh, &problem);
    assert!(off_isolines(&mesh, &map, &graph).is_empty());
    let mut worst: f64 = 1.0;
    for face in 0..mesh.face_count() {
        let along = 1.0 / size(mesh.face_centroid(face)[0]);
        let nearest = gradients(&mesh, &map, face).map(|g| (g / along).max(along / g));
        worst = worst.max(nearest[0].min(nearest[1]));
    }
    // The outline has about twelve quads or more, and is rounded to whole quads by at most half of one.
    assert!(worst < 1.15, "{worst}");
}

#[test]
fn solving_again_for_another_density_gives_the_result_of_a_first_solve() {
    let mesh = shape::by_name("gear", 2_000).unwrap();
    let features = features(&mesh);
    let field = field(&mesh, &features);
    let make =
        |sizing: &Sizing| SeamlessProblem::with_features(&mesh, &field, sizing, &features).unwrap();
    let mut problem = make(&Sizing::Quads(300));
    let mut solver = Solver::new(problem.problem()).unwrap();
    solver.solve(&Options::default()).unwrap();
    for sizing in [Sizing::Quads(900), Sizing::EdgeLength(0.07)] {
        problem.resize(&mesh, &sizing, &mut solver).unwrap();
        let again = solver.solve(&Options::default()).unwrap();
        let fresh = make(&sizing);
        let first = solve(fresh.problem(), &Options::default()).unwrap();
        assert_eq!(again.values(), first.values());
        assert!((again.energy() - first.energy()).abs() <= 1e-9 * first.energy());
        let [a, b] = [(&problem, &again), (&fresh, &first)].map(|(p, s)| p.map(&mesh, s).unwrap());
        assert_eq!(a, b);
    }
    let other = shape::by_name("gear", 3_000).unwrap();
    let error = problem.resize(&other, &Sizing::Quads(9), &mut solver);
    assert_eq!(error.unwrap_err().code(), "length_mismatch");
}

#[test]
fn invalid_sizes_and_features_are_refused() {
    let [mesh, other] = [300, 500].map(|n| shape::by_name("torus", n).unwrap());
    let none = FeatureGraph::none(&mesh);
    let field = field(&mesh, &none);
    let refused = |sizing: Sizing| {
        let error = SeamlessProblem::with_features(&mesh, &field, &sizing, &none).unwrap_err();
        (error.code(), error.index())
    };
    assert_eq!(refused(Sizing::Quads(0)), ("invalid_argument", None));
    for length in [0.0, -1.0] {
        assert_eq!(
            refused(Sizing::EdgeLength(length)),
            ("invalid_argument", None)
        );
    }
    for length in [f64::NAN, f64::INFINITY, 1e-320] {
        assert_eq!(refused(Sizing::EdgeLength(length)).0, "not_finite");
    }
    assert_eq!(
        refused(Sizing::Lengths(vec![[1.0; 2]; 3])).0,
        "length_mismatch"
    );
    let mut lengths = vec![[0.1; 2]; mesh.face_count()];
    lengths[5] = [0.1, 0.0];
    assert_eq!(
        refused(Sizing::Lengths(lengths)),
        ("invalid_argument", Some(5))
    );
    let foreign = FeatureGraph::none(&other);
    let sizing = Sizing::Quads(10);
    let error = SeamlessProblem::with_features(&mesh, &field, &sizing, &foreign).unwrap_err();
    assert_eq!(error.code(), "length_mismatch");
    let six = FieldOptions {
        symmetry: 6,
        ..FieldOptions::default()
    };
    let problem = FieldProblem::with_options(&mesh, &six).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let six = problem.field(&mesh, &solution).unwrap();
    let error = SeamlessProblem::with_features(&mesh, &six, &sizing, &none).unwrap_err();
    assert_eq!(error.code(), "invalid_argument");
    assert!(FeatureGraph::by_angle(&mesh, PI).is_ok());
}

/// The surface of a cube of `n` by `n` squares a side, with two triangles each.
fn cube(n: i32) -> TriangleMesh {
    let mut number = std::collections::BTreeMap::new();
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let mut vertex = |p: [i32; 3]| {
        *number.entry(p).or_insert_with(|| {
            vertices.push(p.map(f64::from));
            vertices.len() as u32 - 1
        })
    };
    for axis in 0..3 {
        for (side, end) in [(0, 0), (1, n)] {
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let mut corner = |a: i32, b: i32| {
                    let mut p = [0; 3];
                    p[axis] = end;
                    p[(axis + 1 + side) % 3] = i + a;
                    p[(axis + 2 - side) % 3] = j + b;
                    vertex(p)
                };
                let [a, b, c, d] = [corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    TriangleMesh::new(vertices, triangles).unwrap()
}

#[test]
fn a_layout_of_given_cones_and_separatrices_is_followed() {
    const N: i32 = 8;
    let mesh = cube(N);
    let is_end = |x: f64| x == 0.0 || x == f64::from(N);
    let ends = |v: usize| mesh.position(v).into_iter().filter(|&x| is_end(x)).count();
    let corners = (0..mesh.vertex_count()).filter(|&v| ends(v) == 3);
    let indices: Vec<_> = corners
        .map(|vertex| PrescribedIndex { vertex, steps: 1 })
        .collect();
    assert_eq!(indices.len(), 8);
    let sharp = FeatureGraph::by_angle(&mesh, FRAC_PI_4).unwrap();
    let separatrices: Vec<usize> = sharp.edges().collect();
    assert_eq!(separatrices.len(), 12 * N as usize);
    let guidance = Guidance {
        indices: Some(indices.clone()),
        feature_edges: separatrices,
        ..Guidance::default()
    };
    let features = guidance.features(&mesh).unwrap();
    let options = guidance.field_options(&mesh, &features).unwrap();
    let problem = FieldProblem::with_options(&mesh, &options).unwrap();
    let solution = solve(problem.problem(), &Options::default()).unwrap();
    let field = problem.field(&mesh, &solution).unwrap();
    let given: Vec<usize> = indices.iter().map(|i| i.vertex).collect();
    assert_eq!(field.irregular_vertices(&mesh), given);
    // An edge of 3.2 quads gets 3: six sides times nine.
    let sizing = Sizing::EdgeLength(f64::from(N) / 3.2);
    let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &features).unwrap();
    let map = map(&mesh, &problem);
    assert!(off_isolines(&mesh, &map, &features).is_empty());
    assert!(map.flipped().is_empty());
    let doubled =
        |[a, b, c]: [[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let area: f64 = map.corner_uvs().into_iter().map(doubled).sum();
    assert!((area / 2.0 - 54.0).abs() < 1e-9, "{area}");
}
