//! Polylines in space, drawn onto surfaces.

use super::exact::{distances, potato};
use crate::error::Error;
use crate::geodesic::{Source, draw_polyline};
use crate::mesh::vector::{Vec3, norm, sub};
use crate::mesh::{TriangleMesh, shape};
use crate::monitor::Monitor;

fn drawn(mesh: &TriangleMesh, points: &[Vec3], closed: bool) -> Source {
    draw_polyline(mesh, points, closed, &Monitor::default()).unwrap()
}

fn length(mesh: &TriangleMesh, source: &Source) -> f64 {
    let Source::Polyline { points, .. } = source else {
        panic!("{source:?}")
    };
    let places: Vec<Vec3> = points.iter().map(|p| p.position(mesh)).collect();
    places.windows(2).map(|w| norm(sub(w[1], w[0]))).sum()
}

#[test]
fn a_polyline_above_a_plane_is_its_projection() {
    let mesh = shape::by_name("plane", 800).unwrap();
    // A rectangle above the square from -1 to 1.
    let corners = [
        [-0.5, -0.3, 0.2],
        [0.7, -0.3, 0.1],
        [0.7, 0.41, 0.3],
        [-0.5, 0.41, 0.0],
    ];
    let line = drawn(&mesh, &corners, true);
    assert!((length(&mesh, &line) - 2.0 * (1.2 + 0.71)).abs() < 1e-12);
    let found = distances(&mesh, &[line]);
    for (v, d) in found.vertices().iter().enumerate() {
        let [x, y, _] = mesh.position(v);
        let (u, w) = ((-0.5 - x).max(x - 0.7), (-0.3 - y).max(y - 0.41));
        let exact = match u.max(w) <= 0.0 {
            true => -u.max(w),
            false => u.max(0.0).hypot(w.max(0.0)),
        };
        assert!((d - exact).abs() < 1e-12, "{d} is not {exact}");
    }
}

#[test]
fn between_far_points_the_polyline_is_a_shortest_path() {
    let mesh = potato(0.9, 0.3);
    for (a, b) in [(0, 20), (3, 31), (17, 40)] {
        let points = [a, b].map(|v| mesh.position(v));
        let line = drawn(&mesh, &points, false);
        let exact = distances(&mesh, &[Source::Vertex(a)]).vertices()[b];
        assert!((length(&mesh, &line) - exact).abs() < 1e-12 * exact);
        let found = distances(&mesh, &[line]);
        assert_eq!((found.vertices()[a], found.vertices()[b]), (0.0, 0.0));
    }
}

#[test]
fn polylines_that_cannot_be_drawn_are_refused() {
    let mesh = shape::by_name("plane", 50).unwrap();
    let draw = |mesh: &TriangleMesh, points: &[Vec3]| {
        draw_polyline(mesh, points, false, &Monitor::default()).unwrap_err()
    };
    assert_eq!(draw(&mesh, &[]).code(), "invalid_argument");
    let nan = Error::NotFinite {
        what: "points of the polyline",
        position: 1,
    };
    assert_eq!(draw(&mesh, &[[0.0; 3], [0.0, f64::NAN, 0.0]]), nan);
    // Two pieces.
    let mut vertices = mesh.vertices().to_vec();
    let count = vertices.len() as u32;
    vertices.extend(mesh.vertices().iter().map(|&[x, y, _]| [x, y, 5.0]));
    let mut triangles = mesh.triangles().to_vec();
    triangles.extend(mesh.triangles().iter().map(|t| t.map(|v| v + count)));
    let both = TriangleMesh::new(vertices, triangles).unwrap();
    let apart = draw(&both, &[[0.1, 0.2, 0.0], [0.1, 0.2, 0.1], [0.1, 0.2, 5.0]]);
    assert_eq!((apart.code(), apart.index()), ("invalid_argument", Some(1)));
}
