//! Points of the surface: as sources, as places of distances and gradients, and as ends of paths.

use super::brute::all_distances;
use super::exact::{distances, potato, sheet};
use crate::geodesic::{GeodesicDistance, Source, SurfacePoint};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{add, dot, norm, scale, sub};
use crate::mesh::{jitter, shape};

/// The same surface with a point as a vertex, the last one.
fn with_vertex(mesh: &TriangleMesh, point: &SurfacePoint) -> TriangleMesh {
    let mut vertices = mesh.vertices().to_vec();
    vertices.push(point.position(mesh));
    let last = mesh.vertex_count() as u32;
    let mut triangles = mesh.triangles().to_vec();
    let [a, b, c] = triangles[point.face];
    triangles[point.face] = [a, b, last];
    triangles.extend([[b, c, last], [c, a, last]]);
    TriangleMesh::new(vertices, triangles).unwrap()
}

/// Points in faces, at places that look random.
fn points(mesh: &TriangleMesh, count: usize) -> Vec<SurfacePoint> {
    let mut x: f64 = 0.37;
    let mut next = || {
        x = (x * 977.13 + 0.1).fract();
        x
    };
    let point = |_| {
        let face = (next() * mesh.face_count() as f64) as usize;
        let weights = [next() + 0.01, next() + 0.01, next() + 0.01];
        let sum: f64 = weights.iter().sum();
        SurfacePoint {
            face,
            barycentric: weights.map(|w| w / sum),
        }
    };
    (0..count).map(point).collect()
}

fn length(mesh: &TriangleMesh, path: &[SurfacePoint]) -> f64 {
    let pieces = path.windows(2);
    let piece = |w: &[SurfacePoint]| norm(sub(w[1].position(mesh), w[0].position(mesh)));
    pieces.map(piece).sum()
}

#[test]
fn a_point_is_as_far_as_a_vertex_at_its_place() {
    for (i, mesh) in [sheet(3, 2.0, 0.2), potato(0.8, 0.4), sheet(3, 6.0, 0.7)]
        .iter()
        .enumerate()
    {
        for point in points(mesh, 12) {
            let exact = all_distances(&with_vertex(mesh, &point));
            let exact = &exact[mesh.vertex_count()];
            let from_point = distances(mesh, &[Source::Point(point)]);
            for v in 0..mesh.vertex_count() {
                let d = from_point.vertices()[v];
                assert!(
                    (d - exact[v]).abs() < 1e-12 * exact[v],
                    "{i}: {d} is not {}",
                    exact[v]
                );
                let from_vertex = distances(mesh, &[Source::Vertex(v)]);
                let d = from_vertex.at(mesh, &point).unwrap();
                assert!(
                    (d - exact[v]).abs() < 1e-12 * exact[v],
                    "{i}: {d} is not {}",
                    exact[v]
                );
            }
        }
    }
}

#[test]
fn distances_between_points_are_the_same_both_ways() {
    let mesh = jitter(&shape::by_name("genus-2", 1_500).unwrap(), 0.3, 1).unwrap();
    let points = points(&mesh, 8);
    let found: Vec<_> = points
        .iter()
        .map(|p| distances(&mesh, &[Source::Point(*p)]))
        .collect();
    for (i, one) in found.iter().enumerate() {
        for (j, other) in found.iter().enumerate() {
            let there = one.at(&mesh, &points[j]).unwrap();
            let back = other.at(&mesh, &points[i]).unwrap();
            assert!((there - back).abs() <= 1e-12 * there, "{there} and {back}");
        }
    }
}

fn check_path(mesh: &TriangleMesh, found: &GeodesicDistance, from: &SurfacePoint) {
    let distance = found.at(mesh, from).unwrap();
    let path = found.path(mesh, from).unwrap();
    let length = length(mesh, &path);
    assert!(
        (length - distance).abs() <= 1e-11 * distance,
        "{length} is not {distance}"
    );
    assert!(found.at(mesh, path.last().unwrap()).unwrap() <= 1e-15 * distance);
    // A path is a polyline on the surface.
    let source = Source::Polyline {
        points: path,
        closed: false,
    };
    assert!(distances(mesh, &[source]).at(mesh, from).unwrap() <= 1e-15 * distance);
}

#[test]
fn paths_are_as_long_as_distances() {
    let meshes = [
        sheet(8, 3.0, 0.3),
        potato(1.2, 0.6),
        jitter(&shape::by_name("genus-2", 1_200).unwrap(), 0.3, 1).unwrap(),
        shape::by_name("plate-with-holes", 800).unwrap(),
    ];
    for mesh in &meshes {
        let of_points = points(mesh, 40);
        let line = vec![
            of_points[0],
            SurfacePoint::vertex(mesh, mesh.corners(of_points[0].face)[0]),
        ];
        let polyline = Source::Polyline {
            points: line,
            closed: false,
        };
        for source in [Source::Vertex(3), Source::Point(of_points[1]), polyline] {
            let found = distances(mesh, &[source]);
            for point in &of_points {
                check_path(mesh, &found, point);
            }
            for v in (0..mesh.vertex_count()).step_by(7) {
                check_path(mesh, &found, &SurfacePoint::vertex(mesh, v));
            }
        }
    }
}

