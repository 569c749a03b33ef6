//! Integers in proportion to given real coefficients.

use super::row::Row;
use super::tolerance::{DENOMINATOR, RATIO, near_integer};

/// Replaces the coefficients of `row` by integers in the same proportion, and returns what one of
/// the new units was worth. `None`, and nothing changed, if there are no such integers.
///
/// Coefficients that are integers in the caller's own units are taken as they are. Failing that,
/// their ratios to the smallest one are developed in continued fractions (Khinchin 1935), whose
/// convergents are the best approximations there are for their denominators.
pub(super) fn integer_multiples(row: &mut Row) -> Option<f64> {
    let in_callers_units = |v: f64| {
        near_integer(v / row.scale, row.magnitude / row.scale).filter(|rounded| *rounded != 0.0)
    };
    let as_given: Option<Vec<f64>> = row.entries.iter().map(|e| in_callers_units(e.1)).collect();
    let (integers, unit) = match as_given {
        Some(integers) => (integers, row.scale),
        None => from_ratios(row)?,
    };
    for (entry, integer) in row.entries.iter_mut().zip(integers) {
        entry.1 = integer;
    }
    Some(unit)
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

/// The least denominator, up to `limit`, of a fraction that equals `ratio` up to rounding.
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
    use super::denominator_of;

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
}
