//! What must not change distances: scale, the order of sources, mirroring, the number of threads, refinement.

use super::exact::{distances, potato, sheet};
use crate::geodesic::{GeodesicOptions, Source, SurfacePoint, geodesic_distance};
use crate::mesh::{TriangleMesh, jitter, shape, subdivide};
use crate::monitor::Monitor;

fn meshes() -> Vec<TriangleMesh> {
    vec![
        sheet(8, 3.0, 0.3),
        potato(1.2, 0.6),
        jitter(&shape::by_name("genus-2", 1_200).unwrap(), 0.3, 1).unwrap(),
        shape::by_name("gear", 2_000).unwrap(),
    ]
}

fn sources(mesh: &TriangleMesh) -> Vec<Source> {
    let point = |face: usize, barycentric| SurfacePoint { face, barycentric };
    let face = mesh.face_count() / 2;
    vec![
        Source::Vertex(1),
        Source::Point(point(face, [0.2, 0.5, 0.3])),
        Source::Polyline {
            points: vec![
                point(4, [0.7, 0.2, 0.1]),
                point(4, [0.0, 0.4, 0.6]),
                point(4, [0.3, 0.0, 0.7]),
            ],
            closed: true,
        },
        Source::Edges(vec![9, mesh.edge_count() - 3]),
    ]
}

#[test]
fn a_scale_that_is_a_power_of_two_scales_the_bits() {
    for mesh in meshes() {
        let found = distances(&mesh, &sources(&mesh));
        for factor in [2f64.powi(-40), 2f64.powi(40), 4.0] {
            let vertices = mesh.vertices().iter().map(|p| p.map(|x| factor * x));
            let scaled = TriangleMesh::new(vertices.collect(), mesh.triangles().to_vec()).unwrap();
            let other = distances(&scaled, &sources(&mesh));
            let expected: Vec<f64> = found.vertices().iter().map(|d| factor * d).collect();
            assert_eq!(other.vertices(), expected);
        }
    }
}

#[test]
fn the_order_of_sources_and_sources_given_twice_change_no_bit() {
    for mesh in meshes() {
        let mut sources = sources(&mesh);
        let found = distances(&mesh, &sources);
        sources.reverse();
        if let Source::Polyline { points, .. } = &mut sources[1] {
            points.reverse();
        }
        sources.push(Source::Vertex(1));
        let other = distances(&mesh, &sources);
        assert_eq!(found.vertices(), other.vertices());
        let count = sources.len() - 2;
        for (a, b) in found.nearest_sources().iter().zip(other.nearest_sources()) {
            assert_eq!(a.unwrap(), count - b.unwrap());
        }
    }
}

#[test]
fn a_mirror_image_has_the_same_distances() {
    for mesh in meshes() {
        let vertices = mesh.vertices().iter().map(|&[x, y, z]| [-x, y, z]);
        let triangles = mesh.triangles().iter().map(|&[a, b, c]| [a, c, b]);
        let mirrored = TriangleMesh::new(vertices.collect(), triangles.collect()).unwrap();
        let found = distances(&mesh, &[Source::Vertex(5)]);
        let other = distances(&mirrored, &[Source::Vertex(5)]);
        for (a, b) in found.vertices().iter().zip(other.vertices()) {
            assert!((a - b).abs() <= 1e-13 * a, "{a} and {b}");
        }
    }
}

#[test]
fn the_numbering_of_the_mesh_does_not_matter() {
    for mesh in meshes() {
        let count = mesh.vertex_count();
        let renumber = |v: u32| (v as usize * 7919 % count) as u32;
        assert_ne!(count % 7919, 0);
        let mut vertices = vec![[0.0; 3]; count];
        (0..count).for_each(|v| vertices[renumber(v as u32) as usize] = mesh.position(v));
        let triangles = mesh
            .triangles()
            .iter()
            .rev()
            .map(|t| [t[1], t[2], t[0]].map(renumber));
        let other = TriangleMesh::new(vertices, triangles.collect()).unwrap();
        let found = distances(&mesh, &[Source::Vertex(5)]);
        let others = distances(&other, &[Source::Vertex(renumber(5) as usize)]);
        for (v, a) in found.vertices().iter().enumerate() {
            let b = others.vertices()[renumber(v as u32) as usize];
            assert!((a - b).abs() <= 1e-13 * a, "{a} and {b}");
        }
    }
}

