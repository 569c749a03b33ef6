//! Planes that are stated and found, and the parts that they cut.

use super::*;
use crate::mesh::shape::by_name;
use crate::mesh::vector::{Vec3, add, normalize, scale};

fn planes(mesh: &TriangleMesh, words: &[&str], tolerance: f64) -> Result<Vec<MirrorPlane>> {
    let asked: Vec<Mirror> = words.iter().map(|word| word.parse().unwrap()).collect();
    mirror_planes(mesh, &asked, tolerance)
}

/// A mesh turned about two axes and moved.
fn turned(mesh: &TriangleMesh) -> (TriangleMesh, Vec3, f64) {
    let (s, c) = 0.7f64.sin_cos();
    let turn = |[x, y, z]: Vec3| {
        let [x, y] = [c * x - s * y, s * x + c * y];
        let [y, z] = [c * y - s * z, s * y + c * z];
        [x, y, z]
    };
    let move_by = [3.0, -2.0, 0.5];
    let points = mesh.vertices().iter().map(|&p| add(turn(p), move_by));
    let points = points.collect();
    let normal = turn([1.0, 0.0, 0.0]);
    let moved = TriangleMesh::new(points, mesh.triangles().to_vec()).unwrap();
    (moved, normal, dot(normal, move_by))
}

#[test]
fn a_plane_perpendicular_to_an_axis_reflects_to_the_last_bit() {
    let mesh = by_name("torus", 600).unwrap();
    let plane = planes(&mesh, &["2,0,0,0"], 0.1).unwrap()[0];
    assert_eq!((plane.normal, plane.offset), ([1.0, 0.0, 0.0], 0.0));
    for &p in mesh.vertices() {
        assert_eq!(plane.reflect(p), [-p[0], p[1], p[2]]);
        assert_eq!(plane.reflect(plane.reflect(p)), p);
    }
}

#[test]
fn the_cut_has_half_of_the_area_and_its_seam_on_the_plane() {
    for (name, loops) in [
        ("torus", 2),
        ("genus-2", 1),
        ("rounded-cube", 1),
        ("gear", 1),
    ] {
        let mesh = by_name(name, 2_000).unwrap();
        for word in ["x", "-y", "0.6,0.48,0.64,0.03"] {
            let plane = planes(&mesh, &[word], 1.0).unwrap();
            let half = Half::new(&mesh, &plane).unwrap();
            let other = MirrorPlane {
                normal: scale(plane[0].normal, -1.0),
                offset: -plane[0].offset,
                ..plane[0]
            };
            let rest = Half::new(&mesh, &[other]).unwrap();
            let area = half.mesh.surface_area() + rest.mesh.surface_area();
            // Vertices near the plane are moved onto it.
            let error = (area / mesh.surface_area() - 1.0).abs();
            assert!(error < 1e-3, "{name} {word}: {error}");
            for &e in &half.seam {
                for v in half.mesh.edge(e).vertices {
                    let height = plane[0].height(half.mesh.position(v));
                    assert!(height.abs() <= 1e-15 * 10.0, "{name} {word}: {height}");
                }
            }
            assert_eq!(half.seam.len(), rest.seam.len());
            assert!(half.mesh.boundary_loop_count() >= 1);
            if word == "x" && loops == 1 && name != "gear" {
                let boundary = half.mesh.edges().filter(|e| e.second.is_none()).count();
                assert_eq!(boundary, half.seam.len());
            }
        }
    }
}

