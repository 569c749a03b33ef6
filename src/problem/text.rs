//! A row as text, for messages.

use std::fmt::Write;

/// The largest number of terms that are shown.
const TERMS: usize = 8;

/// The row as text, such as `2 x3 + 4 x9 = 3`.
pub(crate) fn row_text(row: impl ExactSizeIterator<Item = (usize, f64)>, rhs: f64) -> String {
    format!("{} = {rhs}", terms_text(row))
}

/// The two-sided row as text, such as `1 <= 2 x3 + 4 x9 <= 3`.
pub(crate) fn limits_text(
    row: impl ExactSizeIterator<Item = (usize, f64)>,
    lower: f64,
    upper: f64,
) -> String {
    let terms = terms_text(row);
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) if lower == upper => format!("{terms} = {lower}"),
        (true, true) => format!("{lower} <= {terms} <= {upper}"),
        (true, false) => format!("{terms} >= {lower}"),
        (false, true) => format!("{terms} <= {upper}"),
        (false, false) => format!("{terms} without limits"),
    }
}

/// The terms of a row as text.
fn terms_text(row: impl ExactSizeIterator<Item = (usize, f64)>) -> String {
    let mut text = String::new();
    let more = row.len().saturating_sub(TERMS);
    for (k, (j, v)) in row.take(TERMS).enumerate() {
        let sign = match (k, v < 0.0) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        text.push_str(sign);
        if v.abs() != 1.0 {
            let _ = write!(text, "{} ", v.abs());
        }
        let _ = write!(text, "x{j}");
    }
    if text.is_empty() {
        text.push('0');
    }
    if more > 0 {
        let _ = write!(text, " + ({more} more)");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{limits_text, row_text};

    #[test]
    fn a_row_of_two_sides_shows_those_that_limit() {
        let row = || [(3, 2.0)].into_iter();
        let none = f64::INFINITY;
        assert_eq!(limits_text(row(), 1.0, 3.0), "1 <= 2 x3 <= 3");
        assert_eq!(limits_text(row(), 1.0, none), "2 x3 >= 1");
        assert_eq!(limits_text(row(), -none, 3.0), "2 x3 <= 3");
    }

    #[test]
    fn a_row_reads_as_an_equation() {
        assert_eq!(
            row_text([(3, 2.0), (9, -4.0)].into_iter(), 3.0),
            "2 x3 - 4 x9 = 3"
        );
        assert_eq!(row_text([].into_iter(), 1.0), "0 = 1");
    }
}
