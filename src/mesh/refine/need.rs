//! When a mesh needs refinement: edges that are long beside those of the quads, and needles.

use crate::mesh::TriangleMesh;
use crate::monitor::in_parts;

/// Angles below this, 2 degrees, ask for refinement.
pub const SMALL_ANGLE: f64 = 2.0 / 180.0 * std::f64::consts::PI;

/// Edges longer than this many edges of quads ask for refinement.
const LONG: f64 = 3.0;

/// The least number of edges that are worth a thread.
const LEAST: usize = 1 << 12;

/// Why a mesh needs refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Need {
    /// The longest edge is longer than three edges of the quads; its length.
    LongEdge(f64),
    /// The smallest angle is below [`SMALL_ANGLE`]; the angle in radians.
    SmallAngle(f64),
}

/// Whether a mesh needs refinement for quads with edges of this length, and why.
pub fn needs_refinement(mesh: &TriangleMesh, edge_length: f64) -> Option<Need> {
    let lengths = in_parts(mesh.edge_count(), LEAST, |edges| {
        let sides = edges.map(|e| mesh.edge(e).first);
        let lengths = sides.map(|(face, k)| mesh.edge_length(face, k));
        lengths.fold(0.0, f64::max)
    });
    let longest = lengths.into_iter().fold(0.0, f64::max);
    if longest > LONG * edge_length {
        return Some(Need::LongEdge(longest));
    }
    let angles = mesh.angles().as_flattened().iter().copied();
    let smallest = angles.fold(f64::INFINITY, f64::min);
    (smallest < SMALL_ANGLE).then_some(Need::SmallAngle(smallest))
}
