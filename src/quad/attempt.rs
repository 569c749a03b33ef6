//! The quads of one map, and their quality.

use super::missed::missed;
use super::outcome::Outcome;
use crate::error::Result;
use crate::extract::{IntegerGridMap, QuadMesh, extract};
use crate::map::SeamlessMap;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, may_continue};
use crate::solve::Solution;
use crate::untangle::Untangled;

/// A map is given up if more than one face in this many is folded.
const FOLDED_PART: usize = 4;

/// A map and its quads.
pub(super) struct Attempt {
    /// The number of the field that the map follows.
    pub(super) field: usize,
    pub(super) solution: Solution,
    pub(super) map: Untangled,
    pub(super) quads: QuadMesh,
    /// Features that no edge of a quad follows.
    pub(super) missed: Vec<usize>,
    pub(super) outcome: Outcome,
}

impl Attempt {
    /// The quads of a map that is to follow these features with so many quads.
    pub(super) fn new(
        mesh: &TriangleMesh,
        (features, asked): (&[usize], f64),
        field: usize,
        solution: Solution,
        map: Untangled,
        monitor: &mut Monitor,
    ) -> Result<Self> {
        may_continue()?;
        let exact = IntegerGridMap::from_seamless(mesh, &map.map)?;
        let quads = extract(mesh, &exact, monitor)?;
        may_continue()?;
        let missed = missed(mesh, &quads, features);
        Ok(Attempt {
            outcome: Outcome::of_quads(&quads, asked, missed.len()),
            field,
            solution,
            map,
            quads,
            missed,
        })
    }
}

/// Whether so much of a map is folded that neither untangling nor other integers help: quads of this size
/// are too large for the details of the surface.
pub(super) fn is_hopeless(mesh: &TriangleMesh, map: &SeamlessMap) -> bool {
    FOLDED_PART * map.flipped().len() > mesh.face_count()
}
