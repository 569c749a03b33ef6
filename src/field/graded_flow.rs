//! The turn of transports in a metric in which lengths that vary over the surface are equal.
//!
//! Quads whose edges are to have length h are unit squares in the metric g / h^2. That metric is conformal to the
//! surface's own: with the factor e^(2 phi), phi = -log h, the Gaussian curvature of a vertex, as an angle, grows by
//!
//! ```text
//! sum over its edges of w (phi_v - phi_other),    w half the sum of the cotangents opposite to the edge
//! ```
//!
//! which is the cotangent Laplacian (`pinkall1993`) of phi. So as much curvature moves along each edge, and the
//! transport over the edge turns by it.

use super::FieldOptions;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cotangent, sub};
use crate::monitor::collect_in_parts;

/// The largest weight of an edge: thin triangles would turn the field by any angle.
const LARGEST_WEIGHT: f64 = 3.0;

/// The least number of edges that are worth a thread.
const LEAST: usize = 1 << 12;

/// The additional turn of the transport over every edge, from its first to its second face: the curvature that
/// moves from the first end of the edge to the second. 0 where the options give no lengths.
///
/// # Errors
/// [`Error::LengthMismatch`]; with the vertex, [`Error::NotFinite`] and [`Error::InvalidArgument`] for a length that
/// is not above 0.
pub(super) fn graded_flow(mesh: &TriangleMesh, options: &FieldOptions) -> Result<Vec<f64>> {
    let lengths = &options.lengths;
    if lengths.is_empty() {
        return Ok(vec![0.0; mesh.edge_count()]);
    }
    if lengths.len() != mesh.vertex_count() {
        return Err(Error::LengthMismatch {
            what: "lengths of vertices",
            expected: mesh.vertex_count(),
            actual: lengths.len(),
        });
    }
    for (position, &length) in lengths.iter().enumerate() {
        if !length.is_finite() {
            return Err(Error::NotFinite {
                what: "lengths of vertices",
                position,
            });
        }
        if length <= 0.0 {
            return Err(Error::InvalidArgument {
                what: format!("the length of vertex {position} is {length}; it must be above 0"),
                index: Some(position),
            });
        }
    }
    let moved = |e: usize| {
        let edge = mesh.edge(e);
        let Some(second) = edge.second else {
            return 0.0;
        };
        let weight: f64 = [edge.first, second]
            .map(|(f, k)| opposite(mesh, f, k))
            .iter()
            .sum();
        let [a, b] = edge.vertices.map(|v| -lengths[v].ln());
        (0.5 * weight).clamp(-LARGEST_WEIGHT, LARGEST_WEIGHT) * (b - a)
    };
    Ok(collect_in_parts(mesh.edge_count(), LEAST, moved))
}

/// The cotangent of the angle opposite to a local edge.
fn opposite(mesh: &TriangleMesh, face: usize, k: usize) -> f64 {
    let corners = mesh.corner_positions(face);
    let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
    cotangent(sub(a, c), sub(b, c))
}
