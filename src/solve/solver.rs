//! Repeated solves of one problem with other right sides, linear terms and pins.
//!
//! Elimination, orderings and factors depend on none of these and are kept. Every solve, also the first,
//! passes its right sides through the recorded steps of the elimination ([`Elimination::reduce`]). So the
//! result is the same bit for bit as that of a solve from the start.

use super::Solution;
use super::eliminated::EliminatedProblem;
use super::limited::solve_limited;
use super::run::{solve_eliminated, solve_with, tell_of_ignored_hint};
use super::soft_rows::{SoftRow, solve_softly};
use super::verify::verify;
use crate::eliminate::Elimination;
use crate::error::Result;
use crate::linalg::Ordering;
use crate::monitor::{Monitor, may_continue, watch_memory, with_threads};
use crate::problem::{Model, Problem};
use crate::search::{Factors, Options, SolveStatus, Strategy, WarmStart};

/// A problem of fixed structure, with its elimination and factors kept from solve to solve.
///
/// The first solve costs as much as [`solve`](crate::solve()). A later solve with other linear terms, right
/// sides or pinned values skips elimination, orderings and factorizations. Pinning or releasing an unknown
/// that is in no constraint keeps the elimination. If the unknown is in a constraint, the elimination is
/// made again. The solution is always that of a solve from the start, bit for bit, except that a warm start
/// may improve it.
///
/// A solve that fails changes nothing. The data stay as they were set, and the next solve may use other
/// data.
#[derive(Debug)]
pub struct Solver {
    problem: Problem,
    model: Model,
    /// Whether the problem has changed since the model was made.
    stale: bool,
    cache: Option<Cache>,
    /// Whether a solve that decides integers follows those that decide none.
    is_searched: bool,
    /// Whether factors that only another relaxation would use are kept.
    keeps_all: bool,
    /// The last integer solution, unless the caller has set a guess since.
    earlier: Option<Vec<f64>>,
}

/// The elimination and the factors, which do not depend on right sides.
#[derive(Debug)]
struct Cache {
    ordering: Ordering,
    elimination: Elimination,
    /// The pinned unknowns, which the factors do not contain.
    pinned: Vec<bool>,
    factors: Factors,
}

impl Solver {
    /// A solver for a copy of `problem`.
    ///
    /// # Errors
    /// The errors of [`Model::new`]. All other errors come from the first solve.
    pub fn new(problem: &Problem) -> Result<Self> {
        let _memory = watch_memory(problem.size());
        may_continue()?;
        Ok(Solver {
            model: Model::new(problem)?,
            problem: problem.clone(),
            stale: false,
            cache: None,
            is_searched: false,
            keeps_all: true,
            earlier: None,
        })
    }

    /// Lets solves that decide no integers use the factors of one that does and will follow.
    pub(crate) fn expect_search(&mut self) {
        self.is_searched = true;
    }

    /// Saves memory: no other relaxation is expected to follow the first one.
    pub(crate) fn expect_one_relaxation(&mut self) {
        self.keeps_all = false;
    }

    /// Makes the elimination, which the next solve with this ordering then finds.
    ///
    /// # Errors
    /// As [`solve_with`](crate::solve_with).
    pub(crate) fn eliminate(&mut self, options: &Options, mut monitor: Monitor) -> Result<()> {
        let _memory = watch_memory(self.problem.size());
        with_threads(options.threads, || {
            self.prepare(options, &mut monitor).map(|_| ())
        })
    }

    /// Makes the elimination, and the order and the pattern of the factor of a relaxation, which the next solve with
    /// this ordering then finds. They do not depend on right sides.
    ///
    /// # Errors
    /// As [`solve_with`](crate::solve_with).
    pub(crate) fn analyse(&mut self, options: &Options, monitor: &mut Monitor) -> Result<()> {
        let _memory = watch_memory(self.problem.size());
        with_threads(options.threads, || {
            let mut eliminated = self.prepare(options, monitor)?;
            let (reduced, _) = eliminated.reduce(monitor)?;
            let _watch = monitor.watch();
            eliminated.factors.analyse(&reduced, options.strategy)
        })
    }

    /// The problem in its current state.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// See [`Problem::set_linear`].
    ///
    /// # Errors
    /// Those of [`Problem::set_linear`].
    pub fn set_linear(&mut self, values: &[f64]) -> Result<()> {
        self.change(|problem| problem.set_linear(values))
    }

    /// See [`Problem::set_constant`].
    ///
    /// # Errors
    /// Those of [`Problem::set_constant`].
    pub fn set_constant(&mut self, value: f64) -> Result<()> {
        self.change(|problem| problem.set_constant(value))
    }

    /// See [`Problem::set_constraint_right_sides`]. The next solve detects contradictions.
    ///
    /// # Errors
    /// Those of [`Problem::set_constraint_right_sides`].
    pub fn set_constraint_right_sides(&mut self, rhs: &[f64]) -> Result<()> {
        self.change(|problem| problem.set_constraint_right_sides(rhs))
    }

