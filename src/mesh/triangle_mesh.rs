//! The mesh itself: vertices, faces and their adjacency.

use std::ops::{Neg, Range};
use std::sync::OnceLock;

use super::connectivity::{Connectivity, NONE, connect, number_edges};
use super::rings::{Rings, rings};
use super::vector::Vec3;
use super::{MeshError, check};
use crate::error::Error;
use crate::monitor::{
    Watch, both, collect_in_parts, in_parts, joined, may_continue, span, watch_memory,
};

/// The problems of a mesh have about so many unknowns and coefficients for each face.
const PARTS: usize = 8;

/// The least number of faces or vertices that are worth a thread.
const LEAST: usize = 1 << 14;

/// An oriented triangle mesh, with or without boundary, that is known to be a 2-manifold.
#[derive(Clone)]
pub struct TriangleMesh {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    pub(super) twin: Vec<u32>,
    edge_half: Vec<u32>,
    half_edge: Vec<u32>,
    ring_start: Vec<u32>,
    ring: Vec<u32>,
    /// The angles of all faces, once they are asked for.
    pub(super) angles: OnceLock<Vec<[f64; 3]>>,
    /// The area of all faces, once it is asked for.
    pub(super) area: OnceLock<f64>,
}

/// An undirected edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// The end points, in the direction of the first side.
    pub vertices: [usize; 2],
    /// The side in the lower face: (face, local edge).
    pub first: (usize, usize),
    /// The side in the other face; none at the boundary.
    pub second: Option<(usize, usize)>,
}

