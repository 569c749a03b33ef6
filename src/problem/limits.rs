//! Two-sided rows `l <= a . x <= u` and bounds `l <= x <= u`, as the caller gave them.

use super::RowList;
use super::check::same_length;
use crate::error::{Error, Result};

/// The two-sided rows, in the order given. A side that does not limit is infinite.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inequalities {
    /// The rows. Their right sides have no meaning.
    pub(super) rows: RowList,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Inequalities {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.lower.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.lower.is_empty()
    }

    /// The entries `(variable, coefficient)` of row `i`, as given.
    pub fn row(&self, i: usize) -> impl ExactSizeIterator<Item = (usize, f64)> + Clone + '_ {
        self.rows.row(i)
    }

    /// The lower sides, one for each row.
    pub fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// The upper sides, one for each row.
    pub fn upper(&self) -> &[f64] {
        &self.upper
    }

    /// Replaces the sides, one of each kind for each row.
    pub(super) fn set_sides(&mut self, lower: &[f64], upper: &[f64]) -> Result<()> {
        check_both("inequality sides", self.len(), [lower, upper])?;
        self.lower.copy_from_slice(lower);
        self.upper.copy_from_slice(upper);
        Ok(())
    }

    /// Makes room for the sides of this many more rows.
    pub(super) fn reserve(&mut self, rows: usize) -> Result<()> {
        let room = self.lower.try_reserve(rows);
        room.and_then(|()| self.upper.try_reserve(rows))
            .map_err(|_| Error::OutOfMemory { what: "the rows" })
    }

    /// The rows as a matrix of `cols` columns: sorted, duplicates summed.
    pub(crate) fn to_sparse(&self, cols: usize) -> Result<crate::linalg::Sparse> {
        self.rows.to_sparse(cols)
    }

    /// Appends the sides of rows that have been appended.
    pub(super) fn append_sides(&mut self, lower: &[f64], upper: &[f64]) {
        self.lower.extend_from_slice(lower);
        self.upper.extend_from_slice(upper);
    }
}

/// The bounds of the unknowns. Both arrays are empty until a bound is set.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Bounds {
    pub(super) lower: Vec<f64>,
    pub(super) upper: Vec<f64>,
}

impl Bounds {
    /// The bounds of an unknown.
    pub fn of(&self, variable: usize) -> (f64, f64) {
        match self.lower.get(variable) {
            Some(&lower) => (lower, self.upper[variable]),
            None => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// Whether an unknown has a bound.
    pub fn limit(&self) -> bool {
        let limits = |(l, u): (&f64, &f64)| l.is_finite() || u.is_finite();
        self.lower.iter().zip(&self.upper).any(limits)
    }
}

/// Checks the two sides of rows or bounds: no NaN, no lower side of infinity or upper side of minus infinity,
/// and no lower side above its upper side.
pub(super) fn check_sides(what: &str, lower: &[f64], upper: &[f64]) -> Result<()> {
    let fault = |index: usize, text: String| {
        Err(Error::InvalidArgument {
            what: format!("{what}: entry {index} {text}"),
            index: Some(index),
        })
    };
    for (k, (&l, &u)) in lower.iter().zip(upper).enumerate() {
        if l.is_nan() || u.is_nan() {
            return fault(k, format!("is from {l} to {u}, and NaN is no limit"));
        }
        if l == f64::INFINITY || u == f64::NEG_INFINITY {
            return fault(k, format!("is from {l} to {u}, which no finite number is"));
        }
        if l > u {
            return fault(
                k,
                format!("has the lower limit {l} above the upper limit {u}"),
            );
        }
    }
    Ok(())
}

/// Checks the lengths of two arrays of sides, and the sides.
pub(super) fn check_both(what: &'static str, count: usize, sides: [&[f64]; 2]) -> Result<()> {
    for side in sides {
        same_length(what, count, side.len())?;
    }
    check_sides(what, sides[0], sides[1])
}
