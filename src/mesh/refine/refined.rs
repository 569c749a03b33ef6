//! The refined mesh, and what its elements are on the original one.

use super::SMALL_ANGLE;
use super::locate::locate;
use super::queue::smallest_angle;
use super::working_mesh::WorkingMesh;
use crate::error::{Error, Result};
use crate::mesh::{TriangleMesh, barycentric};

/// A refined mesh. Its first vertices are those of the original mesh, with their numbers and places.
#[derive(Debug, Clone)]
pub struct Refined {
    /// The mesh.
    pub mesh: TriangleMesh,
    /// The original triangle of every triangle: the one at its centroid, which lies on it or, where edges
    /// were flipped, within the deviation of it.
    pub face_origin: Vec<u32>,
    /// The original number of every vertex; none for a new one.
    pub vertex_origin: Vec<Option<u32>>,
    /// An original triangle on which each vertex lies.
    pub vertex_face: Vec<u32>,
    /// The original edge that an edge is part of, where it could not be flipped: a feature, the boundary,
    /// an edge at which the surface turns.
    pub edge_origin: Vec<Option<u32>>,
    /// The number of new vertices.
    pub splits: usize,
    /// The number of flips.
    pub flips: usize,
    /// The number of triangles that still have an angle below [`SMALL_ANGLE`].
    pub small_angles: usize,
    /// Whether nothing is left to do; false if the bound on the triangles ended the refinement.
    pub is_complete: bool,
}

impl Refined {
    /// The edges that are parts of these original edges, in increasing order. They are all their parts
    /// if the original edges are features of the refinement.
    pub fn parts_of(&self, is_wanted: impl Fn(usize) -> bool) -> Vec<usize> {
        let parts = self.edge_origin.iter().enumerate();
        let wanted = parts.filter(|(_, origin)| origin.is_some_and(|e| is_wanted(e as usize)));
        wanted.map(|(edge, _)| edge).collect()
    }

    /// Values for all vertices, from those of the vertices of the original mesh: a new vertex has the value of the
    /// point of the original triangle on which it lies.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is a value for each vertex of `original`, and it has as many vertices
    /// as the mesh that was refined.
    pub fn values_at_vertices(&self, original: &TriangleMesh, values: &[f64]) -> Result<Vec<f64>> {
        let old = self.vertex_origin.iter().flatten().count();
        for actual in [original.vertex_count(), values.len()] {
            if actual != old {
                return Err(Error::LengthMismatch {
                    what: "values at vertices",
                    expected: old,
                    actual,
                });
            }
        }
        let value = |v: usize| match self.vertex_origin[v] {
            Some(v) => values[v as usize],
            None => {
                let face = self.vertex_face[v] as usize;
                let weights = barycentric(original.corner_positions(face), self.mesh.position(v));
                let corners = original.corners(face);
                (0..3).map(|k| weights[k] * values[corners[k]]).sum()
            }
        };
        Ok((0..self.vertex_origin.len()).map(value).collect())
    }

    /// Whether the mesh is the original one.
    pub fn is_unchanged(&self) -> bool {
        self.splits == 0 && self.flips == 0
    }
}

impl WorkingMesh<'_> {
    /// The result.
    pub(super) fn finish(self, is_complete: bool) -> Result<Refined> {
        let mut face_origin = self.origin;
        for (face, corners) in self.triangles.iter().enumerate() {
            let near = face_origin[face];
            let region = self.regions.of_face[near as usize];
            if self.regions.faces(region).len() > 1 {
                let plane = &self.regions.planes[region as usize];
                let [a, b, c] = corners.map(|v| plane.coordinates(self.vertices[v as usize]));
                let centroid = [0, 1].map(|i| (a[i] + b[i] + c[i]) / 3.0);
                face_origin[face] = locate(self.mesh, self.regions, centroid, near).face;
            }
        }
        let old = self.mesh.vertex_count();
        let small = SMALL_ANGLE.sin() * SMALL_ANGLE.sin();
        let is_small = |corners: &&[u32; 3]| {
            smallest_angle(corners.map(|v| self.vertices[v as usize])).0 < small
        };
        let small_angles = self.triangles.iter().filter(is_small).count();
        let (count, edges) = (self.vertices.len(), self.mesh.edge_count());
        let mesh = TriangleMesh::new(self.vertices, self.triangles)?;
        let edge_origin = mesh.edges().map(|edge| {
            let (face, k) = edge.first;
            let origin = self.held[3 * face + k];
            // Edges of curves that were cut into the mesh have numbers beyond those of edges.
            ((origin as usize) < edges).then_some(origin)
        });
        Ok(Refined {
            face_origin,
            vertex_origin: (0..count).map(|v| (v < old).then_some(v as u32)).collect(),
            vertex_face: self.vertex_face,
            edge_origin: edge_origin.collect(),
            splits: self.counts.splits,
            flips: self.counts.flips,
            small_angles,
            is_complete,
            mesh,
        })
    }
}
