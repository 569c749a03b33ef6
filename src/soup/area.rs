//! Triangles without area: the one predicate that repair and the strict mesh share.

use crate::linalg::vector::{Vec3, cross, dot, sub};

/// A face has no area if twice its area is at most this fraction of the square of its longest edge.
///
/// Rounding of the coordinates alone gives a collinear triangle about 1e-16. Needles above the
/// tolerance are valid: their angles are still right to a few digits.
pub const ZERO_AREA_TOLERANCE: f64 = 1e-14;

pub(crate) fn has_no_area([a, b, c]: [Vec3; 3]) -> bool {
    let edges = [sub(b, a), sub(c, b), sub(a, c)];
    let largest = edges.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return true;
    }
    // Scaled first, so that neither tiny nor huge coordinates leave the range of the squares.
    let [u, v, w] = edges.map(|e| e.map(|x| x / largest));
    let normal = cross(u, v);
    let longest = dot(u, u).max(dot(v, v)).max(dot(w, w));
    dot(normal, normal).sqrt() <= ZERO_AREA_TOLERANCE * longest
}
