//! From a map's problem to a map without folds: [`solve_fold_free`], step by step.
//!
//! ```text
//! map         integers are decided
//! separation  integers are decided anew where they miss separation rows
//! untangling  folds and winding defects are removed, with the integers fixed
//! mending     integers around the few faults that remain are changed, one difference at a time: of the first map,
//!             of those that are better, and on the way back
//! next try    separation of elements farther apart; a finer map; one that is finer only around the faults of
//!             the last
//! way back    a map of the size asked for with the gradients of a finer one: the finer one tells in which order
//!             elements lie, where the relaxation has folds. One that comes back part of the way leads on
//! ```
//!
//! [`MapSolver`] keeps what later tries use again, and [`Driver::next`] decides what is tried next. Among
//! all maps with the best [`Outcome`] the coarsest is kept, and among these the first.

use std::borrow::Cow;

use super::map_solver::{MapSolver, Solved, without_long_proof};
use super::outcome::Outcome;
use crate::error::Result;
use crate::map::{ReorderedProblem, SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, Phase, Run, Stage, optional};
use crate::search::{Options, Strategy};
use crate::solve::{Solution, Solver};
use crate::untangle::{FAR, NEAR, UntangleOptions, Untangled, faulty, grow_around};

/// The factor of a refinement in the lengths of the map: about twice as many quads.
const REFINEMENT: f64 = std::f64::consts::SQRT_2;

/// The number of times that a map without folds is made finer because of winding defects.
const REFINEMENTS_TO_UNWIND: usize = 2;

/// The share of a run that its first try takes; most need no other.
const FIRST: f64 = 0.5;

/// The number of times that a map with folds is made finer around them alone.
const GRADINGS: usize = 6;

/// The number of tries for each size on the way back.
const TRIES_BACK: usize = 2;

/// The most faults of a map whose integers are changed around them: where there are more, the quads are too large.
const MENDED: usize = 20;

/// The most maps that are tried for it, and the most faces that these may have together.
const MENDINGS: usize = 24;
const FACES_OF_MENDINGS: usize = 2_000_000;

/// The passes of untangling in each of them.
const PASSES_OF_MENDING: usize = 12;

/// No further map is tried once all of them have taken so many multiplications: a minute or two.
const WORK: u64 = 150_000_000_000;

/// The most faces that untangling may visit while a finer map may be made.
const FACES_BEFORE_REFINING: usize = 500_000;

/// The same limit as a multiple of the mesh's faces. Large regions seldom unfold what small regions do
/// not, and a finer map costs less than they do.
const PASSES_BEFORE_REFINING: usize = 5;

/// A map, the solution that its integers are from, and the result of its untangling.
#[derive(Debug)]
pub struct FoldFreeMap {
    /// The solution of the problem with the separation rows. Its bound may be that without them.
    pub solution: Solution,
    /// The map after untangling.
    pub untangled: Untangled,
    /// How often the integers were decided anew.
    pub rounds: usize,
    /// How much finer the map is than asked for, in steps of the square root of two in length.
    pub refinements: usize,
    /// How often, after that, the map was made finer around its faults alone.
    pub gradings: usize,
}

impl FoldFreeMap {
    /// Less is better: fewer faults, then fewer quads.
    fn rank(&self) -> (Outcome, usize, usize) {
        let outcome = Outcome::of_map(&self.untangled);
        (outcome, self.refinements, self.gradings)
    }

    /// The same for the problem that was given, and its mesh, instead of the problem in another order.
    fn of_given(
        self,
        there: ReorderedProblem,
        mesh: &TriangleMesh,
        given: &SeamlessProblem,
    ) -> Self {
        let map = there.given_map(&self.untangled.map, mesh, given);
        let values = there.given_values(self.solution.values());
        FoldFreeMap {
            solution: self.solution.with_values(values),
            untangled: self.untangled.on_given(&there.reordered, mesh, map),
            ..self
        }
    }

    /// A map that is left as it is.
    ///
    /// # Errors
    /// [`LengthMismatch`](crate::Error::LengthMismatch) for the map of another problem or mesh.
    pub fn untouched(
        mesh: &TriangleMesh,
        problem: &SeamlessProblem,
        solution: Solution,
        map: SeamlessMap,
    ) -> Result<Self> {
        Ok(FoldFreeMap {
            untangled: Untangled::untouched(mesh, problem, map)?,
            solution,
            rounds: 0,
            refinements: 0,
            gradings: 0,
        })
    }
}

