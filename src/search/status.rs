//! The status of a solution: how its solve ended. Optimality is decided here and nowhere else.

use super::StoppedBy;
use crate::monitor::relative_gap;

/// How a solve ended. A problem that cannot be solved leads to an [`Error`](crate::Error) instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SolveStatus {
    /// The energy is proved to be the least possible: the search is complete, or the gap is at most
    /// [`GAP_TOLERANCE`].
    Optimal,
    /// Every constraint and every integrality condition holds. A better solution may exist.
    Feasible,
    /// As `Feasible`, but a limit that the caller set ended the search early: `time_limit` or `nodes`.
    Limit,
    /// As `Feasible`, but the caller ended the search early.
    Cancelled,
    /// Only the relaxation was solved, so integer unknowns may have fractional values.
    Relaxed,
}

/// A solution is optimal if its relative gap is at most this.
pub const GAP_TOLERANCE: f64 = 1e-9;

/// Whether a bound proves that an energy is the least possible. Both may be off by rounding errors that add
/// up to `rounding`.
pub(crate) fn is_closed(energy: f64, lower_bound: f64, rounding: f64) -> bool {
    energy - lower_bound <= rounding || relative_gap(energy, lower_bound) <= GAP_TOLERANCE
}

impl SolveStatus {
    /// The status of a solution whose search proved nothing and ended for this reason. `Limit` is only for
    /// limits that the caller set.
    pub(crate) fn unproved(stopped_by: StoppedBy) -> Self {
        match stopped_by {
            StoppedBy::Cancel => SolveStatus::Cancelled,
            StoppedBy::Time | StoppedBy::Nodes => SolveStatus::Limit,
            StoppedBy::Nothing | StoppedBy::Memory | StoppedBy::Budget => SolveStatus::Feasible,
        }
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_energy_below_it_closes_no_gap_at_any_scale() {
        for scale in [1e-200, 1e-12, 1.0, 1e12] {
            assert!(!is_closed(1.5 * scale, scale, 0.0));
            assert!(is_closed(scale, scale * (1.0 - 1e-10), 0.0));
        }
    }

    #[test]
    fn an_energy_of_zero_is_closed_by_its_rounding_alone() {
        assert!(is_closed(0.0, 0.0, 0.0));
        assert!(!is_closed(0.0, -1e-20, 0.0));
        assert!(is_closed(0.0, -1e-20, 2e-20));
    }
}
