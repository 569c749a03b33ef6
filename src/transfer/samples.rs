//! Points inside of a face of the quads, and the triangles beneath them.

use super::nearest::{Nearest, center, normal, radius};
use crate::mesh::vector::{Vec3, add, cross, dot, norm, scale, sub};

/// A point of a face of the quads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// The triangle beneath it.
    pub(super) triangle: u32,
    /// The area that it stands for.
    pub(super) area: f64,
}

/// Sixteen samples of a quad, four by four of equal parameters of its bilinear patch. Other polygons are four-sided
/// parts between a corner, the middles of two sides and the center; each has four samples.
pub(super) fn samples_of(nearest: &Nearest, corners: &[Vec3]) -> Vec<Sample> {
    let n = corners.len();
    let (center, reach) = (center(corners), radius(corners));
    let whole = normal(corners);
    let middle = |k: usize| scale(add(corners[k % n], corners[(k + 1) % n]), 0.5);
    let mut samples: Vec<Sample> = Vec::with_capacity(4 * n);
    for k in 0..n {
        let part = [corners[k], middle(k), center, middle(k + n - 1)];
        for [s, t] in [[0.25, 0.25], [0.75, 0.25], [0.75, 0.75], [0.25, 0.75]] {
            let (point, tangents) = on_patch(part, s, t);
            let [along, across] = tangents;
            let own = cross(along, across);
            // Where the patch is folded over, the normal of the whole face tells the side.
            let side = if dot(own, whole) > 0.0 { own } else { whole };
            let hint = samples.last().map(|sample| sample.triangle as usize);
            let (triangle, _) = nearest.find(point, side, reach, hint);
            samples.push(Sample {
                triangle: triangle as u32,
                area: 0.25 * norm(own),
            });
        }
    }
    samples
}

/// The point of a bilinear patch, and its derivatives.
fn on_patch([a, b, c, d]: [Vec3; 4], s: f64, t: f64) -> (Vec3, [Vec3; 2]) {
    let between = |p: Vec3, q: Vec3, x: f64| add(scale(p, 1.0 - x), scale(q, x));
    let (low, high) = (between(a, b, s), between(d, c, s));
    let along = between(sub(b, a), sub(c, d), t);
    (between(low, high, t), [along, sub(high, low)])
}
