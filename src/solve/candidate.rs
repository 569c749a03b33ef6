//! A candidate solution, verified on the caller's problem.

use super::second_solve;
use super::verify::{Verdict, verify};
use crate::error::Result;
use crate::problem::Problem;
use crate::search::{SolveStatus, StoppedBy};

/// A solution is not reported as optimal where its energy, verified from the caller's own numbers, is above
/// the one of the search by more than this part of it.
const VERIFIED: f64 = 1e-6;

/// Values of the caller's unknowns, with what the search reports of them.
pub(super) struct Candidate {
    pub values: Vec<f64>,
    /// The energy in the search.
    pub energy: f64,
    pub lower_bound: f64,
    pub status: SolveStatus,
    pub complete: bool,
    pub stopped_by: StoppedBy,
    /// Whether the reduced model has integers.
    pub has_integers: bool,
}

impl Candidate {
    /// Measures the candidate on `problem` and corrects it. If it violates constraints, a second solve
    /// repairs them. A bound above the energy is lowered to the energy. A solution whose verified energy
    /// is too large is no longer called optimal, and its search no longer complete.
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
        let excess = verdict.energy - self.energy;
        let is_off = excess > VERIFIED * verdict.energy.abs() && excess > self.rounding(problem);
        if self.has_integers && is_off {
            self.complete = false;
            if self.status == SolveStatus::Optimal {
                self.status = SolveStatus::Feasible;
            }
        }
        self.lower_bound = self.lower_bound.min(verdict.energy);
        Ok((self, verdict))
    }

    /// The energy that the rounding of the values to floats may add at a minimum, where the slope vanishes.
    fn rounding(&self, problem: &Problem) -> f64 {
        let x = &self.values;
        let mut size = problem.constant().abs();
        for (q, x) in problem.linear().iter().zip(x) {
            size += (q * x).abs();
        }
        for &(i, j, v) in problem.quadratic() {
            size += (v * x[i as usize] * x[j as usize]).abs();
        }
        let (rows, weights) = problem.least_squares();
        for (k, w) in weights.iter().enumerate() {
            let terms = rows.row(k).map(|(j, a)| (a * x[j]).abs());
            size += w.abs() * (terms.sum::<f64>() + rows.rhs()[k].abs()).powi(2);
        }
        f64::EPSILON * f64::EPSILON * size
    }
}
