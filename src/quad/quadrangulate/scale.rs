//! Curvature at the scale of quads.
//!
//! Directions that change within a quad are noise to it, and each turn of them costs irregular
//! vertices. Averaging over so many rounds that its radius is an edge of a quad leaves the rest; and
//! faces are constrained by the number of quads, not by that of faces, which tells nothing of the
//! shape.

use crate::mesh::TriangleMesh;
use crate::mesh::curvature::SMOOTHING_ROUNDS;
use crate::quad::Sizing;

/// No more rounds than this, whose radius is 16 edges of triangles.
const MOST: usize = 256;

/// Rounds of averaging, each over the neighbours of a face: a radius of `sqrt(rounds)` edges.
pub(super) fn smoothing_rounds(mesh: &TriangleMesh, sizing: &Sizing) -> usize {
    let area = mesh.surface_area();
    // Of an equilateral triangle with the mean area.
    let edge = 4.0 / 3f64.sqrt() * area / mesh.face_count() as f64;
    let rounds = area / quads(mesh, sizing) / edge;
    (rounds.round() as usize).clamp(SMOOTHING_ROUNDS, MOST)
}

/// The part of the faces that are so many faces a quad.
pub(super) fn part_of_faces(mesh: &TriangleMesh, sizing: &Sizing, per_quad: f64) -> f64 {
    (per_quad * quads(mesh, sizing) / mesh.face_count() as f64).min(1.0)
}

/// About how many quads of a size that has been checked there will be.
fn quads(mesh: &TriangleMesh, sizing: &Sizing) -> f64 {
    match sizing {
        Sizing::Quads(quads) => (*quads).max(1) as f64,
        Sizing::EdgeLength(length) => mesh.surface_area() / (length * length),
        Sizing::Lengths(lengths) => {
            let faces = lengths.iter().enumerate();
            faces.map(|(face, [a, b])| mesh.area(face) / (a * b)).sum()
        }
    }
}
