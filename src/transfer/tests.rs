//! Values on quads, held against closed forms.

use super::*;
use crate::extract::QuadMesh;
use crate::mesh::attributes::SurfaceAttributes;
use crate::mesh::shape::by_name;
use crate::mesh::vector::Vec3;
use crate::monitor::{CancelToken, with_threads};

/// A grid of `n` by `n` quads over a parallelogram, of which `place` gives the points from parameters up to 1.
fn grid(n: u32, place: impl Fn(f64, f64) -> Vec3) -> QuadMesh {
    let part = |i: u32| f64::from(i) / f64::from(n);
    let vertices = (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
    let vertices = vertices.map(|(i, j)| place(part(i), part(j))).collect();
    let quads = (0..n).flat_map(|j| {
        (0..n).map(move |i| {
            let v = j * (n + 1) + i;
            [v, v + 1, v + n + 2, v + n + 1]
        })
    });
    QuadMesh::from_quads(vertices, quads.collect(), 1)
}

/// A mesh of `n` by `n` squares of two triangles each.
fn triangles(n: u32, place: impl Fn(f64, f64) -> Vec3) -> TriangleMesh {
    let grid = grid(n, place);
    let halves = grid
        .quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    TriangleMesh::new(grid.vertices.clone(), halves.collect()).unwrap()
}

fn monitor() -> Monitor<'static> {
    Monitor::default()
}

#[test]
fn linear_functions_of_a_plane_come_back() {
    // A plane that no axis is normal to.
    let place = |s: f64, t: f64| [2.0 * s - t, s + 3.0 * t, 0.5 * s + t];
    let mesh = triangles(13, place);
    let quads = grid(7, place);
    let functions = |p: &Vec3| [1.0 + p[0] - 2.0 * p[1], 0.25 * p[2], 7.0];
    let values: Vec<f64> = mesh.vertices().iter().flat_map(functions).collect();
    let found = transfer_vertex_values(&mesh, &quads, 3, &values, &mut monitor()).unwrap();
    for (found, p) in found.as_chunks::<3>().0.iter().zip(&quads.vertices) {
        let expected = functions(p);
        for k in 0..3 {
            assert!(
                (found[k] - expected[k]).abs() <= 1e-12,
                "{found:?} {expected:?}"
            );
        }
        // Constants are exact.
        assert_eq!(found[2], 7.0);
    }
    let corner = |face: usize| {
        mesh.corner_positions(face)
            .into_iter()
            .flat_map(|p| functions(&p))
    };
    let values: Vec<f64> = (0..mesh.face_count()).flat_map(corner).collect();
    let found = transfer_corner_values(&mesh, &quads, 3, &values, &mut monitor()).unwrap();
    let corners = quads.quads.as_flattened();
    for (found, &v) in found.as_chunks::<3>().0.iter().zip(corners) {
        let expected = functions(&quads.vertices[v as usize]);
        for k in 0..3 {
            assert!((found[k] - expected[k]).abs() <= 1e-12);
        }
    }
}

#[test]
fn values_stay_within_those_of_the_triangle() {
    let mesh = by_name("genus-2", 1_000).unwrap();
    let quads = grid(9, |s, t| {
        [4.0 * s - 2.0, 4.0 * t - 2.0, (7.0 * s * t).sin()]
    });
    let mut x = 0.37;
    let mut random = || {
        x = (x * 977.13_f64).fract();
        x
    };
    let values: Vec<f64> = (0..4 * mesh.vertex_count()).map(|_| random()).collect();
    let found = transfer_vertex_values(&mesh, &quads, 4, &values, &mut monitor()).unwrap();
    let places = Nearest::new(&mesh, &quads).unwrap().places().unwrap();
    for (v, (face, weights)) in places.into_iter().enumerate() {
        assert!(weights.iter().all(|&w| w >= 0.0));
        for k in 0..4 {
            let three = mesh.corners(face).map(|corner| values[4 * corner + k]);
            let least = three.into_iter().fold(f64::INFINITY, f64::min);
            let most = three.into_iter().fold(f64::NEG_INFINITY, f64::max);
            assert!((least..=most).contains(&found[4 * v + k]));
        }
    }
}

