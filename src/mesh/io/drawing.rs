//! What a writer takes: positions and triangles, with or without colours, manifold or not.

use crate::mesh::vector::Vec3;
use crate::mesh::{MeshError, TriangleMesh};

/// Triangles to be written for a viewer. They need not form a mesh: arms of a cross may float.
#[derive(Debug, Clone, Copy, Default)]
pub struct Drawing<'a> {
    /// Positions.
    pub vertices: &'a [Vec3],
    /// Corners of the triangles.
    pub triangles: &'a [[u32; 3]],
    /// Red, green, blue of every vertex.
    pub vertex_colors: Option<&'a [[u8; 3]]>,
    /// Red, green, blue of every triangle. OBJ has no place for them and leaves them out.
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

impl Drawing<'_> {
    pub(super) fn check(&self) -> Result<(), MeshError> {
        let vertices = self.vertices.len();
        fits("vertex", self.vertex_colors, vertices)?;
        fits("triangle", self.triangle_colors, self.triangles.len())?;
        for (face, corners) in self.triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
                return Err(MeshError::IndexOutOfRange {
                    face,
                    vertex: vertex.into(),
                    vertices,
                });
            }
        }
        Ok(())
    }
}

fn fits(what: &str, colors: Option<&[[u8; 3]]>, expected: usize) -> Result<(), MeshError> {
    match colors {
        Some(colors) if colors.len() != expected => Err(MeshError::InvalidArgument {
            what: format!("there are {} {what} colors, not {expected}", colors.len()),
        }),
        _ => Ok(()),
    }
}
