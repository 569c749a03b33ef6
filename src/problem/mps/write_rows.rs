//! Writing of inequalities and bounds: their types, right sides and ranges.

use std::collections::HashSet;

use crate::error::Result;
use crate::problem::Inequalities;
use crate::problem::files::lines::writable_limit;

/// A row of the file that states an inequality, or one side of it.
pub(super) struct FileRow {
    pub name: String,
    pub kind: char,
    pub right: f64,
    pub range: Option<f64>,
}

/// The rows that state the inequalities, and for each inequality the number of its first row, with the number
/// of all rows at the end.
pub(super) fn file_rows(
    inequalities: &Inequalities,
    names: &[String],
    taken: &mut HashSet<String>,
) -> Result<(Vec<FileRow>, Vec<usize>)> {
    let mut rows = Vec::with_capacity(names.len());
    let mut first = vec![0];
    let sides = inequalities.lower().iter().zip(inequalities.upper());
    for (i, (name, (&lower, &upper))) in names.iter().zip(sides).enumerate() {
        for side in [lower, upper] {
            writable_limit("a side of inequality", i, side)?;
        }
        let row = |kind, right, range| FileRow {
            name: name.clone(),
            kind,
            right,
            range,
        };
        if lower == f64::NEG_INFINITY {
            // The upper side may be infinite too.
            rows.push(row('L', upper, None));
        } else if upper == f64::INFINITY {
            rows.push(row('G', lower, None));
        } else if let Some(range) = exact_range(|range| upper - range, upper - lower, lower) {
            rows.push(row('L', upper, Some(range)));
        } else if let Some(range) = exact_range(|range| lower + range, upper - lower, upper) {
            rows.push(row('G', lower, Some(range)));
        } else {
            rows.push(row('G', lower, None));
            let mut other = format!("{name}_upper");
            while !taken.insert(other.clone()) {
                other.push('_');
            }
            rows.push(FileRow {
                name: other,
                ..row('L', upper, None)
            });
        }
        first.push(rows.len());
    }
    Ok((rows, first))
}

/// The range near `distance` from which a reader computes exactly the other side of the row.
fn exact_range(side: impl Fn(f64) -> f64, distance: f64, other: f64) -> Option<f64> {
    let near = [distance, distance.next_up(), distance.next_down()];
    let exact = |range: &f64| *range >= 0.0 && side(*range).to_bits() == other.to_bits();
    near.into_iter().find(exact)
}

/// The lines of section BOUNDS for a variable: the type, and the value where the type has one.
pub(super) fn bound_lines(
    (lower, upper): (f64, f64),
    integer: bool,
) -> impl Iterator<Item = (&'static str, Option<f64>)> {
    let zero = lower.to_bits() == 0;
    let [first, second] = match (lower, upper) {
        (f64::NEG_INFINITY, f64::INFINITY) => [Some(("FR", None)), None],
        _ if lower.to_bits() == upper.to_bits() => [Some(("FX", Some(lower))), None],
        (_, 1.0) if zero && integer => [Some(("BV", None)), None],
        // Without a line, an integer variable would be binary.
        (_, f64::INFINITY) if zero => [integer.then_some(("PL", None)), None],
        (_, f64::INFINITY) => [Some(("LO", Some(lower))), None],
        (f64::NEG_INFINITY, _) => [Some(("MI", None)), Some(("UP", Some(upper)))],
        _ if zero => [None, Some(("UP", Some(upper)))],
        _ => [Some(("LO", Some(lower))), Some(("UP", Some(upper)))],
    };
    first.into_iter().chain(second)
}
