//! Properties of refined meshes, on triangulations as CAD programs write them.

use std::f64::consts::TAU;

use super::{RefineOptions, Refined, SMALL_ANGLE, needs_refinement, refine};
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, add, cross, dot, norm, normalize, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh, shape};

/// The solid between heights 0 and `height` over a polygon that a fan from its first corner covers.
fn prism(polygon: &[[f64; 2]], height: f64) -> TriangleMesh {
    let n = polygon.len() as u32;
    let at = |z: f64| polygon.iter().map(move |&[x, y]| [x, y, z]);
    let fan = (1..n - 1).flat_map(|i| [[0, i + 1, i], [n, n + i, n + i + 1]]);
    let walls = (0..n).flat_map(|i| {
        let j = (i + 1) % n;
        [[i, j, n + j], [i, n + j, n + i]]
    });
    let triangles = fan.chain(walls).collect();
    TriangleMesh::new(at(0.0).chain(at(height)).collect(), triangles).unwrap()
}

fn cuboid([x, y, z]: [f64; 3]) -> TriangleMesh {
    prism(&[[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]], z)
}

fn cylinder(sides: usize, height: f64) -> TriangleMesh {
    let angles = (0..sides).map(|i| TAU * i as f64 / sides as f64);
    let circle: Vec<_> = angles.map(|a| [a.cos(), a.sin()]).collect();
    prism(&circle, height)
}

/// A mesh, its sharp edges, and an edge length.
fn shapes() -> Vec<(&'static str, TriangleMesh, f64)> {
    vec![
        ("cube", cuboid([1.0, 1.0, 1.0]), 0.1),
        ("long box", cuboid([10.0, 1.0, 2.0]), 0.3),
        ("cylinder", cylinder(64, 20.0), 0.3),
        ("fine cylinder", cylinder(200, 5.0), 0.3),
        ("disk", cylinder(200, 0.1), 0.2),
        ("gear", shape::by_name("gear", 400).unwrap(), 0.1),
        ("sphere", shape::by_name("sphere", 200).unwrap(), 0.1),
        (
            "plate",
            shape::by_name("plate-with-holes", 100).unwrap(),
            0.04,
        ),
    ]
}

fn sharp(mesh: &TriangleMesh) -> FeatureGraph {
    let sharp = FeatureGraph::by_angle(mesh, 30f64.to_radians()).unwrap();
    sharp.with(mesh, &FeatureGraph::boundary(mesh)).unwrap()
}

fn refined(mesh: &TriangleMesh, longest: f64) -> (Refined, RefineOptions) {
    let options = RefineOptions::new(mesh, longest, 1_000_000);
    (refine(mesh, &sharp(mesh), &options).unwrap(), options)
}

/// A bound on the distance of a point from a face: from its plane, and in it from its edges. The closest
/// point has fewer digits on needles.
fn distance(mesh: &TriangleMesh, face: usize, p: Vec3) -> f64 {
    let (corners, normal) = (mesh.corner_positions(face), mesh.normal(face));
    let outside = (0..3).map(|k| {
        let [a, b] = [corners[k], corners[(k + 1) % 3]];
        let out = normalize(cross(sub(b, a), normal));
        dot(sub(p, a), out).max(0.0)
    });
    outside.fold(dot(sub(p, corners[0]), normal).abs(), f64::max)
}

fn middle_points(mesh: &TriangleMesh) -> Vec<Vec3> {
    let of_edges = mesh.edges().map(|e| {
        let [a, b] = e.vertices.map(|v| mesh.position(v));
        scale(add(a, b), 0.5)
    });
    let of_faces = (0..mesh.face_count()).map(|f| mesh.face_centroid(f));
    of_edges.chain(of_faces).collect()
}