impl TriangleMesh {
    /// The mesh of these vertices and faces (corners counter-clockwise seen from outside).
    ///
    /// # Errors
    ///
    /// Checked in this order, each over the whole mesh, the lowest element named: too large, no
    /// faces, coordinates not finite, vertex numbers out of range, a vertex twice in a face,
    /// faces without area ([`ZERO_AREA_TOLERANCE`](super::ZERO_AREA_TOLERANCE)), edges with more
    /// than two faces, inconsistent orientation, isolated vertices, vertices whose faces form
    /// more than one fan.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<TriangleMesh, MeshError> {
        let _span = span("half-edges");
        check::check(&vertices, &triangles)?;
        let Connectivity {
            twin,
            edge_half,
            half_edge,
        } = connect(vertices.len(), &triangles)?;
        let Rings { start, corner } = rings(vertices.len(), &triangles, &twin)?;
        Ok(TriangleMesh {
            vertices,
            triangles,
            twin,
            edge_half,
            half_edge,
            ring_start: start,
            ring: corner,
            angles: OnceLock::new(),
            area: OnceLock::new(),
        })
    }

    /// The same mesh with face `faces[k]` as face k and vertex `vertices[k]` as vertex k: each is there once, and
    /// `place_of_face` and `place_of_vertex` tell where. Corners of faces stay in their order.
    ///
    /// # Errors
    /// The reason to end the current step.
    pub(super) fn in_order(
        &self,
        [faces, vertices]: [&[u32]; 2],
        [place_of_face, place_of_vertex]: [&[u32]; 2],
    ) -> Result<TriangleMesh, Error> {
        let half = |half: u32| match half {
            NONE => NONE,
            _ => 3 * place_of_face[half as usize / 3] + half % 3,
        };
        let triangles = collect_in_parts(faces.len(), LEAST, |k| {
            self.triangles[faces[k] as usize].map(|v| place_of_vertex[v as usize])
        });
        may_continue()?;
        let twin = collect_in_parts(faces.len(), LEAST, |k| {
            let first = 3 * faces[k] as usize;
            [0, 1, 2].map(|k| half(self.twin[first + k]))
        });
        may_continue()?;
        let corners = |v: u32| {
            let [start, end] = [v, v + 1].map(|v| self.ring_start[v as usize] as usize);
            &self.ring[start..end]
        };
        let of_part = |part: Range<usize>| {
            let mut ring = Vec::new();
            for &vertex in &vertices[part] {
                let first = ring.len();
                ring.extend(corners(vertex).iter().map(|&corner| half(corner)));
                if !self.is_boundary_vertex(vertex as usize) {
                    let own = &mut ring[first..];
                    let lowest = (0..own.len()).min_by_key(|&k| own[k]).unwrap_or(0);
                    own.rotate_left(lowest);
                }
            }
            ring
        };
        let (edges, ring) = both(
            faces.len() >= LEAST,
            || number_edges(twin.into_flattened()),
            || joined(in_parts(vertices.len(), LEAST, of_part)),
        );
        may_continue()?;
        let mut ring_start = Vec::with_capacity(vertices.len() + 1);
        let mut end = 0;
        ring_start.push(end);
        ring_start.extend(vertices.iter().map(|&v| {
            end += corners(v).len() as u32;
            end
        }));
        let Connectivity {
            twin,
            edge_half,
            half_edge,
        } = edges;
        Ok(TriangleMesh {
            vertices: collect_in_parts(vertices.len(), LEAST, |k| {
                self.position(vertices[k] as usize)
            }),
            triangles,
            twin,
            edge_half,
            half_edge,
            ring_start,
            ring,
            angles: match self.angles.get() {
                Some(angles) => {
                    collect_in_parts(faces.len(), LEAST, |k| angles[faces[k] as usize]).into()
                }
                None => OnceLock::new(),
            },
            area: OnceLock::new(),
        })
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.triangles.len()
    }

    /// Lets the current call end where there is no memory for its next step on this mesh.
    pub(crate) fn watch_memory(&self) -> Watch {
        watch_memory(PARTS * self.face_count())
    }

    /// Number of undirected edges.
    pub fn edge_count(&self) -> usize {
        self.edge_half.len()
    }

    /// Positions of all vertices.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Corners of all faces.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Position of a vertex.
    pub fn position(&self, vertex: usize) -> Vec3 {
        self.vertices[vertex]
    }

    /// Corners of a face.
    pub fn corners(&self, face: usize) -> [usize; 3] {
        self.triangles[face].map(|v| v as usize)
    }

    /// Positions of the corners of a face.
    #[inline]
    pub fn corner_positions(&self, face: usize) -> [Vec3; 3] {
        self.triangles[face].map(|v| self.vertices[v as usize])
    }

    /// What lies across local edge `k` of a face: (face, local edge), or none at the boundary.
    pub fn neighbor(&self, face: usize, k: usize) -> Option<(usize, usize)> {
        debug_assert!(k < 3, "a face has three edges");
        side(self.twin[3 * face + k])
    }

    /// All edges, in increasing order of (lower face, local edge there).
    pub fn edges(&self) -> impl ExactSizeIterator<Item = Edge> + '_ {
        (0..self.edge_count()).map(|e| self.edge(e))
    }

    /// Edge number `edge` of [`edges`](Self::edges).
    pub fn edge(&self, edge: usize) -> Edge {
        let half = self.edge_half[edge];
        let (face, k) = (half as usize / 3, half as usize % 3);
        let corners = self.corners(face);
        Edge {
            vertices: [corners[k], corners[(k + 1) % 3]],
            first: (face, k),
            second: side(self.twin[half as usize]),
        }
    }

    /// The number in [`edges`](Self::edges) of local edge `k` of a face.
    pub fn edge_of(&self, face: usize, k: usize) -> usize {
        debug_assert!(k < 3, "a face has three edges");
        self.half_edge[3 * face + k] as usize
    }

    /// Whether local edge `k` of a face is its edge's first side.
    pub fn is_first_side(&self, face: usize, k: usize) -> bool {
        self.edge_half[self.edge_of(face, k)] as usize == 3 * face + k
    }

    /// The value of an edge over its local edge `k` out of a face: what is counted from the first
    /// side to the second changes its sign the other way.
    pub fn out_of<T: Neg<Output = T>>(&self, face: usize, k: usize, value: T) -> T {
        match self.is_first_side(face, k) {
            true => value,
            false => -value,
        }
    }

    /// The corners (face, corner) around a vertex, counter-clockwise.
    ///
    /// At a boundary vertex from the corner whose edge (corner to next corner) lies on the
    /// boundary to the one whose previous edge does; else from the corner in the lowest face.
    pub fn ring(&self, vertex: usize) -> impl ExactSizeIterator<Item = (usize, usize)> + '_ {
        let range = self.ring_start[vertex] as usize..self.ring_start[vertex + 1] as usize;
        self.ring[range]
            .iter()
            .map(|&h| (h as usize / 3, h as usize % 3))
    }

    /// Number of faces around a vertex.
    pub fn face_degree(&self, vertex: usize) -> usize {
        (self.ring_start[vertex + 1] - self.ring_start[vertex]) as usize
    }

    /// Whether a vertex lies on the boundary.
    pub fn is_boundary_vertex(&self, vertex: usize) -> bool {
        self.twin[self.ring[self.ring_start[vertex] as usize] as usize] == NONE
    }
}

impl std::fmt::Debug for TriangleMesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TriangleMesh")
            .field("vertices", &self.vertex_count())
            .field("faces", &self.face_count())
            .finish_non_exhaustive()
    }
}

fn side(half: u32) -> Option<(usize, usize)> {
    (half != NONE).then_some((half as usize / 3, half as usize % 3))
}
