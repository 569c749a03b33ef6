//! Features that quads have lost.

use crate::extract::QuadMesh;
use crate::mesh::vector::{add, dot, norm, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};

/// How far the middle of a feature may be from the edges of quads, in mean lengths of those: more
/// than an arc of one quad is off its chord, less than the next line is away.
const FAR: f64 = 0.25;

/// The features, by number of the edge, whose middle is far from all edges of quads.
pub(super) fn missed(mesh: &TriangleMesh, quads: &QuadMesh, features: &[usize]) -> Vec<usize> {
    if features.is_empty() {
        return Vec::new();
    }
    let mut segments = Vec::new();
    for face in quads.faces() {
        let ends = face.iter().zip(face.iter().cycle().skip(1));
        segments.extend(ends.map(|(&a, &b)| {
            let [a, b] = [a, b].map(|v| quads.vertices[v as usize]);
            [a, b, b]
        }));
    }
    let lengths = segments.iter().map(|[a, b, _]| norm(sub(*b, *a)));
    let far = FAR * lengths.sum::<f64>() / segments.len().max(1) as f64;
    let tree = ClosestPoint::of_triangles(segments);
    let is_missed = |&feature: &usize| {
        let [a, b] = mesh.edge(feature).vertices.map(|v| mesh.position(v));
        let middle = scale(add(a, b), 0.5);
        tree.find(middle, None).is_none_or(|(_, point)| {
            let off = sub(point, middle);
            dot(off, off) > far * far
        })
    };
    features.iter().copied().filter(is_missed).collect()
}