#[test]
fn a_label_is_that_of_most_of_the_area() {
    // Triangles left of x = 0.5 are 4, those on the right 9.
    let flat = |s: f64, t: f64| [s, t, 0.0];
    let mesh = triangles(10, flat);
    let is_left = |face: usize| mesh.face_centroid(face)[0] < 0.5;
    let labels: Vec<u32> = (0..mesh.face_count())
        .map(|f| if is_left(f) { 4 } else { 9 })
        .collect();
    let label = |from: f64, to: f64| {
        let quads = grid(1, |s, t| [from + (to - from) * s, t, 0.01]);
        transfer_face_labels(&mesh, &quads, &labels, &mut monitor()).unwrap()
    };
    assert_eq!(label(0.0, 0.5), [4]);
    assert_eq!(label(0.5, 1.0), [9]);
    assert_eq!(label(0.1, 0.7), [4]);
    assert_eq!(label(0.3, 0.9), [9]);
    // Of as much of both the lower one.
    assert_eq!(label(0.25, 0.75), [4]);
}

#[test]
fn both_sides_of_a_thin_plate_keep_their_values() {
    // The sides are 1e-3 apart, and the quads lie nearer to the wrong one.
    let top = triangles(6, |s, t| [s, t, 1e-3]);
    let bottom = triangles(6, |s, t| [t, s, 0.0]);
    let count = top.vertex_count() as u32;
    let vertices = [top.vertices(), bottom.vertices()].concat();
    let below = bottom.triangles().iter().map(|t| t.map(|v| v + count));
    let faces = top.triangles().iter().copied().chain(below).collect();
    let mesh = TriangleMesh::new(vertices, faces).unwrap();
    let upper = top.face_count();
    let labels: Vec<u32> = (0..mesh.face_count())
        .map(|f| u32::from(f >= upper))
        .collect();
    let heights: Vec<f64> = mesh
        .vertices()
        .iter()
        .map(|p| f64::from(p[2] > 0.0))
        .collect();
    for (side, quads) in [grid(4, |s, t| [s, t, 1e-4]), grid(4, |s, t| [t, s, 9e-4])]
        .iter()
        .enumerate()
    {
        let found = transfer_face_labels(&mesh, quads, &labels, &mut monitor()).unwrap();
        assert!(found.iter().all(|&label| label as usize == side));
        let found = transfer_vertex_values(&mesh, quads, 1, &heights, &mut monitor()).unwrap();
        assert!(found.iter().all(|&height| height == 1.0 - side as f64));
    }
}

/// A cylinder about z with `n` triangles around, twice, of which texture coordinates go from 0 to 1 around, and are cut
/// along one line.
fn cylinder(n: u32) -> (TriangleMesh, Vec<f64>) {
    let around = |i: u32, z: f64| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        [angle.cos(), angle.sin(), z]
    };
    let vertices =
        (0..=n).flat_map(|j| (0..n).map(move |i| around(i, f64::from(j) / f64::from(n))));
    let mut faces = Vec::new();
    let mut uv = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let vertex = |i: u32, j: u32| j * n + i % n;
            let at = |i: u32, j: u32| [f64::from(i) / f64::from(n), f64::from(j) / f64::from(n)];
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            for half in [[0, 1, 2], [0, 2, 3]] {
                faces.push(half.map(|k: usize| vertex(corners[k].0, corners[k].1)));
                uv.extend(half.iter().flat_map(|&k| at(corners[k].0, corners[k].1)));
            }
        }
    }
    (TriangleMesh::new(vertices.collect(), faces).unwrap(), uv)
}

