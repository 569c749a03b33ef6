//! Exit codes: the outcome of a run, for scripts.

use std::process::ExitCode;

use roundel::Error;

/// The outcome of a run of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// There is a solution.
    Solved = 0,
    /// A file that cannot be read or written, bad input, or something not supported.
    Failed = 1,
    /// No point satisfies the constraints and the integralities.
    Infeasible = 3,
    /// The objective has no minimum.
    Unbounded = 4,
    /// The run was cancelled or met a limit before a first solution, or before its proof.
    Stopped = 5,
    /// A map or a proof was checked and is not valid.
    Invalid = 6,
    /// Ctrl-C ended the run early, and there is a solution.
    Finished = 7,
}

/// The codes as `--help` prints them. Code 2 comes from clap.
pub const HELP: &str = "\
Exit codes:
  0  solved: the program has a solution to show, proved or not
  1  error: a file, bad input, or something that is not supported
  2  usage: the command line is wrong
  3  infeasible: the constraints contradict each other, or have no integer solution
  4  unbounded: the objective has no least value, or is not convex
  5  stopped: a limit or cancel, before a first solution or before the proof that was asked for
  6  invalid: what was checked is not what it should be
  7  finished early: Ctrl-C came, and the result is that of the best integers so far";

impl Exit {
    /// The code of a run that ended in `error`.
    pub fn of(error: &Error) -> Self {
        match error {
            Error::Infeasible { .. }
            | Error::Contradiction { .. }
            | Error::NoIntegerSolution { .. } => Exit::Infeasible,
            Error::Unbounded { .. } | Error::NotConvex { .. } | Error::NotConvexAt { .. } => {
                Exit::Unbounded
            }
            Error::Cancelled | Error::TimeLimit | Error::SearchLimit { .. } => Exit::Stopped,
            _ => Exit::Failed,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        ExitCode::from(exit as u8)
    }
}
