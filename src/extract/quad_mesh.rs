//! The quads, their places on the triangle mesh, and the figures of the extraction.

use crate::mesh::vector::Vec3;

/// The place of a vertex of the quads on the triangle mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Origin {
    /// At an irregular vertex.
    Vertex(usize),
    /// In a face, with barycentric coordinates.
    Face(usize, [f64; 3]),
    /// Off the surface: in the middle of a cell that was not a square.
    Middle,
}

/// Polygons with shared vertices. If extraction succeeded, all of them are quads.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadMesh {
    /// Positions. Every vertex belongs to a face.
    pub vertices: Vec<Vec3>,
    /// The place of each vertex on the triangle mesh.
    pub origins: Vec<Origin>,
    /// Corners of the quads, counter-clockwise.
    pub quads: Vec<[u32; 4]>,
    /// Corners of the faces that are not quads.
    pub others: Vec<Vec<u32>>,
    /// The number of cells that the boundary cuts. They are left out.
    pub partial_cells: usize,
    /// The number of integer points, duplicated by folds of the map, that were removed or joined.
    pub folds_removed: usize,
    /// The number of moves that turned the cells left by folds into quads.
    pub repaired: usize,
    /// Triangles that the map folds or collapses, in increasing order: the cause of faults.
    pub folded: Vec<usize>,
    /// The Euler characteristic of the triangle mesh.
    pub expected_euler: i64,
}

impl QuadMesh {
    /// Quads that come from no map: their vertices have no places on a mesh, and `expected_euler` is the Euler
    /// characteristic of their surface.
    pub fn from_quads(vertices: Vec<Vec3>, quads: Vec<[u32; 4]>, expected_euler: i64) -> Self {
        QuadMesh {
            origins: vec![Origin::Middle; vertices.len()],
            vertices,
            quads,
            others: Vec::new(),
            partial_cells: 0,
            folds_removed: 0,
            repaired: 0,
            folded: Vec::new(),
            expected_euler,
        }
    }

    /// All faces: the quads, then the others.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let quads = self.quads.iter().map(|quad| quad.as_slice());
        quads.chain(self.others.iter().map(Vec::as_slice))
    }

    /// The quads at every vertex, in increasing order.
    pub(crate) fn around(&self) -> Vec<Vec<u32>> {
        let mut around = vec![Vec::new(); self.vertices.len()];
        for (q, quad) in self.quads.iter().enumerate() {
            for &v in quad {
                around[v as usize].push(q as u32);
            }
        }
        around
    }
}