/// Solves the problem, adds the separation rows that its integers miss and solves again, at most
/// `effort.rounds` times, and untangles the map. Where few faults remain, integers around them are changed, one
/// difference at a time. If folds or winding defects still remain, the same is done with rows between elements
/// farther apart, then for a finer map, at most `effort.refinements` times, and then with smaller quads around the
/// faults alone. The best of the finer maps leads back: integers are decided anew for the size that was asked for, or
/// for the next finer ones, so that gradients are those of the finer map.
/// Among all maps with the fewest faults the coarsest is kept, and among these the first. `monitor` watches each solve
/// and each untangling.
///
/// No further map is tried once all of them have taken a budget of work, which is a minute or two; then folds may
/// remain. With [`Strategy::Auto`] a proof of optimality is tried only if it does not take long: for at most
/// fifty thousand unknowns and thirty million nodes. [`Strategy::Exact`] has no such limits. With
/// [`Strategy::Relax`] no integers are decided, and the map is that of the relaxation.
///
/// A caller who [finishes](crate::Flow::Finish) the run gets the best map so far, whose folds may remain.
///
/// A large mesh whose neighbours are far apart in memory is solved on in another order. The map and the values of the
/// solution are those of the problem and the mesh that were given.
///
/// # Errors
/// Those of [`solve`](crate::solve()) for the first solve and of [`untangle`](crate::untangle::untangle); a later
/// solve that fails because constraints contradict each other ends the rounds.
pub fn solve_fold_free<'a>(
    mesh: &TriangleMesh,
    problem: &SeamlessProblem,
    options: &Options,
    effort: &UntangleOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<FoldFreeMap> {
    let run = monitor().run();
    run.name_stage(Stage::Map);
    let in_order = {
        let _watch = monitor().of_run(&run).watch();
        ReorderedProblem::if_scattered(mesh, problem)?
    };
    let there = in_order.map(|there| -> Result<_> {
        let ordered = &there.reordered.mesh;
        let work = (WORK, &run, &monitor);
        let made = fold_free(ordered, &there.problem, options, effort, work)?;
        Ok(made.of_given(there, mesh, problem))
    });
    match there {
        Some(Ok(made)) => Ok(made),
        Some(Err(error)) if error.is_end_of_run() => Err(error),
        // The same error of the mesh as it is names an element that the caller knows.
        Some(Err(_)) | None => fold_free(mesh, problem, options, effort, (WORK, &run, &monitor)),
    }
}

/// [`solve_fold_free`] on the mesh as it is, with so much work after which no further map is tried.
fn fold_free<'a>(
    mesh: &TriangleMesh,
    problem: &SeamlessProblem,
    options: &Options,
    effort: &UntangleOptions,
    (most_work, run, monitor): (u64, &Run, &impl Fn() -> Monitor<'a>),
) -> Result<FoldFreeMap> {
    let monitor = || monitor().of_run(run);
    let options = without_long_proof(options, problem.problem().variables());
    let solver = Solver::new(problem.problem())?;
    let stated = Cow::Borrowed(problem);
    let mut driver = Driver {
        mesh,
        problem,
        effort,
        maps: MapSolver::new(mesh, stated, solver, &options, &monitor),
        monitor: &monitor,
        most_work: match options.strategy {
            Strategy::Exact => u64::MAX,
            _ => most_work,
        },
        lengths: Vec::new(),
        guide: None,
    };
    if options.strategy == Strategy::Relax {
        let relaxed = driver.maps.solve()?;
        return FoldFreeMap::untouched(mesh, problem, relaxed.solution, relaxed.map);
    }
    let mut last = Tried::default();
    let most = match effort.refinements {
        0 => 1,
        refinements => 1 + refinements + GRADINGS + TRIES_BACK * (1 + refinements),
    };
    let mut best = run.with_share(share_of(0, most), || {
        let first = driver.attempt(last.how)?;
        driver.mended(first)
    })?;
    let mut others = 0;
    while let Some(current) = driver.next(last, &best) {
        others += 1;
        let found = optional(&monitor, || {
            run.with_share(share_of(others, most), || {
                if current.is_guided {
                    return driver.guided(current, &best);
                }
                driver.resize(current, &best)?;
                let found = driver.attempt(current)?;
                match found.rank() < best.rank() {
                    true => driver.mended(found),
                    false => Ok(found),
                }
            })
        });
        let Some(found) = found? else {
            break;
        };
        last = Tried {
            how: current,
            is_best: found.rank() < best.rank(),
            faults: found.untangled.faults(),
        };
        if last.is_best {
            driver.guide = Some(driver.maps.problem().clone());
            best = found;
        }
    }
    run.end_call();
    // There is a result, whatever the caller wants.
    let _ = monitor().progress(Phase::Untangle, 1.0);
    Ok(best)
}

