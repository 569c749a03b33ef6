//! The rows of a proof, which has those cuts of the search that hold in exact numbers.

use super::cut;
use super::format::Cut;
use super::problem::{ExactProblem, Limits};
use super::seal::Ask;
use crate::error::Result;

/// The numbers of the rows of a part in the proof, by those in the search.
pub(super) struct Numbers {
    /// The rows of the problem, which keep theirs.
    given: u32,
    /// The numbers of cuts, which come after them. Nothing stands for one that does not hold.
    cuts: Vec<Option<u32>>,
}

impl Numbers {
    /// The number of a row, if it is in the proof.
    pub fn of_row(&self, row: u32) -> Option<u32> {
        match row.checked_sub(self.given) {
            None => Some(row),
            Some(cut) => self.cuts.get(cut as usize).copied().flatten(),
        }
    }

    /// Adds the cuts that hold in exact numbers to the rows, with the sides that do, and returns them.
    ///
    /// # Errors
    /// That of `ask`.
    pub fn with_cuts(
        problem: &mut ExactProblem,
        limits: &Limits,
        cuts: &[Cut],
        ask: Ask,
    ) -> Result<(Self, Vec<Cut>)> {
        let mut numbers = Numbers {
            given: problem.rows.len() as u32,
            cuts: Vec::with_capacity(cuts.len()),
        };
        let mut added = Vec::new();
        for cut in cuts {
            ask()?;
            let mut cut = cut.clone();
            for case in &mut cut.cases {
                let own = |(row, by): &(u32, f64)| Some((numbers.of_row(*row)?, *by));
                case.multipliers = case.multipliers.iter().filter_map(own).collect();
            }
            let mut number = None;
            if let Ok(Some(most)) = cut::most(problem, limits, &cut) {
                cut.lower = most.below();
                if cut::add(problem, limits, &cut).is_ok() {
                    number = Some(problem.rows.len() as u32 - 1);
                    added.push(cut);
                }
            }
            numbers.cuts.push(number);
        }
        Ok((numbers, added))
    }
}
