//! Faces between isolines: all three corners lie on features or the boundary, with an integer value in
//! one coordinate.
//!
//! In most of these faces two corners lie on one isoline and the third lies on another. The integers
//! alone decide on which side of the first isoline the other one is. If it is on the wrong side, or if
//! both are the same isoline, the face is turned over or flat wherever the other vertices move.

use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;

/// A face between isolines, the coordinate, and the difference that it should have from each corner to
/// the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct IsolineTriangle {
    pub face: usize,
    pub axis: usize,
    aim: [f64; 3],
}

impl IsolineTriangle {
    /// Two corners whose integers must differ by another amount than in this map, and that amount; `None`
    /// if the face is right. If all corners are on one isoline, they are the two that should be farthest
    /// apart. Otherwise they are an end of the edge on an isoline and the corner on the wrong side of it.
    pub fn wrong(&self, map: &SeamlessMap) -> Option<([usize; 2], f64)> {
        self.wrong_at(map.uv(self.face).map(|p| p[self.axis].round()))
    }

    fn wrong_at(&self, at: [f64; 3]) -> Option<([usize; 2], f64)> {
        let ahead = |k: usize| (k + 1) % 3;
        if at[0] == at[1] && at[0] == at[2] {
            let size = |k: &usize| self.aim[*k].abs();
            let across = (0..3).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            return Some(([across, ahead(across)], self.aim[across]));
        }
        let along = (0..3).find(|&k| at[k] == at[ahead(k)])?;
        let apex = ahead(ahead(along));
        let aim = 0.5 * (self.aim[ahead(along)] - self.aim[apex]);
        ((at[apex] - at[along]) * aim < 0.0).then_some(([along, apex], aim))
    }
}

impl SeamlessProblem {
    /// All faces between isolines, once per coordinate, in increasing order. `held` says which
    /// coordinates of every copy integers hold.
    pub(super) fn isoline_triangles(
        &self,
        mesh: &TriangleMesh,
        held: &[[bool; 2]],
    ) -> Vec<IsolineTriangle> {
        let mut found = Vec::new();
        for face in 0..mesh.face_count() {
            let copies = self.sectors.copy[face];
            for axis in 0..2 {
                if copies.iter().all(|&c| held[c as usize][axis]) {
                    let aim = [0, 1, 2].map(|k| self.aim(mesh, face, k, (k + 1) % 3)[axis]);
                    found.push(IsolineTriangle { face, axis, aim });
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first edge should nearly be an isoline, and the third corner 1.5 beyond it.
    const TRIANGLE: IsolineTriangle = IsolineTriangle {
        face: 0,
        axis: 0,
        aim: [0.2, 1.4, -1.6],
    };

    #[test]
    fn a_face_between_isolines_as_it_should_be_is_left_alone() {
        assert_eq!(TRIANGLE.wrong_at([4.0, 4.0, 5.0]), None);
        assert_eq!(TRIANGLE.wrong_at([4.0, 4.0, 7.0]), None);
        // Not decided by this coordinate.
        assert_eq!(TRIANGLE.wrong_at([4.0, 5.0, 3.0]), None);
    }

    #[test]
    fn a_corner_on_the_wrong_side_of_an_isoline_is_told_how_far_it_should_be() {
        assert_eq!(TRIANGLE.wrong_at([4.0, 4.0, 3.0]), Some(([0, 2], 1.5)));
        let turned = IsolineTriangle {
            aim: [-1.6, 0.2, 1.4],
            ..TRIANGLE
        };
        assert_eq!(turned.wrong_at([3.0, 4.0, 4.0]), Some(([1, 0], 1.5)));
    }

    #[test]
    fn a_face_on_one_isoline_is_opened_where_it_should_be_widest() {
        assert_eq!(TRIANGLE.wrong_at([4.0, 4.0, 4.0]), Some(([2, 0], -1.6)));
    }
}
