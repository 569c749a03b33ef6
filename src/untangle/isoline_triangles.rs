//! Faces between isolines: all corners on features or the boundary, of integer value in one coordinate.
//!
//! Two corners of such a face are mostly on one isoline and the third is on another. Which side of the
//! first the other is on is for the integers alone: on the wrong one, or on the same isoline, the face is
//! turned over or flat whatever else moves.

use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;

/// Such a face, its coordinate, and by how much that should differ from each corner to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct IsolineTriangle {
    pub face: usize,
    pub axis: usize,
    aim: [f64; 3],
}

impl IsolineTriangle {
    /// The two corners, if any, between which integers must differ otherwise than in this map, and
    /// by how much they should: of a face on one isoline the two that should be farthest apart, and
    /// else an end of the edge on an isoline and the corner on the wrong side of it.
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
    /// All such faces, once per coordinate, in increasing order; `held` says which coordinates of every
    /// copy integers hold.
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

    /// The first edge should be an isoline nearly, the third corner 1.5 beyond it.
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
