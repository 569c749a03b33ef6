//! Turns in the plane, counter-clockwise: by quarters about the origin, and as signed angles.

use std::ops::Neg;

/// A point or vector turned by so many quarters.
pub fn turned<T: Neg<Output = T>>(quarters: u8, [x, y]: [T; 2]) -> [T; 2] {
    match quarters % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// The angle that turns the direction of `a` into that of `b`, in (-pi, pi].
pub(crate) fn angle_between(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
}

/// The angle of a triangle at one of its corners: negative where the triangle is turned over.
pub(crate) fn angle_at(triangle: [[f64; 2]; 3], corner: usize) -> f64 {
    let [apex, next, last] = [0, 1, 2].map(|i| triangle[(corner + i) % 3]);
    let [a, b] = [next, last].map(|p| [p[0] - apex[0], p[1] - apex[1]]);
    angle_between(a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_compose() {
        let point = [3, 5];
        assert_eq!(turned(1, point), [-5, 3]);
        for a in 0..4 {
            for b in 0..4 {
                assert_eq!(turned(a, turned(b, point)), turned(a + b, point));
            }
        }
    }

    #[test]
    fn angles_are_signed() {
        use std::f64::consts::{FRAC_PI_2, PI};
        assert_eq!(angle_between([2.0, 0.0], [0.0, 3.0]), FRAC_PI_2);
        assert_eq!(angle_between([0.0, 3.0], [2.0, 0.0]), -FRAC_PI_2);
        assert_eq!(angle_between([1.0, 0.0], [-1.0, 0.0]), PI);
        let triangle = [[1.0, 1.0], [4.0, 1.0], [1.0, 5.0]];
        let sum: f64 = (0..3).map(|corner| angle_at(triangle, corner)).sum();
        assert_eq!(angle_at(triangle, 0), FRAC_PI_2);
        assert!((sum - PI).abs() < 1e-15);
        let [a, b, c] = triangle;
        assert_eq!(angle_at([a, c, b], 0), -FRAC_PI_2);
    }
}
