//! Irregular vertices keep away from features: by distances in closed form on flat shapes.

use roundel::field::{FieldOptions, Guidance, near_features, solve_field};
use roundel::map::Sizing;
use roundel::mesh::TriangleMesh;
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::shape::by_name;
use roundel::quad::{QuadOptions, quadrangulate};
use roundel::{Error, Monitor, Options};

/// A flat strip from x = 0 to `length` and y = 0 to 1, of squares cut in two.
fn strip(length: u32, across: u32) -> TriangleMesh {
    let columns = length * across;
    let at = |i: u32, j: u32| i * (across + 1) + j;
    let step = f64::from(across).recip();
    let points = (0..=columns)
        .flat_map(|i| (0..=across).map(move |j| [f64::from(i) * step, f64::from(j) * step, 0.0]));
    let triangles = (0..columns).flat_map(|i| {
        (0..across).flat_map(move |j| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
    });
    TriangleMesh::new(points.collect(), triangles.collect()).unwrap()
}

fn near_boundary(mesh: &TriangleMesh, length: f64) -> Vec<usize> {
    let features = FeatureGraph::boundary(mesh);
    let lengths = vec![length; mesh.vertex_count()];
    near_features(mesh, &features, &lengths, &Monitor::default()).unwrap()
}

#[test]
fn vertices_are_near_by_distance_however_fine_the_triangles_are() {
    for across in [10, 40] {
        let mesh = strip(2, across);
        // Strictly between the rows of both meshes.
        let near = near_boundary(&mesh, 0.26);
        let expected = |v: &usize| {
            let [x, y, _] = mesh.position(*v);
            let distance = x.min(2.0 - x).min(y).min(1.0 - y);
            distance > 1e-9 && distance < 0.26
        };
        let all: Vec<usize> = (0..mesh.vertex_count()).filter(expected).collect();
        assert_eq!(near, all, "{across}");
    }
}

#[test]
fn in_a_gap_of_less_than_two_lengths_the_middle_is_far_enough() {
    let mesh = strip(8, 20);
    let near = near_boundary(&mesh, 2.0);
    let in_middle = |v: usize| {
        let [x, y, _] = mesh.position(v);
        (x.min(8.0 - x) > 1.0).then_some(y.min(1.0 - y))
    };
    for v in 0..mesh.vertex_count() {
        let Some(distance) = in_middle(v) else {
            continue;
        };
        let expected = distance > 1e-9 && distance < 0.375 - 1e-9;
        assert_eq!(near.binary_search(&v).is_ok(), expected, "{distance}");
    }
}

/// The irregular vertices of a field in a disk of radius 1: their distances from its boundary, and the sum of
/// their quarter turns.
fn irregular(mesh: &TriangleMesh, options: &FieldOptions) -> (Vec<f64>, i32) {
    let (field, _) = solve_field(mesh, options, &Options::default(), Monitor::default).unwrap();
    let steps = field.vertex_index_steps(mesh);
    let irregular = (0..steps.len()).filter(|&v| steps[v] != 0);
    let distance = |v: usize| {
        let [x, y, _] = mesh.position(v);
        1.0 - x.hypot(y)
    };
    (irregular.map(distance).collect(), steps.iter().sum())
}

#[test]
fn irregular_vertices_of_a_disk_keep_their_distance_from_its_boundary() {
    let mesh = by_name("disk", 3_000).unwrap();
    let features = FeatureGraph::boundary(&mesh);
    let of = |clearance: f64| {
        let guidance = Guidance {
            clearance: Some(clearance),
            ..Guidance::default()
        };
        guidance.field_options(&mesh, &features).unwrap()
    };
    let (free, quarters) = irregular(&mesh, &of(0.0));
    assert_eq!((free.len(), quarters), (4, 4));
    assert!(free.iter().all(|&d| d < 0.6), "{free:?}");
    let boundary = |v: &usize| mesh.is_boundary_vertex(*v);
    let kept = FieldOptions {
        kept_turns: (0..mesh.vertex_count()).filter(boundary).collect(),
        ..of(0.7)
    };
    let (kept, quarters) = irregular(&mesh, &kept);
    assert_eq!(quarters, 4);
    // The boundary is a polygon inside the circle.
    assert!(
        !kept.is_empty() && kept.iter().all(|&d| d > 0.7),
        "{kept:?}"
    );
    // Where the boundary may take them, none is nearer either.
    let (moved, _) = irregular(&mesh, &of(0.7));
    assert!(moved.iter().all(|&d| d > 0.7), "{moved:?}");
}

#[test]
fn quads_without_features_inside_the_surface_are_those_without_clearance() {
    let mesh = by_name("plate-with-holes", 600).unwrap();
    let quads = |clearance: Option<f64>| {
        let mut options = QuadOptions {
            sizing: Sizing::Quads(150),
            ..QuadOptions::default()
        };
        options.guidance.clearance = clearance;
        let made = quadrangulate(&mesh, &options, Monitor::default).unwrap();
        (made.quads, made.near_features)
    };
    assert_eq!(quads(None), quads(Some(0.0)));
}

#[test]
fn lengths_and_vertices_that_cannot_be_are_refused() {
    let mesh = by_name("disk", 200).unwrap();
    let features = FeatureGraph::boundary(&mesh);
    let count = mesh.vertex_count();
    let refused = |lengths: Vec<f64>| {
        let error = near_features(&mesh, &features, &lengths, &Monitor::default()).unwrap_err();
        (error.code(), error.index())
    };
    let with = |length: f64| {
        let mut lengths = vec![1.0; count];
        lengths[3] = length;
        lengths
    };
    assert_eq!(refused(with(f64::NAN)), ("not_finite", Some(3)));
    assert_eq!(refused(with(0.0)), ("invalid_argument", Some(3)));
    assert_eq!(refused(vec![1.0]).0, "length_mismatch");
    for clearance in [-1.0, f64::INFINITY] {
        let guidance = Guidance {
            clearance: Some(clearance),
            ..Guidance::default()
        };
        assert!(guidance.field_options(&mesh, &features).is_err());
    }
    let on_boundary = (0..count).find(|&v| mesh.is_boundary_vertex(v)).unwrap();
    let solved = |regular: Vec<usize>, kept_turns: Vec<usize>| {
        let options = FieldOptions {
            regular,
            kept_turns,
            ..FieldOptions::default()
        };
        solve_field(&mesh, &options, &Options::default(), Monitor::default).unwrap_err()
    };
    let error = solved(vec![count], Vec::new());
    assert!(matches!(error, Error::IndexOutOfRange { position: 0, .. }));
    let error = solved(Vec::new(), vec![0, count]);
    assert!(matches!(error, Error::IndexOutOfRange { position: 1, .. }));
    let error = solved(vec![on_boundary], Vec::new());
    assert_eq!((error.code(), error.index()), ("invalid_argument", Some(0)));
}

/// A sphere with a needle: all edges at its tip are sharp.
fn needle(faces: usize, height: f64) -> TriangleMesh {
    let sphere = by_name("sphere", faces).unwrap();
    let moved = |v: usize| match v {
        0 => sphere.position(v).map(|x| (1.0 + height) * x),
        _ => sphere.position(v),
    };
    let vertices = (0..sphere.vertex_count()).map(moved).collect();
    let corners = (0..sphere.face_count()).map(|f| sphere.corners(f).map(|v| v as u32));
    TriangleMesh::new(vertices, corners.collect()).unwrap()
}

#[test]
fn sharp_edges_that_are_shorter_than_quads_are_no_features_of_theirs() {
    let quads = |mesh: &TriangleMesh, count: usize, length: Option<f64>| {
        let mut options = QuadOptions {
            sizing: Sizing::Quads(count),
            ..QuadOptions::default()
        };
        options.guidance.feature_angle = Some(0.5);
        options.guidance.feature_length = length;
        quadrangulate(mesh, &options, Monitor::default).unwrap()
    };
    let mesh = needle(2_000, 0.05);
    let [made, all] = [None, Some(0.0)].map(|length| quads(&mesh, 200, length));
    assert!(made.features.is_empty() && made.quads.is_conforming());
    assert_eq!(made.quads.figures().irregular, 8);
    assert!(!all.features.is_empty());
    // Where the mesh is refined for its quads as well.
    let [made, all] = [1.2, 0.0].map(|length| quads(&needle(320, 0.15), 2_000, Some(length)));
    assert!(made.refined.is_some() && made.quads.is_conforming());
    assert_eq!((made.features.len(), made.feature_length), (0, Some(1.2)));
    assert!(!all.features.is_empty());
}
