//! From a map's problem to a map without folds: [`solve_fold_free`], step by step.
//!
//! ```text
//! map         its integers decided
//! separation  cones that they collapse held apart, integers decided anew
//! untangling  folds and winding defects undone, the integers held
//! next try    a finer map, and then one that is finer around the faults of the last alone
//! ```
//!
//! [`MapSolver`] keeps what is learned on the way, [`Driver::next`] decides what is tried next, and of all
//! maps the first with the best [`Outcome`] is kept.

use std::borrow::Cow;

use super::map_solver::{MapSolver, Solved, without_long_proof};
use super::outcome::Outcome;
use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;
use crate::monitor::Monitor;
use crate::search::{Options, Strategy};
use crate::solve::{Solution, Solver};
use crate::untangle::{UntangleOptions, Untangled, grow_around};

/// By how much a refinement multiplies the lengths of the map: about twice as many quads.
const REFINEMENT: f64 = std::f64::consts::SQRT_2;

/// How often a map without folds is made finer for vertices that it goes around too often.
const REFINEMENTS_TO_UNWIND: usize = 2;

/// How often a map that keeps folds is made finer around them alone.
const GRADINGS: usize = 4;

/// Where integers still collapse cones and a finer map may be made, untangling gets this part of its
/// passes: it seldom helps.
const PART_OF_PASSES: usize = 8;

/// Where a finer map may be made, untangling may look at so many faces,
const FACES_BEFORE_REFINING: usize = 500_000;

/// and at so many times those of the mesh: what small regions do not unfold large ones seldom do, and
/// a finer map costs less than they.
const PASSES_BEFORE_REFINING: usize = 5;

/// A map, the solution that its integers are from, and what became of it.
#[derive(Debug)]
pub struct FoldFreeMap {
    /// The solution: of the problem with the constraints that were added. Its bound may be that without
    /// them.
    pub solution: Solution,
    /// The map after untangling.
    pub untangled: Untangled,
    /// How often integers were decided anew.
    pub rounds: usize,
    /// How often the map was made finer, each time by the square root of two in length.
    pub refinements: usize,
    /// How often, after that, it was made finer around its faults alone.
    pub gradings: usize,
}

impl FoldFreeMap {
    /// A map that nothing was done to.
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

/// Solves the problem, holds apart the cones that its integers collapse and solves again, at most
/// `effort.rounds` times, and untangles the map. Where folds are left, or vertices that the map goes
/// around too often, the same is done for a finer map, at most `effort.refinements` times, and then with
/// smaller quads around them alone; of all maps the first with the fewest of these is kept.
/// `monitor` watches each solve and each untangling.
///
/// With [`Strategy::Auto`] a proof is tried only where the map need not wait for it long: up to fifty
/// thousand unknowns, for at most thirty million nodes; [`Strategy::Exact`] is there for more. With
/// [`Strategy::Relax`] there are no integers to speak of, and the map is that of the relaxation.
///
/// # Errors
/// Those of [`solve`](crate::solve()) for the first solve and of [`untangle`](crate::untangle::untangle);
/// a later solve that fails for constraints that contradict each other ends the rounds.
pub fn solve_fold_free<'a>(
    mesh: &TriangleMesh,
    problem: &SeamlessProblem,
    options: &Options,
    effort: &UntangleOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<FoldFreeMap> {
    let options = without_long_proof(options, problem.problem().variables());
    let solver = Solver::new(problem.problem())?;
    let stated = Cow::Borrowed(problem);
    let mut driver = Driver {
        mesh,
        problem,
        effort,
        maps: MapSolver::new(mesh, stated, solver, &options, &monitor),
        lengths: Vec::new(),
    };
    if options.strategy == Strategy::Relax {
        let relaxed = driver.maps.solve()?;
        return FoldFreeMap::untouched(mesh, problem, relaxed.solution, relaxed.map);
    }
    let mut size = Size::default();
    let mut best = driver.attempt(size)?;
    while let Some(next) = driver.next(size, &best) {
        size = next;
        driver.resize(size, &best)?;
        let found = driver.attempt(size)?;
        if Outcome::of_map(&found.untangled) < Outcome::of_map(&best.untangled) {
            best = found;
        }
    }
    Ok(best)
}

/// How much finer a map is than asked for: so often as a whole, and then so often around its faults.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Size {
    refinements: usize,
    gradings: usize,
}

/// What all tries share.
struct Driver<'a, M> {
    mesh: &'a TriangleMesh,
    /// For the size that is asked for.
    problem: &'a SeamlessProblem,
    effort: &'a UntangleOptions,
    maps: MapSolver<'a, M>,
    /// How many times as fine each face is, once maps are finer around faults.
    lengths: Vec<f64>,
}

impl<'m, M: Fn() -> Monitor<'m>> Driver<'_, M> {
    /// The size that is tried after this one, if any.
    fn next(&self, last: Size, best: &FoldFreeMap) -> Option<Size> {
        if best.untangled.faults() == 0 || self.effort.refinements == 0 {
            return None;
        }
        let most = match best.untangled.flipped_after {
            0 => self.effort.refinements.min(REFINEMENTS_TO_UNWIND),
            _ => self.effort.refinements,
        };
        if last.gradings == 0 && last.refinements < most {
            return Some(Size {
                refinements: last.refinements + 1,
                gradings: 0,
            });
        }
        (last.gradings < GRADINGS).then_some(Size {
            refinements: best.refinements,
            gradings: last.gradings + 1,
        })
    }

    /// Goes over to a size.
    fn resize(&mut self, size: Size, best: &FoldFreeMap) -> Result<()> {
        let (mesh, problem) = (self.mesh, self.problem);
        let factor = REFINEMENT.powi(size.refinements as i32);
        if size.gradings == 1 {
            self.lengths = vec![factor; mesh.face_count()];
            grow_around(mesh, problem, &best.untangled, &mut self.lengths);
        }
        self.maps.resize(|solver| match size.gradings {
            0 => problem.refined(mesh, factor, solver),
            _ => problem.graded(mesh, &self.lengths, solver),
        })
    }

    /// A map of the size at hand.
    fn attempt(&mut self, size: Size) -> Result<FoldFreeMap> {
        let first = self.maps.solve()?;
        let separated = self.maps.separate_cones(&first, self.effort.rounds)?;
        let mut effort = *self.effort;
        if size.gradings > 0 || size.refinements < effort.refinements {
            let faces = self.mesh.face_count().max(1);
            let few = PASSES_BEFORE_REFINING + FACES_BEFORE_REFINING / faces;
            effort.passes = effort.passes.min(few);
            if separated.outcome > Outcome::default() {
                effort.passes /= PART_OF_PASSES;
            }
        }
        let Solved { solution, map } = separated.better.unwrap_or(first);
        let untangled = self.maps.untangle(&map, &effort)?;
        if size.gradings > 0 {
            // The next is to be finer around what this one has left.
            grow_around(self.mesh, self.problem, &untangled, &mut self.lengths);
        }
        Ok(FoldFreeMap {
            untangled,
            solution,
            rounds: separated.rounds,
            refinements: size.refinements,
            gradings: size.gradings,
        })
    }
}
