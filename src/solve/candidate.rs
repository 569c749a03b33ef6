//! A candidate solution, verified on the caller's problem.

use super::second_solve;
use super::verify::{Verdict, verify};
use crate::error::Result;
use crate::monitor::relative_gap;
use crate::problem::Problem;
use crate::search::SolveStatus;

/// A solution is not reported as optimal where its relative gap, verified from the caller's own numbers,
/// is larger than this.
const VERIFIED_GAP: f64 = 1e-6;

/// Values of the caller's unknowns, with the bound and the status that the search reports.
pub(super) struct Candidate {
    pub values: Vec<f64>,
    pub lower_bound: f64,
    pub status: SolveStatus,
    /// Whether the reduced model has integers.
    pub has_integers: bool,
}

impl Candidate {
    /// Measures the candidate on `problem` and corrects it. If it violates constraints, a second solve
    /// repairs them. A bound above the energy is lowered to the energy. A solution whose verified gap is
    /// too large is no longer called optimal.
    pub fn verified(mut self, problem: &Problem) -> Result<(Self, Verdict)> {
        let mut verdict = verify(problem, &self.values)?;
        // A search that was stopped returns what it has found, without a second solve.
        let repaired = match self.status {
            SolveStatus::Optimal | SolveStatus::Feasible => {
                second_solve::with_integers_held(problem, &self.values, &verdict)
            }
            SolveStatus::Relaxed => second_solve::with_integers_real(problem, &verdict),
            SolveStatus::Limit | SolveStatus::Cancelled => None,
        };
        if let Some(better) = repaired {
            (self.values, verdict) = (better.values, better.verdict);
            // Without integers both solves are of the same problem, and the first bound is inaccurate.
            if self.status == SolveStatus::Relaxed || !self.has_integers {
                self.lower_bound = better.lower_bound;
            }
        }
        let proved = relative_gap(verdict.energy, self.lower_bound) <= VERIFIED_GAP;
        if self.status == SolveStatus::Optimal && self.has_integers && !proved {
            self.status = SolveStatus::Feasible;
        }
        self.lower_bound = self.lower_bound.min(verdict.energy);
        Ok((self, verdict))
    }
}
