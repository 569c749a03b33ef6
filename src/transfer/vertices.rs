//! Numbers of vertices at places of the mesh.

use super::nearest::Place;
use crate::mesh::TriangleMesh;

pub(super) fn interpolated(
    mesh: &TriangleMesh,
    places: &[Place],
    components: usize,
    values: &[f64],
) -> Vec<f64> {
    let mut found = Vec::with_capacity(components * places.len());
    for &(face, weights) in places {
        let corners = mesh.corners(face);
        let of = |k: usize| corners.map(|vertex| values[components * vertex + k]);
        found.extend((0..components).map(|k| mixed(weights, of(k))));
    }
    found
}

/// The value at barycentric coordinates, which rounding does not take out of the range of the three. Values without
/// weight do not count.
pub(super) fn mixed(weights: [f64; 3], values: [f64; 3]) -> f64 {
    let [mut sum, mut least, mut most] = [0.0, f64::INFINITY, f64::NEG_INFINITY];
    for (weight, value) in weights.into_iter().zip(values) {
        if weight > 0.0 {
            sum += weight * value;
            least = least.min(value);
            most = most.max(value);
        }
    }
    match sum.is_nan() {
        true => sum,
        false => sum.clamp(least, most),
    }
}
