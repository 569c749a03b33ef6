//! Delaunay flips (`lawson1977`): an edge is flipped where the corner beyond it lies inside the
//! circumcircle.
//!
//! Splits in the middle make many squares, whose corners lie on one circle. An edge is flipped only where the
//! determinant of `shewchuk1997`, section 4.1, is above its rounding by far: what is flipped is then never
//! flipped back.

use super::working_mesh::{WorkingMesh, next, previous};

/// The least determinant for a flip, as a part of the sum of its terms without signs. Rounding is at most
/// 1e-15 of it.
const CLEARLY: f64 = 1e-12;

impl WorkingMesh<'_> {
    /// Flips edges around the new vertex `m`, a corner of `face`, until its triangles are Delaunay.
    pub(super) fn restore_delaunay(&mut self, m: u32, face: u32) {
        let corner = (0..3).find(|&k| self.triangles[face as usize][k] == m);
        let first = 3 * face + corner.map_or(0, |k| k as u32);
        let edges = self.around(first).map(next).collect();
        self.flip_to_delaunay(edges);
    }

    /// Flips these edges and those around them until all are Delaunay.
    pub(super) fn flip_to_delaunay(&mut self, mut open: Vec<u32>) {
        while let Some(half) = open.pop() {
            if self.is_held(half) || self.is_delaunay(half) {
                continue;
            }
            let faces = [half / 3, self.twin[half as usize] / 3];
            if self.flip(half) {
                let [f, g] = faces;
                open.extend([3 * f, 3 * f + 2, 3 * g, 3 * g + 1]);
            }
        }
    }

    fn is_delaunay(&self, half: u32) -> bool {
        let other = self.twin[half as usize];
        let [a, b] = self.ends(half);
        let [c, d] = [half, other].map(|h| self.tail(previous(h)));
        let [a, b, c, d] = self.in_plane(self.region(half / 3), [a, b, c, d]);
        !is_clearly_inside([a, b, c], d)
    }
}

/// Whether a point lies inside the circumcircle of a counter-clockwise triangle.
fn is_clearly_inside(triangle: [[f64; 2]; 3], d: [f64; 2]) -> bool {
    let [a, b, c] = triangle.map(|p| [p[0] - d[0], p[1] - d[1]]);
    let (mut sum, mut size) = (0.0, 0.0);
    for [p, q, r] in [[a, b, c], [b, c, a], [c, a, b]] {
        let lift = p[0] * p[0] + p[1] * p[1];
        let terms = [q[0] * r[1], q[1] * r[0]];
        sum += lift * (terms[0] - terms[1]);
        size += lift * (terms[0].abs() + terms[1].abs());
    }
    sum > CLEARLY * size
}
