//! The rectangle closest to four points.

use crate::mesh::vector::{Vec3, add, cross, dot, normalize, scale, sub};

/// Twice the vectors along the first and the third edge of a quad, and along the second and the fourth.
pub(super) fn sides([a, b, c, d]: [Vec3; 4]) -> [Vec3; 2] {
    [add(sub(b, a), sub(c, d)), add(sub(d, a), sub(c, b))]
}

/// The rectangle about the centre of these corners that is closest to them, in the plane normal to the cross product
/// of their diagonals. `uniformity` blends the lengths of its edges, the first and the second, with those given.
pub(super) fn closest(corners: [Vec3; 4], edges: [f64; 2], uniformity: f64) -> [Vec3; 4] {
    let [a, b, c, d] = corners;
    let center = scale(add(add(a, b), add(c, d)), 0.25);
    let normal = normalize(cross(sub(c, a), sub(d, b)));
    let [first, second] = sides(corners);
    // Both point along the first edge.
    let both = [first, cross(second, normal)];
    let sum = add(both[0], both[1]);
    let axis = normalize(sub(sum, scale(normal, dot(normal, sum))));
    let half = [0, 1].map(|k| {
        let length = 0.5 * dot(both[k], axis);
        0.5 * (length + uniformity * (edges[k] - length))
    });
    let along = scale(axis, half[0]);
    let across = scale(cross(normal, axis), half[1]);
    let [low, high] = [sub(center, across), add(center, across)];
    [
        sub(low, along),
        add(low, along),
        add(high, along),
        sub(high, along),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::vector::norm;
    use crate::smooth::square;

    #[test]
    fn a_rectangle_of_the_wanted_size_is_closest_to_itself() {
        let corners = [
            [1.0, 2.0, 3.0],
            [1.0, 5.0, 3.0],
            [0.0, 5.0, 3.0],
            [0.0, 2.0, 3.0],
        ];
        for (corner, found) in corners.into_iter().zip(closest(corners, [3.0, 1.0], 0.7)) {
            assert!(norm(sub(corner, found)) < 1e-14);
        }
        let [_, b, c, _] = closest(corners, [1.0, 2.0], 0.5);
        assert!((norm(sub(b, c)) - 1.5).abs() < 1e-14);
    }

    #[test]
    fn of_points_that_are_nearly_a_square_it_is_nearly_the_closest_square() {
        let corners = [
            [0.0, 0.0, 0.1],
            [1.3, 0.2, -0.1],
            [1.1, 1.4, 0.2],
            [-0.2, 1.4, 0.0],
        ];
        let squares = square::closest(corners, 1.25, 1.0);
        for (square, rectangle) in squares.into_iter().zip(closest(corners, [1.25; 2], 1.0)) {
            assert!(norm(sub(square, rectangle)) < 1e-14);
        }
    }
}
