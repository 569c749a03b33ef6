//! Figures of the connectivity of quads, counted from the faces alone.

use super::QuadMesh;
use super::faults::{has_twice, is_bad};

/// Counts over a mesh of quads. Edges are pairs of vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct QuadFigures {
    /// Vertices minus edges plus faces.
    pub euler: i64,
    /// Vertices with a number of edges other than four, or than three on the boundary.
    pub irregular: usize,
    /// Edges with one face.
    pub boundary_edges: usize,
    /// Edges with more than two faces, or with two faces of the same direction.
    pub bad_edges: usize,
    /// Faces that contain a vertex twice.
    pub degenerate: usize,
}

impl QuadMesh {
    /// The counts.
    pub fn figures(&self) -> QuadFigures {
        let sides = self.sides();
        let mut valence = vec![0; self.vertices.len()];
        let mut is_boundary = vec![false; self.vertices.len()];
        let (mut edges, mut boundary_edges, mut bad_edges) = (0, 0, 0);
        for edge in sides.chunk_by(|a, b| a.0 == b.0) {
            edges += 1;
            boundary_edges += usize::from(edge.len() == 1);
            bad_edges += usize::from(is_bad(edge));
            for v in edge[0].0 {
                valence[v as usize] += 1;
                is_boundary[v as usize] |= edge.len() == 1;
            }
        }
        let regular = |boundary: bool| if boundary { 3 } else { 4 };
        let irregular = valence
            .iter()
            .zip(is_boundary)
            .filter(|(v, b)| **v != regular(*b));
        QuadFigures {
            euler: self.vertices.len() as i64 - edges + self.faces().count() as i64,
            irregular: irregular.count(),
            boundary_edges,
            bad_edges,
            degenerate: self.faces().filter(|face| has_twice(face)).count(),
        }
    }

    /// Whether all faces are quads, each edge has two faces (one at a boundary), and the Euler
    /// characteristic is that of the triangle mesh.
    pub fn is_conforming(&self) -> bool {
        let figures = self.figures();
        !self.quads.is_empty()
            && self.others.is_empty()
            && figures.bad_edges == 0
            && figures.degenerate == 0
            && figures.euler == self.expected_euler
    }
}
