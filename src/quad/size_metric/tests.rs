//! Sizes that vary: bounds, gradation, the scale that keeps the number of quads, and bad input.

use super::*;
use crate::mesh::shape::by_name;

fn of(mesh: &TriangleMesh, options: &QuadOptions) -> Result<Option<SizeMetric>> {
    let features = options.guidance.features(mesh)?;
    SizeMetric::new(mesh, options, &features, &Monitor::default())
}

fn sized(quads: usize) -> QuadOptions {
    QuadOptions {
        sizing: Sizing::Quads(quads),
        ..QuadOptions::default()
    }
}

/// The number of squares of these lengths that fit on the surface.
fn count(mesh: &TriangleMesh, lengths: &[f64]) -> f64 {
    let faces = at_faces(mesh, lengths).into_iter().enumerate();
    faces
        .map(|(face, length)| mesh.area(face) / (length * length))
        .sum()
}

/// Ratio of the largest length to the least.
fn spread(lengths: &[f64]) -> f64 {
    let least = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    lengths.iter().copied().fold(0.0, f64::max) / least
}

#[test]
fn without_options_sizes_are_as_given() {
    let mesh = by_name("torus", 800).unwrap();
    assert_eq!(of(&mesh, &sized(300)).unwrap(), None);
}

/// Of a thick torus: on the outer equator the curvatures are 1/r and 1/(R+r), inside 1/r and -1/(R-r).
#[test]
fn lengths_follow_curvature_and_fit_as_many_quads() {
    let mesh = by_name("torus", 20_000).unwrap();
    let found = |adapt: f64| {
        let options = QuadOptions {
            adapt,
            gradation: 100.0,
            ..sized(500)
        };
        of(&mesh, &options).unwrap().unwrap()
    };
    let [half, full] = [0.5, 1.0].map(found);
    for metric in [&half, &full] {
        assert!((count(&mesh, &metric.lengths) / 500.0 - 1.0).abs() < 1e-6);
        assert!(matches!(metric.sizing, Sizing::Graded { quads: 500, .. }));
    }
    assert!((spread(&half.lengths).powi(2) / spread(&full.lengths) - 1.0).abs() < 1e-6);
    let [low, high] = mesh.bounding_box();
    let minor = 0.5 * (high[2] - low[2]);
    let outer = 0.5 * (high[0] - low[0]);
    let curved = 1.0 / minor + 1.0 / outer;
    let inner = (1.0 / minor).max((1.0 / minor - 1.0 / (outer - 2.0 * minor)).abs());
    let expected = (curved / inner).sqrt();
    assert!((spread(&full.lengths) / expected - 1.0).abs() < 0.02);
}

#[test]
fn neighbouring_lengths_keep_to_the_gradation() {
    let mesh = by_name("sphere", 3_000).unwrap();
    let density = (0..mesh.vertex_count()).map(|v| if v % 97 == 0 { 20.0 } else { 1.0 });
    let options = QuadOptions {
        density: density.collect(),
        gradation: 1.3,
        ..sized(400)
    };
    let lengths = of(&mesh, &options).unwrap().unwrap().lengths;
    for face in 0..mesh.face_count() {
        let corners = mesh.corners(face);
        for k in 0..3 {
            let [a, b] = [k, (k + 1) % 3].map(|k| lengths[corners[k]]);
            assert!((a - b).abs() <= 0.3 * mesh.edge_length(face, k) * (1.0 + 1e-12));
        }
    }
    assert!(spread(&lengths) > 2.0);
}

#[test]
fn painted_density_is_the_number_of_edges_a_length() {
    let mesh = by_name("sphere", 3_000).unwrap();
    let density = mesh
        .vertices()
        .iter()
        .map(|p| if p[2] > 0.0 { 2.0 } else { 1.0 });
    let options = QuadOptions {
        density: density.collect(),
        gradation: 1000.0,
        ..sized(400)
    };
    let lengths = of(&mesh, &options).unwrap().unwrap().lengths;
    assert!((spread(&lengths) - 2.0).abs() < 1e-12);
}

