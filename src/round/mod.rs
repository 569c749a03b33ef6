//! The rounding strategies: direct (all at once), greedy (one unknown, re-optimise, repeat), adaptive
//! greedy (several unknowns at a time, re-optimise as far as needed), and multiple (adaptive as published).

mod adaptive;
mod candidates;
mod descend;
mod direct;
mod greedy;
mod multiple;
mod regions;

pub(crate) use adaptive::adaptive;
pub(crate) use direct::{direct, nearest_integers};
pub(crate) use greedy::greedy;
pub(crate) use multiple::multiple;

/// The integer nearest to `x`. Exact halves are rounded away from zero, as everywhere in the library.
pub fn nearest(x: f64) -> f64 {
    x.round()
}
