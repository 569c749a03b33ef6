//! Quads of meshes that are manifold and oriented, and odd in every other way: a lone triangle, fans of the
//! boundary alone, slivers, parts smaller than a quad.

use roundel::Monitor;
use roundel::map::Sizing;
use roundel::mesh::TriangleMesh;
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate};

fn quads(mesh: &TriangleMesh, count: usize, refine: bool) -> Quadrangulation {
    let options = QuadOptions {
        sizing: Sizing::Quads(count),
        refine,
        ..QuadOptions::default()
    };
    quadrangulate(mesh, &options, Monitor::default).unwrap()
}

/// A conforming mesh of about as many quads as were wanted.
fn hold(mesh: &TriangleMesh, count: usize) {
    let made = quads(mesh, count, true);
    let found = made.quads.quads.len();
    assert!(made.quads.is_conforming(), "{:?}", made.quads.figures());
    assert!((count / 2..=2 * count).contains(&found), "{found}");
}

fn mesh(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
    TriangleMesh::new(points.to_vec(), triangles.to_vec()).unwrap()
}

fn lone_triangle() -> TriangleMesh {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.8, 0.0]];
    mesh(&points, &[[0, 1, 2]])
}

#[test]
fn a_lone_triangle_is_a_surface() {
    hold(&lone_triangle(), 300);
    assert!(!quads(&lone_triangle(), 300, false).quads.quads.is_empty());
}

#[test]
fn a_strip_of_triangles_is_a_surface() {
    let points: Vec<[f64; 3]> = (0..10)
        .map(|k| [f64::from(k), f64::from(k % 2), 0.0])
        .collect();
    let strip = |k: u32| match k % 2 {
        0 => [k, k + 2, k + 1],
        _ => [k, k + 1, k + 2],
    };
    let triangles: Vec<[u32; 3]> = (0..8).map(strip).collect();
    hold(&mesh(&points, &triangles), 300);
}

#[test]
fn a_disk_without_inner_vertices_has_quads() {
    // A fan from the first vertex of a circle.
    let at = |k: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos();
        [cos, sin, 0.0]
    };
    let points: Vec<[f64; 3]> = (0..24).map(at).collect();
    let triangles: Vec<[u32; 3]> = (1..23).map(|k| [0, k, k + 1]).collect();
    hold(&mesh(&points, &triangles), 300);
}

/// A tetrahedron of this width and of length 1.
fn rod(width: f64) -> TriangleMesh {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.5, width, 0.0],
        [0.5, 0.0, width],
    ];
    mesh(&points, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
}

#[test]
fn a_tetrahedron_of_slivers_has_quads() {
    assert!(quads(&rod(0.02), 12, true).quads.is_conforming());
}

#[test]
fn a_rod_far_thinner_than_its_quads_is_an_error_that_says_so() {
    let options = QuadOptions {
        sizing: Sizing::Quads(12),
        ..QuadOptions::default()
    };
    let error = quadrangulate(&rod(1e-4), &options, Monitor::default).unwrap_err();
    assert!(error.to_string().contains("no quads fit"), "{error}");
}

#[test]
fn triangles_smaller_than_a_quad_beside_a_square_have_quads_of_their_own() {
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    let at = |i: u32, j: u32| 11 * i + j;
    for i in 0..=10 {
        points.extend((0..=10).map(|j| [f64::from(i), f64::from(j), 0.0]));
    }
    for (i, j) in (0..10).flat_map(|i| (0..10).map(move |j| (i, j))) {
        triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
        triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    for k in 0..3 {
        let x = 12.0 + f64::from(k);
        let first = points.len() as u32;
        points.extend([[x, 0.0, 0.0], [x + 0.3, 0.0, 0.0], [x, 0.3, 0.0]]);
        triangles.push([first, first + 1, first + 2]);
    }
    let made = quads(&mesh(&points, &triangles), 100, true);
    assert!(made.quads.is_conforming(), "{:?}", made.quads.figures());
    assert_eq!(made.quads.figures().euler, 4);
}