#[test]
fn no_quad_has_texture_coordinates_of_both_sides_of_a_seam() {
    // Both sides of the seam belong to one chart. The quads end at it, or lie across it.
    let (mesh, uv) = cylinder(48);
    for shift in [0.0, 0.25, 0.5, 0.8] {
        let n = 12;
        let quads = grid(n, |s, t| {
            let angle = std::f64::consts::TAU * (s + shift / f64::from(n));
            [angle.cos(), angle.sin(), t]
        });
        let found = transfer_corner_values(&mesh, &quads, 2, &uv, &mut monitor()).unwrap();
        for (quad, uv) in quads.quads.iter().zip(found.as_chunks::<8>().0) {
            let u = [uv[0], uv[2], uv[4], uv[6]];
            let least = u.into_iter().fold(f64::INFINITY, f64::min);
            let most = u.into_iter().fold(0.0, f64::max);
            let width = most - least;
            assert!(
                width > 0.4 / 12.0 && width < 1.001 / 12.0,
                "{shift} {quad:?} {u:?}"
            );
            // Away from the seam the coordinates are those of the angle, which the facets change a little.
            for (k, &v) in quad.iter().enumerate() {
                let [x, y, z] = quads.vertices[v as usize];
                let angle = y.atan2(x).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
                assert!((uv[2 * k + 1] - z).abs() < 1e-12);
                if (0.1..0.9).contains(&angle) {
                    assert!((u[k] - angle).abs() < 1e-3, "{} {angle}", u[k]);
                }
            }
        }
        if shift == 0.0 {
            let area: f64 = found.as_chunks::<8>().0.iter().map(|uv| area_of(*uv)).sum();
            assert!((area - 1.0).abs() < 1e-12, "{area}");
        }
    }
}

/// The signed area of a quad in the plane.
fn area_of(uv: [f64; 8]) -> f64 {
    let across = [uv[4] - uv[0], uv[5] - uv[1], uv[6] - uv[2], uv[7] - uv[3]];
    0.5 * (across[0] * across[3] - across[1] * across[2])
}

#[test]
fn corners_where_a_seam_ends_are_on_the_side_of_their_quad() {
    // A slit from the left to the middle of a square: v jumps by 10 across it.
    let flat = |s: f64, t: f64| [s, t, 0.0];
    let mesh = triangles(8, flat);
    let jump = |face: usize, p: Vec3| {
        let center = mesh.face_centroid(face);
        let is_above = center[1] > 0.5 && center[0] < 0.5 && p[0] < 0.5;
        if is_above { 10.0 * (0.5 - p[0]) } else { 0.0 }
    };
    let of_face = |face: usize| mesh.corner_positions(face).map(|p| p[1] + jump(face, p));
    let values: Vec<f64> = (0..mesh.face_count()).flat_map(of_face).collect();
    let quads = grid(4, flat);
    let found = transfer_corner_values(&mesh, &quads, 1, &values, &mut monitor()).unwrap();
    for (quad, values) in quads.quads.iter().zip(found.as_chunks::<4>().0) {
        let points = quad.map(|v| quads.vertices[v as usize]);
        let center = points
            .iter()
            .fold([0.0; 2], |[x, y], p| [x + p[0] / 4.0, y + p[1] / 4.0]);
        for (p, value) in points.iter().zip(values) {
            let is_above = center[0] < 0.5 && center[1] > 0.5;
            let slit = if is_above { 10.0 * (0.5 - p[0]) } else { 0.0 };
            assert!(
                (value - p[1] - slit).abs() < 1e-12,
                "{center:?} {p:?} {value}"
            );
        }
    }
}

