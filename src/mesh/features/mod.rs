//! Feature graphs: the edges that a quad mesh should keep, as curves between nodes.
//!
//! Edges come from the angle between faces, from the line elements or the attributes of a file, or from the caller. A
//! node is a corner, where three or more feature edges meet or two meet at a sharp turn, or an open
//! end, where a single feature edge stops.

#[cfg(feature = "mesh-io")]
mod attributes;
mod curves;
mod detect;
#[cfg(feature = "mesh-io")]
mod file;
mod short;

use super::TriangleMesh;
use crate::error::{Error, Result};

/// Where exactly two feature edges meet, they form a corner if the curve turns by more than this: half
/// of the right angle by which one quad more or less turns it.
pub const CORNER_TURN: f64 = std::f64::consts::FRAC_PI_4;

/// A chain of feature edges between two nodes, or a loop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FeatureCurve {
    /// The edges of the mesh, tip to tail.
    pub edges: Vec<usize>,
    /// The vertices along them, one more than edges; a loop ends at its first vertex.
    pub vertices: Vec<usize>,
}

impl FeatureCurve {
    /// Whether the curve comes back to where it starts.
    pub fn is_loop(&self) -> bool {
        self.vertices.first() == self.vertices.last()
    }
}

/// A set of edges of a mesh, taken apart into curves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FeatureGraph {
    is_feature: Vec<bool>,
    degree: Vec<u32>,
    corners: Vec<usize>,
    open_ends: Vec<usize>,
    curves: Vec<FeatureCurve>,
}

impl FeatureGraph {
    /// The graph without edges.
    pub fn none(mesh: &TriangleMesh) -> Self {
        Self::of(mesh, vec![false; mesh.edge_count()])
    }

    /// The graph of these edges, in any order; an edge may be named twice.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`] for an edge that does not exist.
    pub fn from_edges(mesh: &TriangleMesh, edges: &[usize]) -> Result<Self> {
        check_edges(mesh, "feature edges", edges)?;
        let mut is_feature = vec![false; mesh.edge_count()];
        edges.iter().for_each(|&e| is_feature[e] = true);
        Ok(Self::of(mesh, is_feature))
    }

    /// The graph of the edges between these pairs of vertices.
    ///
    /// # Errors
    /// With the position in `lines`, [`Error::IndexOutOfRange`] for a vertex that does not exist,
    /// [`Error::InvalidArgument`] for two that no edge joins.
    pub fn from_lines(mesh: &TriangleMesh, lines: &[[usize; 2]]) -> Result<Self> {
        let mut is_feature = vec![false; mesh.edge_count()];
        for (position, &[a, b]) in lines.iter().enumerate() {
            if let Some(&v) = [a, b].iter().find(|&&v| v >= mesh.vertex_count()) {
                return Err(out_of_range(
                    "feature lines",
                    position,
                    v,
                    mesh.vertex_count(),
                ));
            }
            match edge_between(mesh, [a, b]) {
                Some(e) => is_feature[e] = true,
                None => {
                    return Err(Error::InvalidArgument {
                        what: format!(
                            "feature line {position}: no edge joins vertices {a} and {b}"
                        ),
                        index: Some(position),
                    });
                }
            }
        }
        Ok(Self::of(mesh, is_feature))
    }

    /// This graph and the edges of another on the same mesh.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for a graph on another mesh.
    pub fn with(self, mesh: &TriangleMesh, other: &FeatureGraph) -> Result<Self> {
        self.check_mesh(mesh)?;
        other.check_mesh(mesh)?;
        let mut is_feature = self.is_feature;
        for (here, &there) in is_feature.iter_mut().zip(&other.is_feature) {
            *here |= there;
        }
        Ok(Self::of(mesh, is_feature))
    }

    /// Whether an edge of the mesh is a feature.
    pub fn contains(&self, edge: usize) -> bool {
        self.is_feature[edge]
    }

    /// The feature edges, in increasing order.
    pub fn edges(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_feature.len()).filter(|&e| self.is_feature[e])
    }

    /// How many feature edges end at a vertex.
    pub fn degree(&self, vertex: usize) -> usize {
        self.degree[vertex] as usize
    }

    /// Vertices where three or more feature edges meet, or two at a turn of more than
    /// [`CORNER_TURN`], in increasing order.
    pub fn corners(&self) -> &[usize] {
        &self.corners
    }

    /// Vertices where a single feature edge ends, in increasing order.
    pub fn open_ends(&self) -> &[usize] {
        &self.open_ends
    }

    /// The curves: those between nodes by the lower of their first vertices, then the loops
    /// without a node.
    pub fn curves(&self) -> &[FeatureCurve] {
        &self.curves
    }

    /// Whether this can be a graph on that mesh.
    pub(crate) fn check_mesh(&self, mesh: &TriangleMesh) -> Result<()> {
        match (self.is_feature.len(), self.degree.len()) == (mesh.edge_count(), mesh.vertex_count())
        {
            true => Ok(()),
            false => Err(Error::LengthMismatch {
                what: "the edges of the feature graph",
                expected: mesh.edge_count(),
                actual: self.is_feature.len(),
            }),
        }
    }
}

/// The edge that joins two vertices of the mesh.
pub(crate) fn edge_between(mesh: &TriangleMesh, [a, b]: [usize; 2]) -> Option<usize> {
    let along = |[a, b]: [usize; 2]| {
        let mut spokes = mesh.ring(a);
        let found = spokes.find(|&(f, k)| mesh.corners(f)[(k + 1) % 3] == b);
        found.map(|(f, k)| mesh.edge_of(f, k))
    };
    along([a, b]).or_else(|| along([b, a]))
}

/// Whether all of `edges` are edges of the mesh.
pub(crate) fn check_edges(mesh: &TriangleMesh, what: &'static str, edges: &[usize]) -> Result<()> {
    let len = mesh.edge_count();
    match edges.iter().position(|&e| e >= len) {
        Some(position) => Err(out_of_range(what, position, edges[position], len)),
        None => Ok(()),
    }
}

fn out_of_range(what: &'static str, position: usize, value: usize, len: usize) -> Error {
    Error::IndexOutOfRange {
        what,
        position,
        value: i64::try_from(value).unwrap_or(i64::MAX),
        len,
    }
}

#[cfg(all(test, feature = "mesh-io"))]
mod attribute_tests;
#[cfg(test)]
mod tests;
