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
    centre.expand_each(point, |i, x| cleaned(x.high, i, model, strategy))
}

/// Restores pins and integers, which the expansion may have rounded.
pub(super) fn clean(values: &mut [f64], model: &Model, strategy: Strategy) {
    for (i, x) in values.iter_mut().enumerate() {
        *x = cleaned(*x, i, model, strategy);
    }
}

/// The value of unknown `i`, which is `x` but for rounding.
fn cleaned(x: f64, i: usize, model: &Model, strategy: Strategy) -> f64 {
    let value = match model.pinned().get(i) {
        Some(pin) => pin,
        None if model.integer()[i] && strategy != Strategy::Relax => x.round(),
        None => x,
    };
    // The output contains no minus zero.
    value + 0.0
}
