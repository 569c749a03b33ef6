//! Sources of segments: closed forms in the plane, and points that are set ever more densely.

use super::exact::{distances, potato, sheet};
use crate::geodesic::{Source, SurfacePoint};
use crate::mesh::vector::{Vec3, norm, sub};
use crate::mesh::{TriangleMesh, closest_on_segment, jitter, shape};

fn to_segment(p: Vec3, ends: [Vec3; 2]) -> f64 {
    norm(sub(p, closest_on_segment(ends, p)))
}

/// A flat square of side `n`: a sheet whose boundary is straight.
fn square(n: usize) -> TriangleMesh {
    let mesh = sheet(n, 0.0, 0.3);
    let place = |v: usize| match mesh.is_boundary_vertex(v) {
        true => mesh.position(v).map(f64::round),
        false => mesh.position(v),
    };
    let vertices = (0..mesh.vertex_count()).map(place).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).unwrap()
}

/// A straight cut of a flat mesh: where it crosses edges, and its ends.
fn cut(mesh: &TriangleMesh, [a, b]: [Vec3; 2]) -> Vec<SurfacePoint> {
    let mut found: Vec<(f64, SurfacePoint)> = Vec::new();
    let cross = |u: Vec3, v: Vec3| u[0] * v[1] - u[1] * v[0];
    for edge in mesh.edges() {
        let [p, q] = edge.vertices.map(|v| mesh.position(v));
        let (d, e) = (sub(b, a), sub(q, p));
        let denominator = cross(d, e);
        let share = cross(sub(p, a), e) / denominator;
        let place = cross(sub(p, a), d) / denominator;
        if (0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&place) {
            let (face, k) = edge.first;
            let mut barycentric = [0.0; 3];
            barycentric[k] = 1.0 - place;
            barycentric[(k + 1) % 3] = place;
            found.push((share, SurfacePoint { face, barycentric }));
        }
    }
    found.sort_by(|x, y| x.0.total_cmp(&y.0));
    found.into_iter().map(|f| f.1).collect()
}

#[test]
fn in_the_plane_the_distance_from_a_segment_is_that_of_space() {
    let mesh = square(20);
    let ends = [[2.81, 3.33, 0.0], [17.52, 15.77, 0.0]];
    let points = cut(&mesh, ends);
    assert!(points.len() > 20);
    let segment = [points[0], *points.last().unwrap()].map(|p| p.position(&mesh));
    let polyline = Source::Polyline {
        points,
        closed: false,
    };
    let found = distances(&mesh, &[polyline]);
    for (v, d) in found.vertices().iter().enumerate() {
        let exact = to_segment(mesh.position(v), segment);
        assert!((d - exact).abs() <= 1e-12, "{v}: {d} is not {exact}");
    }
    for face in 0..mesh.face_count() {
        let point = SurfacePoint {
            face,
            barycentric: [0.5, 0.3, 0.2],
        };
        let d = found.at(&mesh, &point).unwrap();
        let exact = to_segment(point.position(&mesh), segment);
        assert!((d - exact).abs() <= 1e-12, "{face}: {d} is not {exact}");
    }
}

#[test]
fn in_the_plane_edges_are_segments() {
    let mesh = square(20);
    let edges: Vec<usize> = (0..mesh.edge_count()).step_by(97).collect();
    let segments: Vec<_> = edges
        .iter()
        .map(|&e| mesh.edge(e).vertices.map(|v| mesh.position(v)))
        .collect();
    let found = distances(&mesh, &[Source::Edges(edges)]);
    for (v, d) in found.vertices().iter().enumerate() {
        let exact = segments.iter().map(|s| to_segment(mesh.position(v), *s));
        let exact = exact.fold(f64::INFINITY, f64::min);
        assert!((d - exact).abs() <= 1e-12, "{v}: {d} is not {exact}");
    }
}

#[test]
fn a_segment_within_a_face_starts_in_all_directions() {
    let mesh = square(10);
    for face in (0..mesh.face_count()).step_by(9) {
        let points = [[0.6, 0.3, 0.1], [0.1, 0.25, 0.65]]
            .map(|barycentric| SurfacePoint { face, barycentric });
        let segment = points.map(|p| p.position(&mesh));
        let polyline = Source::Polyline {
            points: points.to_vec(),
            closed: true,
        };
        let found = distances(&mesh, &[polyline]);
        for (v, d) in found.vertices().iter().enumerate() {
            let exact = to_segment(mesh.position(v), segment);
            assert!((d - exact).abs() <= 1e-12, "{v}: {d} is not {exact}");
        }
    }
}

