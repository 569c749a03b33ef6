//! Validation of the caller's arrays: each failure names the entry.

use crate::error::{Error, Result};

pub(super) fn same_length(what: &'static str, expected: usize, actual: usize) -> Result<()> {
    if expected == actual {
        return Ok(());
    }
    Err(Error::LengthMismatch {
        what,
        expected,
        actual,
    })
}

pub(super) fn in_range(what: &'static str, indices: &[usize], len: usize) -> Result<()> {
    match indices.iter().position(|&i| i >= len) {
        None => Ok(()),
        Some(position) => Err(Error::IndexOutOfRange {
            what,
            position,
            value: i64::try_from(indices[position]).unwrap_or(i64::MAX),
            len,
        }),
    }
}

pub(super) fn all_finite(what: &'static str, values: &[f64]) -> Result<()> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(position) => Err(Error::NotFinite { what, position }),
    }
}

pub(super) fn finite(what: &'static str, value: f64) -> Result<()> {
    all_finite(what, &[value])
}
