//! Feature edges as isolines of a map.
//!
//! `bommes2009`, section 5.2 ("alignment"): along a feature edge the coordinate across it is constant
//! and its value is an integer, so that the edge becomes a chain of quad edges. Constraints link the
//! vertices of a curve within a chart, and transitions over seams link charts, so that one integer for
//! each curve in each chart is enough.

use super::Combing;
use super::sectors::Sectors;
use crate::field::OrientationField;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{dot, sub};

/// A feature edge in the chart of its first face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Isoline {
    /// The edge of the mesh.
    pub(crate) edge: usize,
    /// The copies of its ends, along the curve.
    pub(crate) ends: [u32; 2],
    /// The coordinate that stays the same: 0 for u, 1 for v.
    pub(crate) axis: usize,
    /// Whether it is the first edge of its curve in its chart, whose value is made integer.
    pub(crate) is_first: bool,
}

impl Isoline {
    /// The unknowns that are the same at both ends.
    pub(crate) fn unknowns(&self) -> [usize; 2] {
        self.ends.map(|copy| 2 * copy as usize + self.axis)
    }
}

/// All feature edges, curve by curve.
///
/// An edge follows the coordinate whose arm is nearer to it in its first face.
pub(super) fn isolines(
    mesh: &TriangleMesh,
    field: &OrientationField,
    combing: &Combing,
    sectors: &Sectors,
    features: &FeatureGraph,
) -> Vec<Isoline> {
    let mut found: Vec<Isoline> = Vec::new();
    for curve in features.curves() {
        let mut last: Option<Isoline> = None;
        for (&e, &start) in curve.edges.iter().zip(&curve.vertices) {
            let (face, k) = mesh.edge(e).first;
            let p = mesh.corner_positions(face);
            let along = sub(p[(k + 1) % 3], p[k]);
            let [x, y] = combing.arms(mesh, field, face);
            let follows_u = dot(along, x).abs() >= dot(along, y).abs();
            let mut ends = [k, (k + 1) % 3].map(|corner| sectors.copy[face][corner]);
            if mesh.corners(face)[k] != start {
                ends.swap(0, 1);
            }
            let axis = usize::from(follows_u);
            let goes_on = last.is_some_and(|l| l.axis == axis && l.ends[1] == ends[0]);
            let isoline = Isoline {
                edge: e,
                ends,
                axis,
                is_first: !goes_on,
            };
            found.push(isoline);
            last = Some(isoline);
        }
    }
    found
}
