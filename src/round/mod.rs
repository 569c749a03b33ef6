//! Rounding: direct (once) and greedy (one unknown, re-optimise, repeat).

mod direct;
mod greedy;

pub(crate) use direct::direct;
pub(crate) use greedy::greedy;

/// The integer nearest to `x`; exact halves go away from zero, as everywhere in the library.
pub fn nearest(x: f64) -> f64 {
    x.round()
}