#[test]
fn what_has_no_value_gives_none() {
    let flat = |s: f64, t: f64| [s, t, 0.0];
    let mesh = triangles(8, flat);
    let quads = grid(4, flat);
    let is_left = |x: f64| x < 0.5;
    let of_face = |face: usize| {
        let x = mesh.face_centroid(face)[0];
        [if is_left(x) { f64::NAN } else { x }; 3]
    };
    let values: Vec<f64> = (0..mesh.face_count()).flat_map(of_face).collect();
    let found = transfer_corner_values(&mesh, &quads, 1, &values, &mut monitor()).unwrap();
    for (quad, values) in quads.quads.iter().zip(found.as_chunks::<4>().0) {
        let lowest = quads.vertices[quad[0] as usize][0];
        assert!(values.iter().all(|value| value.is_nan() == is_left(lowest)));
    }
    let values: Vec<f64> = mesh
        .vertices()
        .iter()
        .map(|p| if p[0] > 0.9 { f64::NAN } else { p[1] })
        .collect();
    let found = transfer_vertex_values(&mesh, &quads, 1, &values, &mut monitor()).unwrap();
    for (p, value) in quads.vertices.iter().zip(found) {
        assert_eq!(value.is_nan(), p[0] > 0.9, "{p:?}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mesh = by_name("genus-2", 3_000).unwrap();
    let quads = grid(40, |s, t| [4.0 * s - 2.0, 4.0 * t - 2.0, (9.0 * s).sin()]);
    let values: Vec<f64> = mesh.vertices().iter().map(|p| p[0].sin() + p[2]).collect();
    let corners: Vec<f64> = mesh
        .triangles()
        .iter()
        .flatten()
        .map(|&v| values[v as usize])
        .collect();
    let labels: Vec<u32> = (0..mesh.face_count() as u32).map(|f| f / 7).collect();
    let found = |threads| {
        with_threads(threads, || {
            let labels = transfer_face_labels(&mesh, &quads, &labels, &mut monitor()).unwrap();
            let vertices =
                transfer_vertex_values(&mesh, &quads, 1, &values, &mut monitor()).unwrap();
            let corners =
                transfer_corner_values(&mesh, &quads, 1, &corners, &mut monitor()).unwrap();
            (labels, vertices, corners)
        })
    };
    assert_eq!(found(1), found(3));
}

#[test]
fn input_that_does_not_fit_is_refused() {
    let flat = |s: f64, t: f64| [s, t, 0.0];
    let (mesh, quads) = (triangles(2, flat), grid(1, flat));
    let labels = |labels: &[u32]| transfer_face_labels(&mesh, &quads, labels, &mut monitor());
    assert_eq!(labels(&[0; 7]).unwrap_err().code(), "length_mismatch");
    let vertices =
        |size, values: &[f64]| transfer_vertex_values(&mesh, &quads, size, values, &mut monitor());
    assert_eq!(
        vertices(1, &[0.0; 8]).unwrap_err().code(),
        "length_mismatch"
    );
    assert_eq!(
        vertices(2, &[0.0; 9]).unwrap_err().code(),
        "length_mismatch"
    );
    assert_eq!(vertices(0, &[]).unwrap_err().code(), "invalid_argument");
    assert_eq!(
        vertices(usize::MAX, &[0.0; 9]).unwrap_err().code(),
        "length_mismatch"
    );
    let mut values = [0.0; 18];
    values[7] = f64::INFINITY;
    let error = vertices(2, &values).unwrap_err();
    assert_eq!((error.code(), error.index()), ("not_finite", Some(3)));
    let corners = |values: &[f64]| transfer_corner_values(&mesh, &quads, 1, values, &mut monitor());
    assert_eq!(corners(&[0.0; 23]).unwrap_err().code(), "length_mismatch");
    let mut values = [0.0; 24];
    values[5] = f64::NEG_INFINITY;
    assert_eq!(corners(&values).unwrap_err().index(), Some(5));
    let token = CancelToken::new();
    token.cancel();
    let cancelled = &mut Monitor::default().cancel_token(token);
    let error = transfer_face_labels(&mesh, &quads, &[0; 8], cancelled).unwrap_err();
    assert_eq!(error.code(), "cancelled");
    let attributes = SurfaceAttributes {
        uv: Some(vec![[0.0; 2]; 23]),
        ..SurfaceAttributes::default()
    };
    let error = transfer_attributes(&mesh, &quads, &attributes, &mut monitor()).unwrap_err();
    assert_eq!(error.code(), "length_mismatch");
}