#[test]
fn lengths_change_with_the_distance_along_the_surface() {
    let mesh = by_name("sphere", 3_000).unwrap();
    let options = QuadOptions {
        near: Near::Vertices,
        near_vertices: vec![7],
        near_size: 0.25,
        near_distance: Some(1.0),
        gradation: 1000.0,
        ..sized(400)
    };
    let lengths = of(&mesh, &options).unwrap().unwrap().lengths;
    let sources = [Source::Vertex(7)];
    let found = geodesic_distance(
        &mesh,
        &sources,
        &GeodesicOptions::default(),
        &Monitor::default(),
    )
    .unwrap();
    let far = 4.0 * lengths[7];
    for (length, distance) in lengths.iter().zip(found.vertices()) {
        let expected = far * (0.25 + 0.75 * distance.min(1.0));
        assert!((length / expected - 1.0).abs() < 1e-12);
    }
}

#[test]
fn lengths_keep_to_their_bounds_and_a_number_that_these_rule_out_is_given_up() {
    let mesh = by_name("torus", 2_000).unwrap();
    let edge = Sizing::Quads(300).edge_length(&mesh);
    let bounded = |least: f64, largest: f64| {
        let options = QuadOptions {
            adapt: 1.0,
            min_length: Some(least * edge),
            max_length: Some(largest * edge),
            ..sized(300)
        };
        of(&mesh, &options).unwrap().unwrap()
    };
    let met = bounded(0.9, 1.1);
    assert!(
        met.lengths
            .iter()
            .all(|l| (0.9 * edge..=1.1 * edge).contains(l))
    );
    assert!(matches!(met.sizing, Sizing::Graded { .. }));
    let given_up = bounded(0.1, 0.5);
    assert!(given_up.lengths.iter().all(|l| *l <= 0.5 * edge));
    assert!(matches!(given_up.sizing, Sizing::Lengths(_)));
}

#[test]
fn lengths_that_are_given_keep_their_proportions() {
    let mesh = by_name("torus", 800).unwrap();
    let options = QuadOptions {
        sizing: Sizing::Lengths(vec![[0.1, 0.2]; mesh.face_count()]),
        density: vec![2.0; mesh.vertex_count()],
        ..QuadOptions::default()
    };
    let Sizing::Lengths(pairs) = of(&mesh, &options).unwrap().unwrap().sizing else {
        panic!("lengths were given");
    };
    for [along, across] in pairs {
        assert!((along - 0.05).abs() < 1e-12 && (across - 0.1).abs() < 1e-12);
    }
}

#[test]
fn bad_densities_vertices_and_bounds_are_named() {
    let mesh = by_name("torus", 800).unwrap();
    let refused = |change: &dyn Fn(&mut QuadOptions)| {
        let mut options = sized(100);
        change(&mut options);
        let error = of(&mesh, &options).unwrap_err();
        (error.code(), error.index())
    };
    let dense = |v: f64| {
        let mut density = vec![1.0; mesh.vertex_count()];
        density[5] = v;
        refused(&|options| options.density.clone_from(&density))
    };
    assert_eq!(refused(&|o| o.density = vec![1.0; 3]).0, "length_mismatch");
    assert_eq!(dense(0.0), ("invalid_argument", Some(5)));
    assert_eq!(dense(-1.0), ("invalid_argument", Some(5)));
    assert_eq!(dense(f64::NAN), ("not_finite", Some(5)));
    let far = refused(&|options| options.near_vertices = vec![0, 1 << 20]);
    assert_eq!(far, ("index_out_of_range", Some(1)));
    let bounds = refused(&|options| {
        options.min_length = Some(2.0);
        options.max_length = Some(1.0);
    });
    assert_eq!(bounds, ("invalid_argument", None));
}
