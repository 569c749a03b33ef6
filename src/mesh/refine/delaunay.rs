//! Delaunay flips (`lawson1977`): an edge is flipped where the corner beyond it lies inside the
//! circumcircle, which is decided exactly (`shewchuk1997`) by the crate `robust`.

use robust::{Coord, incircle};

use super::working_mesh::{WorkingMesh, next, previous};

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
        let points = self.in_plane(self.region(half / 3), [a, b, c, d]);
        let [a, b, c, d] = points.map(|[x, y]| Coord { x, y });
        incircle(a, b, c, d) <= 0.0
    }
}
