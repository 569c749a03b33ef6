//! The problems of one field and one map, solved by several strategies.

use crate::error::Result;
use crate::monitor::Monitor;
use crate::problem::Problem;
use crate::search::{Options, Strategy};
use crate::solve::{Solution, solve_with};

/// The solutions of one strategy: of the field's problem, and of the map's problem for the chosen field.
#[derive(Debug, Clone)]
pub struct Compared {
    /// The strategy that decided the integers.
    pub strategy: Strategy,
    /// The solution of the field's problem.
    pub field: Solution,
    /// The solution of the map's problem.
    pub map: Solution,
}

/// Solves both problems by every strategy, each time from the start.
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
