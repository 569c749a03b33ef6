//! Curvature at the scale of quads.
//!
//! Directions that change within a quad are noise to it, and each turn of them costs irregular
//! vertices. Averaging over so many rounds that its radius is an edge of a quad leaves the rest.

use crate::mesh::TriangleMesh;
use crate::mesh::curvature::SMOOTHING_ROUNDS;
use crate::quad::Sizing;

/// No more rounds than this, whose radius is 16 edges of triangles.
const MOST: usize = 256;

/// Rounds of averaging, each over the neighbours of a face: a radius of `sqrt(rounds)` edges.
pub(super) fn smoothing_rounds(mesh: &TriangleMesh, sizing: &Sizing) -> usize {
    let area = mesh.surface_area();
    let quad = match sizing {
        Sizing::Quads(quads) => area / (*quads).max(1) as f64,
        Sizing::EdgeLength(length) => length * length,
        Sizing::Lengths(_) => return SMOOTHING_ROUNDS,
    };
    // Of an equilateral triangle with the mean area.
    let edge = 4.0 / 3f64.sqrt() * area / mesh.face_count() as f64;
    ((quad / edge).round() as usize).clamp(SMOOTHING_ROUNDS, MOST)
}
