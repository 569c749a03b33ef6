//! A solve with a proof that code which shares nothing with the search can check.
//!
//! The proof is the tree of branch and bound. Where other methods have solved the problem, branch and bound
//! searches once more from their solution.

use super::limited::{conclude, solve_limited};
use super::run::{begin, solve_unlimited};
use super::solution::Solution;
use crate::branch;
use crate::error::{Error, Result};
use crate::linalg::DisjointSets;
use crate::monitor::{Monitor, watch_memory, with_threads};
use crate::problem::{Model, Problem};
use crate::proof::{Derivation, Proof};
use crate::search::{Options, SolveStatus, Strategy};

/// The largest number of unknowns that Q couples, for a search after other methods.
const LARGEST: usize = 3000;

/// The nodes of a search after other methods. It may never close a tree of integers without bounds.
const NODES: usize = 200_000;

/// The outcome of a solve, with its proof.
#[derive(Debug, Clone)]
pub struct Proved {
    /// The solution, or the error of a problem that has none.
    pub outcome: Result<Solution>,
    /// The proof of the bound, or that there is no point. Its bound may be lower than that of the solution.
    pub proof: Proof,
}

/// Solves `problem` and writes a proof. The strategy is `exact` or `auto`; limits hold as for a solve without
/// one, and a search that ends early proves the bound that it has reached.
///
/// # Errors
/// The errors of [`solve_with`](crate::solve_with), except for a problem without a point whose proof is the
/// result; [`Error::InvalidArgument`] for another strategy; [`Error::NotSupported`] for what cannot be proved.
pub fn solve_with_proof(problem: &Problem, options: &Options, monitor: Monitor) -> Result<Proved> {
    if !matches!(options.strategy, Strategy::Exact | Strategy::Auto) {
        return Err(Error::InvalidArgument {
            what: format!(
                "strategy {} proves nothing; a proof needs exact or auto",
                options.strategy.name()
            ),
            index: None,
        });
    }
    let _memory = watch_memory(problem.size());
    with_threads(options.threads, || prove(problem, options, monitor))
}

fn prove(problem: &Problem, options: &Options, mut monitor: Monitor) -> Result<Proved> {
    let model = begin(problem, options, &mut monitor)?;
    let mut derivation = Derivation::default();
    let guess = model.guess();
    let mut outcome = if problem.is_limited() {
        let record = Some(&mut derivation);
        solve_limited(problem, &model, options, guess, record, &mut monitor)
    } else {
        solve_unlimited(problem, &model, options, guess, &mut monitor)
    };
    may_have_proof(&outcome)?;
    if !derivation.is_begun {
        fits(&model)?;
        let start = outcome.as_ref().ok().map(Solution::values);
        let record = Some(&mut derivation);
        // What is known to be optimal shall be proved so, whatever `auto` would spend on finding it.
        let is_open = outcome
            .as_ref()
            .is_ok_and(|s| s.status != SolveStatus::Optimal);
        let options = &Options {
            strategy: if is_open {
                options.strategy
            } else {
                Strategy::Exact
            },
            nodes: options.nodes.min(NODES),
            ..options.clone()
        };
        let found = branch::solve(problem, &model, options, start, None, record, &mut monitor);
        let again = found.and_then(|found| conclude(problem, &model, options, found, &monitor));
        may_have_proof(&again)?;
        outcome = better(outcome, again)?;
    }
    let values = outcome.as_ref().ok().map(Solution::values);
    let proof = Proof::new(problem, &derivation, values)?;
    Ok(Proved { outcome, proof })
}

/// Whether an outcome can be proved: a solution, or that there is none.
fn may_have_proof(outcome: &Result<Solution>) -> Result<()> {
    match outcome {
        Ok(_)
        | Err(
            Error::Infeasible { .. }
            | Error::Contradiction { .. }
            | Error::NoIntegerSolution { .. },
        ) => Ok(()),
        Err(error) => Err(error.clone()),
    }
}

/// The outcome of two solves of one problem.
fn better(first: Result<Solution>, second: Result<Solution>) -> Result<Result<Solution>> {
    match (first, second) {
        (Ok(first), Ok(second)) => {
            let is_optimal = [&first, &second]
                .map(Solution::status)
                .contains(&SolveStatus::Optimal);
            let bounds = [&first, &second].map(|s| s.lower_bound.unwrap_or(f64::NEG_INFINITY));
            let is_better = second.energy < first.energy
                && second.max_constraint_violation <= first.max_constraint_violation.max(1e-12);
            let mut best = if is_better { second } else { first };
            best.lower_bound = Some(bounds[0].max(bounds[1]).min(best.energy));
            if is_optimal {
                best.status = SolveStatus::Optimal;
            }
            Ok(Ok(best))
        }
        (Err(first), Err(_)) => Ok(Err(first)),
        _ => Err(Error::NotSupported {
            what: "a proof in exact numbers: rounding errors decide whether there is a point"
                .into(),
            index: None,
            line: None,
        }),
    }
}

/// The dense inverse of a block of Q must fit into memory.
fn fits(model: &Model) -> Result<()> {
    let n = model.variables();
    let mut sets = DisjointSets::new(n);
    for (i, j, _) in model.hessian().entries() {
        sets.join(i as usize, j as usize);
    }
    let mut sizes = vec![0; n];
    for j in 0..n {
        sizes[sets.root(j)] += 1;
    }
    match sizes.into_iter().max() {
        Some(size) if size > LARGEST => Err(Error::NotSupported {
            what: format!(
                "a proof in exact numbers: Q couples {size} unknowns, and at most {LARGEST} may be"
            ),
            index: None,
            line: None,
        }),
        _ => Ok(()),
    }
}
