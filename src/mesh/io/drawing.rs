//! What a writer takes: positions and triangles, with or without colours, manifold or not.

use crate::mesh::TriangleMesh;
use crate::mesh::vector::Vec3;

/// Triangles to be written for a viewer. They need not form a mesh: arms of a cross may float.
#[derive(Debug, Clone, Copy, Default)]
pub struct Drawing<'a> {
    /// Positions.
    pub vertices: &'a [Vec3],
    /// Corners of the triangles.
    pub triangles: &'a [[u32; 3]],
    /// Red, green, blue of every vertex. OBJ, PLY and OFF hold them.
    pub vertex_colors: Option<&'a [[u8; 3]]>,
    /// A number for every vertex, such as a distance. PLY holds it, as `quality`, which MeshLab shows.
    pub vertex_quality: Option<&'a [f64]>,
    /// Red, green, blue of every triangle. PLY and OFF hold them.
    pub triangle_colors: Option<&'a [[u8; 3]]>,
}

impl<'a> From<&'a TriangleMesh> for Drawing<'a> {
    fn from(mesh: &'a TriangleMesh) -> Self {
        Drawing {
            vertices: mesh.vertices(),
            triangles: mesh.triangles(),
            ..Drawing::default()
        }
    }
}
