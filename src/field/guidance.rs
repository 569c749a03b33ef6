//! What a field and its map follow: features, boundary, directions, curvature and indices, stated once
//! for both.
//!
//! If several of them determine the direction of a face, the first of these decides: a given direction,
//! a feature or the boundary, a reliable curvature.

use super::feature_alignment::edge_constraints;
use super::{
    Constraint, FieldOptions, Guide, PrescribedIndex, curvature_guidance, feature_constraints,
    near_features,
};
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::curvature::{SMOOTHING_ROUNDS, watched_curvature};
use crate::mesh::features::FeatureGraph;
use crate::monitor::{Monitor, may_continue};
use crate::search::table::options;

options! {
    /// What a field follows, and which edges become isolines of its map. The default is crosses that
    /// follow the boundary, where there is one, and nothing else.
    pub struct Guidance,

    /// The options of a guidance; lists of elements are members of [`Guidance`] alone.
    GUIDANCE_OPTIONS {
        /// See [`FieldOptions::symmetry`].
        symmetry: u8 = 4, "4" in "1|2|4|6",
            "the number of arms of a direction: 4 for crosses, which a map needs";
        /// See [`curvature_constraints`](super::curvature_constraints).
        constrain_curvature: f64 = 0.0, "0" in "[0, 1]",
            "the fraction of the faces that take the direction of least absolute curvature: those where it is most reliable";
        /// See [`curvature_guides`](super::curvature_guides).
        curvature_weight: f64 = 0.0, "0" in "[0, inf)",
            "the weight with which all other faces follow the direction of least absolute curvature, for an area of 1 and absolute curvatures that differ by 1";
        /// For crosses at most two edges of a face become features.
        feature_angle: Option<f64> = None, "unset" in "[0, 3.141592653589793]",
            "an edge is a feature if the normals of its faces differ by this many radians or more; 0: none is";
        /// See [`FeatureGraph::without_short`].
        feature_length: Option<f64> = None, "unset" in "[0, inf)",
            "curves of sharp edges that end somewhere are features if they are at least this long, and patches between sharp edges if their area is at least a sixteenth of its square; unset: 0 for a field or a map, two edges of the quads for quads";
        /// A field of single directions, N = 1, does not follow them: the side of an edge on which it should
        /// lie is undefined.
        align_boundary: bool = true, "1" in "[0, 1]",
            "1: the edges of the boundary are features";
        /// Directions of curvature are those at this scale; see [`FieldOptions::detail`],
        /// [`map_options`](Self::map_options) and
        /// [`quadrangulate`](crate::quad::quadrangulate).
        detail: Option<f64> = None, "unset" in "[0, inf)",
            "details smaller than this length attract no irregular vertices; unset: 0 for a field, an edge of the quads for a map, a quarter of an edge for quads";
        /// See [`near_features`](super::near_features).
        clearance: Option<f64> = None, "unset" in "[0, inf)",
            "irregular vertices keep this far from features, or lie on them; unset: 0 for a field or a map, for quads an edge of theirs if there are features inside the surface";
    }
    and {
        /// Directions that faces have, each face at most once.
        constraints: Vec<Constraint> = Vec::new();
        /// Directions that faces should have, each face at most once. A face with a constraint keeps
        /// that.
        guides: Vec<Guide> = Vec::new();
        /// The index of every irregular vertex; none leaves that to the energy.
        indices: Option<Vec<PrescribedIndex>> = None;
        /// Features: edges between these vertices.
        feature_lines: Vec<[usize; 2]> = Vec::new();
        /// Features by number of the edge.
        feature_edges: Vec<usize> = Vec::new();
    }
    by {}
}

/// The least length of a curve of sharp edges that quads follow, in edges of theirs, if the caller does not say it.
const FEATURE_EDGES: f64 = 2.0;

impl Guidance {
    /// The edges to follow.
    ///
    /// # Errors
    /// Those of [`FeatureGraph::with_sharp`], [`FeatureGraph::from_lines`] and
    /// [`FeatureGraph::from_edges`].
    pub fn features(&self, mesh: &TriangleMesh) -> Result<FeatureGraph> {
        let given = self.given_features(mesh)?;
        let Some(angle) = self.feature_angle.filter(|&angle| angle != 0.0) else {
            return Ok(given);
        };
        let with_sharp = match self.symmetry {
            4 => given.clone().with_sharp(mesh, angle)?,
            _ => (given.clone()).with(mesh, &FeatureGraph::by_angle(mesh, angle)?)?,
        };
        self.without_short(mesh, with_sharp, &given)
    }

