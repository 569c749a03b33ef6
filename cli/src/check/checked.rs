//! What `roundel check` found, for its summary and its report.

use roundel::check::MapCheck;
use roundel::mesh::TriangleMesh;

/// A map that has been checked.
pub(super) struct Checked {
    pub(super) mesh: TriangleMesh,
    pub(super) check: MapCheck,
    pub(super) read: f64,
    pub(super) seconds: f64,
}
