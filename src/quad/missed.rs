//! Features that the quads miss.

use crate::extract::QuadMesh;
use crate::mesh::vector::{add, dot, norm, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};

/// The largest distance of a feature's middle from the edges of quads, in their mean length. It is more
/// than the distance of an arc of one quad from its chord, and less than that of the next line.
const FAR: f64 = 0.25;

/// The features, by edge number, whose middle is farther than that from all edges of quads.
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