/// Along the gradient, distance grows as fast as the way.
#[test]
fn gradients_are_unit_vectors_along_which_distance_grows() {
    let mesh = jitter(&shape::by_name("genus-2", 1_200).unwrap(), 0.3, 1).unwrap();
    let points = points(&mesh, 60);
    for source in [
        Source::Vertex(5),
        Source::Edges((0..mesh.edge_count()).step_by(300).collect()),
    ] {
        let found = distances(&mesh, &[source]);
        let mut checked = 0;
        for point in &points {
            let gradient = found.gradient(&mesh, point).unwrap();
            assert!((norm(gradient) - 1.0).abs() < 1e-12);
            assert!(dot(gradient, mesh.normal(point.face)).abs() < 1e-12);
            let step = 1e-5 * mesh.mean_edge_length();
            let at = |sign: f64| {
                let moved = add(point.position(&mesh), scale(gradient, sign * step));
                found.at(&mesh, &in_face(&mesh, point.face, moved)).unwrap()
            };
            let slope = (at(1.0) - at(-1.0)) / (2.0 * step);
            checked += usize::from((slope - 1.0).abs() < 1e-6);
        }
        // A point may be that near to where two paths are shortest.
        assert!(checked >= 59, "{checked}");
    }
}

fn in_face(mesh: &TriangleMesh, face: usize, p: [f64; 3]) -> SurfacePoint {
    let c = mesh.corner_positions(face);
    let normal = mesh.normal(face);
    let part = |k: usize| {
        let [a, b] = [sub(c[(k + 1) % 3], p), sub(c[(k + 2) % 3], p)];
        dot(crate::mesh::vector::cross(a, b), normal)
    };
    let parts = [0, 1, 2].map(part);
    let sum: f64 = parts.iter().sum();
    SurfacePoint {
        face,
        barycentric: parts.map(|x| x / sum),
    }
}

#[test]
fn the_nearest_source_is_that_of_the_least_distance() {
    let mesh = jitter(&shape::by_name("genus-2", 1_500).unwrap(), 0.3, 1).unwrap();
    let points = points(&mesh, 30);
    let edges = (0..5).map(|i| mesh.edge_of(10 * i, 0)).collect();
    let sources = [
        Source::Vertex(400),
        Source::Point(points[0]),
        Source::Edges(edges),
        Source::Vertex(17),
    ];
    let all = distances(&mesh, &sources);
    let single: Vec<_> = sources
        .iter()
        .map(|s| distances(&mesh, std::slice::from_ref(s)))
        .collect();
    for (v, d) in all.vertices().iter().enumerate() {
        let least = single
            .iter()
            .map(|s| s.vertices()[v])
            .fold(f64::INFINITY, f64::min);
        assert!((d - least).abs() <= 1e-13 * least);
        let nearest = all.nearest_sources()[v].unwrap();
        assert!(single[nearest].vertices()[v] <= d * (1.0 + 1e-13));
    }
    for point in &points {
        let d = all.at(&mesh, point).unwrap();
        let nearest = all.nearest_source(&mesh, point).unwrap().unwrap();
        assert!((single[nearest].at(&mesh, point).unwrap() - d).abs() <= 1e-13 * d);
    }
}

#[test]
fn beyond_the_limit_distances_are_infinite_and_up_to_it_the_same() {
    use crate::geodesic::{GeodesicOptions, geodesic_distance};
    let mesh = jitter(&shape::by_name("genus-2", 1_500).unwrap(), 0.3, 1).unwrap();
    let all = distances(&mesh, &[Source::Vertex(9)]);
    let options = GeodesicOptions {
        limit: 0.4 * all.farthest().1,
        everywhere: true,
    };
    let monitor = crate::monitor::Monitor::default();
    let near = geodesic_distance(&mesh, &[Source::Vertex(9)], &options, &monitor).unwrap();
    let expected = |d: f64| if d <= options.limit { d } else { f64::INFINITY };
    for (v, d) in all.vertices().iter().enumerate() {
        assert_eq!(near.vertices()[v], expected(*d));
        assert_eq!(near.nearest_sources()[v].is_some(), *d <= options.limit);
    }
    for point in points(&mesh, 60) {
        let d = expected(all.at(&mesh, &point).unwrap());
        assert_eq!(near.at(&mesh, &point).unwrap(), d);
        assert_eq!(
            near.path(&mesh, &point).unwrap().is_empty(),
            d.is_infinite()
        );
    }
}
