//! Folds that no motion can remove, because the integers alone collapse a triangle.
//!
//! Two causes are visible in one element: a face without positive area whose corners are all fixed by
//! integers, and an edge whose two ends are fixed at one point.

use super::freedom::Freedom;
use crate::mesh::TriangleMesh;
use crate::mesh::orientation;

/// Why faces stay folded.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Stuck {
    /// Faces that are not positively oriented and whose corners are all fixed.
    pub faces: Vec<usize>,
    /// Edges with both ends fixed at the same point.
    pub edges: Vec<usize>,
}

impl Stuck {
    /// The causes among these folded faces.
    pub fn find(mesh: &TriangleMesh, freedom: &Freedom, values: &[f64], folded: &[usize]) -> Self {
        let mut stuck = Stuck::default();
        for &face in folded {
            let copies = freedom.copies[face];
            let uv = copies.map(|c| [values[2 * c as usize], values[2 * c as usize + 1]]);
            let is_held = copies.map(|c| freedom.is_held(c));
            if is_held == [true; 3] && orientation(uv) <= 0.0 {
                stuck.faces.push(face);
            }
            for k in 0..3 {
                let next = (k + 1) % 3;
                // Both points have integer coordinates, so they are equal or far apart.
                let apart = (uv[k][0] - uv[next][0]).hypot(uv[k][1] - uv[next][1]);
                if is_held[k] && is_held[next] && apart < 0.5 {
                    stuck.edges.push(mesh.edge_of(face, k));
                }
            }
        }
        stuck.edges.sort_unstable();
        stuck.edges.dedup();
        stuck
    }
}
