//! The quality of quads: angles, scaled Jacobians and edge lengths.

use crate::extract::QuadMesh;
use crate::mesh::vector::{Vec3, cross, dot, norm, normalize, sub};

/// Figures over all quads.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct QuadQuality {
    /// Mean over all corners of the deviation from a right angle, in degrees.
    pub angle_deviation: f64,
    /// The first percentile of the scaled Jacobians.
    pub scaled_jacobian_p1: f64,
    /// The least scaled Jacobian.
    pub scaled_jacobian_min: f64,
    /// Quads with a scaled Jacobian of zero or less.
    pub inverted: usize,
    /// Standard deviation of edge lengths, relative to their mean.
    pub edge_spread: f64,
}

impl QuadQuality {
    /// The figures of these quads. All are zero if there are no quads.
    pub fn new(quads: &QuadMesh) -> Self {
        let corners = quads
            .quads
            .iter()
            .map(|quad| quad.map(|v| quads.vertices[v as usize]));
        let corners: Vec<[Vec3; 4]> = corners.collect();
        if corners.is_empty() {
            return QuadQuality::default();
        }
        let mut jacobians: Vec<f64> = corners.iter().copied().map(scaled_jacobian).collect();
        jacobians.sort_unstable_by(f64::total_cmp);
        let count = (4 * corners.len()) as f64;
        let deviations = corners
            .iter()
            .flat_map(|c| [0, 1, 2, 3].map(|k| deviation(*c, k)));
        let length = |c: &[Vec3; 4], k: usize| norm(sub(c[(k + 1) % 4], c[k]));
        let lengths = corners
            .iter()
            .flat_map(|c| [0, 1, 2, 3].map(|k| length(c, k)));
        let (sum, squares) = lengths.fold((0.0, 0.0), |(s, q), l| (s + l, q + l * l));
        let mean = sum / count;
        QuadQuality {
            angle_deviation: deviations.sum::<f64>() / count,
            scaled_jacobian_p1: jacobians[(jacobians.len() - 1) / 100],
            scaled_jacobian_min: jacobians[0],
            inverted: jacobians.iter().take_while(|&&j| j <= 0.0).count(),
            edge_spread: (squares / count - mean * mean).max(0.0).sqrt() / mean,
        }
    }
}

/// The least over the corners of the sine of the angle, signed about the normal of the quad: the
/// direction of the cross product of its diagonals.
pub(super) fn scaled_jacobian(corners: [Vec3; 4]) -> f64 {
    let [a, b, c, d] = corners;
    let normal = normalize(cross(sub(c, a), sub(d, b)));
    let sine = |k: usize| {
        let to_next = normalize(sub(corners[(k + 1) % 4], corners[k]));
        let to_last = normalize(sub(corners[(k + 3) % 4], corners[k]));
        dot(cross(to_next, to_last), normal)
    };
    (0..4).map(sine).fold(f64::INFINITY, f64::min)
}

fn deviation(corners: [Vec3; 4], k: usize) -> f64 {
    let to_next = sub(corners[(k + 1) % 4], corners[k]);
    let to_last = sub(corners[(k + 3) % 4], corners[k]);
    let angle = norm(cross(to_next, to_last)).atan2(dot(to_next, to_last));
    (angle.to_degrees() - 90.0).abs()
}
