//! Curvatures of shapes whose curvatures are known.

use super::{Curvature, curvature, smoothed_curvature};
use crate::mesh::vector::{Vec3, add, dot, normalize, scale};
use crate::mesh::{TriangleMesh, jitter, shape};

fn direction(mesh: &TriangleMesh, found: &Curvature, face: usize) -> Vec3 {
    let [x, y] = mesh.frame(face);
    let (sin, cos) = found.direction[face].sin_cos();
    add(scale(x, cos), scale(y, sin))
}

#[test]
fn a_sphere_is_umbilic_with_the_inverse_radius_as_curvature() {
    let mesh = shape::by_name("sphere", 5_000).unwrap();
    let large = mesh.vertices().iter().map(|&p| scale(p, 4.0)).collect();
    let mesh = TriangleMesh::new(large, mesh.triangles().to_vec()).unwrap();
    for rounds in [0, 4] {
        let found = smoothed_curvature(&mesh, rounds);
        for f in 0..mesh.face_count() {
            assert!((found.k1[f] - 0.25).abs() < 1e-3, "{}", found.k1[f]);
            assert!((found.k2[f] - 0.25).abs() < 1e-3, "{}", found.k2[f]);
            assert!(found.reliability(f) < 1e-3);
        }
    }
}

#[test]
fn on_a_torus_curvatures_are_right_and_least_curvature_runs_along_the_ring() {
    let mesh = shape::by_name("torus", 20_000).unwrap();
    let found = curvature(&mesh);
    for f in 0..mesh.face_count() {
        let [x, y, _] = mesh.face_centroid(f);
        let radius = x.hypot(y);
        let along_ring = (radius - 1.0) / 0.4 / radius;
        assert!((found.k1[f] - 2.5).abs() < 0.05, "{}", found.k1[f]);
        assert!((found.k2[f] - along_ring).abs() < 0.05, "{}", found.k2[f]);
        let along = [-y / radius, x / radius, 0.0];
        assert!(dot(direction(&mesh, &found, f), along).abs() > 0.999);
    }
}

#[test]
fn a_rounded_cube_is_flat_on_its_sides_and_follows_its_edges() {
    let mesh = jitter(&shape::by_name("rounded-cube", 20_000).unwrap(), 1e-3, 7).unwrap();
    let found = curvature(&mesh);
    let (mut followed, mut flat_faces) = (0, 0);
    for f in 0..mesh.face_count() {
        let p = mesh.face_centroid(f);
        let flat = p.iter().filter(|x| x.abs() < 0.55).count();
        let rounded = p.iter().filter(|x| x.abs() > 0.75).count();
        if flat == 2 && p.iter().any(|x| x.abs() > 0.99) {
            // The noise alone bends by a few thousandths of an edge over an edge of 0.04.
            assert!(found.k1[f].abs() < 0.15, "side: {}", found.k1[f]);
            flat_faces += 1;
        } else if flat == 1 && rounded == 2 {
            let edge = p.map(|x| f64::from(u8::from(x.abs() < 0.55)));
            assert!(dot(direction(&mesh, &found, f), edge).abs() > 0.999);
            assert!(
                (found.k1[f] - 1.0 / 0.35).abs() < 0.1,
                "edge: {}",
                found.k1[f]
            );
            followed += 1;
        }
    }
    assert!(followed > 500 && flat_faces > 500);
}

#[test]
fn turning_the_surface_inside_out_negates_curvature_and_keeps_directions() {
    let mesh = shape::by_name("torus", 2_000).unwrap();
    let flipped: Vec<_> = mesh
        .triangles()
        .iter()
        .map(|&[a, b, c]| [b, a, c])
        .collect();
    let inside = TriangleMesh::new(mesh.vertices().to_vec(), flipped).unwrap();
    let (out, turned) = (curvature(&mesh), curvature(&inside));
    for f in 0..mesh.face_count() {
        assert!((out.k1[f] + turned.k1[f]).abs() < 1e-9);
        let cos = dot(direction(&mesh, &out, f), direction(&inside, &turned, f));
        assert!(cos.abs() > 1.0 - 1e-9);
    }
}

#[test]
fn the_most_reliable_faces_are_found_and_directions_are_in_half_a_turn() {
    let mesh = shape::by_name("gear", 4_000).unwrap();
    let found = curvature(&mesh);
    let mut order: Vec<usize> = (0..mesh.face_count()).collect();
    order.sort_by(|&a, &b| found.reliability(b).total_cmp(&found.reliability(a)));
    for count in [0, 1, 80, order.len() - 1, order.len(), order.len() + 1] {
        let mut expected = order[..count.min(order.len())].to_vec();
        expected.sort_unstable();
        assert_eq!(found.most_reliable(count), expected);
    }
    assert!(order.iter().all(|&face| found.reliability(face) >= 0.0));
    let half = std::f64::consts::FRAC_PI_2;
    assert!(found.direction.iter().all(|&t| t > -half && t <= half));
}

#[test]
fn a_sharp_edge_is_followed() {
    let mesh = shape::by_name("gear", 20_000).unwrap();
    let found = curvature(&mesh);
    let axis = [0.0, 0.0, 1.0];
    let near_bore_rim = |p: &Vec3| p[2].abs() < 0.15 && p[0].hypot(p[1]) < 0.41;
    let mut followed = 0;
    for f in 0..mesh.face_count() {
        let p = mesh.face_centroid(f);
        if near_bore_rim(&p) {
            assert!(dot(normalize(direction(&mesh, &found, f)), axis).abs() > 0.99);
            assert!(found.k1[f] < 0.0, "the bore bends towards its normal");
            followed += 1;
        }
    }
    assert!(followed > 100, "{followed}");
}
