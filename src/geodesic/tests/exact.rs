//! Distances from vertices against an exhaustive search.

use super::brute::all_distances;
use crate::geodesic::{GeodesicDistance, GeodesicOptions, Source, geodesic_distance};
use crate::mesh::TriangleMesh;
use crate::monitor::Monitor;

pub(super) fn distances(mesh: &TriangleMesh, sources: &[Source]) -> GeodesicDistance {
    let options = GeodesicOptions {
        everywhere: true,
        ..GeodesicOptions::default()
    };
    geodesic_distance(mesh, sources, &options, &Monitor::default()).unwrap()
}

/// A bumpy sheet of `2 n^2` triangles: heights from a sequence that looks random.
pub(super) fn sheet(n: usize, height: f64, seed: f64) -> TriangleMesh {
    let mut x = seed;
    let mut next = || {
        x = (x * 977.13_f64 + 0.1).fract();
        x - 0.5
    };
    let vertices = (0..(n + 1) * (n + 1)).map(|i| {
        let (u, v) = ((i % (n + 1)) as f64, (i / (n + 1)) as f64);
        [u + 0.3 * next(), v + 0.3 * next(), height * next()]
    });
    let mut triangles = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let a = (j * (n + 1) + i) as u32;
            let (b, c) = (a + 1, a + n as u32 + 1);
            triangles.extend([[a, b, c + 1], [a, c + 1, c]]);
        }
    }
    TriangleMesh::new(vertices.collect(), triangles).unwrap()
}

/// A closed surface of 8 octants that are divided, with radii from a sequence that looks random.
pub(super) fn potato(spread: f64, seed: f64) -> TriangleMesh {
    let mesh = crate::mesh::shape::by_name("sphere", 60).unwrap();
    let mut x = seed;
    let vertices = mesh.vertices().iter().map(|p| {
        x = (x * 977.13_f64 + 0.1).fract();
        p.map(|c| c * (1.0 + spread * (x - 0.5)))
    });
    TriangleMesh::new(vertices.collect(), mesh.triangles().to_vec()).unwrap()
}

fn compare(mesh: &TriangleMesh) -> f64 {
    let exact = all_distances(mesh);
    let mut worst: f64 = 0.0;
    for v in 0..mesh.vertex_count() {
        let found = distances(mesh, &[Source::Vertex(v)]);
        for (w, d) in found.vertices().iter().enumerate() {
            let error = (d - exact[v][w]).abs() / exact[v][w].max(1e-300);
            assert!(error < 1e-12, "{v} to {w}: {d} is not {}", exact[v][w]);
            worst = worst.max(error);
        }
    }
    worst
}

#[test]
fn an_exhaustive_search_finds_the_same_distances() {
    for i in 0..12 {
        compare(&sheet(
            3,
            [0.0, 0.5, 2.0, 8.0][i % 4],
            0.1 + 0.07 * i as f64,
        ));
        compare(&potato([0.1, 0.6, 1.5][i % 3], 0.3 + 0.05 * i as f64));
    }
}