    /// The same, and the third edge of each face between sharp edges: a face that will be divided can follow all three.
    pub(crate) fn features_to_divide(&self, mesh: &TriangleMesh) -> Result<FeatureGraph> {
        let features = self.features(mesh)?;
        let Some(angle) = self.feature_angle.filter(|&angle| angle != 0.0) else {
            return Ok(features);
        };
        let sharp = FeatureGraph::by_angle(mesh, angle)?;
        let with_sharp = sharp.with(mesh, &features)?;
        self.without_short(mesh, with_sharp, &features)
    }

    /// The features that the caller names, without sharp edges.
    fn given_features(&self, mesh: &TriangleMesh) -> Result<FeatureGraph> {
        let lines = FeatureGraph::from_lines(mesh, &self.feature_lines)?;
        let edges = FeatureGraph::from_edges(mesh, &self.feature_edges)?;
        let given = lines.with(mesh, &edges)?;
        match self.align_boundary && self.symmetry != 1 {
            true => given.with(mesh, &FeatureGraph::boundary(mesh)),
            false => Ok(given),
        }
    }

    /// The features without what is too short, but with all edges of `held`.
    fn without_short(
        &self,
        mesh: &TriangleMesh,
        features: FeatureGraph,
        held: &FeatureGraph,
    ) -> Result<FeatureGraph> {
        match self.feature_length.filter(|&length| length != 0.0) {
            Some(length) => features.without_short(mesh, held, length),
            None => Ok(features),
        }
    }

    /// The same guidance for quads of this edge length: it says which sharp edges are too short for them.
    pub fn for_quads(&self, edge_length: f64) -> Self {
        Guidance {
            feature_length: self.feature_length.or(Some(FEATURE_EDGES * edge_length)),
            ..self.clone()
        }
    }

    /// The options of a field that follows these features, for a field on its own.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for features of another mesh, [`Error::InvalidArgument`] for
    /// features of a field of single directions, and those of [`feature_constraints`],
    /// [`curvature_constraints`](super::curvature_constraints), [`curvature_guides`](super::curvature_guides) and
    /// [`near_features`](super::near_features).
    pub fn field_options(
        &self,
        mesh: &TriangleMesh,
        features: &FeatureGraph,
    ) -> Result<FieldOptions> {
        let regular = self.regular(mesh, features, None, &Monitor::default())?;
        self.options_with(mesh, features, regular)
    }

    /// The same with vertices that should be regular.
    pub(crate) fn options_with(
        &self,
        mesh: &TriangleMesh,
        features: &FeatureGraph,
        regular: Vec<usize>,
    ) -> Result<FieldOptions> {
        Ok(FieldOptions {
            regular,
            ..self.options_at(mesh, features, self.detail.unwrap_or(0.0))?
        })
    }

    /// The vertices that should be regular to be as far from features as the clearance asks for, or, where it is not
    /// set, these lengths at every vertex.
    ///
    /// # Errors
    /// Those of [`near_features`], and of a clearance that is no length.
    pub(crate) fn regular(
        &self,
        mesh: &TriangleMesh,
        features: &FeatureGraph,
        otherwise: Option<Vec<f64>>,
        monitor: &Monitor,
    ) -> Result<Vec<usize>> {
        let lengths = match self.clearance {
            Some(0.0) => None,
            Some(clearance) => Some(vec![clearance; mesh.vertex_count()]),
            None => otherwise,
        };
        match lengths {
            Some(lengths) => near_features(mesh, features, &lengths, monitor),
            None => Ok(Vec::new()),
        }
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
        let regular = self.regular(mesh, features, None, &Monitor::default())?;
        Ok(FieldOptions {
            regular,
            ..self.options_at(mesh, features, detail)?
        })
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
            regular: Vec::new(),
            kept_turns: Vec::new(),
            detail,
            lengths: Vec::new(),
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
        may_continue()?;
        let count = curvature_guidance::count(mesh, self.constrain_curvature)?;
        curvature_guidance::check_weight(self.curvature_weight)?;
        if count > 0 || self.curvature_weight > 0.0 {
            let curvature = watched_curvature(mesh, smoothing_rounds(mesh, detail))?;
            may_continue()?;
            options.constrain_others(curvature_guidance::most_reliable(&curvature, count));
            may_continue()?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::table::hold;

    #[test]
    fn every_option_of_the_table_starts_at_its_default_and_comes_back_as_set() {
        hold(GUIDANCE_OPTIONS, Guidance::set, Guidance::get);
    }
}
