//! From the reduced unknowns back to the caller's.

use crate::eliminate::ReducedModel;
use crate::problem::Model;
use crate::search::Strategy;

/// The caller's unknowns; pins and integers exact to the last bit.
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
        // No minus zero in anybody's output.
        *x += 0.0;
    }
    values
}
