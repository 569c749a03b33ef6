//! The distance that irregular vertices keep from features: an edge of the quads, unless the guidance says otherwise.
//!
//! Where the quads of the first field do not conform, the tries after it do without, and the best of them is followed
//! by one with it: the constraints of such fields take long where features are many.

use super::QuadOptions;
use super::attempt::Attempt;
use super::driver::Driver;
use super::final_error::is_final;
use crate::error::Result;
use crate::field::OrientationField;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::{Monitor, optional};

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

/// Quads of a field that keeps irregular vertices away from features, where the best quads have another one, and these
/// are as whole.
pub(super) fn keep_clear<'m, M: Fn() -> Monitor<'m>>(
    driver: &mut Driver<'_, M>,
    best: Attempt,
) -> Result<Attempt> {
    if driver.keeps_clear || !best.outcome.conforms() || driver.work.get() == 0 {
        return Ok(best);
    }
    let regular = driver.regular(&best)?;
    let field = &driver.at(&best).field;
    if near_features(driver.mesh, field, &regular) == 0 {
        return Ok(best);
    }
    let most_visits = best.map.visited.max(driver.mesh.face_count());
    let (before, monitor) = (driver.most_visits, driver.monitor);
    (driver.keeps_clear, driver.most_visits) = (true, most_visits);
    let found = optional(monitor, || {
        let found = driver.follow(false)?;
        driver.untangled_if_needed(found)
    });
    driver.most_visits = before;
    match found {
        Err(error) if is_final(&error) => Err(error),
        Ok(Some(found)) if found.outcome.is_as_whole_as(&best.outcome) => Ok(found),
        // The quads that there are remain.
        _ => {
            driver.keeps_clear = false;
            Ok(best)
        }
    }
}

/// The number of irregular vertices of a field among those that should be regular.
pub(super) fn near_features(
    mesh: &TriangleMesh,
    field: &OrientationField,
    regular: &[usize],
) -> usize {
    let steps = field.vertex_index_steps(mesh);
    regular.iter().filter(|&&v| steps[v] != 0).count()
}
