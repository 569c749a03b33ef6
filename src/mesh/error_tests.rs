//! Every way in which vertices and faces fail to be a mesh, and the element named.

use proptest::collection::vec;
use proptest::prelude::*;

use super::{MeshError, TriangleMesh, jitter, shape};

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn points(count: usize) -> Vec<[f64; 3]> {
    // On a space curve, so that no three are in line.
    let on_curve = |t: f64| [t, t * t, t * t * t];
    (0..count).map(|i| on_curve(1.0 + i as f64)).collect()
}

fn refused(vertices: Vec<[f64; 3]>, triangles: &[[u32; 3]]) -> MeshError {
    let error = TriangleMesh::new(vertices, triangles.to_vec()).expect_err("not a mesh");
    assert!(!error.to_string().is_empty());
    assert_eq!(error.line(), None);
    error
}

#[test]
fn nothing_is_not_a_mesh() {
    let error = refused(points(3), &[]);
    assert_eq!(
        (&error, error.code(), error.index()),
        (&MeshError::NoFaces, "no_faces", None)
    );
}

#[test]
fn coordinates_must_be_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut vertices = points(4);
        vertices[2][1] = bad;
        let error = refused(vertices, &TETRAHEDRON);
        assert_eq!(error, MeshError::NotFinite { vertex: 2 });
        assert_eq!(
            (error.code(), error.index()),
            ("vertex_not_finite", Some(2))
        );
    }
}

#[test]
fn a_vertex_number_must_be_of_a_vertex() {
    let error = refused(points(4), &[[0, 1, 2], [1, 4, 3]]);
    let expected = MeshError::IndexOutOfRange {
        face: 1,
        vertex: 4,
        vertices: 4,
    };
    assert_eq!(error, expected);
    assert_eq!(
        (error.code(), error.index()),
        ("vertex_out_of_range", Some(1))
    );
}

#[test]
fn a_face_visits_a_vertex_once() {
    for twice in [[1, 1, 2], [1, 2, 1], [2, 1, 1]] {
        let error = refused(points(3), &[[0, 1, 2], twice]);
        assert_eq!(error, MeshError::RepeatedVertex { face: 1, vertex: 1 });
        assert_eq!((error.code(), error.index()), ("repeated_vertex", Some(1)));
    }
}

#[test]
fn a_face_has_an_area_at_any_scale_and_a_needle_is_one() {
    for scale in [1e-200, 1.0, 1e200] {
        let triangle = |height: f64| {
            vec![
                [0.0; 3],
                [scale, 0.0, 0.0],
                [0.5 * scale, height * scale, 0.0],
            ]
        };
        let error = refused(triangle(1e-15), &[[0, 1, 2]]);
        assert_eq!(error, MeshError::ZeroArea { face: 0 });
        assert_eq!((error.code(), error.index()), ("zero_area", Some(0)));
        assert!(TriangleMesh::new(triangle(1e-12), vec![[0, 1, 2]]).is_ok());
    }
    assert_eq!(refused(vec![[1.0; 3]; 3], &[[0, 1, 2]]).code(), "zero_area");
}

#[test]
fn an_edge_has_at_most_two_faces() {
    let error = refused(points(5), &[[2, 3, 4], [0, 1, 2], [1, 0, 3], [0, 1, 4]]);
    let expected = MeshError::NonManifoldEdge {
        vertices: [0, 1],
        faces: vec![1, 2, 3],
    };
    assert_eq!(error, expected);
    assert_eq!(
        (error.code(), error.index()),
        ("non_manifold_edge", Some(1))
    );
    assert!(error.to_string().contains("0-1"));
}

#[test]
fn neighbors_are_oriented_alike() {
    let mut faces = TETRAHEDRON;
    faces[3].swap(0, 1);
    let error = refused(points(4), &faces);
    let expected = MeshError::InconsistentOrientation {
        vertices: [0, 2],
        faces: [0, 3],
    };
    assert_eq!(error, expected);
    assert_eq!(
        (error.code(), error.index()),
        ("inconsistent_orientation", Some(0))
    );
}

#[test]
fn a_crowded_edge_is_named_before_a_misoriented_one() {
    let error = refused(
        points(6),
        &[[0, 1, 2], [0, 1, 3], [3, 4, 5], [4, 3, 0], [3, 4, 2]],
    );
    assert_eq!(error.code(), "non_manifold_edge");
}

