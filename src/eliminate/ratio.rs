//! Integers in proportion to given real coefficients.

use super::row::Row;
use super::tolerance::{DENOMINATOR, LARGEST, RATIO, TELLING, near_integer};

/// Replaces the coefficients of `row` by coprime integers in the same proportion, and returns the value of
/// the new unit in the old one. If there are no such integers, returns `None` and changes nothing.
///
/// Coefficients that are integers in the caller's own units are taken unchanged, unless they are large
/// numbers that were computed: those may be integers by accident. If the caller gave integers, then the
/// pivots give a common denominator of all that was computed. Otherwise the ratios to the smallest coefficient are expanded in continued fractions (`khinchin1935`), whose convergents are the best
/// approximations among all fractions with denominators as small. The last resort is integers in the caller's
/// units up to noise.
pub(super) fn integer_multiples(row: &mut Row) -> Option<f64> {
    let limit = if row.touched { TELLING } else { LARGEST };
    let exact = |v: f64| (v.fract() == 0.0 && v.abs() < limit).then_some(v);
    let near = |v: f64| near_integer(v, row.magnitude / row.scale).filter(|v| *v != 0.0);
    let (mut integers, unit) = as_given(row, exact)
        .or_else(|| by_denominator(row))
        .or_else(|| from_ratios(row))
        .or_else(|| as_given(row, near))?;
    let factor = integers.iter().fold(0.0, |g, &v| gcd(g, v));
    integers.iter_mut().for_each(|v| *v /= factor);
    for (entry, integer) in row.entries.iter_mut().zip(integers) {
        entry.1 = integer;
    }
    Some(unit * factor)
}

/// All coefficients in the caller's units, if `integer` accepts each of them.
fn as_given(row: &Row, integer: impl Fn(f64) -> Option<f64>) -> Option<(Vec<f64>, f64)> {
    let integers: Option<Vec<f64>> = row
        .entries
        .iter()
        .map(|e| integer(e.1 / row.scale))
        .collect();
    Some((integers?, row.scale))
}

/// All coefficients in units of one by the row's denominator.
fn by_denominator(row: &Row) -> Option<(Vec<f64>, f64)> {
    let whole = |e: &(u32, f64)| row.whole(e.1).filter(|v| *v != 0.0);
    let integers: Option<Vec<f64>> = row.entries.iter().map(whole).collect();
    Some((integers?, row.scale / row.denominator?))
}

/// The non-negative greatest common divisor of two integers. Remainders of doubles are exact.
pub(super) fn gcd(a: f64, b: f64) -> f64 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0.0 {
        (a, b) = (b, a % b);
    }
    a
}

fn from_ratios(row: &Row) -> Option<(Vec<f64>, f64)> {
    let sizes = row.entries.iter().map(|e| e.1.abs());
    let least = sizes.fold(f64::INFINITY, f64::min);
    let mut denominator = 1.0;
    for (_, a) in &row.entries {
        denominator *= denominator_of(denominator * a / least, DENOMINATOR / denominator)?;
    }
    let unit = least / denominator;
    Some((
        row.entries.iter().map(|e| (e.1 / unit).round()).collect(),
        unit,
    ))
}

/// The least denominator, at most `limit`, of a fraction that equals `ratio` up to rounding.
fn denominator_of(ratio: f64, limit: f64) -> Option<f64> {
    let tolerance = RATIO * (1.0 + ratio.abs());
    let (mut denominator, mut previous) = (1.0, 0.0);
    let mut rest = ratio;
    loop {
        let scaled = ratio * denominator;
        if (scaled - scaled.round()).abs() <= tolerance * denominator {
            return Some(denominator);
        }
        rest = 1.0 / (rest - rest.floor());
        (denominator, previous) = (rest.floor() * denominator + previous, denominator);
        if denominator.is_nan() || denominator > limit {
            return None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{denominator_of, gcd};

    #[test]
    fn fractions_are_recognised_through_rounding() {
        for (p, q) in [
            (1, 3),
            (-22, 7),
            (9999, 1000),
            (0, 1),
            (355, 113),
            (1, 9973),
        ] {
            let ratio = f64::from(p) / f64::from(q) * (1.0 + 3e-16);
            assert_eq!(denominator_of(ratio, 1e4), Some(f64::from(q)));
        }
    }

    #[test]
    fn irrational_numbers_are_not() {
        for ratio in [2f64.sqrt(), std::f64::consts::PI, 1.0 / 5f64.sqrt()] {
            assert_eq!(denominator_of(ratio, 1e4), None);
        }
    }

    #[test]
    fn the_common_divisor_of_large_numbers_is_exact() {
        let p = 94_906_249.0; // prime, and near the root of 2^53
        assert_eq!(gcd(p * 94_906_260.0, -p * 7.0), p);
        assert_eq!(gcd(0.0, -6.0), 6.0);
    }
}