#[test]
fn the_surface_stays_in_place() {
    for (name, mesh, longest) in shapes() {
        let (found, options) = refined(&mesh, longest);
        let (old, new) = (ClosestPoint::new(&mesh), ClosestPoint::new(&found.mesh));
        let exact = 1e-12 * super::diagonal(&mesh);
        assert_eq!(
            &found.mesh.vertices()[..mesh.vertex_count()],
            mesh.vertices()
        );
        for (v, &face) in found.vertex_face.iter().enumerate() {
            let off = distance(&mesh, face as usize, found.mesh.position(v));
            assert!(off <= exact, "{name}: vertex {v} is off by {off}");
        }
        for (f, &face) in found.face_origin.iter().enumerate() {
            let off = distance(&mesh, face as usize, found.mesh.face_centroid(f));
            assert!(off <= options.deviation + exact, "{name}: {off}");
        }
        for (tree, other) in [(&old, &found.mesh), (&new, &mesh)] {
            for p in middle_points(other) {
                let (_, q) = tree.find(p, None).unwrap();
                assert!(norm(sub(p, q)) <= options.deviation + exact, "{name}");
            }
        }
        // Of the same volume, or area if it is open: nothing is folded over.
        let area = found.mesh.surface_area() / mesh.surface_area();
        assert!((area - 1.0).abs() < 1e-3, "{name}: {area}");
        for (f, &face) in found.face_origin.iter().enumerate() {
            let turn = dot(found.mesh.normal(f), mesh.normal(face as usize));
            assert!(turn > 0.96, "{name}: {turn}");
        }
    }
}

#[test]
fn topology_and_features_stay() {
    for (name, mesh, longest) in shapes() {
        let (found, _) = refined(&mesh, longest);
        assert_eq!(
            found.mesh.euler_characteristic(),
            mesh.euler_characteristic()
        );
        assert_eq!(found.mesh.boundary_loop_count(), mesh.boundary_loop_count());
        let features = sharp(&mesh);
        let parts = found.parts_of(|e| features.contains(e));
        let again = FeatureGraph::from_edges(&found.mesh, &parts).unwrap();
        assert_eq!(again.corners(), features.corners(), "{name}");
        assert_eq!(again.curves().len(), features.curves().len(), "{name}");
        let length = |mesh: &TriangleMesh, edges: &mut dyn Iterator<Item = usize>| -> f64 {
            let of = |e| {
                let (face, k) = mesh.edge(e).first;
                mesh.edge_length(face, k)
            };
            edges.map(of).sum()
        };
        let [old, new] = [
            length(&mesh, &mut features.edges()),
            length(&found.mesh, &mut parts.iter().copied()),
        ];
        assert!((old - new).abs() <= 1e-9 * old, "{name}: {old} {new}");
        for &e in &parts {
            let origin = mesh.edge(found.edge_origin[e].unwrap() as usize);
            let [a, b] = origin.vertices.map(|v| mesh.position(v));
            for v in found.mesh.edge(e).vertices {
                let off = sub(found.mesh.position(v), a);
                let across = norm(cross(off, sub(b, a))) / norm(sub(b, a));
                assert!(across <= 1e-12 * super::diagonal(&mesh), "{name}");
            }
        }
    }
}

#[test]
fn edges_are_short_and_angles_large() {
    for (name, mesh, longest) in shapes() {
        let (found, options) = refined(&mesh, longest);
        assert!(found.is_complete, "{name}");
        assert_eq!(found.small_angles, 0, "{name}");
        assert_eq!(needs_refinement(&found.mesh, longest / 3.0), None, "{name}");
        let faces = 0..found.mesh.face_count();
        let angles = faces.flat_map(|f| [0, 1, 2].map(|k| found.mesh.angle(f, k)));
        let least = angles.fold(f64::INFINITY, f64::min);
        assert!(least >= options.smallest_angle - 1e-9, "{name}: {least}");
    }
}