/// Halving all edges leaves the surface what it is. Paths along the edges are never shorter.
#[test]
fn refinement_changes_nothing_and_paths_along_edges_are_longer() {
    for mesh in meshes() {
        let found = distances(&mesh, &[Source::Vertex(5)]);
        let fine = subdivide(&subdivide(&mesh).unwrap()).unwrap();
        let finer = distances(&fine, &[Source::Vertex(5)]);
        let along_edges = dijkstra(&fine, 5);
        let mut closest = f64::INFINITY;
        for (v, d) in found.vertices().iter().enumerate() {
            assert!((d - finer.vertices()[v]).abs() <= 1e-12 * d);
            assert!(*d <= along_edges[v] * (1.0 + 1e-13));
            closest = closest.min(d / along_edges[v]);
        }
        assert!(closest > 0.5);
    }
}

fn dijkstra(mesh: &TriangleMesh, source: usize) -> Vec<f64> {
    let mut distance = vec![f64::INFINITY; mesh.vertex_count()];
    distance[source] = 0.0;
    let lengths: Vec<f64> = mesh
        .edges()
        .map(|e| mesh.edge_length(e.first.0, e.first.1))
        .collect();
    loop {
        let mut changed = false;
        for (edge, length) in mesh.edges().zip(&lengths) {
            let [a, b] = edge.vertices;
            for (a, b) in [(a, b), (b, a)] {
                if distance[a] + length < distance[b] {
                    distance[b] = distance[a] + length;
                    changed = true;
                }
            }
        }
        if !changed {
            return distance;
        }
    }
}

#[test]
fn keeping_windows_and_threads_change_no_bit() {
    for mesh in meshes() {
        let found = distances(&mesh, &sources(&mesh));
        let options = GeodesicOptions::default();
        let run =
            || geodesic_distance(&mesh, &sources(&mesh), &options, &Monitor::default()).unwrap();
        for threads in [1, 2, 3] {
            let other = crate::monitor::with_threads(threads, run);
            assert_eq!(found.vertices(), other.vertices());
            assert_eq!(found.nearest_sources(), other.nearest_sources());
        }
    }
}

/// Needles: triangles as flat as meshes may have them, beside each other and around vertices.
#[test]
fn needles_do_not_matter() {
    for flat in [1e-3, 1e-6, 1e-9, 1e-12] {
        let mesh = sheet(6, 1.0, 0.4);
        let count = mesh.vertex_count() as u32;
        let mut vertices = mesh.vertices().to_vec();
        let mut triangles = mesh.triangles().to_vec();
        // A vertex almost on an edge of every third face.
        for face in (0..mesh.face_count()).step_by(3) {
            let [a, b, c] = triangles[face];
            let p = SurfacePoint {
                face,
                barycentric: [0.5 - flat, 0.5, flat],
            };
            let new = vertices.len() as u32;
            vertices.push(p.position(&mesh));
            triangles[face] = [a, b, new];
            triangles.extend([[b, c, new], [c, a, new]]);
        }
        let with_needles = TriangleMesh::new(vertices, triangles).unwrap();
        for source in [0, 24, 40] {
            let found = distances(&mesh, &[Source::Vertex(source)]);
            let other = distances(&with_needles, &[Source::Vertex(source)]);
            for v in 0..count as usize {
                let (a, b) = (found.vertices()[v], other.vertices()[v]);
                assert!((a - b).abs() <= 1e-11 * a, "{flat}: {a} and {b}");
            }
            for face in (0..mesh.face_count()).step_by(3) {
                let point = SurfacePoint {
                    face,
                    barycentric: [0.5 - flat, 0.5, flat],
                };
                let a = found.at(&mesh, &point).unwrap();
                let b = other.vertices()[count as usize + face / 3];
                assert!((a - b).abs() <= 1e-11 * a, "{flat}: {a} and {b}");
            }
        }
    }
}
