//! Points of the surface by the smallest element that holds them: a vertex, an edge or a face.
//!
//! The place of a point does not depend on the face by which it was named, so that sources given twice are found
//! and the order of sources does not matter.

use super::source::SurfacePoint;
use crate::mesh::TriangleMesh;

/// Where a point lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Place {
    Vertex(usize),
    /// The edge, and the point's share of the way along it, strictly between 0 and 1.
    Edge(usize, f64),
    /// The face, and the weights of its corners, all positive.
    Face(usize, [f64; 3]),
}

/// Weights up to this are zero, so that no point is almost on an edge.
const ZERO: f64 = 1e-12;

impl Place {
    pub(super) fn of(mesh: &TriangleMesh, point: &SurfacePoint) -> Place {
        let weights = point.barycentric.map(|w| if w <= ZERO { 0.0 } else { w });
        let sum: f64 = weights.iter().sum();
        let face = point.face;
        let is_zero = weights.map(|w| w == 0.0);
        let zeros = is_zero.iter().filter(|z| **z).count();
        match zeros {
            0 => Place::Face(face, weights.map(|w| w / sum)),
            1 => {
                // Local edge k lies opposite corner k + 2.
                let k = (0..3).find(|k| is_zero[(k + 2) % 3]).unwrap_or(0);
                let (edge, share) = (mesh.edge_of(face, k), weights[(k + 1) % 3] / sum);
                match mesh.is_first_side(face, k) {
                    true => Place::Edge(edge, share),
                    false => Place::Edge(edge, weights[k] / sum),
                }
            }
            _ => {
                let k = (0..3).find(|k| !is_zero[*k]).unwrap_or(0);
                Place::Vertex(mesh.corners(face)[k])
            }
        }
    }

    /// The faces that hold it, each with the weights of its corners.
    pub(super) fn faces(&self, mesh: &TriangleMesh) -> Vec<(usize, [f64; 3])> {
        match *self {
            Place::Vertex(v) => {
                let corner = |(f, k): (usize, usize)| {
                    let mut weights = [0.0; 3];
                    weights[k] = 1.0;
                    (f, weights)
                };
                mesh.ring(v).map(corner).collect()
            }
            Place::Edge(e, share) => {
                let edge = mesh.edge(e);
                let side = |(f, k): (usize, usize), share: f64| {
                    let mut weights = [0.0; 3];
                    weights[k] = 1.0 - share;
                    weights[(k + 1) % 3] = share;
                    (f, weights)
                };
                let second = edge.second.map(|s| side(s, 1.0 - share));
                std::iter::once(side(edge.first, share))
                    .chain(second)
                    .collect()
            }
            Place::Face(f, weights) => vec![(f, weights)],
        }
    }

    /// A key that orders places. Of numbers that are not negative, bits have the order of values.
    pub(super) fn key(&self) -> (u8, usize, [u64; 2]) {
        match *self {
            Place::Vertex(v) => (0, v, [0; 2]),
            Place::Edge(e, share) => (1, e, [share.to_bits(), 0]),
            Place::Face(f, w) => (2, f, [w[0].to_bits(), w[1].to_bits()]),
        }
    }
}
