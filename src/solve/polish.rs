//! A second solve without the integer unknowns, where the first does not hold the constraints.
//!
//! A chain of constraints between integers may lead to an expansion `x = T y + t` whose numbers are far
//! beyond those of the solution. Integers come out of it exactly where `y` is integer. Of continuous
//! unknowns that stand in the same constraints few digits are left, and of a relaxation, where `y` is
//! not integer, few of any unknown. With the integers pinned where they were found, or made real for the
//! relaxation, there is no such chain: pivots are chosen by size.

use super::solve;
use super::verify::{Verdict, verify};
use crate::search::{Options, Strategy};
use crate::{Problem, Result};

/// A violation up to here is what the rounding of the values themselves may come to.
const CLEAN: f64 = 1e-9;

/// A solution in which the constraints hold better.
pub(super) struct Mended {
    pub values: Vec<f64>,
    pub verdict: Verdict,
    /// What the second solve proves of the problem that it was given.
    pub lower_bound: f64,
}

/// The continuous unknowns once more, with the integers of `values`, if `verdict` says of these that the
/// constraints do not hold.
pub(super) fn with_integers_held(
    problem: &Problem,
    values: &[f64],
    verdict: &Verdict,
) -> Option<Mended> {
    let mend = || {
        let mut held = problem.clone();
        for (i, _) in problem.integers().iter().enumerate().filter(|(_, is)| **is) {
            held.pin(i, values[i])?;
        }
        again(problem, &held)
    };
    let keeps = |new: &Mended| new.verdict.integrality_violation <= verdict.integrality_violation;
    better(problem, verdict, mend).filter(keeps)
}

/// The minimum with all integers real once more, if `verdict` says of the first that the constraints do not
/// hold.
pub(super) fn with_integers_real(problem: &Problem, verdict: &Verdict) -> Option<Mended> {
    better(problem, verdict, || again(problem, &problem.relaxed()))
}

/// What `mend` makes where there is something to mend, and it does. An unknown that is an integer and free is
/// what distinguishes `problem` from those solved here.
fn better(
    problem: &Problem,
    verdict: &Verdict,
    mend: impl FnOnce() -> Result<Mended>,
) -> Option<Mended> {
    let free_integers =
        (problem.integers().iter().zip(problem.pins())).any(|(is, pin)| *is && pin.is_none());
    if verdict.constraint_violation <= CLEAN || !free_integers {
        return None;
    }
    let better = |new: &Mended| new.verdict.constraint_violation < verdict.constraint_violation;
    mend().ok().filter(better)
}

/// Solves `continuous`, and measures the result on `problem`.
fn again(problem: &Problem, continuous: &Problem) -> Result<Mended> {
    let options = Options {
        strategy: Strategy::Relax,
        ..Options::default()
    };
    let solution = solve(continuous, &options)?;
    let values = solution.values().to_vec();
    Ok(Mended {
        verdict: verify(problem, &values)?,
        lower_bound: solution.lower_bound().unwrap_or(f64::NEG_INFINITY),
        values,
    })
}
