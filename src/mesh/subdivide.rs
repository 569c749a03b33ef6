//! Midpoint subdivision: every face becomes four similar ones, and the surface stays the same.

use super::vector::{add, scale};
use super::{MeshError, TriangleMesh};

/// Splits every face at the midpoints of its edges.
///
/// Vertices keep their numbers, edge `e` gets vertex `vertex_count + e`; face `f` becomes
/// 4 f + k at its corners `k` (each starting at that corner, so first edges keep their
/// direction at corner 0) and 4 f + 3 in the middle.
///
/// # Errors
///
/// [`MeshError::TooLarge`]; [`MeshError::ZeroArea`] where a needle cannot be halved any more.
pub fn subdivide(mesh: &TriangleMesh) -> Result<TriangleMesh, MeshError> {
    let count = mesh.vertex_count();
    let mut vertices = mesh.vertices().to_vec();
    vertices.extend(mesh.edges().map(|edge| {
        let [a, b] = edge.vertices.map(|v| mesh.position(v));
        scale(add(a, b), 0.5)
    }));
    if vertices.len() >= u32::MAX as usize {
        return Err(MeshError::TooLarge {
            vertices: vertices.len(),
            faces: 4 * mesh.face_count(),
        });
    }
    let mut triangles = Vec::with_capacity(4 * mesh.face_count());
    for (face, &[a, b, c]) in mesh.triangles().iter().enumerate() {
        let [ab, bc, ca] = [0, 1, 2].map(|k| (count + mesh.edge_of(face, k)) as u32);
        triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    TriangleMesh::new(vertices, triangles)
}
