//! Edges that must lie on integer isolines: features and the boundary.

use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cross, dot, norm};

/// The distance of an edge from the nearest line u = integer or v = integer: that of its farther end, in the
/// face where it is larger.
pub(super) fn distance_to_isoline(mesh: &TriangleMesh, uv: &[[[f64; 2]; 3]], edge: usize) -> f64 {
    let edge = mesh.edge(edge);
    let sides = std::iter::once(edge.first).chain(edge.second);
    sides.fold(0.0, |largest: f64, (face, k)| {
        let (a, b) = (uv[face][k], uv[face][(k + 1) % 3]);
        let along = |axis: usize| {
            let line = (0.5 * (a[axis] + b[axis])).round();
            (a[axis] - line).abs().max((b[axis] - line).abs())
        };
        largest.max(along(0).min(along(1)))
    })
}

/// The interior edges over which the normal turns by more than `angle` radians, increasing.
pub fn feature_edges(mesh: &TriangleMesh, angle: f64) -> Vec<usize> {
    let is_sharp = |&e: &usize| {
        let edge = mesh.edge(e);
        let Some((across, _)) = edge.second else {
            return false;
        };
        let [a, b] = [edge.first.0, across].map(|face| mesh.normal(face));
        let cosine = dot(a, b);
        norm(cross(a, b)).atan2(cosine) > angle
    };
    (0..mesh.edge_count()).filter(is_sharp).collect()
}
