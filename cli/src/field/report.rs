//! The JSON object of a field: that of a solve, with figures of the mesh and the field.

use std::path::Path;

use serde::Serialize;

use super::solved::Solved;
use crate::mesh::RepairCounts;
use crate::report::Report;

/// What `--json` prints of a field.
#[derive(Serialize)]
pub struct FieldReport<'a> {
    #[serde(flatten)]
    solve: Report<'a>,
    repair: &'a RepairCounts,
    faces: usize,
    vertices: usize,
    symmetry: u8,
    feature_edges: usize,
    irregular_vertices: usize,
    index_sum: f64,
    euler_characteristic: i64,
}

impl<'a> FieldReport<'a> {
    /// The report of what was found for the mesh in `file`.
    pub(super) fn new(file: &Path, solved: &'a Solved) -> Self {
        let (mesh, field) = (&solved.mesh, &solved.field);
        FieldReport {
            solve: Report::new(
                file,
                solved.strategy.name(),
                solved.before,
                &solved.solution,
                roundel::peak_memory(),
            ),
            repair: &solved.repair,
            faces: mesh.face_count(),
            vertices: mesh.vertex_count(),
            symmetry: field.symmetry(),
            feature_edges: solved.features,
            irregular_vertices: field.irregular_vertices(mesh).len(),
            index_sum: field.index_sum(mesh),
            euler_characteristic: mesh.euler_characteristic(),
        }
    }
}
