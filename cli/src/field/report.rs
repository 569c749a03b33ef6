//! The JSON object of a field: that of a solve, with figures of the mesh and the field.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use super::CurveCounts;
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
    /// Where curves are followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    curves: Option<CurveCounts>,
    irregular_vertices: usize,
    /// How many irregular vertices have an index of so many steps of 1/N of a turn.
    index_counts: BTreeMap<i32, usize>,
    index_sum: f64,
    euler_characteristic: i64,
}

impl<'a> FieldReport<'a> {
    /// The report of what was found for the mesh in `file`.
    pub(super) fn new(file: &Path, solved: &'a Solved) -> Self {
        let (mesh, field) = (&solved.mesh, &solved.field);
        let mut index_counts = BTreeMap::new();
        for steps in field.vertex_index_steps(mesh) {
            if steps != 0 {
                *index_counts.entry(steps).or_insert(0) += 1;
            }
        }
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
            feature_edges: solved.features.len(),
            curves: solved.curves,
            irregular_vertices: index_counts.values().sum(),
            index_counts,
            index_sum: field.index_sum(mesh),
            euler_characteristic: mesh.euler_characteristic(),
        }
    }
}
