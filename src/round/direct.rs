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
    let rounded = nearest_integers(model, search.relaxed());
    search.offer(factors, &rounded)?;
    Ok(rounded)
}

/// The integers nearest to those of a point.
pub(crate) fn nearest_integers(model: &ReducedModel, point: &[f64]) -> Vec<f64> {
    let nearest = |&k: &u32| model.nearest(k as usize, point[k as usize]);
    model.integers().iter().map(nearest).collect()
}
