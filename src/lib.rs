//! Roundel: mixed-integer quadratic problems of geometry processing.
//!
//! ```text
//! minimise   E(x) = 1/2 x'Qx + q'x + c + sum_k w_k (a_k . x - r_k)^2
//! subject to C x = d
//!            l_G <= G x <= u_G,   l <= x <= u
//!            x_i integer for i in I
//! ```
//!
//! `Q` is symmetric positive semi-definite and sparse. The constraints may be redundant. Sides and bounds that
//! do not limit are infinite. The signs are those of MPS, OSQP and Clarabel. A problem passes through these
//! stages:
//!
//! ```text
//! Problem --validate--> Model --eliminate--> ReducedModel --(strategy, Search)--> Solution
//! ```
//!
//! A problem with inequalities or bounds is solved without them first. If that solution is not within them,
//! branch and bound searches.
//!
//! ```
//! use roundel::{solve, Options, Problem, Strategy};
//!
//! // (x0 - 0.4)^2 + (x0 - x1)^2 with x1 an integer
//! let mut problem = Problem::new(2)?;
//! problem.add_least_squares(&[0], &[1.0], 0.4, 1.0)?;
//! problem.add_least_squares(&[0, 1], &[1.0, -1.0], 0.0, 1.0)?;
//! problem.set_integers(&[1])?;
//! let options = Options { strategy: Strategy::Greedy, ..Options::default() };
//! let solution = solve(&problem, &options)?;
//! assert_eq!(solution.values(), &[0.2, 0.0]);
//! # Ok::<(), roundel::Error>(())
//! ```
//!
//! | Part of the interface | Contents |
//! | --- | --- |
//! | [`Problem`], [`problem::files`] | a problem, and its files |
//! | [`Options`], [`Strategy`], [`WarmStart`], [`search`] | what a solve may do; the list of all options |
//! | [`solve()`], [`solve_with`], [`Solver`], [`Solution`], [`mod@solve`] | one solve, re-solves, results, verification, replay |
//! | [`solve_with_proof`], [`Proof`], [`proof`] | proofs that a stranger can check |
//! | [`Monitor`], [`Event`], [`CancelToken`], [`monitor`] | progress, cancel, time limit |
//! | [`soup`] | polygon soups: files of any kind, and their repair |
//! | [`mesh`], [`field`], [`map`], [`untangle`], [`check`] | meshes, orientation fields, seamless maps, their repair and their check |
//! | [`geodesic`] | exact distances along the surface, and shortest paths |
//! | [`extract`], [`smooth`], [`quad`] | quads from a map; all the way from a mesh to quads |
//! | [`layout`] | quads that follow a base layout, and the layout that quads have |
//! | [`transfer`] | materials, colours and other values, from triangles to quads |
//! | [`Error`], [`InputError`] | what can go wrong |
//! | [`capi`] | the C interface |

#![deny(unsafe_code)]
#![deny(missing_docs)]

mod branch;
pub mod capi;
pub mod check;
mod cut;
mod cycle;
mod eliminate;
mod error;
pub mod extract;
pub mod field;
pub mod geodesic;
#[doc(hidden)]
pub mod internals;
mod lattice;
pub mod layout;
mod linalg;
pub mod map;
pub mod mesh;
pub mod monitor;
mod network;
pub mod problem;
pub mod proof;
pub mod quad;
mod round;
pub mod search;
pub mod smooth;
pub mod solve;
pub mod soup;
pub mod transfer;
pub mod untangle;

#[cfg(test)]
#[path = "../tests/common/random.rs"]
mod test_random;

pub use capi::{peak_memory, release_free_memory};
pub use error::{Conflicting, Error, InputError, Result};
pub use linalg::Ordering;
pub use monitor::{CancelToken, Event, Flow, Monitor};
pub use problem::{Layout, Model, Problem, Triangle};
pub use proof::Proof;
pub use search::{Candidate, LazyRows, Options, SolveStatus, StoppedBy, Strategy, WarmStart};
pub use solve::{
    Proved, Seconds, Solution, Solver, solve, solve_with, solve_with_lazy_rows, solve_with_proof,
};

/// The Rust examples of the README and of the book are run as tests.
#[cfg(doctest)]
mod book {
    #[doc = include_str!("../README.md")]
    struct Readme;
    #[doc = include_str!("../docs/errors.md")]
    struct Errors;
    #[doc = include_str!("../docs/geodesic.md")]
    struct Geodesic;
    #[doc = include_str!("../docs/layouts.md")]
    struct Layouts;
    #[doc = include_str!("../docs/options.md")]
    struct Options;
    #[doc = include_str!("../docs/problems.md")]
    struct Problems;
    #[doc = include_str!("../docs/proofs.md")]
    struct Proofs;
    #[doc = include_str!("../docs/rust.md")]
    struct Rust;
    #[doc = include_str!("../docs/soup.md")]
    struct Soup;
    #[doc = include_str!("../docs/strategies.md")]
    struct Strategies;
    #[doc = include_str!("../docs/trust.md")]
    struct Trust;
}
