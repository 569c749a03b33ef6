//! A second solve without integer unknowns, if the first solution violates the constraints.
//!
//! A chain of constraints between integers may lead to an expansion `x = T y + t` whose numbers are far
//! larger than those of the solution. For integer `y` the integers are exact, but continuous unknowns in
//! the same constraints lose most of their digits to cancellation. In a relaxation `y` is not integer, and
//! every unknown may lose its digits. The second solve pins the integers to the values of the first, or
//! makes them real for a relaxation. Then there is no such chain, and pivots are chosen by size.

use super::around::around_relaxation;
use super::eliminated::EliminatedProblem;
use super::expand::expand;
use super::verify::{Verdict, verify};
use crate::eliminate::Elimination;
use crate::error::Result;
use crate::linalg::Ordering;
use crate::monitor::Monitor;
use crate::problem::{Model, Problem};
use crate::search::{Factors, Strategy};

/// Violations up to this size may come from the rounding of the values alone.
const CLEAN: f64 = 1e-9;

/// The result of a second solve.
pub(super) struct SecondSolve {
    pub values: Vec<f64>,
    pub verdict: Verdict,
    /// The lower bound from the second solve.
    pub lower_bound: f64,
}

/// Solves for the continuous unknowns again, with the integers of `values`, if `verdict` says that these
/// values violate the constraints. None unless the result is better.
pub(super) fn with_integers_held(
    problem: &Problem,
    values: &[f64],
    verdict: &Verdict,
) -> Option<SecondSolve> {
    let solve = || {
        let mut held = problem.clone();
        for (i, _) in problem.integers().iter().enumerate().filter(|(_, is)| **is) {
            held.pin(i, values[i])?;
        }
        again(problem, &held)
    };
    let keeps =
        |new: &SecondSolve| new.verdict.integrality_violation <= verdict.integrality_violation;
    better(problem, verdict, solve).filter(keeps)
}

/// Solves the relaxation again, with real unknowns for the integers, if `verdict` says that the first
/// minimiser violates the constraints. None unless the result is better.
pub(super) fn with_integers_real(problem: &Problem, verdict: &Verdict) -> Option<SecondSolve> {
    better(problem, verdict, || again(problem, &problem.relaxed()))
}

/// The result of `solve`, if the constraints are violated and the result violates them less. Without free
/// integers the second problem would be the first one, so there is no second solve.
fn better(
    problem: &Problem,
    verdict: &Verdict,
    solve: impl FnOnce() -> Result<SecondSolve>,
) -> Option<SecondSolve> {
    let free_integers = (problem.integers().iter().zip(problem.pins().iter()))
        .any(|(is, pin)| *is && pin.is_none());
    if verdict.constraint_violation <= CLEAN || !free_integers {
        return None;
    }
    let better =
        |new: &SecondSolve| new.verdict.constraint_violation < verdict.constraint_violation;
    solve().ok().filter(better)
}

/// Solves `continuous`, which has no free integers, and measures the result on `problem`.
fn again(problem: &Problem, continuous: &Problem) -> Result<SecondSolve> {
    let model = Model::new(continuous)?;
    let monitor = &mut Monitor::default();
    let mut of = EliminatedProblem {
        problem: continuous,
        model: &model,
        elimination: &Elimination::new(&model, Ordering::FillReducing, monitor)?,
        factors: &mut Factors::new(Ordering::FillReducing),
        earlier: model.guess(),
    };
    let (reduced, _) = of.reduce(monitor)?;
    let (centre, relaxation) = around_relaxation(&mut of, &reduced, Strategy::Relax)?;
    let values = expand(&centre, &model, Strategy::Relax, &relaxation.point);
    let energy = verify(continuous, &values)?.energy;
    Ok(SecondSolve {
        verdict: verify(problem, &values)?,
        lower_bound: relaxation.lower_bound.min(energy),
        values,
    })
}
