//! Patches of quadrangles, welded where they meet and split into triangles.

use crate::mesh::vector::{Vec3, norm, sub};
use crate::mesh::{MeshError, TriangleMesh};

/// A surface of quadrangles, counter-clockwise.
#[derive(Default)]
pub(super) struct Quads {
    pub(super) points: Vec<Vec3>,
    pub(super) quads: Vec<[u32; 4]>,
}

impl Quads {
    /// Adds the image of [0, 1]^2 under `position`, in `columns` times `rows` quadrangles.
    pub(super) fn add_patch(
        &mut self,
        columns: usize,
        rows: usize,
        position: impl Fn(f64, f64) -> Vec3,
    ) {
        let base = self.points.len();
        let at = |i: usize, j: usize| (base + j * (columns + 1) + i) as u32;
        for j in 0..=rows {
            let v = j as f64 / rows as f64;
            let row = (0..=columns).map(|i| position(i as f64 / columns as f64, v));
            self.points.extend(row);
        }
        for j in 0..rows {
            let row =
                (0..columns).map(|i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            self.quads.extend(row);
        }
    }

    /// Unites the points that patches share.
    pub(super) fn weld(self) -> Quads {
        let (points, number) = weld(&self.points);
        let renumber = |q: [u32; 4]| q.map(|v| number[v as usize]);
        Quads {
            points,
            quads: self.quads.into_iter().map(renumber).collect(),
        }
    }

    /// Splits every quadrangle along its shorter diagonal; a tie keeps the one from its first
    /// corner.
    pub(super) fn triangulate(self) -> Result<TriangleMesh, MeshError> {
        let length = |a: u32, b: u32| norm(sub(self.points[a as usize], self.points[b as usize]));
        let mut triangles = Vec::with_capacity(2 * self.quads.len());
        for &[a, b, c, d] in &self.quads {
            // Diagonals of equal length in theory must not be told apart by their rounding.
            if length(b, d) < length(a, c) * (1.0 - 1e-9) {
                triangles.extend([[a, b, d], [b, c, d]]);
            } else {
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        TriangleMesh::new(self.points, triangles)
    }
}

/// Unites points that are equal but for rounding: the points left, in order of their first
/// appearance, and the new number of each.
///
/// Shapes are a few units wide and their points at least 1e-4 apart. The cells are shifted by an
/// irrational part of their width, so that coordinates which are round numbers keep away from
/// the walls.
pub(super) fn weld(points: &[Vec3]) -> (Vec<Vec3>, Vec<u32>) {
    const CELL: f64 = 1e-7;
    const SHIFT: f64 = 0.381_966_011_250_105;
    let cell = |p: &Vec3| p.map(|x| (x / CELL + SHIFT).floor() as i64);
    let mut order: Vec<(_, u32)> = points.iter().map(cell).zip(0..).collect();
    order.sort_unstable();
    let mut first = vec![0; points.len()];
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        for &(_, i) in same {
            first[i as usize] = same[0].1;
        }
    }
    let mut kept = Vec::new();
    let mut number = vec![0u32; points.len()];
    for (i, &p) in points.iter().enumerate() {
        if first[i] as usize == i {
            number[i] = kept.len() as u32;
            kept.push(p);
        } else {
            number[i] = number[first[i] as usize];
        }
    }
    (kept, number)
}
