//! The elimination of equality constraints, before everything else: `x = T y + t`, with `y` free.
//!
//! Continuous unknowns are eliminated by pivots, integer ones by unimodular steps only. The integer points of
//! `y` are therefore exactly the integer solutions of the constraints.
//!
//! The method is that of `bommes2012`, chapter 5: Gaussian elimination that always takes the row with the
//! fewest entries, and in it a continuous unknown before an integer one. In the thesis, integer rows without
//! a unit coefficient may fail; here Euclid's algorithm solves them.
//!
//! | step | file |
//! | --- | --- |
//! | rows, whose turn it is, and substitution into the others | `tableau`, `row`, `occurrences` |
//! | a row with continuous unknowns | `continuous` |
//! | a row of integers | `integral`, `ratio` |
//! | long rows | `sweep`, `subtree`, `cluster` |
//! | back substitution, T | `stack`, `back` |
//! | right sides and pinned values, t | `steps`, `right_sides` |
//! | the objective in y | `project` |
//! | the reduced model around a point, in twice the working precision | `centre`, `rounding` |
//! | its independent parts | `components` |
//! | unknowns pinned afterwards | `hold` |
//!
//! Only `t` and the linear part of the objective depend on the right sides. An [`Elimination`] keeps
//! everything else, so that new right sides need no new elimination.

mod back;
mod centre;
mod cluster;
mod components;
mod continuous;
mod errors;
mod expansion;
mod hold;
mod integral;
mod occurrences;
mod project;
mod ratio;
mod record;
mod reduced;
mod right_sides;
mod rounding;
mod row;
mod run;
mod stack;
mod steps;
mod substitution;
mod subtree;
mod sweep;
mod tableau;
mod tolerance;
mod unknowns;

pub use centre::Centre;
pub use components::{Component, Part, parts};
pub use expansion::Expansion;
pub use reduced::ReducedModel;
pub use rounding::Rounding;
pub(crate) use run::Equations;
pub use run::{Elimination, eliminate};
