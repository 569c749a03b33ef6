//! Symmetric scaling to a diagonal near one, so that one tolerance fits all pivots.

use super::Sparse;

/// Powers of two `s` with `s_i^2 A_ii` in [1/2, 2), and 1 where the diagonal is not positive.
///
/// Scaling by powers of two has no rounding error, so pivots that cancel exactly still do so.
pub fn equilibrate(lower: &Sparse) -> Vec<f64> {
    (0..lower.rows())
        .map(|i| match lower.row(i).last() {
            Some((j, d)) if j == i => unit_scale(d),
            _ => 1.0,
        })
        .collect()
}

/// The power of two `s` with `s^2 d` in [1/2, 2), or 1 where `d` is not positive.
pub fn unit_scale(d: f64) -> f64 {
    if d > 0.0 {
        (-0.5 * d.log2()).round().exp2()
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
}