#[test]
fn every_vertex_belongs_to_a_face() {
    let error = refused(points(6), &TETRAHEDRON);
    assert_eq!(error, MeshError::IsolatedVertex { vertex: 4 });
    assert_eq!((error.code(), error.index()), ("isolated_vertex", Some(4)));
}

#[test]
fn the_faces_of_a_vertex_form_one_fan() {
    let open = refused(points(5), &[[0, 1, 2], [2, 3, 4]]);
    assert_eq!(open, MeshError::NonManifoldVertex { vertex: 2 });
    assert_eq!(
        (open.code(), open.index()),
        ("non_manifold_vertex", Some(2))
    );
    let mut closed = TETRAHEDRON.to_vec();
    closed.extend(TETRAHEDRON.map(|t| t.map(|v| v + 3)));
    let error = refused(points(7), &closed);
    assert_eq!(error, MeshError::NonManifoldVertex { vertex: 3 });
    let mut mixed = TETRAHEDRON.to_vec();
    mixed.push([3, 4, 5]);
    let error = refused(points(6), &mixed);
    assert_eq!(error, MeshError::NonManifoldVertex { vertex: 3 });
}

#[test]
fn jitter_takes_finite_amplitudes_from_zero() {
    let mesh = shape::by_name("sphere", 100).expect("a shape");
    for amplitude in [-1.0, f64::NAN, f64::INFINITY] {
        let error = jitter(&mesh, amplitude, 0).expect_err("not an amplitude");
        assert_eq!((error.code(), error.index()), ("invalid_argument", None));
    }
    assert_eq!(
        jitter(&mesh, 0.0, 0).expect("unmoved").vertices(),
        mesh.vertices()
    );
}

/// What is wrong by definition, in the documented order, found by looking at all pairs of faces.
fn fault(faces: &[[u32; 3]], vertices: u32) -> Option<&'static str> {
    if faces.iter().any(|&[a, b, c]| a == b || b == c || c == a) {
        return Some("repeated_vertex");
    }
    let directed = |a: u32, b: u32| {
        let runs = |f: &&[u32; 3]| (0..3).any(|k| f[k] == a && f[(k + 1) % 3] == b);
        faces.iter().filter(runs).count()
    };
    let pairs = || (0..vertices).flat_map(|a| (0..vertices).map(move |b| (a, b)));
    if pairs().any(|(a, b)| directed(a, b) + directed(b, a) > 2) {
        return Some("non_manifold_edge");
    }
    if pairs().any(|(a, b)| directed(a, b) > 1) {
        return Some("inconsistent_orientation");
    }
    if (0..vertices).any(|v| !faces.as_flattened().contains(&v)) {
        return Some("isolated_vertex");
    }
    let one_fan = |v: u32| {
        let around: Vec<_> = faces.iter().filter(|f| f.contains(&v)).collect();
        let mut reached = vec![around[0]];
        while let Some(more) = around.iter().find(|f| {
            let adjacent = |g: &&&[u32; 3]| g.iter().filter(|&&w| w != v && f.contains(&w)).count();
            !reached.iter().any(|g| std::ptr::eq(*g, **f))
                && reached.iter().any(|g| adjacent(&g) > 0)
        }) {
            reached.push(more);
        }
        reached.len() == around.len()
    };
    (!(0..vertices).all(one_fan)).then_some("non_manifold_vertex")
}

proptest! {
    #[test]
    fn faces_are_a_mesh_exactly_when_the_definition_says_so(
        faces in vec([0..5u32, 0..5u32, 0..5u32], 1..7),
    ) {
        let found = TriangleMesh::new(points(5), faces.clone()).err();
        prop_assert_eq!(found.map(|e| e.code()), fault(&faces, 5));
    }

    #[test]
    fn a_tetrahedron_with_faces_taken_away_or_turned_is_judged_by_the_definition(
        keep in vec(0..3u8, 4..=4),
    ) {
        let faces: Vec<_> = std::iter::zip(TETRAHEDRON, keep)
            .filter(|(_, keep)| *keep > 0)
            .map(|([a, b, c], keep)| if keep == 1 { [a, b, c] } else { [a, c, b] })
            .collect();
        prop_assume!(!faces.is_empty());
        let found = TriangleMesh::new(points(4), faces.clone()).err();
        prop_assert_eq!(found.map(|e| e.code()), fault(&faces, 4));
    }
}