/// The share of the run that a try takes: the first one, or one of at most `most` others.
fn share_of(number: usize, most: usize) -> [f64; 2] {
    let end = |number: usize| match most {
        0 => 1.0,
        _ => FIRST + (1.0 - FIRST) * number.min(most) as f64 / most as f64,
    };
    match number {
        0 => [0.0, end(0)],
        _ => [end(number - 1), end(number)],
    }
}

/// How a try differs from the first: which elements are kept apart, and how much finer the map is, as a whole and
/// then around the faults.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Try {
    /// Whether elements far apart are kept apart, too.
    is_far: bool,
    refinements: usize,
    gradings: usize,
    /// Whether the map has the gradients of a finer one.
    is_guided: bool,
}

/// A try that has been made.
#[derive(Debug, Clone, Copy, Default)]
struct Tried {
    how: Try,
    /// Whether it gave the best map.
    is_best: bool,
    faults: usize,
}

/// The next try on the way back: with elements far apart kept apart, too, if few faults remain, and then with smaller
/// quads. A new guide leads back from the start.
fn back(
    Tried {
        how: last,
        is_best,
        faults,
    }: Tried,
) -> Try {
    let guided = |is_far, refinements| Try {
        is_far,
        refinements,
        gradings: 0,
        is_guided: true,
    };
    match (last.is_guided && !is_best, last.is_far || faults > MENDED) {
        (false, _) => guided(false, 0),
        (true, false) => guided(true, last.refinements),
        (true, true) => guided(false, last.refinements + 1),
    }
}

/// The data that all tries share.
struct Driver<'a, M> {
    mesh: &'a TriangleMesh,
    /// The problem for the size that is asked for.
    problem: &'a SeamlessProblem,
    effort: &'a UntangleOptions,
    maps: MapSolver<'a, M>,
    monitor: &'a M,
    /// No further map is tried once all of them have taken so many multiplications.
    most_work: u64,
    /// The factor of each face's size, once maps are made finer around faults.
    lengths: Vec<f64>,
    /// The problem of the best map, if it is not the first.
    guide: Option<SeamlessProblem>,
}

