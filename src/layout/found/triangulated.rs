//! Quads as triangles with a field: the lines of the quads are its crosses.
//!
//! Triangles `2 q` and `2 q + 1` are those of quad `q`, on both sides of the diagonal from its first corner. The arm
//! of both runs along its first edge.

use super::QuadSurface;
use crate::error::{Error, Result};
use crate::field::OrientationField;
use crate::mesh::vector::{Vec3, add, cross, dot, norm, normalize, sub};
use crate::mesh::{MeshError, TriangleMesh};

/// The triangles of quads, and the field of their lines.
pub(super) struct Triangulated {
    pub(super) mesh: TriangleMesh,
    pub(super) field: OrientationField,
}

impl Triangulated {
    /// # Errors
    /// [`MeshError::ZeroArea`] with the quad, for one that is no quadrangle in space.
    pub(super) fn new(surface: &QuadSurface) -> Result<Self> {
        let halves = |&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]];
        let triangles = surface.quads().iter().flat_map(halves).collect();
        let mesh = TriangleMesh::new(surface.positions().to_vec(), triangles);
        let mesh = mesh.map_err(|error| match error {
            MeshError::ZeroArea { face } => MeshError::ZeroArea { face: face / 2 },
            other => other,
        })?;
        let arms: Vec<Vec3> = (0..mesh.face_count())
            .map(|face| arm(surface, face / 2))
            .collect();
        let field = OrientationField::with_quarters(&mesh, &arms, |e| quarters(surface, &mesh, e));
        let field = field.map_err(|error| match error {
            Error::InvalidArgument {
                index: Some(face), ..
            } => Error::from(MeshError::ZeroArea { face: face / 2 }),
            other => other,
        })?;
        Ok(Triangulated { mesh, field })
    }

    /// The edges of the triangles that are edges of quads whose faces meet at this angle or a larger one, in
    /// radians, and those of the boundary.
    pub(super) fn sharp_edges(&self, angle: f64) -> Vec<usize> {
        let mesh = &self.mesh;
        let is_sharp = |&e: &usize| {
            let edge = mesh.edge(e);
            let Some((other, _)) = edge.second else {
                return true;
            };
            let face = edge.first.0;
            let normals = [face, other].map(|f| mesh.normal(f));
            face / 2 != other / 2
                && norm(cross(normals[0], normals[1])).atan2(dot(normals[0], normals[1])) >= angle
        };
        (0..mesh.edge_count()).filter(is_sharp).collect()
    }
}

/// The arm of the cross that fits both directions of a quad best: halfway between the first, and the second turned
/// back by a quarter.
fn arm(surface: &QuadSurface, quad: usize) -> Vec3 {
    let [a, b, c, d] = surface.quads()[quad].map(|v| surface.positions()[v as usize]);
    let u = normalize(add(sub(b, a), sub(c, d)));
    let v = normalize(add(sub(d, a), sub(c, b)));
    add(u, cross(v, normalize(cross(u, v))))
}

/// The quarter turns from the arm of the first face of an edge to that of the second.
fn quarters(surface: &QuadSurface, mesh: &TriangleMesh, edge: usize) -> i32 {
    let (face, k) = mesh.edge(edge).first;
    let Some(h) = half_edge(face, k) else {
        return 0;
    };
    // The same edge is direction `h % 4` of one quad and against direction `over % 4` of the other.
    let over = surface.twin(h);
    (h % 4 + 6 - over % 4) as i32 % 4
}

/// The half-edge of the quads along a local edge of a triangle; none for a diagonal.
fn half_edge(face: usize, k: usize) -> Option<usize> {
    let side = match (face % 2, k) {
        (0, 0) => 0,
        (0, 1) => 1,
        (1, 1) => 2,
        (1, 2) => 3,
        _ => return None,
    };
    Some(4 * (face / 2) + side)
}
