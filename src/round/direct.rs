//! Direct rounding: each integer is rounded to its nearest value in the relaxation, all at once.
//!
//! This is the first of the solvers that `bommes2012`, section 5.3, compares: the fastest, with the highest
//! energies.

use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::search::{Factors, Search};

/// Rounds the relaxation once.
///
/// # Errors
/// The errors of [`Search::prepare`] and of the evaluation of its one offer.
pub(crate) fn direct(
    model: &ReducedModel,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    search.prepare(factors)?;
    round_all(model, factors, search)?;
    Ok(())
}

/// Offers the relaxation rounded, and returns these integers.
///
/// # Errors
/// The errors of the evaluation of the offer.
pub(super) fn round_all(
    model: &ReducedModel,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<Vec<f64>> {
    let integers = model.integers().iter();
    let rounded = integers.map(|&k| model.nearest(k as usize, search.relaxed()[k as usize]));
    let rounded: Vec<f64> = rounded.collect();
    search.offer(factors, &rounded)?;
    Ok(rounded)
}
