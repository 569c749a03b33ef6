//! Expansion of the reduced unknowns to the caller's unknowns.

use crate::eliminate::Centre;
use crate::problem::Model;
use crate::search::Strategy;

/// The caller's unknowns at the step `point` from the centre. Pins and integers are exact to the last bit.
pub(super) fn expand(
    centre: &Centre,
    model: &Model,
    strategy: Strategy,
    point: &[f64],
) -> Vec<f64> {
    let exact = centre.expand(point).into_iter();
    let mut values: Vec<f64> = exact.map(|x| x.high).collect();
    // They are collected where both parts of each were.
    values.shrink_to_fit();
    clean(&mut values, model, strategy);
    values
}

/// Restores pins and integers, which the expansion may have rounded.
pub(super) fn clean(values: &mut [f64], model: &Model, strategy: Strategy) {
    for (i, x) in values.iter_mut().enumerate() {
        if let Some(pin) = model.pinned().get(i) {
            *x = pin;
        } else if model.integer()[i] && strategy != Strategy::Relax {
            *x = x.round();
        }
        // The output contains no minus zero.
        *x += 0.0;
    }
}
