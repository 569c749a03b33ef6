//! What `roundel field` found, for its summary and its report.

use roundel::field::OrientationField;
use roundel::mesh::TriangleMesh;
use roundel::{Solution, Strategy};

use super::CurveCounts;
use crate::changes::Changes;
use crate::mesh::RepairCounts;
use crate::report::Preparation;

/// A field, and how it was found.
pub(super) struct Solved {
    pub(super) strategy: Strategy,
    pub(super) mesh: TriangleMesh,
    pub(super) repair: RepairCounts,
    pub(super) changes: Changes,
    pub(super) curves: Option<CurveCounts>,
    /// The edges that it follows.
    pub(super) features: Vec<usize>,
    pub(super) field: OrientationField,
    pub(super) solution: Solution,
    pub(super) before: Preparation,
    /// Seconds that files and picture took.
    pub(super) written: f64,
}
