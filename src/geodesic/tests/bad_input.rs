//! Sources that are not on the surface, and other bad input, are errors that name what is wrong.

use crate::error::Error;
use crate::geodesic::{GeodesicOptions, Source, SurfacePoint, geodesic_distance};
use crate::mesh::{TriangleMesh, shape};
use crate::monitor::{CancelToken, Monitor};

fn mesh() -> TriangleMesh {
    shape::by_name("sphere", 100).unwrap()
}

fn error(sources: &[Source]) -> Error {
    let options = GeodesicOptions::default();
    geodesic_distance(&mesh(), sources, &options, &Monitor::default()).unwrap_err()
}

fn point(face: usize, barycentric: [f64; 3]) -> SurfacePoint {
    SurfacePoint { face, barycentric }
}

#[test]
fn elements_that_do_not_exist_are_refused() {
    let (vertices, faces, edges) = (
        mesh().vertex_count(),
        mesh().face_count(),
        mesh().edge_count(),
    );
    let third = [1.0 / 3.0; 3];
    for (source, what, value, len) in [
        (
            Source::Vertex(vertices),
            "source vertices",
            vertices,
            vertices,
        ),
        (
            Source::Point(point(faces + 7, third)),
            "source faces",
            faces + 7,
            faces,
        ),
        (Source::Edges(vec![0, edges]), "source edges", edges, edges),
    ] {
        let expected = Error::IndexOutOfRange {
            what,
            position: 1,
            value: value as i64,
            len,
        };
        assert_eq!(error(&[Source::Vertex(0), source]), expected);
    }
}

#[test]
fn points_outside_of_their_face_are_refused() {
    for barycentric in [[1.2, -0.2, 0.0], [0.5, 0.4, 0.0], [0.6, 0.6, 0.0]] {
        let found = error(&[Source::Vertex(0), Source::Point(point(3, barycentric))]);
        assert_eq!((found.code(), found.index()), ("invalid_argument", Some(1)));
        assert!(
            found
                .to_string()
                .starts_with("source 1: point 0 is outside of face 3: "),
            "{found}"
        );
    }
    for bad in [f64::NAN, f64::INFINITY] {
        let found = error(&[Source::Point(point(3, [bad, 0.0, 1.0]))]);
        assert_eq!((found.code(), found.index()), ("not_finite", Some(0)));
    }
    // Rounding is allowed for.
    let near = Source::Point(point(3, [1.0 + 1e-12, -1e-12, 0.0]));
    let options = GeodesicOptions::default();
    assert!(geodesic_distance(&mesh(), &[near], &options, &Monitor::default()).is_ok());
}

#[test]
fn polylines_that_leave_the_surface_are_refused() {
    let points = vec![
        point(0, [0.2, 0.3, 0.5]),
        point(0, [0.5, 0.3, 0.2]),
        point(50, [0.2, 0.3, 0.5]),
    ];
    let found = error(&[Source::Polyline {
        points,
        closed: false,
    }]);
    assert_eq!(
        found.to_string(),
        "source 0: points 1 and 2 of the polyline lie on no common face"
    );
    assert_eq!(found.index(), Some(0));
}

#[test]
fn without_sources_there_is_no_distance() {
    let empty = Source::Polyline {
        points: Vec::new(),
        closed: true,
    };
    for sources in [vec![], vec![Source::Edges(vec![])], vec![empty]] {
        assert_eq!(error(&sources).code(), "invalid_argument");
    }
}

#[test]
fn limits_that_are_no_distance_are_refused() {
    for limit in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        let options = GeodesicOptions {
            limit,
            ..GeodesicOptions::default()
        };
        let found = geodesic_distance(&mesh(), &[Source::Vertex(0)], &options, &Monitor::default());
        assert_eq!(found.unwrap_err().code(), "invalid_argument");
    }
}

#[test]
fn questions_about_points_that_are_not_on_the_surface_are_refused() {
    let (mesh, third) = (mesh(), [1.0 / 3.0; 3]);
    let run = |everywhere| {
        let options = GeodesicOptions {
            everywhere,
            ..GeodesicOptions::default()
        };
        geodesic_distance(&mesh, &[Source::Vertex(0)], &options, &Monitor::default()).unwrap()
    };
    let found = run(true);
    let code = |p: SurfacePoint| found.at(&mesh, &p).unwrap_err().code();
    assert_eq!(code(point(mesh.face_count(), third)), "index_out_of_range");
    assert_eq!(code(point(0, [f64::NAN, 0.0, 1.0])), "not_finite");
    assert_eq!(code(point(0, [2.0, -1.0, 0.0])), "invalid_argument");
    let other = shape::by_name("sphere", 400).unwrap();
    assert_eq!(
        found.at(&other, &point(0, third)).unwrap_err().code(),
        "length_mismatch"
    );
    let vertices_only = run(false);
    assert_eq!(
        vertices_only
            .at(&mesh, &point(0, third))
            .unwrap_err()
            .code(),
        "invalid_argument"
    );
    let vertex = SurfacePoint::vertex(&mesh, 9);
    assert_eq!(
        vertices_only.at(&mesh, &vertex).unwrap(),
        found.vertices()[9]
    );
    assert_eq!(
        vertices_only.path(&mesh, &vertex),
        found.path(&mesh, &vertex)
    );
}

#[test]
fn a_cancelled_call_ends() {
    let token = CancelToken::new();
    token.cancel();
    let monitor = Monitor::default().cancel_token(token);
    let options = GeodesicOptions::default();
    let found = geodesic_distance(&mesh(), &[Source::Vertex(0)], &options, &monitor);
    assert_eq!(found.unwrap_err(), Error::Cancelled);
}
