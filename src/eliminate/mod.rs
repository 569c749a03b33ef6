//! Equality constraints are eliminated before anything else: `x = T y + t`, with `y` free.
//!
//! Continuous unknowns are eliminated by pivots, integer ones by unimodular steps only, so that
//! the integer points of `y` are exactly the integer solutions of the constraints.

mod expansion;
mod reduced;

pub use expansion::Expansion;
pub use reduced::ReducedModel;
