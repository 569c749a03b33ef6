//! The solve from beginning to end: validation, elimination, relaxation, search, expansion, verification.

mod around;
mod candidate;
mod cascades;
mod components;
mod condense;
mod dispatch;
mod eliminated;
mod expand;
mod limited;
mod prove;
mod reformulate;
mod relax;
pub mod replay;
mod run;
mod second_solve;
mod soft_rows;
mod solution;
mod solver;
mod verify;

pub use prove::{Proved, solve_with_proof};
pub use run::{solve, solve_with, solve_with_lazy_rows};
pub(crate) use soft_rows::{SoftRow, has_many_integers};
pub use solution::{Counts, Seconds, Solution};
pub use solver::Solver;
pub use verify::{Verdict, verify};
