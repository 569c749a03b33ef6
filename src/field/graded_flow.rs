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
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cotangent, sub};
use crate::mesh::vertex_values::check_positive;
use crate::monitor::collect_in_parts;

/// The largest weight of an edge: thin triangles would turn the field by any angle.
const LARGEST_WEIGHT: f64 = 3.0;

/// The least number of edges that are worth a thread.
const LEAST: usize = 1 << 12;

/// The additional turn of the transport over every edge, from its first to its second face: the curvature that
/// moves from the first end of the edge to the second. 0 where the options give no lengths.
///
/// # Errors
/// Those of [`check_positive`].
pub(super) fn graded_flow(mesh: &TriangleMesh, options: &FieldOptions) -> Result<Vec<f64>> {
    let lengths = &options.lengths;
    if lengths.is_empty() {
        return Ok(vec![0.0; mesh.edge_count()]);
    }
    check_positive(mesh, "lengths of vertices", lengths)?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::solve_field;
    use crate::mesh::shape::by_name;
    use crate::monitor::Monitor;
    use crate::search::Options;

    fn of(lengths: Vec<f64>) -> FieldOptions {
        FieldOptions {
            lengths,
            ..FieldOptions::default()
        }
    }

    #[test]
    fn equal_lengths_turn_nothing() {
        let mesh = by_name("torus", 800).unwrap();
        for lengths in [Vec::new(), vec![0.3; mesh.vertex_count()]] {
            let flow = graded_flow(&mesh, &of(lengths)).unwrap();
            assert!(flow.iter().all(|&turn| turn == 0.0));
        }
    }

    /// In the metric of lengths |p|^2 a plane is flat but for the origin: polar coordinates of the
    /// inversion. Around every vertex but those near the origin curvature stays 0.
    #[test]
    fn lengths_of_a_conformal_map_of_the_plane_leave_it_flat() {
        let mesh = by_name("plane", 20_000).unwrap();
        let square = |v: usize| mesh.position(v).iter().map(|x| x * x).sum::<f64>();
        let lengths = (0..mesh.vertex_count())
            .map(|v| square(v).max(1e-9))
            .collect();
        let flow = graded_flow(&mesh, &of(lengths)).unwrap();
        let mut inflow = vec![0.0; mesh.vertex_count()];
        for (edge, turn) in mesh.edges().zip(&flow) {
            let [a, b] = edge.vertices;
            inflow[a] -= turn;
            inflow[b] += turn;
        }
        let far = |v: usize| square(v) > 0.1 && !mesh.is_boundary_vertex(v);
        let most = (0..inflow.len())
            .filter(|&v| far(v))
            .map(|v| inflow[v].abs())
            .fold(0.0, f64::max);
        assert!(most < 2e-4, "{most}");
        // log |p|^-2 has a source of -4 pi.
        let inside: f64 = (0..inflow.len())
            .filter(|&v| square(v) <= 0.1)
            .map(|v| inflow[v])
            .sum();
        assert!(
            (inside.abs() / (4.0 * std::f64::consts::PI) - 1.0).abs() < 0.01,
            "{inside}"
        );
    }

    #[test]
    fn small_quads_in_a_plane_have_irregular_vertices_around_them() {
        let mesh = by_name("plane", 3_000).unwrap();
        let middle = |v: usize| mesh.position(v).iter().map(|x| x * x).sum::<f64>();
        let lengths: Vec<f64> = (0..mesh.vertex_count())
            .map(|v| 1.0 - 0.9 * (-8.0 * middle(v)).exp())
            .collect();
        let irregular = |lengths: Vec<f64>| -> Vec<(usize, i32)> {
            let solve = Options::default();
            let found = solve_field(&mesh, &of(lengths), &solve, Monitor::default).unwrap();
            let steps = found.0.vertex_index_steps(&mesh).into_iter().enumerate();
            steps.filter(|&(_, steps)| steps != 0).collect()
        };
        assert_eq!(irregular(Vec::new()), []);
        // Around the middle the metric has a curvature of 4.8 quarters of a turn.
        let found = irregular(lengths);
        let inside = found.iter().filter(|&&(v, _)| middle(v) < 0.1);
        let quarters: i32 = inside.map(|&(_, steps)| steps).sum();
        assert!((3..=6).contains(&quarters), "{found:?}");
    }

    #[test]
    fn lengths_are_as_many_as_vertices_finite_and_above_zero() {
        let mesh = by_name("torus", 800).unwrap();
        let refused = |length: f64| {
            let mut lengths = vec![1.0; mesh.vertex_count()];
            lengths[3] = length;
            let error = graded_flow(&mesh, &of(lengths)).unwrap_err();
            (error.code(), error.index())
        };
        assert_eq!(refused(0.0), ("invalid_argument", Some(3)));
        assert_eq!(refused(f64::INFINITY), ("not_finite", Some(3)));
        assert_eq!(
            graded_flow(&mesh, &of(vec![1.0])).unwrap_err().code(),
            "length_mismatch"
        );
    }
}
