//! A row as text, for messages.

use std::fmt::Write;

/// The largest number of terms that are shown.
const TERMS: usize = 8;

/// The row as text, such as `2 x3 + 4 x9 = 3`.
pub(crate) fn row_text(row: impl ExactSizeIterator<Item = (usize, f64)>, rhs: f64) -> String {
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
    let _ = write!(text, " = {rhs}");
    text
}

#[cfg(test)]
mod tests {
    use super::row_text;

    #[test]
    fn a_row_reads_as_an_equation() {
        assert_eq!(
            row_text([(3, 2.0), (9, -4.0)].into_iter(), 3.0),
            "2 x3 - 4 x9 = 3"
        );
        assert_eq!(row_text([].into_iter(), 1.0), "0 = 1");
    }
}
