//! Rounding: direct (once), greedy (one unknown, re-optimise, repeat), and adaptive greedy (several
//! at a time, re-optimised as far as needed).

mod adaptive;
mod candidates;
mod direct;
mod greedy;
mod multiple;

pub(crate) use adaptive::adaptive;
pub(crate) use direct::direct;
pub(crate) use greedy::greedy;
pub(crate) use multiple::multiple;

/// The integer nearest to `x`; exact halves go away from zero, as everywhere in the library.
pub fn nearest(x: f64) -> f64 {
    x.round()
}