impl<'m, M: Fn() -> Monitor<'m>> Driver<'_, M> {
    /// What to try next, if there is anything.
    fn next(&self, last: Tried, best: &FoldFreeMap) -> Option<Try> {
        if self.maps.work() >= self.most_work {
            return None;
        }
        let faults = best.untangled.faults();
        let finer = match faults > 0 && !last.how.is_guided {
            true => self.finer_than(last.how, best),
            false => None,
        };
        finer.or_else(|| {
            let next = back(last);
            let is_coarser = (next.refinements, 0) < (best.refinements, best.gradings);
            (is_coarser && faults <= MENDED).then_some(next)
        })
    }

    /// A try that may have fewer faults than the last, in general because it is finer.
    fn finer_than(&self, last: Try, best: &FoldFreeMap) -> Option<Try> {
        if !last.is_far {
            return Some(Try {
                is_far: true,
                ..last
            });
        }
        if self.effort.refinements == 0 {
            return None;
        }
        let most = match best.untangled.flipped_after {
            0 => self.effort.refinements.min(REFINEMENTS_TO_UNWIND),
            _ => self.effort.refinements,
        };
        if last.gradings == 0 && last.refinements < most {
            return Some(Try {
                refinements: last.refinements + 1,
                ..last
            });
        }
        (last.gradings < GRADINGS).then_some(Try {
            refinements: best.refinements,
            gradings: last.gradings + 1,
            ..last
        })
    }

    /// The map with fewer faults, if it has few and other integers around them leave fewer.
    fn mended(&mut self, mut first: FoldFreeMap) -> Result<FoldFreeMap> {
        let is_worth_trying = (1..=MENDED).contains(&first.untangled.faults());
        if self.effort.rounds == 0 || !is_worth_trying {
            return Ok(first);
        }
        let effort = UntangleOptions {
            passes: self.effort.passes.min(PASSES_OF_MENDING),
            ..*self.effort
        };
        let most = MENDINGS.min(FACES_OF_MENDINGS / self.mesh.face_count().max(1));
        let (maps, untangled) = (&mut self.maps, &first.untangled);
        let mended = optional(self.monitor, || maps.mend(untangled, &effort, most))?;
        let (tries, better) = mended.unwrap_or_default();
        first.rounds += tries;
        if let Some((solved, untangled)) = better {
            first.solution = solved.solution;
            first.untangled = untangled;
        }
        Ok(first)
    }

    /// Changes to the size of a try.
    fn resize(&mut self, next: Try, best: &FoldFreeMap) -> Result<()> {
        let (mesh, problem) = (self.mesh, self.problem);
        let factor = REFINEMENT.powi(next.refinements as i32);
        if next.gradings == 1 {
            self.lengths = vec![factor; mesh.face_count()];
            let faults = faulty(mesh, &best.untangled);
            grow_around(mesh, problem, faults, &mut self.lengths);
        }
        self.maps.resize(|solver| match next.gradings {
            0 => problem.refined(mesh, factor, solver),
            _ => problem.graded(mesh, &self.lengths, solver),
        })
    }

    /// A map of this size with the gradients of `finer`. Where untangling removes its faults as well, it is the map with
    /// the same integers and the least energy.
    fn guided(&mut self, next: Try, finer: &FoldFreeMap) -> Result<FoldFreeMap> {
        let (mesh, problem, map) = (self.mesh, self.problem, &finer.untangled.map);
        let factor = REFINEMENT.powi(next.refinements as i32);
        let of_finer = self.guide.as_ref().unwrap_or(problem);
        self.maps
            .resize(|solver| problem.guided(mesh, factor, (of_finer, map), solver))?;
        let found = self.attempt(next)?;
        let mut found = self.mended(found)?;
        self.maps
            .resize(|solver| problem.refined(mesh, factor, solver))?;
        let unguided = self.maps.with_integers_of(&found.untangled.map)?;
        found.solution = unguided.solution;
        if found.untangled.faults() == 0 {
            let untangled = self.maps.untangle(&unguided.map, self.effort)?;
            if untangled.faults() == 0 {
                found.untangled = untangled;
            }
        }
        Ok(found)
    }

    /// A map of the current size.
    fn attempt(&mut self, current: Try) -> Result<FoldFreeMap> {
        let first = self.maps.solve()?;
        let (maps, monitor) = (&mut self.maps, self.monitor);
        let rounds = self.effort.rounds;
        let reach = if current.is_far { FAR } else { NEAR };
        let with_all = current.is_guided || current.refinements + current.gradings == 0;
        let separated = optional(monitor, || {
            maps.separate_cones(&first, reach, with_all, rounds)
        })?;
        let mut effort = *self.effort;
        if current.gradings > 0 || current.refinements < effort.refinements {
            let faces = self.mesh.face_count().max(1);
            let few = PASSES_BEFORE_REFINING + FACES_BEFORE_REFINING / faces;
            effort.passes = effort.passes.min(few);
        }
        let rounds = separated.as_ref().map_or(0, |separated| separated.rounds);
        let better = separated.and_then(|separated| separated.better);
        let Solved { solution, map } = better.unwrap_or(first);
        let untangled = match optional(monitor, || maps.untangle(&map, &effort))? {
            Some(untangled) => untangled,
            None => self.maps.untouched(map)?,
        };
        if current.gradings > 0 {
            // The next map is finer around the faults of this one.
            let faults = faulty(self.mesh, &untangled);
            grow_around(self.mesh, self.problem, faults, &mut self.lengths);
        }
        Ok(FoldFreeMap {
            untangled,
            solution,
            rounds,
            refinements: current.refinements,
            gradings: current.gradings,
        })
    }
}

#[cfg(test)]
#[path = "fold_free_tests.rs"]
mod tests;
