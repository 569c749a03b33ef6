//! What a search claims, held against the problem as it was given.

use super::polish;
use super::verify::{Verdict, verify};
use crate::monitor::relative_gap;
use crate::search::SolveStatus;
use crate::{Problem, Result};

/// What the search holds for proved is not called so where verification, from the caller's own numbers,
/// finds a relative gap beyond this.
const VERIFIED_GAP: f64 = 1e-6;

/// Values in the caller's unknowns, and what is said of them.
pub(super) struct Claim {
    pub values: Vec<f64>,
    pub lower_bound: f64,
    pub status: SolveStatus,
    /// Whether integers were decided.
    pub decided: bool,
}

impl Claim {
    /// What is left of the claim where it is measured on `problem`, and the measures: constraints that do
    /// not hold are mended, no bound is above the energy, and what is not proved is not called so.
    pub fn verified(mut self, problem: &Problem) -> Result<(Self, Verdict)> {
        let mut verdict = verify(problem, &self.values)?;
        // Of a search that was stopped, what it found is returned as it is.
        let mended = match self.status {
            SolveStatus::Optimal | SolveStatus::Feasible => {
                polish::with_integers_held(problem, &self.values, &verdict)
            }
            SolveStatus::Relaxed => polish::with_integers_real(problem, &verdict),
            SolveStatus::Limit | SolveStatus::Cancelled => None,
        };
        if let Some(better) = mended {
            (self.values, verdict) = (better.values, better.verdict);
            // With no integer decided both solves are of the same problem, and the first is off.
            if self.status == SolveStatus::Relaxed || !self.decided {
                self.lower_bound = better.lower_bound;
            }
        }
        let proved = relative_gap(verdict.energy, self.lower_bound) <= VERIFIED_GAP;
        if self.status == SolveStatus::Optimal && self.decided && !proved {
            self.status = SolveStatus::Feasible;
        }
        self.lower_bound = self.lower_bound.min(verdict.energy);
        Ok((self, verdict))
    }
}
