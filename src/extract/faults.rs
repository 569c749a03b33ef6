//! The elements that prevent a mesh from being a conforming mesh of quads.

use super::QuadMesh;

/// The faulty elements, each list in increasing order.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct QuadFaults {
    /// Faces that are not quads or contain a vertex twice. The quads are numbered first, then the others, as
    /// in files.
    pub faces: Vec<usize>,
    /// Edges, as pairs of vertices, with more than two faces or with two faces of the same direction.
    pub edges: Vec<[usize; 2]>,
    /// Vertices whose faces form more than one fan.
    pub vertices: Vec<usize>,
}

impl QuadFaults {
    /// Whether there is no faulty element.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty() && self.edges.is_empty() && self.vertices.is_empty()
    }
}

/// A side of a face: its ends in increasing order, and whether it runs from the first to the second.
pub(super) type Side = ([u32; 2], bool);

impl QuadMesh {
    /// The faulty elements. There may be none although the Euler characteristic is wrong: then a handle of
    /// the mesh was closed or a component lost.
    pub fn faults(&self) -> QuadFaults {
        let is_at_fault = |face: &[u32]| face.len() != 4 || has_twice(face);
        let faces = self.faces().enumerate();
        let faces = faces.filter(|(_, face)| is_at_fault(face));
        let sides = self.sides();
        let edges = sides.chunk_by(|a, b| a.0 == b.0);
        let edges = edges.filter(|edge| is_bad(edge));
        QuadFaults {
            faces: faces.map(|(number, _)| number).collect(),
            edges: edges.map(|edge| edge[0].0.map(|v| v as usize)).collect(),
            vertices: self.pinched(),
        }
    }

    /// The sides of all faces, sorted by edge.
    pub(crate) fn sides(&self) -> Vec<Side> {
        let mut sides = Vec::with_capacity(4 * self.quads.len());
        for face in self.faces() {
            for (k, &a) in face.iter().enumerate() {
                let b = face[(k + 1) % face.len()];
                sides.push(([a.min(b), a.max(b)], a < b));
            }
        }
        sides.sort_unstable();
        sides
    }

    /// Vertices whose faces are not all connected over edges at the vertex.
    fn pinched(&self) -> Vec<usize> {
        // (vertex, vertex before, vertex after) of every corner.
        let mut corners: Vec<[u32; 3]> = Vec::with_capacity(4 * self.quads.len());
        for face in self.faces() {
            let n = face.len();
            corners.extend((0..n).map(|k| [face[k], face[(k + n - 1) % n], face[(k + 1) % n]]));
        }
        corners.sort_unstable();
        let around = corners.chunk_by(|a, b| a[0] == b[0]);
        let pinched = around.filter(|fan| is_parted(fan));
        pinched.map(|fan| fan[0][0] as usize).collect()
    }
}

/// Whether a face contains a vertex twice.
pub(super) fn has_twice(face: &[u32]) -> bool {
    let mut corners = face.to_vec();
    corners.sort_unstable();
    corners.windows(2).any(|pair| pair[0] == pair[1])
}

/// Whether an edge with these sides has more than two faces, or two that run the same way.
pub(super) fn is_bad(edge: &[Side]) -> bool {
    edge.len() > 2 || edge.len() == 2 && edge[0].1 == edge[1].1
}

/// Whether the corners of one vertex form more than one fan. Two corners are connected if one ends at
/// the vertex with which the other begins.
fn is_parted(corners: &[[u32; 3]]) -> bool {
    let mut is_reached = vec![false; corners.len()];
    is_reached[0] = true;
    let mut open = vec![0];
    while let Some(at) = open.pop() {
        for (i, corner) in corners.iter().enumerate() {
            let joins = corner[1] == corners[at][2] || corner[2] == corners[at][1];
            if joins && !std::mem::replace(&mut is_reached[i], true) {
                open.push(i);
            }
        }
    }
    is_reached.contains(&false)
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::Origin;
    use super::*;

    /// A mesh of these faces, whose vertices lie on a line.
    pub(in super::super) fn mesh(quads: &[[u32; 4]], others: &[&[u32]]) -> QuadMesh {
        let faces = quads.iter().map(|q| q.as_slice());
        let most = faces.chain(others.iter().copied()).flatten().max();
        let count = most.map_or(0, |&v| v as usize + 1);
        let vertices = (0..count).map(|v| [v as f64, 0.0, 0.0]).collect();
        QuadMesh {
            origins: (0..count).map(Origin::Vertex).collect(),
            others: others.iter().map(|face| face.to_vec()).collect(),
            ..QuadMesh::from_quads(vertices, quads.to_vec(), 1)
        }
    }

    #[test]
    fn two_quads_with_one_edge_have_no_faults() {
        let pair = mesh(&[[0, 1, 2, 3], [1, 4, 5, 2]], &[]);
        assert!(pair.faults().is_empty() && pair.is_conforming());
    }

    #[test]
    fn elements_at_fault_are_named() {
        // Two quads that share only a vertex, a pentagon, a quad with a vertex twice, and an edge of three
        // faces.
        let pinch = mesh(&[[0, 1, 2, 3], [2, 4, 5, 6]], &[]).faults();
        assert_eq!((pinch.vertices, pinch.faces.len()), (vec![2], 0));
        let other = mesh(&[[0, 1, 2, 3], [4, 5, 4, 6]], &[&[1, 7, 8, 9, 2]]).faults();
        assert_eq!(other.faces, [1, 2]);
        let fin = mesh(&[[0, 1, 2, 3], [1, 0, 4, 5], [0, 1, 6, 7]], &[]).faults();
        assert_eq!(fin.edges, [[0, 1]]);
    }
}
