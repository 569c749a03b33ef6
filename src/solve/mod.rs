//! Orchestration: validate, eliminate, relax, search, expand, verify.

mod choose;
mod claim;
mod polish;
mod reformulate;
mod relax;
pub mod replay;
mod run;
mod solution;
mod solver;
mod subject_to;
mod verify;

pub use run::{solve, solve_with};
pub use solution::{Counts, Seconds, Solution};
pub use solver::Solver;
pub use verify::{Verdict, verify};
