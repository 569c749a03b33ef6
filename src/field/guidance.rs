//! What a field and its map follow: features, boundary, directions, curvature and indices, stated once
//! for both.
//!
//! If several of them determine the direction of a face, the first of these decides: a given direction,
//! a feature or the boundary, a reliable curvature.

use super::feature_alignment::edge_constraints;
use super::{
    Constraint, FieldOptions, Guide, PrescribedIndex, curvature_guidance, feature_constraints,
};
use crate::mesh::TriangleMesh;
use crate::mesh::curvature::{SMOOTHING_ROUNDS, smoothed_curvature};
use crate::mesh::features::FeatureGraph;
use crate::{Error, Result};

/// What a field shall follow, and which edges become isolines of its map.
#[derive(Debug, Clone, PartialEq)]
pub struct Guidance {
    /// N: arms of a direction, evenly around; see [`FieldOptions::symmetry`].
    pub symmetry: u8,
    /// Directions that faces have, each face at most once.
    pub constraints: Vec<Constraint>,
    /// Directions that faces should have, each face at most once. A face with a constraint keeps
    /// that.
    pub guides: Vec<Guide>,
    /// The index of every irregular vertex; none leaves that to the energy.
    pub indices: Option<Vec<PrescribedIndex>>,
    /// This part of the faces, those with the most reliable curvature, have the direction of least
    /// absolute curvature ([`curvature_constraints`](super::curvature_constraints)).
    pub constrain_curvature: f64,
    /// The weight with which all other faces are pulled towards it
    /// ([`curvature_guides`](super::curvature_guides)).
    pub curvature_weight: f64,
    /// Edges whose normals differ by at least this are features (radians), for crosses no more than
    /// two of a face.
    pub feature_angle: Option<f64>,
    /// Features: edges between these vertices.
    pub feature_lines: Vec<[usize; 2]>,
    /// Features by number of the edge.
    pub feature_edges: Vec<usize>,
    /// Whether edges of the boundary are followed like features. A field of single directions, N = 1,
    /// does not follow them: nothing tells to which side of an edge it points.
    pub align_boundary: bool,
    /// Details smaller than this length attract no irregular vertices, and directions of curvature
    /// are those at this scale; see [`FieldOptions::detail`]. `None` means 0 for a field on its own,
    /// the edge length of quads for a field that a map follows ([`map_options`](Self::map_options)),
    /// and a quarter of it in [`quadrangulate`](crate::quad::quadrangulate).
    pub detail: Option<f64>,
}

impl Default for Guidance {
    /// Crosses that follow the boundary, where there is one, and nothing else.
    fn default() -> Self {
        Guidance {
            symmetry: 4,
            constraints: Vec::new(),
            guides: Vec::new(),
            indices: None,
            constrain_curvature: 0.0,
            curvature_weight: 0.0,
            feature_angle: None,
            feature_lines: Vec::new(),
            feature_edges: Vec::new(),
            align_boundary: true,
            detail: None,
        }
    }
}

impl Guidance {
    /// The edges to follow.
    ///
    /// # Errors
    /// Those of [`FeatureGraph::with_sharp`], [`FeatureGraph::from_lines`] and
    /// [`FeatureGraph::from_edges`].
    pub fn features(&self, mesh: &TriangleMesh) -> Result<FeatureGraph> {
        let lines = FeatureGraph::from_lines(mesh, &self.feature_lines)?;
        let edges = FeatureGraph::from_edges(mesh, &self.feature_edges)?;
        let mut features = lines.with(mesh, &edges)?;
        if self.align_boundary && self.symmetry != 1 {
            features = features.with(mesh, &FeatureGraph::boundary(mesh))?;
        }
        match self.feature_angle {
            Some(angle) if self.symmetry == 4 => features.with_sharp(mesh, angle),
            Some(angle) => features.with(mesh, &FeatureGraph::by_angle(mesh, angle)?),
            None => Ok(features),
        }
    }

    /// The options of a field that follows these features, for a field on its own.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for features of another mesh, [`Error::InvalidArgument`] for
    /// features of a field of single directions, and those of [`feature_constraints`],
    /// [`curvature_constraints`](super::curvature_constraints) and
    /// [`curvature_guides`](super::curvature_guides).
    pub fn field_options(
        &self,
        mesh: &TriangleMesh,
        features: &FeatureGraph,
    ) -> Result<FieldOptions> {
        self.options_at(mesh, features, self.detail.unwrap_or(0.0))
    }

    /// The same for the field that a map with quads of this edge length shall follow.
    ///
    /// # Errors
    /// As [`field_options`](Self::field_options).
    pub fn map_options(
        &self,
        mesh: &TriangleMesh,
        features: &FeatureGraph,
        edge_length: f64,
    ) -> Result<FieldOptions> {
        let detail = self.detail.unwrap_or(edge_length);
        self.options_at(mesh, features, detail)
    }

    fn options_at(
        &self,
        mesh: &TriangleMesh,
        features: &FeatureGraph,
        detail: f64,
    ) -> Result<FieldOptions> {
        let mut options = FieldOptions {
            symmetry: self.symmetry,
            constraints: self.constraints.clone(),
            firm: usize::MAX,
            guides: self.guides.clone(),
            indices: self.indices.clone(),
            detail,
        };
        options.constrain_others(match self.symmetry {
            4 => feature_constraints(mesh, features)?,
            1 if features.edges().next().is_some() => {
                return Err(Error::InvalidArgument {
                    what: "a field of symmetry 1 cannot follow features: nothing tells to which side of an edge it points".into(),
                    index: None,
                });
            }
            _ => edge_constraints(mesh, features)?,
        });
        options.firm = options.constraints.len();
        let count = curvature_guidance::count(mesh, self.constrain_curvature)?;
        curvature_guidance::check_weight(self.curvature_weight)?;
        if count > 0 || self.curvature_weight > 0.0 {
            let curvature = smoothed_curvature(mesh, smoothing_rounds(mesh, detail));
            options.constrain_others(curvature_guidance::most_reliable(&curvature, count));
            let guides = curvature_guidance::all_guides(mesh, &curvature, self.curvature_weight);
            options.guide_others(guides);
        }
        Ok(options)
    }
}

/// The most rounds of averaging curvature: a radius of 16 edges of triangles.
const MOST_ROUNDS: usize = 256;

/// The rounds of averaging over neighbours that reach as far as a length: its square over that of an
/// edge.
///
/// Directions that change within a quad are noise to that quad.
fn smoothing_rounds(mesh: &TriangleMesh, length: f64) -> usize {
    // Of an equilateral triangle with the mean area.
    let edge = 4.0 / 3f64.sqrt() * mesh.surface_area() / mesh.face_count() as f64;
    ((length * length / edge).round() as usize).clamp(SMOOTHING_ROUNDS, MOST_ROUNDS)
}
