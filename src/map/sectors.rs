//! The vertices of the cut surface: one copy of a vertex for each sector between cut edges.

use super::CutGraph;
use crate::mesh::TriangleMesh;

/// Which copy of its vertex every corner has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Sectors {
    /// The copy at every corner of every face.
    pub(crate) copy: Vec<[u32; 3]>,
    /// The first copy of every vertex, and at the end the number of copies.
    pub(crate) first: Vec<u32>,
}

impl Sectors {
    /// Copies are numbered by vertex, within one counter-clockwise: from the first corner of the
    /// ring that has a cut edge on its clockwise side (at the boundary from the first corner).
    pub(super) fn new(mesh: &TriangleMesh, cut: &CutGraph) -> Self {
        let mut copy = vec![[0; 3]; mesh.face_count()];
        let mut first = Vec::with_capacity(mesh.vertex_count() + 1);
        let mut copies = 0;
        let mut ring = Vec::new();
        for v in 0..mesh.vertex_count() {
            ring.clear();
            ring.extend(mesh.ring(v));
            let begins = |&(f, k): &(usize, usize)| cut.contains(mesh.edge_of(f, k));
            if !mesh.is_boundary_vertex(v) {
                let start = ring.iter().position(begins).unwrap_or(0);
                ring.rotate_left(start);
            }
            first.push(copies);
            for (i, &(face, corner)) in ring.iter().enumerate() {
                if i > 0 && begins(&(face, corner)) {
                    copies += 1;
                }
                copy[face][corner] = copies;
            }
            copies += 1;
        }
        first.push(copies);
        Sectors { copy, first }
    }

    /// How many vertices the cut surface has.
    pub(crate) fn count(&self) -> usize {
        self.first.last().map_or(0, |&n| n as usize)
    }
}
