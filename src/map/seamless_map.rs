//! A seamless map: coordinates on the cut surface and how they change over the cut.

use crate::mesh::{Reordered, TriangleMesh, turned};

/// How coordinates change over one cut edge, from its first to its second face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transition {
    /// The edge of the mesh.
    pub edge: usize,
    /// Quarter turns counter-clockwise, 0 to 3.
    pub quarters: u8,
    /// What is added after the turn. Integers, except after a relaxation.
    pub translation: [f64; 2],
}

impl Transition {
    /// The coordinates of the second face for those of the first.
    pub fn apply(&self, uv: [f64; 2]) -> [f64; 2] {
        let turned = turned(self.quarters, uv);
        [0, 1].map(|axis| turned[axis] + self.translation[axis])
    }

    /// `q = R p + t` is `p = R^-1 q - R^-1 t`.
    pub(super) fn inverse(&self) -> Self {
        let quarters = (4 - self.quarters) % 4;
        let back = turned(quarters, self.translation);
        Transition {
            edge: self.edge,
            quarters,
            // No minus zero in anybody's output.
            translation: back.map(|x| 0.0 - x),
        }
    }
}

/// Coordinates on a cut surface that turn by quarters and shift by integers over the cut.
#[derive(Debug, Clone, PartialEq)]
pub struct SeamlessMap {
    /// Of all unknowns of the problem, the coordinates first.
    pub(super) values: Vec<f64>,
    pub(super) coordinates: usize,
    pub(super) copies: Vec<[u32; 3]>,
    pub(super) transitions: Vec<Transition>,
    pub(super) cones: Vec<usize>,
    pub(super) flipped: Vec<usize>,
    pub(super) energy: f64,
}

impl SeamlessMap {
    /// The map of a mesh in another order, on `given`, the mesh as it was.
    pub(crate) fn on_given(&self, reordered: &Reordered, given: &TriangleMesh) -> Self {
        let transitions = self.transitions.iter().map(|transition| {
            let edge = reordered.edge(given, transition.edge);
            let (_, is_turned) = reordered.place_of_edge(given, edge);
            let over = match is_turned {
                true => transition.inverse(),
                false => *transition,
            };
            Transition { edge, ..over }
        });
        let mut transitions: Vec<Transition> = transitions.collect();
        transitions.sort_unstable_by_key(|transition| transition.edge);
        SeamlessMap {
            values: self.values.clone(),
            copies: reordered.of_given_faces(&self.copies),
            transitions,
            cones: reordered.given_vertices(&self.cones),
            flipped: reordered.given_faces(&self.flipped),
            ..*self
        }
    }

    /// The coordinates of the corners of a face.
    pub fn uv(&self, face: usize) -> [[f64; 2]; 3] {
        let uv = self.vertex_uvs();
        self.copies[face].map(|copy| uv[copy as usize])
    }

    /// The coordinates of all corners, face by face.
    pub fn corner_uvs(&self) -> Vec<[[f64; 2]; 3]> {
        (0..self.copies.len()).map(|face| self.uv(face)).collect()
    }

    /// The coordinates of the vertices of the cut surface, to be used with
    /// [`copies`](Self::copies).
    pub fn vertex_uvs(&self) -> &[[f64; 2]] {
        self.values[..self.coordinates].as_chunks().0
    }

    /// The values of all unknowns of the problem that the map was made of.
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// The vertices of the cut surface at the corners of every face.
    pub fn copies(&self) -> &[[u32; 3]] {
        &self.copies
    }

    /// How coordinates change over each cut edge, in increasing order of edges.
    pub fn transitions(&self) -> &[Transition] {
        &self.transitions
    }

    /// The vertices around which the map turns, in increasing order.
    pub fn cones(&self) -> &[usize] {
        &self.cones
    }

    /// Faces that the map turns over or collapses, decided exactly, in increasing order.
    pub fn flipped(&self) -> &[usize] {
        &self.flipped
    }

    /// Sum over triangles of `area (|grad u - h X|^2 + |grad v - h Y|^2)`, recomputed from the
    /// mesh.
    pub fn energy(&self) -> f64 {
        self.energy
    }
}
