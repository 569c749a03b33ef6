//! The status of a solution: how its solve ended.

/// How a solve ended. A problem that cannot be solved leads to an [`Error`](crate::Error) instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SolveStatus {
    /// The energy is proved to be the least possible (see [`GAP_TOLERANCE`]).
    Optimal,
    /// Every constraint and every integrality condition holds. A better solution may exist.
    Feasible,
    /// As `Feasible`, but the time limit ended the search early.
    Limit,
    /// As `Feasible`, but the caller ended the search early.
    Cancelled,
    /// Only the relaxation was solved, so integer unknowns may have fractional values.
    Relaxed,
}

/// A solution is optimal if its relative gap is at most this.
pub const GAP_TOLERANCE: f64 = 1e-9;

impl SolveStatus {
    /// The word that the program prints for this status.
    pub fn name(self) -> &'static str {
        match self {
            SolveStatus::Optimal => "optimal",
            SolveStatus::Feasible => "feasible",
            SolveStatus::Limit => "limit",
            SolveStatus::Cancelled => "cancelled",
            SolveStatus::Relaxed => "relaxed",
        }
    }
}
