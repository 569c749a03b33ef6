//! The result of a solve.

use crate::monitor::relative_gap;
use crate::search::{SolveStatus, StoppedBy};

/// Sizes of a problem before and after elimination.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// The number of unknowns.
    pub variables: usize,
    /// The number of integer unknowns.
    pub integers: usize,
    /// The number of equality constraints.
    pub constraints: usize,
    /// The number of inequalities, which are two-sided rows.
    pub inequalities: usize,
    /// The number of integer unknowns after elimination.
    pub reduced_integers: usize,
    /// The number of continuous unknowns after elimination.
    pub reduced_continuous: usize,
    /// The number of entries below the diagonal of the relaxation's factor.
    pub factor_nonzeros: usize,
}

/// Wall-clock seconds by phase.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Seconds {
    /// Validation and elimination of the constraints.
    pub eliminate: f64,
    /// Orderings and factorizations.
    pub factor: f64,
    /// The search for integers.
    pub round: f64,
    /// The whole solve, including verification.
    pub total: f64,
}

/// A solution: values, their energy, and a lower bound on the energy of every solution.
///
/// Energy and violations are computed again from the caller's own arrays, by code that shares nothing with
/// the solver.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    pub(super) values: Vec<f64>,
    pub(super) energy: f64,
    pub(super) lower_bound: Option<f64>,
    pub(super) status: SolveStatus,
    pub(super) complete: bool,
    pub(super) stopped_by: StoppedBy,
    pub(super) work: u64,
    pub(super) counts: Counts,
    pub(super) seconds: Seconds,
    pub(super) max_constraint_violation: f64,
    pub(super) max_integrality_violation: f64,
}

impl Solution {
    /// One value for each unknown. Integer unknowns have exact integers, except after a relaxation.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The same solution with the values of another problem that states the same.
    pub(crate) fn with_values(self, values: Vec<f64>) -> Self {
        Solution { values, ..self }
    }

    /// The objective, in the caller's units.
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// A lower bound: no integer solution has less energy.
    pub fn lower_bound(&self) -> Option<f64> {
        self.lower_bound
    }

    /// The relative gap `(energy - lower_bound) / |energy|`, if there is a bound. It is 0 where they are equal,
    /// and infinite for an energy of 0 above the bound.
    pub fn gap(&self) -> Option<f64> {
        self.lower_bound
            .map(|bound| relative_gap(self.energy, bound))
    }

    /// How the solve ended.
    pub fn status(&self) -> SolveStatus {
        self.status
    }

    /// Whether the search has visited everything that could be better; always true without integers. A
    /// solution can be optimal without that, if a bound proves it.
    pub fn is_complete(&self) -> bool {
        self.complete
    }

    /// Why the search ended before it was complete.
    pub fn stopped_by(&self) -> StoppedBy {
        self.stopped_by
    }

    /// The same solution, whose limit of nodes was not the caller's but a budget.
    pub(crate) fn within_budget(mut self) -> Self {
        if self.stopped_by == StoppedBy::Nodes {
            self.stopped_by = StoppedBy::Budget;
        }
        if self.status == SolveStatus::Limit && self.stopped_by == StoppedBy::Budget {
            self.status = SolveStatus::Feasible;
        }
        self
    }

    /// The multiplications of the relaxation and of the search, approximately. The relaxation counts as 50
    /// for each entry of the reduced Hessian; roundings do not count. The number is the same on every
    /// machine.
    pub fn work(&self) -> u64 {
        self.work
    }

    /// Sizes before and after elimination.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Seconds by phase.
    pub fn seconds(&self) -> &Seconds {
        &self.seconds
    }

    /// The largest `|c . x - d| / max(1, sum_j |c_j x_j|)` over the constraints.
    pub fn max_constraint_violation(&self) -> f64 {
        self.max_constraint_violation
    }

    /// The largest distance of an integer unknown from an integer.
    pub fn max_integrality_violation(&self) -> f64 {
        self.max_integrality_violation
    }
}
