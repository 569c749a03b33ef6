//! Orchestration: options, budgets, progress and cancel, the search, the solution.

mod claim;
mod decide;
mod factors;
mod held;
mod monitor;
mod options;
mod presets;
mod reformulate;
mod relax;
pub mod replay;
mod run;
mod search;
mod solution;
mod solver;
mod status;
mod strategy;
mod subject_to;
mod verify;
mod warm_start;
mod work;

pub use monitor::{CancelToken, Event, EventKind, Flow, Monitor, Phase};
pub use options::{OPTIONS, OptionInfo, OptionKind, OptionValue, Options};
pub use presets::{PRESETS, Preset};
pub use run::{solve, solve_with};
pub use solution::{Counts, Seconds, Solution};
pub use solver::Solver;
pub use status::{GAP_TOLERANCE, SolveStatus};
pub use strategy::Strategy;
pub use verify::{Verdict, verify};
pub use warm_start::WarmStart;

pub(crate) use factors::Factors;
pub(crate) use search::Search;
pub(crate) use work::Work;
