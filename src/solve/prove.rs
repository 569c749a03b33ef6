//! A solve with a proof that code which shares nothing with the search can check.
//!
//! The proof is the tree of branch and bound, or that of a flow. Where other methods have solved the problem, branch
//! and bound searches once more from their solution. Then the proof is written, as long as the caller lets it.

use super::condense::condense;
use super::limited::{conclude, solve_limited};
use super::run::{begin, solve_unlimited};
use super::solution::Solution;
use crate::branch;
use crate::error::{Error, Result};
use crate::linalg::DisjointSets;
use crate::monitor::{Monitor, may_continue, watch_memory, with_threads};
use crate::problem::{Model, Problem};
use crate::proof::{Derivation, Proof};
use crate::search::{Options, SolveStatus, StoppedBy, Strategy};

/// The largest number of unknowns that Q couples, for a search after other methods.
const LARGEST: usize = 3000;

/// The nodes of a search after other methods. It may never close a tree of integers without bounds.
const NODES: usize = 200_000;

/// The most integers for a tree where the closest point of a lattice falls short. With more, its bound is lower still.
const OF_TREE: usize = 60;

/// The part of the time limit that searches may take. What they leave is for the proof.
const SEARCH: f64 = 0.5;

/// A proof by a lattice whose bound is below that of the search by no more than this part of it is the best there is.
const REACHED: f64 = 1e-7;

/// The outcome of a solve, with its proof.
#[derive(Debug, Clone)]
pub struct Proved {
    /// The solution, or the error of a problem that has none.
    pub outcome: Result<Solution>,
    /// The proof of the bound, or that there is no point. Its bound may be lower than that of the solution. If it was
    /// stopped before it was complete, what stopped it: [`StoppedBy::Time`], [`StoppedBy::Cancel`],
    /// [`StoppedBy::Memory`], or [`StoppedBy::Nodes`] and [`StoppedBy::Budget`] before the search had a point.
    pub proof: std::result::Result<Proof, StoppedBy>,
}

/// Solves `problem` and makes a proof. The strategy is `exact` or `auto`. A search that ends early proves the bound
/// that it has reached. Half of a time limit is for the search at most, so that time is left for the proof. A
/// proof that the limit or a cancel ends is not made, and the solution is kept; a caller who wants the results so
/// far ends the search alone.
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
    let limit = options.time_limit;
    let options = &Options {
        time_limit: SEARCH * limit,
        ..options.clone()
    };
    let model = &begin(problem, options, &mut monitor)?;
    let mut proving = Proving {
        problem,
        model,
        options,
        limit,
        derivation: Derivation::default(),
        monitor,
    };
    let outcome = proving.solve();
    may_have_proof(&outcome)?;
    if proving.derivation.is_begun {
        return proving.write(outcome, None);
    }
    let search_ended = proving.monitor.stopped();
    if search_ended.is_some() {
        proving.monitor.extend(limit);
    }
    let integers = |solution: &Solution| solution.counts().reduced_integers;
    let is_last = search_ended.is_some()
        || fits(model).is_err()
        || outcome.as_ref().map_or(0, integers) > OF_TREE;
    let of_lattice = match proving.by_lattice(&outcome, is_last)? {
        Some(proof) if is_last || reaches(&proof, &outcome) => {
            let proof = Ok(proof);
            return Ok(Proved { outcome, proof });
        }
        other => other,
    };
    fits(model)?;
    if let Some(stopped) = search_ended.and_then(|stop| stopped_by(&stop.into())) {
        let proof = Err(stopped);
        return Ok(Proved { outcome, proof });
    }
    let again = proving.search_again(&outcome);
    if let Some(stopped) = again.as_ref().err().and_then(stopped_by) {
        let proof = of_lattice.ok_or(stopped);
        return Ok(Proved { outcome, proof });
    }
    may_have_proof(&again)?;
    proving.write(better(outcome, again)?, of_lattice)
}

/// A proof while it is made.
struct Proving<'a, 'm> {
    problem: &'a Problem,
    model: &'a Model,
    /// Their time limit is that of the searches.
    options: &'a Options,
    /// The time limit of the caller.
    limit: f64,
    /// What branch and bound has recorded.
    derivation: Derivation,
    monitor: Monitor<'m>,
}

