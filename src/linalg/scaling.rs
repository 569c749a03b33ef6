//! Symmetric scaling to a diagonal near one, so that one tolerance fits all pivots.

use super::Sparse;

/// Powers of two `s` with `s_i^2 A_ii` in [1/2, 2), and 1 where the diagonal is not positive.
///
/// Scaling by powers of two has no rounding error, so pivots that cancel exactly still do so.
pub fn equilibrate(lower: &Sparse) -> Vec<f64> {
    (0..lower.rows())
        .map(|i| unit_scale(lower.diagonal(i)))
        .collect()
}

/// The power of two `s` with `s^2 d` in [1/2, 2), or 1 where `d` is not positive.
pub fn unit_scale(d: f64) -> f64 {
    if d > 0.0 {
        // From the exponent of d, so that a factor of 4 halves s exactly. Logarithms round.
        let exponent = (d.to_bits() >> 52) as i32 - 1023;
        f64::from(-(exponent + 1).div_euclid(2)).exp2()
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diagonals_of_any_size_come_near_one() {
        let entries = [(0, 0, 1e-30), (1, 0, 7.0), (1, 1, 3e20), (2, 0, 1.0)];
        let a = Sparse::from_triplets(3, 3, entries.into_iter()).unwrap();
        let s = equilibrate(&a);
        for (s, d) in s.iter().zip([1e-30, 3e20]) {
            assert!((0.5..2.0).contains(&(s * s * d)));
        }
        assert_eq!(s[2], 1.0);
    }

    #[test]
    fn four_times_a_diagonal_halves_its_scale() {
        for d in [1.0, 1.9, 2.0, 3.0] {
            for k in -40..40 {
                let scaled = unit_scale(d * f64::from(2 * k).exp2());
                assert_eq!(scaled, unit_scale(d) * f64::from(-k).exp2(), "{d} {k}");
                assert!((0.5..2.0).contains(&(unit_scale(d).powi(2) * d)));
            }
        }
    }
}