#[test]
fn a_refinement_is_the_same_every_time_and_at_every_power_of_two() {
    for (name, mesh, longest) in shapes() {
        let (first, _) = refined(&mesh, longest);
        let (second, _) = refined(&mesh, longest);
        assert_eq!(first.mesh.vertices(), second.mesh.vertices(), "{name}");
        for factor in [2f64.powi(-40), 2f64.powi(30)] {
            let points = mesh.vertices().iter().map(|&p| scale(p, factor)).collect();
            let scaled = TriangleMesh::new(points, mesh.triangles().to_vec()).unwrap();
            let (found, _) = refined(&scaled, factor * longest);
            assert_eq!(found.mesh.triangles(), first.mesh.triangles(), "{name}");
            assert_eq!(found.face_origin, first.face_origin, "{name}");
        }
    }
}

#[test]
fn the_bound_on_the_triangles_holds() {
    let mesh = cylinder(64, 20.0);
    let options = RefineOptions::new(&mesh, 0.05, 3_000);
    let found = refine(&mesh, &sharp(&mesh), &options).unwrap();
    assert!(!found.is_complete);
    let most = mesh.face_count() + 3_000;
    assert!((most..most + 3).contains(&found.mesh.face_count()));
}

#[test]
fn where_nothing_is_at_fault_nothing_changes() {
    for name in ["sphere", "torus", "plane", "rounded-cube"] {
        let mesh = shape::by_name(name, 3_000).unwrap();
        let (found, _) = refined(&mesh, 1.0);
        assert!(found.is_unchanged());
        assert_eq!(found.mesh.triangles(), mesh.triangles());
    }
}

#[test]
fn an_angle_between_features_stays_and_is_counted() {
    let tip = SMALL_ANGLE.tan() / 2.0;
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, tip, 0.0]];
    let mesh = TriangleMesh::new(corners, vec![[0, 1, 2]]).unwrap();
    let (found, _) = refined(&mesh, 0.1);
    assert!(found.is_complete);
    assert!(
        (1..10).contains(&found.small_angles),
        "{}",
        found.small_angles
    );
}

#[test]
fn a_face_between_three_features_is_divided() {
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = TriangleMesh::new(corners, vec![[0, 1, 2]]).unwrap();
    let (found, _) = refined(&mesh, 2.0);
    assert_eq!(found.mesh.face_count(), 3);
}

#[test]
fn a_flip_does_not_join_the_two_sides_of_a_thin_plate() {
    // A flat tetrahedron: the Delaunay diagonal of the upper side is an edge of the lower one.
    let points = vec![
        [0.0, -3.0, 1e-6],
        [1.0, 0.0, 0.0],
        [0.0, 3.0, 1e-6],
        [-1.0, 0.0, 0.0],
    ];
    let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    let mesh = TriangleMesh::new(points, triangles).unwrap();
    let (found, _) = refined(&mesh, 0.5);
    assert_eq!(found.mesh.euler_characteristic(), 2);
}

#[test]
fn a_pillow_of_two_faces_is_refined() {
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 2, 1]]).unwrap();
    let (found, _) = refined(&mesh, 0.2);
    assert!(found.mesh.face_count() > 20);
    assert_eq!(found.mesh.euler_characteristic(), 2);
}

#[test]
fn options_out_of_range_are_refused() {
    let mesh = cuboid([1.0; 3]);
    let features = sharp(&mesh);
    let good = RefineOptions::new(&mesh, 0.1, 10);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let length = RefineOptions {
            longest_edge: bad,
            ..good.clone()
        };
        assert!(refine(&mesh, &features, &length).is_err(), "{bad}");
    }
    for bad in [-1.0, 1.0, f64::NAN] {
        let angle = RefineOptions {
            smallest_angle: bad,
            ..good.clone()
        };
        assert!(refine(&mesh, &features, &angle).is_err(), "{bad}");
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let deviation = RefineOptions {
            deviation: bad,
            ..good.clone()
        };
        assert!(refine(&mesh, &features, &deviation).is_err(), "{bad}");
    }
}
