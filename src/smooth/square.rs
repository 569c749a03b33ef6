//! The square closest to four points.

use crate::extract::QuadMesh;
use crate::mesh::vector::{Vec3, add, cross, dot, norm, normalize, scale, sub};

/// The square about the centre of these corners that is closest to them, in the plane normal to the
/// cross product of their diagonals. `uniformity` blends its size with the given edge length.
pub(super) fn closest(corners: [Vec3; 4], edge: f64, uniformity: f64) -> [Vec3; 4] {
    let [a, b, c, d] = corners;
    let center = scale(add(add(a, b), add(c, d)), 0.25);
    let normal = normalize(cross(sub(c, a), sub(d, b)));
    // The sum of all corners, each turned back to the first: corner k by k quarters about the normal.
    let mut arm = [0.0; 3];
    for (k, corner) in corners.into_iter().enumerate() {
        let from = sub(corner, center);
        let flat = sub(from, scale(normal, dot(normal, from)));
        arm = add(arm, (0..k).fold(flat, |v, _| cross(v, normal)));
    }
    let length = 0.25 * norm(arm);
    let wanted = edge / std::f64::consts::SQRT_2;
    let arm = scale(normalize(arm), length + uniformity * (wanted - length));
    let mut turned = arm;
    corners.map(|_| {
        let corner = add(center, turned);
        turned = cross(normal, turned);
        corner
    })
}

/// Mean length of the edges of quads.
pub(super) fn mean_edge(quads: &QuadMesh) -> f64 {
    let corners = quads
        .quads
        .iter()
        .map(|quad| quad.map(|v| quads.vertices[v as usize]));
    let lengths = corners.flat_map(|c| [0, 1, 2, 3].map(|k| norm(sub(c[(k + 1) % 4], c[k]))));
    let (sum, count) = lengths.fold((0.0, 0), |(sum, n), length| (sum + length, n + 1));
    sum / f64::from(count.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_of_the_wanted_size_is_closest_to_itself() {
        let corners = [
            [1.0, 2.0, 3.0],
            [3.0, 2.0, 3.0],
            [3.0, 4.0, 3.0],
            [1.0, 4.0, 3.0],
        ];
        for (corner, found) in corners.into_iter().zip(closest(corners, 2.0, 0.7)) {
            assert!(norm(sub(corner, found)) < 1e-14);
        }
    }

    #[test]
    fn what_is_asked_for_is_a_square() {
        let corners = [
            [0.0, 0.0, 0.1],
            [1.3, 0.2, -0.1],
            [1.1, 0.9, 0.2],
            [-0.2, 1.4, 0.0],
        ];
        let [a, b, c, d] = closest(corners, 1.0, 0.5);
        let lengths = [[a, b], [b, c], [c, d], [d, a]].map(|[p, q]| norm(sub(q, p)));
        assert!(lengths.iter().all(|l| (l - lengths[0]).abs() < 1e-14));
        assert!(dot(sub(b, a), sub(d, a)).abs() < 1e-14);
    }
}
