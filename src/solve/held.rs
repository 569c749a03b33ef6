//! The continuous unknowns once more, the integers held where they were found.
//!
//! A chain of constraints between integers may lead to an expansion `x = T y + t` whose numbers are far
//! beyond those of the solution. Integers come out of it exactly; of continuous unknowns that stand in the
//! same constraints few digits are left. With the integers pinned there is no such chain.

use super::verify::{Verdict, verify};
use super::{Options, Strategy, solve};
use crate::{Problem, Result};

/// A violation up to here is what the rounding of the values themselves may come to.
const CLEAN: f64 = 1e-9;

/// Values with which the constraints hold better than with `values`, of which `verdict` says that they do
/// not, if there are any.
pub(super) fn mend(
    problem: &Problem,
    values: &[f64],
    verdict: Verdict,
) -> Option<(Vec<f64>, Verdict)> {
    if verdict.constraint_violation <= CLEAN {
        return None;
    }
    let better = |(_, new): &(Vec<f64>, Verdict)| {
        new.constraint_violation < verdict.constraint_violation
            && new.integrality_violation <= verdict.integrality_violation
    };
    with_integers_held(problem, values).ok().filter(better)
}

/// The best values, and what they are worth, with the integers of `values`.
fn with_integers_held(problem: &Problem, values: &[f64]) -> Result<(Vec<f64>, Verdict)> {
    let mut held = problem.clone();
    for (i, _) in problem.integers().iter().enumerate().filter(|(_, is)| **is) {
        held.pin(i, values[i])?;
    }
    let options = Options {
        strategy: Strategy::Relax,
        ..Options::default()
    };
    let values = solve(&held, &options)?.values().to_vec();
    let verdict = verify(problem, &values)?;
    Ok((values, verdict))
}
