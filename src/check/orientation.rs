//! The orientation of a triangle in the plane (`bommes2012`, equation (6.3)), decided exactly.
//!
//! The orientation is the sign of the area, computed with as many digits as necessary (`shewchuk1997`) by the
//! crate `robust`. The plain formula gives the wrong sign for needles.

use robust::{Coord, orient2d};

/// A number with the sign of the triangle's area: positive if its corners run counter-clockwise, and zero
/// exactly if they are collinear.
pub fn orientation(uv: [[f64; 2]; 3]) -> f64 {
    let [a, b, c] = uv.map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_is_right_where_the_plain_formula_fails() {
        let step = f64::EPSILON;
        let (b, c) = ([12.0, 12.0], [24.0, 24.0]);
        for i in 0..32 {
            for j in 0..32 {
                let a = [0.5 + f64::from(i) * step, 0.5 + f64::from(j) * step];
                // Above the diagonal the triangle runs clockwise.
                let expected = i.cmp(&j);
                let sign = orientation([a, b, c]).partial_cmp(&0.0);
                assert_eq!(sign, Some(expected.reverse()), "{i} {j}");
            }
        }
    }
}