impl Proving<'_, '_> {
    /// The outcome of the solve. Branch and bound records its tree; other methods record nothing.
    fn solve(&mut self) -> Result<Solution> {
        let (problem, model, options) = (self.problem, self.model, self.options);
        let (guess, monitor) = (model.guess(), &mut self.monitor);
        match problem.is_limited() {
            true => {
                let record = Some(&mut self.derivation);
                solve_limited(problem, model, options, guess, record, monitor)
            }
            false => solve_unlimited(problem, model, options, guess, monitor),
        }
    }

    /// The proof by the closest point of a lattice, of a problem that has a solution. None if there is no such proof,
    /// or whatever told the solve to end came first. If it is the last one that is tried, it may take all the time.
    fn by_lattice(&mut self, outcome: &Result<Solution>, is_last: bool) -> Result<Option<Proof>> {
        let Ok(solution) = outcome else {
            return Ok(None);
        };
        let (problem, values) = (self.problem, solution.values());
        let monitor = &mut self.monitor;
        let derived = condense(problem, self.model, self.options, values, monitor);
        let made = derived.and_then(|derived| {
            let Some(derived) = derived else {
                return Ok(None);
            };
            if is_last {
                monitor.extend(self.limit);
            }
            let _watch = monitor.watch();
            let ask = || Ok(may_continue()?);
            Proof::new(problem, &derived, Some(values), &ask).map(Some)
        });
        if made.is_err() {
            monitor.extend(self.options.time_limit);
        }
        match made {
            Err(error @ Error::OutOfMemory { .. }) => Err(error),
            made => Ok(made.unwrap_or_default()),
        }
    }

    /// The outcome of branch and bound from the solution of other methods. It records its tree.
    fn search_again(&mut self, outcome: &Result<Solution>) -> Result<Solution> {
        let (problem, model, monitor) = (self.problem, self.model, &mut self.monitor);
        let start = outcome.as_ref().ok().map(Solution::values);
        let record = Some(&mut self.derivation);
        // What is known to be optimal shall be proved so, whatever `auto` would spend on finding it.
        let is_open = outcome
            .as_ref()
            .is_ok_and(|s| s.status != SolveStatus::Optimal);
        let options = &Options {
            strategy: if is_open {
                self.options.strategy
            } else {
                Strategy::Exact
            },
            nodes: self.options.nodes.min(NODES),
            ..self.options.clone()
        };
        let found = branch::solve(problem, model, options, start, None, record, monitor)?;
        conclude(problem, model, options, found, monitor)
    }

    /// Writes the proof that was recorded, or gives that of a lattice if it proves more.
    fn write(mut self, outcome: Result<Solution>, of_lattice: Option<Proof>) -> Result<Proved> {
        let values = outcome.as_ref().ok().map(Solution::values);
        let search_ended = self.monitor.stopped().map(Error::from);
        self.monitor.extend(self.limit);
        let made = self.monitor.check().map_err(Error::from).and_then(|()| {
            let _watch = self.monitor.watch();
            Proof::new(self.problem, &self.derivation, values, &|| {
                Ok(may_continue()?)
            })
        });
        let proof = match (made, of_lattice) {
            (Ok(proof), Some(other)) if other.lower_bound() > proof.lower_bound() => Ok(other),
            (Ok(proof), _) | (Err(_), Some(proof)) => Ok(proof),
            (Err(error), None) => {
                // A search that was stopped may have no bound yet.
                let ended = search_ended.filter(|_| matches!(error, Error::NotSupported { .. }));
                let stopped = stopped_by(&error).or_else(|| ended.as_ref().and_then(stopped_by));
                Err(stopped.ok_or(error)?)
            }
        };
        Ok(Proved { outcome, proof })
    }
}

/// Whether a proof has the bound of the solution, but for rounding errors.
fn reaches(proof: &Proof, outcome: &Result<Solution>) -> bool {
    let bound = |solution: &Solution| solution.lower_bound.zip(proof.lower_bound());
    let bounds = outcome.as_ref().ok().and_then(bound);
    bounds.is_some_and(|(own, proved)| proved >= own - REACHED * own.abs().max(1.0))
}

