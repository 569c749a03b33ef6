//! Geodesic sphere and disk: triangular grids of even size.

use std::f64::consts::TAU;

use super::quads::weld;
use crate::mesh::vector::{Vec3, add, normalize, scale};
use crate::mesh::{MeshError, TriangleMesh};

/// The icosahedron, every face in `f`^2 triangles, on the unit sphere: 20 f^2 triangles.
pub(super) fn sphere(target: usize) -> Result<TriangleMesh, MeshError> {
    let f = nearest_square(target, 20);
    let (corners, faces) = icosahedron();
    let mut points = Vec::with_capacity(10 * (f + 1) * (f + 2));
    let mut triangles = Vec::with_capacity(20 * f * f);
    for face in faces {
        let [a, b, c] = face.map(|v| corners[v]);
        let base = points.len();
        let at = |i: usize, j: usize| (base + j * (2 * f + 3 - j) / 2 + i) as u32;
        for j in 0..=f {
            for i in 0..=f - j {
                let part = add(
                    scale(a, (f - i - j) as f64),
                    add(scale(b, i as f64), scale(c, j as f64)),
                );
                points.push(normalize(part));
            }
        }
        for j in 0..f {
            for i in 0..f - j {
                triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j + 1 < f {
                    triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
    }
    let (points, number) = weld(&points);
    let renumber = |t: [u32; 3]| t.map(|v| number[v as usize]);
    TriangleMesh::new(points, triangles.into_iter().map(renumber).collect())
}

/// The unit disk in the plane z = 0: rings of 6 k points around the centre, 6 f^2 triangles.
pub(super) fn disk(target: usize) -> Result<TriangleMesh, MeshError> {
    let f = nearest_square(target, 6);
    let mut points = vec![[0.0; 3]];
    for ring in 1..=f {
        let radius = ring as f64 / f as f64;
        points.extend((0..6 * ring).map(|i| {
            let (sin, cos) = (TAU * i as f64 / (6 * ring) as f64).sin_cos();
            [radius * cos, radius * sin, 0.0]
        }));
    }
    let at = |ring: usize, i: usize| match ring {
        0 => 0,
        _ => (1 + 3 * ring * (ring - 1) + i % (6 * ring)) as u32,
    };
    let mut triangles = Vec::with_capacity(6 * f * f);
    for ring in 1..=f {
        for sector in 0..6 {
            for i in 0..ring {
                let (outer, inner) = (sector * ring + i, sector * (ring - 1) + i);
                triangles.push([at(ring - 1, inner), at(ring, outer), at(ring, outer + 1)]);
                if i + 1 < ring {
                    let across = at(ring - 1, inner + 1);
                    triangles.push([at(ring - 1, inner), at(ring, outer + 1), across]);
                }
            }
        }
    }
    TriangleMesh::new(points, triangles)
}

/// The f of at least 1 for which `unit` f^2 is nearest to the target.
pub(super) fn nearest_square(target: usize, unit: usize) -> usize {
    let low = ((target / unit) as f64).sqrt().floor() as usize;
    let distance = |f: &usize| (unit * f * f).abs_diff(target);
    (low.max(1)..=low + 1).min_by_key(distance).unwrap_or(1)
}

fn icosahedron() -> ([Vec3; 12], [[usize; 3]; 20]) {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let corners = [
        [-1.0, g, 0.0],
        [1.0, g, 0.0],
        [-1.0, -g, 0.0],
        [1.0, -g, 0.0],
        [0.0, -1.0, g],
        [0.0, 1.0, g],
        [0.0, -1.0, -g],
        [0.0, 1.0, -g],
        [g, 0.0, -1.0],
        [g, 0.0, 1.0],
        [-g, 0.0, -1.0],
        [-g, 0.0, 1.0],
    ];
    #[rustfmt::skip]
    let faces = [
        [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
        [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
        [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
        [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
    ];
    (corners, faces)
}
