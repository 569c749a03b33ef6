//! Cones that rounding has put on top of each other, held apart.
//!
//! Two cones that an edge joins cannot lie at one point, nor three of a face on one line: whatever
//! else moves, the faces there stay without area. Such integers are decided anew with the cones held
//! apart by constraints: along the coordinate in which the edge should be longest by one unit, or,
//! for a face, by the nearest triangle of units that is the right way round.

use crate::mesh::TriangleMesh;
use crate::mesh::vector::{dot, sub};
use crate::quad::check::orientation;
use crate::quad::{SeamlessMap, SeamlessProblem};
use crate::{Problem, Result};

/// What the integers of cones collapse.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Collapsed {
    /// Edges whose two ends are cones at one point, in increasing order.
    pub edges: Vec<usize>,
    /// Faces of three cones, no two at one point, that are collinear or clockwise.
    pub faces: Vec<usize>,
}

impl Collapsed {
    /// What is collapsed in a map of this mesh.
    pub fn find(mesh: &TriangleMesh, map: &SeamlessMap) -> Self {
        let mut is_cone = vec![false; mesh.vertex_count()];
        map.cones().iter().for_each(|&v| is_cone[v] = true);
        let is_collapsed = |&e: &usize| {
            let edge = mesh.edge(e);
            let (face, k) = edge.first;
            let uv = map.uv(face);
            let (a, b) = (uv[k], uv[(k + 1) % 3]);
            // Both at integers, which are equal or far apart.
            edge.vertices.iter().all(|&v| is_cone[v]) && (a[0] - b[0]).hypot(a[1] - b[1]) < 0.5
        };
        let edges: Vec<usize> = (0..mesh.edge_count()).filter(is_collapsed).collect();
        let is_lost = |&face: &usize| {
            let corners = mesh.corners(face);
            let is_short = |k: usize| edges.binary_search(&mesh.edge_of(face, k)).is_ok();
            corners.iter().all(|&v| is_cone[v])
                && !(0..3).any(is_short)
                && orientation(map.uv(face).map(|p| p.map(f64::round))) <= 0.0
        };
        let faces = (0..mesh.face_count()).filter(is_lost).collect();
        Collapsed { edges, faces }
    }

    /// How many elements.
    pub fn count(&self) -> usize {
        self.edges.len() + self.faces.len()
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty() && self.faces.is_empty()
    }
}

/// A constraint between two coordinates: the second is by so much larger than the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Apart {
    unknowns: [usize; 2],
    by: f64,
}

impl Apart {
    pub fn add_to(&self, problem: &mut Problem) -> Result<()> {
        let [a, b] = self.unknowns;
        problem.add_constraint(&[b, a], &[1.0, -1.0], self.by)?;
        Ok(())
    }
}

impl SeamlessProblem {
    /// The constraints that hold collapsed cones apart.
    ///
    /// No two cones are joined twice, so that they seldom contradict each other; constraints of
    /// earlier rounds they may.
    pub(super) fn apart(&self, mesh: &TriangleMesh, collapsed: &Collapsed) -> Vec<Apart> {
        let mut joined = Joined((0..mesh.vertex_count() as u32).collect());
        let mut found = Vec::new();
        for &face in &collapsed.faces {
            let [a, b, c] = mesh.corners(face);
            if joined.join(a, b) && joined.join(a, c) {
                let [ab, ac] = units(self.aim(mesh, face, 0, 1), self.aim(mesh, face, 0, 2));
                for axis in 0..2 {
                    found.push(self.hold_apart(face, [0, 1], axis, ab[axis]));
                    found.push(self.hold_apart(face, [0, 2], axis, ac[axis]));
                }
            }
        }
        for &e in &collapsed.edges {
            let edge = mesh.edge(e);
            let (face, k) = edge.first;
            if joined.join(edge.vertices[0], edge.vertices[1]) {
                let aim = self.aim(mesh, face, k, (k + 1) % 3);
                let axis = usize::from(aim[1].abs() > aim[0].abs());
                let unit = 1f64.copysign(aim[axis]);
                found.push(self.hold_apart(face, [k, (k + 1) % 3], axis, unit));
            }
        }
        found
    }

    /// By how much the coordinates of two corners of a face should differ.
    fn aim(&self, mesh: &TriangleMesh, face: usize, from: usize, to: usize) -> [f64; 2] {
        let corners = mesh.corner_positions(face);
        let step = sub(corners[to], corners[from]);
        self.targets(mesh, face).map(|target| dot(target, step))
    }

    fn hold_apart(&self, face: usize, ends: [usize; 2], axis: usize, by: f64) -> Apart {
        let unknowns = ends.map(|k| 2 * self.sectors.copy[face][k] as usize + axis);
        Apart { unknowns, by }
    }
}

/// The two vectors of entries -1, 0 and 1, the second to the left of the first, that are nearest to
/// these.
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

/// Which vertices are joined already: union-find with path halving.
struct Joined(Vec<u32>);

impl Joined {
    fn root(&mut self, v: usize) -> usize {
        let mut v = v;
        while self.0[v] as usize != v {
            self.0[v] = self.0[self.0[v] as usize];
            v = self.0[v] as usize;
        }
        v
    }

    /// Whether they were not joined before.
    fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a] = b as u32;
        a != b
    }
}

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

    #[test]
    fn vertices_are_joined_once() {
        let mut joined = Joined((0..4).collect());
        assert!(joined.join(0, 1) && joined.join(2, 3) && joined.join(1, 2));
        assert!(!joined.join(0, 3));
    }
}
