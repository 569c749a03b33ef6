//! Rounding: direct (once) and greedy (one unknown, re-optimise, repeat).

/// The integer nearest to `x`; exact halves go away from zero, as everywhere in the library.
pub fn nearest(x: f64) -> f64 {
    x.round()
}
