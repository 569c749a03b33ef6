//! What repair gives: the mesh, the edits, and the maps to the soup and back.

use super::edits::Edits;
use super::lists::{Lists, NONE};
use crate::linalg::vector::Vec3;

/// An oriented manifold triangle mesh, and where it came from.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Repaired {
    /// Positions of all vertices.
    pub vertices: Vec<Vec3>,
    /// Corners of all triangles.
    pub triangles: Vec<[u32; 3]>,
    /// The input vertex of each vertex; none for one that repair made.
    pub vertex_origin: Vec<Option<u32>>,
    /// The input polygon of each triangle; none for one that fills a hole.
    pub triangle_origin: Vec<Option<u32>>,
    /// What was done.
    pub edits: Edits,
    /// For each input vertex the one that stands for it, or [`NONE`].
    pub(super) stands_for: Vec<u32>,
    pub(super) vertices_of: Lists,
    pub(super) triangles_of: Lists,
}

impl Repaired {
    /// The vertices that come from an input vertex, or from the one to which it was welded: several where
    /// it was split, none where it was dropped.
    pub fn vertices_of(&self, input_vertex: usize) -> &[u32] {
        match self.welded_to(input_vertex) {
            Some(vertex) => self.vertices_of.of(vertex as usize),
            None => &[],
        }
    }

    /// The triangles that come from an input polygon.
    pub fn triangles_of(&self, input_polygon: usize) -> &[u32] {
        self.triangles_of.of(input_polygon)
    }

    /// The input vertex to which an input vertex was welded, itself if to none; none if its coordinates are
    /// not finite or there is no such vertex.
    pub fn welded_to(&self, input_vertex: usize) -> Option<u32> {
        let vertex = self.stands_for.get(input_vertex).copied();
        vertex.filter(|&v| v != NONE)
    }

    /// Number of vertices of the soup.
    pub fn input_vertex_count(&self) -> usize {
        self.stands_for.len()
    }
}
