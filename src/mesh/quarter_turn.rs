//! Quarter turns of the plane, counter-clockwise about the origin.

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
}
