//! The distance that irregular vertices keep from features: an edge of the quads, unless the guidance says otherwise.

use super::QuadOptions;
use crate::error::Result;
use crate::field::{FieldOptions, OrientationField};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::Monitor;

/// What the fields of one size of quads keep to.
#[derive(Debug, Clone, Default)]
pub(super) struct Clearance {
    /// See [`FieldOptions::regular`].
    pub(super) regular: Vec<usize>,
    /// See [`FieldOptions::kept_turns`].
    pub(super) kept_turns: Vec<usize>,
}

impl Clearance {
    /// The clearance of these features. A boundary alone has none, unless the guidance asks for it: quads that follow
    /// no features are those without this step. With `off_features`, no irregular vertices move onto features.
    ///
    /// # Errors
    /// Those of [`near_features`](crate::field::near_features) and of sizes that no map can have.
    pub(super) fn new(
        mesh: &TriangleMesh,
        options: &QuadOptions,
        features: &FeatureGraph,
        off_features: bool,
        monitor: &Monitor,
    ) -> Result<Self> {
        let is_inner = |e: usize| mesh.edge(e).second.is_some();
        let of_quads = match features.edges().any(is_inner) {
            true => Some(options.sizing.lengths_at_vertices(mesh)?),
            false => None,
        };
        let regular = options
            .guidance
            .regular(mesh, features, of_quads, monitor)?;
        let on_features = (0..mesh.vertex_count()).filter(|&v| features.degree(v) > 0);
        let kept_turns = match off_features && !regular.is_empty() {
            true => on_features.collect(),
            false => Vec::new(),
        };
        Ok(Clearance {
            regular,
            kept_turns,
        })
    }
}

/// The number of irregular vertices of a field among those that should be regular.
pub(super) fn near_features(
    mesh: &TriangleMesh,
    field: &OrientationField,
    options: &FieldOptions,
) -> usize {
    let steps = field.vertex_index_steps(mesh);
    options.regular.iter().filter(|&&v| steps[v] != 0).count()
}