#[test]
fn a_plane_through_vertices_and_along_edges_cuts_no_needles() {
    // An octahedron: the plane contains four of its edges, and one through two vertices only.
    let points = vec![
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let faces = vec![
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    let mesh = TriangleMesh::new(points, faces).unwrap();
    let half = Half::new(&mesh, &planes(&mesh, &["z"], 1e-12).unwrap()).unwrap();
    assert_eq!((half.mesh.vertex_count(), half.mesh.face_count()), (5, 4));
    assert_eq!(half.seam.len(), 4);
    assert!(half.edge_origin.iter().all(Option::is_some));
    let diagonal = planes(&mesh, &["1,1,0,0"], 1e-12).unwrap();
    let half = Half::new(&mesh, &diagonal).unwrap();
    // Each of four faces is halved at the middle of an edge.
    assert_eq!((half.mesh.vertex_count(), half.mesh.face_count()), (6, 6));
    assert_eq!(half.seam.len(), 4);
}

#[test]
fn faces_in_the_plane_belong_to_neither_side() {
    // Two cubes beside a plate between them would be no manifold: an open strip with a flat middle is one.
    let at = |x: f64, z: f64| [[x, 0.0, z], [x, 1.0, z]];
    let points = [at(0.0, -1.0), at(1.0, 0.0), at(2.0, 0.0), at(3.0, 1.0)].concat();
    let strip = (0..3u32).flat_map(|i| {
        [
            [2 * i, 2 * i + 2, 2 * i + 1],
            [2 * i + 1, 2 * i + 2, 2 * i + 3],
        ]
    });
    let mesh = TriangleMesh::new(points, strip.collect()).unwrap();
    let half = Half::new(&mesh, &planes(&mesh, &["0,0,1,0"], 1.0).unwrap()).unwrap();
    assert_eq!(half.face_origin, [4, 5]);
    assert_eq!(half.seam.len(), 1);
}

#[test]
fn vertices_at_which_fans_meet_are_split() {
    // A saddle whose middle lies on the plane, and four of whose eight spokes point to each side.
    let ring = (0..8).map(|k| {
        let (s, c) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
        [c, s, [0.5, 0.0, -0.5, 0.0][k as usize % 4]]
    });
    let mut points = vec![[0.0; 3]];
    points.extend(ring);
    let faces = (0..8).map(|k| [0, k + 1, (k + 1) % 8 + 1]);
    let mesh = TriangleMesh::new(points, faces.collect()).unwrap();
    let half = Half::new(&mesh, &planes(&mesh, &["0,0,1,0"], 1.0).unwrap()).unwrap();
    assert_eq!(half.mesh.components().count, 2);
    assert_eq!((half.mesh.vertex_count(), half.mesh.face_count()), (8, 4));
}

#[test]
fn the_plane_of_a_mesh_that_was_turned_is_found() {
    let (mesh, normal, offset) = turned(&by_name("genus-3", 3_000).unwrap());
    let found = planes(&mesh, &["auto"], 1e-3).unwrap()[0];
    assert!(found.deviation < 1e-3, "{}", found.deviation);
    let [stated] = [Mirror::Plane { normal, offset }];
    assert!(mirror_planes(&mesh, &[stated], 1e-3).is_ok());
}

#[test]
fn several_planes_that_are_found_are_perpendicular() {
    let (mesh, ..) = turned(&by_name("torus", 2_000).unwrap());
    let found = planes(&mesh, &["auto", "auto", "auto"], 0.02).unwrap();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        assert!(dot(found[i].normal, found[j].normal).abs() < 1e-12);
    }
}

#[test]
fn bad_planes_are_refused_with_their_number() {
    let mesh = by_name("torus", 600).unwrap();
    for (words, tolerance, index) in [
        (&["x", "0,0,0,1"][..], 1.0, Some(1)),
        (&["nan,0,0,1"], 1.0, Some(0)),
        (&["x", "1,0.1,0,0"], 1.0, Some(1)),
        (&["x", "x"], 1.0, Some(1)),
        (&["x", "y", "z", "auto"], 1.0, Some(3)),
        (&["1,0,0,0.4"], 0.01, Some(0)),
        (&["x"], -1.0, None),
        (&["x"], f64::NAN, None),
    ] {
        let error = planes(&mesh, words, tolerance).unwrap_err();
        assert_eq!(error.index(), index, "{words:?}: {error}");
    }
    let beside = planes(&mesh, &["1,0,0,50"], 1.0);
    // Nothing is on the far side.
    let error = beside
        .and_then(|planes| Half::new(&mesh, &planes))
        .unwrap_err();
    assert_eq!(error.index(), Some(0));
    let touching = MirrorPlane {
        normal: normalize([1.0, 0.0, 0.0]),
        offset: 50.0,
        deviation: 0.0,
    };
    let error = Half::new(&mesh, &[touching]).unwrap_err();
    assert!(error.to_string().contains("cuts nothing"), "{error}");
    for text in ["", "w", "1,2,3", "+x", "--x", "1,2,3,4,5", "x,y"] {
        assert!(text.parse::<Mirror>().is_err(), "{text}");
    }
}