    /// See [`Problem::set_least_squares_right_sides`].
    ///
    /// # Errors
    /// Those of [`Problem::set_least_squares_right_sides`].
    pub fn set_least_squares_right_sides(&mut self, rhs: &[f64]) -> Result<()> {
        self.change(|problem| problem.set_least_squares_right_sides(rhs))
    }

    /// See [`Problem::set_inequality_sides`].
    ///
    /// # Errors
    /// Those of [`Problem::set_inequality_sides`].
    pub fn set_inequality_sides(&mut self, lower: &[f64], upper: &[f64]) -> Result<()> {
        self.change(|problem| problem.set_inequality_sides(lower, upper))
    }

    /// See [`Problem::set_bounds`].
    ///
    /// # Errors
    /// Those of [`Problem::set_bounds`].
    pub fn set_bounds(&mut self, variables: &[usize], lower: &[f64], upper: &[f64]) -> Result<()> {
        self.change(|problem| problem.set_bounds(variables, lower, upper))
    }

    /// See [`Problem::pin`].
    ///
    /// # Errors
    /// Those of [`Problem::pin`].
    pub fn pin(&mut self, variable: usize, value: f64) -> Result<()> {
        self.change(|problem| problem.pin(variable, value))
    }

    /// Releases a pinned unknown; see [`Problem::unpin`].
    ///
    /// # Errors
    /// Those of [`Problem::unpin`].
    pub fn unpin(&mut self, variable: usize) -> Result<()> {
        self.change(|problem| problem.unpin(variable))
    }

    /// See [`Problem::set_guess`]. A warm start begins there until a solution is found.
    ///
    /// # Errors
    /// Those of [`Problem::set_guess`].
    pub fn set_guess(&mut self, values: &[f64]) -> Result<()> {
        self.change(|problem| problem.set_guess(values))?;
        self.earlier = None;
        Ok(())
    }

    /// Makes these values those of the last integer solution, which a warm start begins with.
    pub(crate) fn continue_from(&mut self, values: &[f64]) {
        self.earlier = Some(values.to_vec());
    }

    fn change(&mut self, change: impl FnOnce(&mut Problem) -> Result<()>) -> Result<()> {
        change(&mut self.problem)?;
        self.stale = true;
        Ok(())
    }

    /// Solves the current problem without a monitor.
    ///
    /// # Errors
    /// As [`solve`](crate::solve()).
    pub fn solve(&mut self, options: &Options) -> Result<Solution> {
        self.solve_with(options, Monitor::default())
    }

    /// Solves the current problem with a `monitor`.
    ///
    /// # Errors
    /// As [`solve_with`](crate::solve_with).
    pub fn solve_with(&mut self, options: &Options, mut monitor: Monitor) -> Result<Solution> {
        let _memory = watch_memory(self.problem.size());
        let solution = with_threads(options.threads, || {
            if self.problem.is_limited() {
                return self.solve_limited(options, &mut monitor);
            }
            let eliminated = self.prepare(options, &mut monitor)?;
            solve_eliminated(eliminated, options, &mut monitor)
        })?;
        if solution.status() != SolveStatus::Relaxed {
            self.earlier = Some(solution.values().to_vec());
        }
        Ok(solution)
    }

    /// Finds the best values for the integers of the last solution. A solve with
    /// [`WarmStart::Keep`](crate::WarmStart::Keep) finds them as well, but makes a relaxation first. Here there is none.
    /// So the lower bound is that of a sum of squares, or infinite where the objective is something else. Where the
    /// factor for the values has not been made, it is a solve that keeps the integers.
    ///
    /// # Errors
    /// The errors of [`solve_with`](crate::solve_with).
    pub(crate) fn follow(&mut self, options: &Options, mut monitor: Monitor) -> Result<Solution> {
        let _memory = watch_memory(self.problem.size());
        let found = with_threads(options.threads, || match &self.earlier {
            Some(_) if !self.problem.is_limited() => {
                self.prepare(options, &mut monitor)?.follow(&mut monitor)
            }
            _ => Ok(None),
        })?;
        if let Some(solution) = found {
            self.earlier = Some(solution.values().to_vec());
            return Ok(solution);
        }
        let keep = Options {
            warm_start: WarmStart::Keep,
            ..options.clone()
        };
        self.solve_with(&keep, monitor)
    }

