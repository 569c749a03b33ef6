//! Elements that rounding has collapsed or turned over, and the constraints that separate them.
//!
//! Integers that collapse an element ([`super::held_elements`]) are decided anew under separation
//! constraints. For two cones the constraint applies to the coordinate in which the path between them
//! should be longest. It asks for the rounded length of the path, and for one unit at least. For a face
//! the constraints ask for the nearest counter-clockwise triangle whose sides have coordinates -1, 0 and
//! 1. Corners of a face between isolines are kept one unit apart.

use super::held_elements::{HeldElements, NearCones};
use super::isoline_triangles::IsolineTriangle;
use crate::linalg::DisjointSets;
use crate::map::{SeamlessMap, SeamlessProblem, SeparationConstraint};
use crate::mesh::TriangleMesh;
use crate::mesh::orientation;

/// The elements that the integers of a map collapse.
pub(crate) struct Collapsed {
    /// Pairs of cones that lie at one point or are in the wrong order.
    pairs: Vec<NearCones>,
    /// Faces of three cones or corners, no two at one point, that are collinear or clockwise.
    faces: Vec<usize>,
    /// Faces between isolines that the integers collapse or turn over.
    isoline_triangles: Vec<IsolineTriangle>,
}

impl Collapsed {
    /// Finds the collapsed elements of a map.
    pub(crate) fn find(elements: &HeldElements, map: &SeamlessMap) -> Self {
        let uv = map.vertex_uvs();
        let is_collapsed = |pair: &&NearCones| {
            let [a, b] = pair.copies.map(|c| uv[c as usize]);
            let along = [0, 1].map(|i| (b[i] - a[i]).round());
            along[0] * pair.aim[0] + along[1] * pair.aim[1] <= 0.0
        };
        let is_lost = |&&face: &&usize| {
            let at = map.uv(face).map(|p| p.map(f64::round));
            let is_short = |k: usize| at[k] == at[(k + 1) % 3];
            !(0..3).any(is_short) && orientation(at) <= 0.0
        };
        let is_wrong = |face: &&IsolineTriangle| face.wrong(map).is_some();
        let triangles = elements.isoline_triangles.iter();
        Collapsed {
            pairs: elements
                .pairs
                .iter()
                .filter(is_collapsed)
                .copied()
                .collect(),
            faces: elements.faces.iter().filter(is_lost).copied().collect(),
            isoline_triangles: triangles.filter(is_wrong).copied().collect(),
        }
    }

    /// The number of collapsed elements.
    pub(crate) fn count(&self) -> usize {
        self.pairs.len() + self.faces.len() + self.isoline_triangles.len()
    }

    /// The constraints that separate them.
    ///
    /// No two vertices are joined twice, so that these constraints seldom contradict each other. They may
    /// contradict those of earlier rounds.
    pub(crate) fn separation(
        &self,
        mesh: &TriangleMesh,
        problem: &SeamlessProblem,
        map: &SeamlessMap,
    ) -> Vec<SeparationConstraint> {
        let mut joined = DisjointSets::new(mesh.vertex_count());
        let mut found = Vec::new();
        for &face in &self.faces {
            let [a, b, c] = mesh.corners(face);
            if joined.join(a, b) && joined.join(a, c) {
                let aims = [1, 2].map(|end| problem.aim(mesh, face, 0, end));
                let [first, second, third] = problem.sectors.copy[face];
                let [ab, ac] = units(aims[0], aims[1]);
                for axis in 0..2 {
                    found.push(SeparationConstraint::new([first, second], axis, ab[axis]));
                    found.push(SeparationConstraint::new([first, third], axis, ac[axis]));
                }
            }
        }
        for triangle in &self.isoline_triangles {
            let Some((ends, aim)) = triangle.wrong(map) else {
                continue;
            };
            let [a, b] = ends.map(|k| mesh.corners(triangle.face)[k]);
            if joined.join(a, b) {
                let copies = ends.map(|k| problem.sectors.copy[triangle.face][k]);
                let by = 1f64.copysign(aim);
                found.push(SeparationConstraint::new(copies, triangle.axis, by));
            }
        }
        for pair in &self.pairs {
            let [a, b] = pair.vertices.map(|v| v as usize);
            if joined.join(a, b) {
                let axis = usize::from(pair.aim[1].abs() > pair.aim[0].abs());
                let aim = pair.aim[axis];
                let by = aim.abs().round().max(1.0).copysign(aim);
                found.push(SeparationConstraint::new(pair.copies, axis, by));
            }
        }
        found
    }
}

/// The two vectors nearest to the given ones whose entries are -1, 0 or 1, with the second to the left of
/// the first.
fn units(first: [f64; 2], second: [f64; 2]) -> [[f64; 2]; 2] {
    let entries =
        (0..81).map(|n: i32| [n / 27, n / 9 % 3, n / 3 % 3, n % 3].map(|e| f64::from(e - 1)));
    let left = entries.filter(|[a, b, c, d]| a * d - b * c > 0.0);
    let aim = [first[0], first[1], second[0], second[1]];
    let distance = |e: &[f64; 4]| (0..4).map(|i| (e[i] - aim[i]).powi(2)).sum::<f64>();
    let nearest = left.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let [a, b, c, d] = nearest.unwrap_or([1.0, 0.0, 0.0, 1.0]);
    [[a, b], [c, d]]
}

#[cfg(test)]
#[path = "collapsed_tests.rs"]
mod on_flat_meshes;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_the_right_way_round_and_near() {
        assert_eq!(units([0.9, 0.2], [-0.1, 1.2]), [[1.0, 0.0], [0.0, 1.0]]);
        for n in 0..50 {
            let aim = [0, 1, 2, 3].map(|i| f64::from(n * 4 + i).sin());
            let [[a, b], [c, d]] = units([aim[0], aim[1]], [aim[2], aim[3]]);
            assert!(a * d - b * c > 0.0);
        }
    }
}
