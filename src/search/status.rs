//! How a solve ended.

/// How a solve ended. A problem that cannot be solved at all ends in an
/// [`Error`](crate::Error) instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SolveStatus {
    /// The energy is the least possible, and that is proved (see [`GAP_TOLERANCE`]).
    Optimal,
    /// Every constraint and integrality holds; a better solution may exist.
    Feasible,
    /// As feasible, but the time limit ended the search early.
    Limit,
    /// As feasible, but the caller ended the search early.
    Cancelled,
    /// The relaxation was asked for: integers may be fractions.
    Relaxed,
}

/// A solution counts as proved when its relative gap is at most this.
pub const GAP_TOLERANCE: f64 = 1e-9;

impl SolveStatus {
    /// The word that the program prints.
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
