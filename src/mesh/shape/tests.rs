//! Properties of the shapes.

use super::{MAX_TRIANGLES, by_name, from_spec};
use crate::mesh::vector::{Vec3, cross, dot, norm};
use crate::mesh::{MeshError, TriangleMesh};

/// Name, genus, boundary loops, and the least angle in degrees that is promised.
const SHAPES: &[(&str, usize, usize, f64)] = &[
    ("rounded-cube", 0, 0, 35.0),
    ("sphere", 0, 0, 50.0),
    ("torus", 1, 0, 29.0),
    ("genus-1", 1, 0, 18.0),
    ("genus-2", 2, 0, 18.0),
    ("genus-3", 3, 0, 18.0),
    ("genus-12", 12, 0, 18.0),
    ("gear", 1, 0, 20.0),
    ("plane", 0, 1, 44.9),
    ("disk", 0, 1, 43.0),
    ("plate-with-holes", 0, 4, 20.0),
];

fn volume(mesh: &TriangleMesh) -> f64 {
    let cone = |[a, b, c]: [Vec3; 3]| dot(a, cross(b, c)) / 6.0;
    (0..mesh.face_count())
        .map(|f| cone(mesh.corner_positions(f)))
        .sum()
}

#[test]
fn every_shape_has_its_genus_its_boundary_and_good_angles() {
    for &(name, genus, loops, degrees) in SHAPES {
        for target in [1_000, 3_000, 10_000] {
            let mesh = by_name(name, target).expect("a shape");
            assert_eq!(mesh.components().count, 1, "{name}");
            assert_eq!(mesh.genus(), genus, "{name}");
            assert_eq!(mesh.boundary_loop_count(), loops, "{name}");
            let least = (0..mesh.face_count())
                .flat_map(|f| [0, 1, 2].map(|k| mesh.angle(f, k)))
                .fold(f64::INFINITY, f64::min);
            assert!(
                least.to_degrees() > degrees,
                "{name} {target}: {}",
                least.to_degrees()
            );
            if loops == 0 {
                assert!(volume(&mesh) > 0.0, "{name} is inside out");
            } else {
                assert!((0..mesh.face_count()).all(|f| mesh.normal(f)[2] > 0.99));
            }
        }
    }
}

#[test]
fn triangles_come_within_a_tenth_of_what_was_asked() {
    for &(name, genus, ..) in SHAPES {
        let from = 3_000 * genus.max(1);
        for target in (0..12).map(|i| from + 391 * i) {
            let found = by_name(name, target).expect("a shape").face_count();
            let off = found.abs_diff(target) as f64 / target as f64;
            assert!(off < 0.1, "{name} {target}: {found}");
        }
    }
}

#[test]
fn the_coarsest_shapes_are_valid() {
    for &(name, genus, ..) in SHAPES {
        for target in [1, 10, 50, 100, 200, 500] {
            assert_eq!(by_name(name, target).expect("a shape").genus(), genus);
        }
    }
}

#[test]
fn a_shape_is_the_same_every_time() {
    for &(name, ..) in SHAPES {
        let (a, b) = (by_name(name, 2_000).unwrap(), by_name(name, 2_000).unwrap());
        assert_eq!(a.vertices(), b.vertices());
        assert_eq!(a.triangles(), b.triangles());
    }
}

#[test]
fn points_lie_on_the_surface() {
    for p in by_name("sphere", 3_000).unwrap().vertices() {
        assert!((norm(*p) - 1.0).abs() < 1e-12);
    }
    for p in by_name("torus", 3_000).unwrap().vertices() {
        let off_ring = p[0].hypot(p[1]) - 1.0;
        assert!((off_ring.hypot(p[2]) - 0.4).abs() < 1e-12);
    }
    for p in by_name("rounded-cube", 3_000).unwrap().vertices() {
        let beyond = p.map(|x| (x.abs() - 0.65).max(0.0));
        assert!((norm(beyond) - 0.35).abs() < 1e-12);
    }
    for p in by_name("genus-1", 3_000).unwrap().vertices() {
        let off_ring = p[0].hypot(p[1]) - 1.0;
        assert!((off_ring.hypot(p[2]) - 0.42).abs() < 1e-9);
    }
}

#[test]
fn a_spec_is_told_from_a_file_name() {
    assert!(from_spec("sphere.obj").is_none());
    assert!(from_spec("sphere").is_none());
    let mesh = from_spec("shape:sphere").unwrap().unwrap();
    assert_eq!(mesh.face_count(), 9_680);
    let mesh = from_spec("shape:genus-2:4000").unwrap().unwrap();
    assert_eq!(mesh.genus(), 2);
}

#[test]
fn what_is_no_shape_is_refused() {
    let names = [
        "",
        "cube",
        "genus-",
        "genus-0",
        "genus-101",
        "genus--1",
        "genus-+2",
        "Sphere",
    ];
    for name in names {
        let error = by_name(name, 1_000).expect_err("no shape");
        assert_eq!(
            error,
            MeshError::UnknownShape {
                name: name.to_owned()
            }
        );
        assert_eq!(error.code(), "unknown_shape");
    }
    for spec in [
        "shape:sphere:0",
        "shape:sphere:",
        "shape:sphere:-5",
        "shape:sphere:1e3",
        "shape:sphere:99999999",
    ] {
        let error = from_spec(spec).unwrap().expect_err("no such number");
        assert_eq!(error.code(), "invalid_argument", "{spec}");
    }
    assert!(by_name("plane", MAX_TRIANGLES + 1).is_err());
}
