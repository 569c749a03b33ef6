//! Barycentric coordinates in a triangle.

use super::vector::{Vec3, cross, dot, sub};

/// The barycentric coordinates of a point of a triangle in space: none is negative, and their sum is 1. A triangle
/// without area has equal ones.
pub(crate) fn barycentric([a, b, c]: [Vec3; 3], p: Vec3) -> [f64; 3] {
    let normal = cross(sub(b, a), sub(c, a));
    let opposite = [[b, c], [c, a], [a, b]];
    let parts = opposite.map(|[q, r]| dot(normal, cross(sub(q, p), sub(r, p))).max(0.0));
    let sum: f64 = parts.iter().sum();
    match sum > 0.0 {
        true => parts.map(|part| part / sum),
        false => [1.0 / 3.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_give_the_point_back_and_are_those_of_a_corner_there() {
        let corners = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 2.0, 3.0]];
        for (k, &corner) in corners.iter().enumerate() {
            let expected = [0, 1, 2].map(|i| f64::from(u8::from(i == k)));
            assert_eq!(barycentric(corners, corner), expected);
        }
        let weights = [0.5, 0.25, 0.25];
        let point = [0, 1, 2].map(|i| (0..3).map(|k| weights[k] * corners[k][i]).sum());
        assert_eq!(barycentric(corners, point), weights);
    }

    #[test]
    fn points_outside_and_triangles_without_area_have_coordinates() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let weights = barycentric(corners, [-1.0, 0.5, 0.0]);
        assert!(weights.iter().all(|&w| w >= 0.0));
        assert_eq!(barycentric([[1.0; 3]; 3], [2.0; 3]), [1.0 / 3.0; 3]);
    }
}