/// The distance from a polyline is at most that from points on it, and nears it as they get denser: with the square
/// of their spacing away from the line, and no slower than the spacing anywhere.
#[test]
fn points_on_a_polyline_come_ever_nearer_from_above() {
    let surfaces = [
        sheet(6, 2.0, 0.3),
        potato(0.9, 0.3),
        jitter(&shape::by_name("genus-2", 600).unwrap(), 0.3, 1).unwrap(),
    ];
    for mesh in &surfaces {
        // A path between two vertices, as a polyline.
        let from = distances(mesh, &[Source::Vertex(2)]);
        let start = SurfacePoint::vertex(mesh, from.farthest().0);
        let path = from.path(mesh, &start).unwrap();
        assert!(path.len() > 3);
        let line = Source::Polyline {
            points: path.clone(),
            closed: false,
        };
        let exact = distances(mesh, &[line]);
        let mut last = f64::INFINITY;
        for pieces in [1, 4, 16] {
            let (points, spacing) = dense(mesh, &path, pieces);
            let found = distances(mesh, &points);
            let mut worst: f64 = 0.0;
            for (d, e) in found.vertices().iter().zip(exact.vertices()) {
                assert!(*d >= e * (1.0 - 1e-12), "{d} is below {e}");
                assert!(*d <= e + 0.5 * spacing * (1.0 + 1e-12));
                worst = worst.max(d - e);
            }
            assert!(worst < 0.5 * last, "{worst} after {last}");
            last = worst;
        }
    }
}

/// Points on a polyline, so many a segment, and the largest distance of two that follow each other.
fn dense(mesh: &TriangleMesh, path: &[SurfacePoint], pieces: usize) -> (Vec<Source>, f64) {
    let mut points = vec![Source::Point(path[0])];
    let mut spacing: f64 = 0.0;
    for pair in path.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| p.position(mesh));
        spacing = spacing.max(norm(sub(b, a)) / pieces as f64);
        let common = (0..mesh.face_count()).find_map(|f| {
            let inside = |p: &SurfacePoint| weights_in(mesh, f, p);
            Some((f, inside(&pair[0])?, inside(&pair[1])?))
        });
        let (face, a, b) = common.unwrap();
        for i in 1..=pieces {
            let share = i as f64 / pieces as f64;
            let barycentric = [0, 1, 2].map(|k| a[k] + share * (b[k] - a[k]));
            points.push(Source::Point(SurfacePoint { face, barycentric }));
        }
    }
    (points, spacing)
}

/// The weights of a point in another face, if that holds it.
fn weights_in(mesh: &TriangleMesh, face: usize, point: &SurfacePoint) -> Option<[f64; 3]> {
    let corners = mesh.corners(face);
    let mut weights = [0.0; 3];
    for (v, w) in mesh.corners(point.face).into_iter().zip(point.barycentric) {
        if w > 0.0 {
            weights[corners.iter().position(|c| *c == v)?] = w;
        }
    }
    Some(weights)
}

#[test]
fn the_boundary_and_features_are_sources_by_loop_and_curve() {
    let plate = shape::by_name("plate-with-holes", 1_000).unwrap();
    let boundary = Source::boundary(&plate);
    assert_eq!(boundary.len(), 4);
    let found = distances(&plate, &boundary);
    for (v, d) in found.vertices().iter().enumerate() {
        assert_eq!(*d == 0.0, plate.is_boundary_vertex(v));
        let segments = plate.edges().filter(|e| e.second.is_none());
        let exact =
            segments.map(|e| to_segment(plate.position(v), e.vertices.map(|v| plate.position(v))));
        let exact = exact.fold(f64::INFINITY, f64::min);
        assert!((d - exact).abs() < 1e-13, "{d} is not {exact}");
    }
    let gear = shape::by_name("gear", 3_000).unwrap();
    let graph = crate::mesh::features::FeatureGraph::by_angle(&gear, 0.7).unwrap();
    let sources = Source::features(&graph);
    assert_eq!(sources.len(), graph.curves().len());
    let found = distances(&gear, &sources);
    for (v, d) in found.vertices().iter().enumerate() {
        assert_eq!(*d == 0.0, graph.degree(v) > 0);
    }
}
