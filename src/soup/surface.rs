//! The triangles that the steps of repair work on.

use super::area::has_no_area;
use super::edits::Edits;
use super::lists::NONE;
use crate::linalg::vector::{Vec3, cross, norm, sub};

/// Triangles on their way from the soup to the mesh. Until edges are cut, their corners are input vertices.
#[derive(Debug, Default)]
pub(super) struct Surface {
    pub(super) positions: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The corners before welding: faces that shared vertices in the soup fit each other best.
    pub(super) before: Vec<[u32; 3]>,
    /// The input polygon of each triangle, [`NONE`] for a triangle that repair made.
    pub(super) polygon: Vec<u32>,
    /// The input vertex of each vertex, [`NONE`] for a vertex that repair made.
    pub(super) origin: Vec<u32>,
    pub(super) edits: Edits,
}

impl Surface {
    pub(super) fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }

    pub(super) fn push(&mut self, triangle: [u32; 3], before: [u32; 3], polygon: u32) {
        self.triangles.push(triangle);
        self.before.push(before);
        self.polygon.push(polygon);
    }

    /// Keeps the triangles for which `keep` holds, in their order.
    pub(super) fn retain(&mut self, mut keep: impl FnMut(usize) -> bool) {
        let mut to = 0;
        for from in 0..self.triangles.len() {
            if keep(from) {
                self.triangles[to] = self.triangles[from];
                self.before[to] = self.before[from];
                self.polygon[to] = self.polygon[from];
                to += 1;
            }
        }
        self.triangles.truncate(to);
        self.before.truncate(to);
        self.polygon.truncate(to);
    }
}

/// Whether the strict mesh refuses the triangle, in this direction or turned: rounding may tell them apart.
pub(super) fn flat([a, b, c]: [Vec3; 3]) -> bool {
    has_no_area([a, b, c]) || has_no_area([a, c, b])
}

pub(super) fn area([a, b, c]: [Vec3; 3]) -> f64 {
    norm(cross(sub(b, a), sub(c, a))) / 2.0
}

/// The half-edge after this one in its triangle; half-edge 3 t + k runs from corner k of triangle t.
pub(super) fn next(half: u32) -> u32 {
    if half % 3 == 2 { half - 2 } else { half + 1 }
}

/// The half-edge before this one in its triangle.
pub(super) fn previous(half: u32) -> u32 {
    if half.is_multiple_of(3) {
        half + 2
    } else {
        half - 1
    }
}

/// The vertex from which a half-edge runs.
pub(super) fn tail(triangles: &[[u32; 3]], half: u32) -> u32 {
    triangles[half as usize / 3][half as usize % 3]
}

/// The vertex to which a half-edge runs.
pub(super) fn tip(triangles: &[[u32; 3]], half: u32) -> u32 {
    tail(triangles, next(half))
}

/// The fan of every corner around its vertex, and the number of fans; fans are numbered by their lowest
/// corner. The twins of all half-edges run against them.
pub(super) fn fans(twin: &[u32]) -> (Vec<u32>, u32) {
    let mut fan = vec![NONE; twin.len()];
    let mut count = 0;
    for first in 0..twin.len() as u32 {
        if fan[first as usize] != NONE {
            continue;
        }
        let mut corner = first;
        while corner != NONE && fan[corner as usize] == NONE {
            fan[corner as usize] = count;
            corner = twin[previous(corner) as usize];
        }
        let mut across = twin[first as usize];
        while across != NONE && fan[next(across) as usize] == NONE {
            fan[next(across) as usize] = count;
            across = twin[next(across) as usize];
        }
        count += 1;
    }
    (fan, count)
}
