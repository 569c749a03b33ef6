//! Expansion of the reduced unknowns to the caller's unknowns.

use crate::eliminate::ReducedModel;
use crate::problem::Model;
use crate::search::Strategy;

/// The caller's unknowns. Pins and integers are exact to the last bit.
pub(super) fn expand(
    reduced: &ReducedModel,
    model: &Model,
    strategy: Strategy,
    point: &[f64],
) -> Vec<f64> {
    let mut values = reduced.expansion().expand(point);
    for (i, x) in values.iter_mut().enumerate() {
        if let Some(pin) = model.pinned()[i] {
            *x = pin;
        } else if model.integer()[i] && strategy != Strategy::Relax {
            *x = x.round();
        }
        // The output contains no minus zero.
        *x += 0.0;
    }
    values
}