    /// Solves the current problem under further rows between integers, which this solve keeps where it can.
    /// It uses the elimination and the factors of the problem without them. The bound is that of the
    /// relaxation without the rows.
    ///
    /// # Errors
    /// The errors of [`solve_with`](crate::solve_with).
    pub(crate) fn solve_softly(
        &mut self,
        rows: &[SoftRow],
        options: &Options,
        mut monitor: Monitor,
    ) -> Result<Solution> {
        let _memory = watch_memory(self.problem.size());
        with_threads(options.threads, || {
            let eliminated = self.prepare(options, &mut monitor)?;
            match solve_softly(eliminated, rows, options, &mut monitor)? {
                Some(solution) => Ok(solution),
                None => self.solve_with_springs(rows, options, monitor),
            }
        })
    }

    /// [`solve_softly`](Self::solve_softly) for more integers than that solves for: every row is a spring in the objective.
    pub(super) fn solve_with_springs(
        &mut self,
        rows: &[SoftRow],
        options: &Options,
        monitor: Monitor,
    ) -> Result<Solution> {
        let relaxed = Options {
            strategy: Strategy::Relax,
            ..options.clone()
        };
        let lower_bound = self.solve_with(&relaxed, monitor.silent())?.lower_bound;
        let mut problem = self.problem.clone();
        for row in rows {
            let (indices, coefficients): (Vec<_>, Vec<_>) = row.terms.iter().copied().unzip();
            problem.add_least_squares(&indices, &coefficients, row.least, 0.5 * row.weight)?;
        }
        let decided = match options.strategy {
            // The optimum with springs proves nothing.
            Strategy::Exact => Strategy::Auto,
            strategy => strategy,
        };
        let options = Options {
            strategy: decided,
            ..options.clone()
        };
        let mut solution = solve_with(&problem, &options, monitor)?;
        // The rows depend on integers alone, for which the other unknowns are the best without them as well.
        solution.energy = verify(&self.problem, &solution.values)?.energy;
        solution.lower_bound = lower_bound;
        solution.complete = false;
        solution.status = SolveStatus::unproved(solution.stopped_by);
        Ok(solution)
    }

    /// Solves the current problem, which has inequalities or bounds.
    fn solve_limited(&mut self, options: &Options, monitor: &mut Monitor) -> Result<Solution> {
        monitor.start(options.time_limit);
        monitor.check()?;
        self.refresh()?;
        tell_of_ignored_hint(&self.model, monitor);
        let earlier = self.earlier.as_deref().unwrap_or(self.model.guess());
        solve_limited(&self.problem, &self.model, options, earlier, None, monitor)
    }

    /// Makes the model that of the current problem.
    fn refresh(&mut self) -> Result<()> {
        if self.stale {
            self.model = self.model.with_data_of(&self.problem)?;
            self.stale = false;
        }
        Ok(())
    }

    /// The current problem with its elimination and factors, from the cache if they are still valid.
    fn prepare(
        &mut self,
        options: &Options,
        monitor: &mut Monitor,
    ) -> Result<EliminatedProblem<'_>> {
        monitor.start(options.time_limit);
        monitor.check()?;
        let _watch = monitor.watch();
        self.refresh()?;
        tell_of_ignored_hint(&self.model, monitor);
        let mut cache = match self.cache.take() {
            Some(cache) if cache.serves(&self.model, options.ordering) => cache,
            _ => Cache::new(&self.model, options.ordering, self.keeps_all, monitor)?,
        };
        cache.leave_out_pinned(&self.model);
        let cache = self.cache.insert(cache);
        if self.is_searched {
            cache.factors.expect_search();
        }
        Ok(EliminatedProblem {
            problem: &self.problem,
            model: &self.model,
            elimination: &cache.elimination,
            factors: &mut cache.factors,
            earlier: self.earlier.as_deref().unwrap_or(self.model.guess()),
        })
    }
}

impl Cache {
    fn new(
        model: &Model,
        ordering: Ordering,
        keeps_all: bool,
        monitor: &mut Monitor,
    ) -> Result<Self> {
        Ok(Cache {
            ordering,
            elimination: Elimination::new(model, ordering, monitor)?,
            pinned: pinned(model).collect(),
            factors: match keeps_all {
                true => Factors::kept(ordering),
                false => Factors::new(ordering),
            },
        })
    }

    /// Whether this elimination equals that of a solve of `model` from the start, except for the columns of
    /// pinned unknowns.
    fn serves(&self, model: &Model, ordering: Ordering) -> bool {
        let fits = |(i, pinned): (usize, bool)| {
            pinned == self.elimination.was_pinned(i) || (pinned && self.elimination.can_hold(i))
        };
        ordering == self.ordering && pinned(model).enumerate().all(fits)
    }

    /// Discards the factors if other unknowns are pinned now.
    fn leave_out_pinned(&mut self, model: &Model) {
        if !pinned(model).eq(self.pinned.iter().copied()) {
            self.pinned = pinned(model).collect();
            self.factors = self.factors.anew();
        }
    }
}

fn pinned(model: &Model) -> impl Iterator<Item = bool> + '_ {
    model.pinned().iter().map(Option::is_some)
}