/// What ended a step with this error, if the step was told to end.
fn stopped_by(error: &Error) -> Option<StoppedBy> {
    match error {
        Error::Cancelled => Some(StoppedBy::Cancel),
        Error::TimeLimit => Some(StoppedBy::Time),
        Error::SearchLimit { what: "nodes" } => Some(StoppedBy::Nodes),
        Error::SearchLimit { .. } => Some(StoppedBy::Budget),
        Error::OutOfMemory { .. } => Some(StoppedBy::Memory),
        _ => None,
    }
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

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::monitor::{CancelToken, Flow};

    /// A knapsack whose tree has some nodes.
    fn knapsack() -> Problem {
        let n = 10;
        let all: Vec<usize> = (0..n).collect();
        let mut problem = Problem::new(n).unwrap();
        for &k in &all {
            let rhs = 0.3 + 0.07 * (k * k % 7) as f64;
            problem.add_least_squares(&[k], &[1.0], rhs, 1.0).unwrap();
        }
        let row = [0, 1, 2, 3];
        problem
            .add_least_squares(&row, &[1.0, -1.0, 2.0, 1.0], 1.4, 0.5)
            .unwrap();
        let sizes: Vec<f64> = all.iter().map(|k| (3 + k * 5 % 8) as f64).collect();
        problem
            .add_inequality(&all, &sizes, 17.5, f64::INFINITY)
            .unwrap();
        problem.set_binaries(&all).unwrap();
        problem
    }

    #[test]
    fn a_proof_that_is_told_to_end_at_any_question_ends_there() {
        let problem = knapsack();
        let options = Options::default();
        let mut monitor = Monitor::default();
        let model = begin(&problem, &options, &mut monitor).unwrap();
        let mut derivation = Derivation::default();
        let record = Some(&mut derivation);
        let guess = model.guess();
        let solved = solve_limited(&problem, &model, &options, guess, record, &mut monitor);
        let solution = solved.unwrap();
        let make = |last: usize| {
            let asked = Cell::new(0);
            let ask = || {
                asked.set(asked.get() + 1);
                match asked.get() > last {
                    true => Err(Error::TimeLimit),
                    false => Ok(()),
                }
            };
            (
                Proof::new(&problem, &derivation, Some(solution.values()), &ask),
                asked.get(),
            )
        };
        let (whole, asked) = make(usize::MAX);
        let whole = whole.unwrap();
        assert!(whole.nodes() > 3 && asked > whole.nodes(), "{asked}");
        for last in 0..asked {
            assert_eq!(make(last).0, Err(Error::TimeLimit), "{last} of {asked}");
        }
        assert_eq!(make(asked).0, Ok(whole));
    }

    #[test]
    fn a_cancelled_solve_keeps_its_solution_and_has_no_proof() {
        let token = CancelToken::new();
        let cancel = token.clone();
        let monitor = Monitor::default()
            .cancel_token(token)
            .on_event(move |event| {
                if event.energy.is_finite() {
                    cancel.cancel();
                }
                Flow::Continue
            });
        let proved = solve_with_proof(&knapsack(), &Options::default(), monitor).unwrap();
        assert_eq!(proved.outcome.unwrap().status(), SolveStatus::Cancelled);
        assert_eq!(proved.proof, Err(StoppedBy::Cancel));
    }

    #[test]
    fn a_caller_who_wants_the_results_so_far_gets_a_proof_of_the_bound_so_far() {
        let token = CancelToken::new();
        let finish = token.clone();
        let monitor = Monitor::default()
            .cancel_token(token)
            .on_event(move |event| {
                if event.energy.is_finite() && event.lower_bound.is_finite() {
                    finish.finish();
                }
                Flow::Continue
            });
        let proved = solve_with_proof(&knapsack(), &Options::default(), monitor).unwrap();
        let bound = proved.proof.unwrap().lower_bound().unwrap();
        assert!(bound.is_finite() && bound <= proved.outcome.unwrap().energy());
    }

    #[test]
    fn a_time_limit_before_the_first_solution_is_that_of_the_solve() {
        let options = Options {
            time_limit: 0.0,
            ..Options::default()
        };
        let error = solve_with_proof(&knapsack(), &options, Monitor::default()).unwrap_err();
        assert_eq!(error, Error::TimeLimit);
    }
}
