//! The same two problems, decided by several strategies.

use crate::error::Result;
use crate::monitor::Monitor;
use crate::problem::Problem;
use crate::search::{Options, Strategy};
use crate::solve::{Solution, solve_with};

/// What one strategy makes of the field's problem, and of the map's for the field that was taken.
#[derive(Debug, Clone)]
pub struct Compared {
    /// How the integers were decided.
    pub strategy: Strategy,
    /// The field's problem solved.
    pub field: Solution,
    /// The map's problem solved.
    pub map: Solution,
}

/// Solves both problems by every strategy, each from the start.
pub(super) fn compare<'a>(
    [field, map]: [(&Problem, &Options); 2],
    strategies: &[Strategy],
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Vec<Compared>> {
    let compared = strategies.iter().map(|&strategy| {
        let solve = |(problem, options): (&Problem, &Options)| {
            let options = Options {
                strategy,
                ..options.clone()
            };
            solve_with(problem, &options, monitor())
        };
        Ok(Compared {
            strategy,
            field: solve(field)?,
            map: solve(map)?,
        })
    });
    compared.collect()
}
