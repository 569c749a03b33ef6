//! From the problem to a map without folds: decide, hold apart, decide anew, untangle, refine.

use super::grading::grow_around;
use super::{Collapsed, Structure, UntangleOptions, Untangled, untangle_in};
use crate::map::solve_separated;
use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::TriangleMesh;
use crate::{Monitor, Options, Result, Solution, Solver, Strategy, solve_with};

/// By how much a refinement multiplies the lengths of the map: about twice as many quads.
const REFINEMENT: f64 = std::f64::consts::SQRT_2;

/// How often a map without folds is made finer for vertices that it goes around too often.
const REFINEMENTS_TO_UNWIND: usize = 2;

/// How often a map that keeps folds is made finer around them alone.
const GRADINGS: usize = 4;

/// Where integers still collapse cones and a finer map may be made, untangling gets this part of its
/// passes: it seldom helps.
const PART_OF_PASSES: usize = 8;

/// With [`Strategy::Auto`] a proof is tried for maps of at most so many unknowns,
const PROVED: usize = 50_000;

/// and may visit so many nodes: a map shall not wait for it.
const NODES: usize = 30_000_000;

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
    /// What the integers still collapse.
    pub collapsed: Collapsed,
}

impl FoldFreeMap {
    /// A map that nothing was done to.
    pub fn as_it_is(solution: Solution, map: SeamlessMap) -> Self {
        FoldFreeMap {
            untangled: Untangled::as_it_is(map),
            solution,
            rounds: 0,
            refinements: 0,
            gradings: 0,
            collapsed: Collapsed::default(),
        }
    }
}

/// Solves the problem, holds apart the cones that its integers collapse and solves again, at most
/// `options.rounds` times, and untangles the map. Where folds are left, or vertices that the map goes
/// around too often, the same is done for a finer map, at most `options.refinements` times, and then with
/// smaller quads around them alone; of all maps the first with the fewest of these is kept.
/// `monitor` watches each solve and each untangling.
///
/// With [`Strategy::Auto`] a proof is tried only where the map need not wait for it long: up to fifty
/// thousand unknowns, for at most thirty million nodes; [`Strategy::Exact`] is there for more. With
/// [`Strategy::Relax`] there are no integers to speak of, and the map is that of the relaxation.
///
/// # Errors
/// Those of [`solve`](crate::solve()) for the first solve and of [`untangle`](super::untangle); a later solve that fails
/// for constraints that contradict each other ends the rounds.
pub fn solve_fold_free<'a>(
    mesh: &TriangleMesh,
    problem: &SeamlessProblem,
    solver: &Options,
    options: &UntangleOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<FoldFreeMap> {
    if solver.strategy == Strategy::Relax {
        let solution = solve_with(problem.problem(), solver, monitor())?;
        let map = problem.map(mesh, &solution)?;
        return Ok(FoldFreeMap::as_it_is(solution, map));
    }
    let mut solver = solver.clone();
    if solver.strategy == Strategy::Auto {
        solver.nodes = solver.nodes.min(NODES);
        if problem.problem().variables() > PROVED {
            solver.strategy = Strategy::Lattice;
        }
    }
    let mut sizes = Sizes {
        mesh,
        solver,
        options,
        monitor,
        kept: Solver::new(problem.problem())?,
        structure: None,
    };
    let mut best = sizes.solve(problem, options.refinements)?;
    for refinements in 1..=options.refinements {
        let untangled = &best.untangled;
        let is_done = match untangled.flipped_after {
            0 => untangled.winding_defects.is_empty() || refinements > REFINEMENTS_TO_UNWIND,
            _ => false,
        };
        if is_done {
            break;
        }
        let by = REFINEMENT.powi(refinements as i32);
        let finer = problem.refined(mesh, by, &mut sizes.kept)?;
        let found = sizes.solve(&finer, options.refinements - refinements)?;
        if found.untangled.faults() < best.untangled.faults() {
            best = FoldFreeMap {
                refinements,
                ..found
            };
        }
    }
    if options.refinements > 0 {
        sizes.grade(problem, best)
    } else {
        Ok(best)
    }
}

/// What the maps of one problem have in common, whatever their size.
struct Sizes<'s, M> {
    mesh: &'s TriangleMesh,
    solver: Options,
    options: &'s UntangleOptions,
    monitor: M,
    /// Of the problem for the size at hand.
    kept: Solver,
    /// Known once there is a map.
    structure: Option<Structure>,
}

impl<'m, M: Fn() -> Monitor<'m>> Sizes<'_, M> {
    /// The best map so far, or one that has smaller quads around its faults, if it has fewer.
    fn grade(&mut self, problem: &SeamlessProblem, mut best: FoldFreeMap) -> Result<FoldFreeMap> {
        let by = REFINEMENT.powi(best.refinements as i32);
        let mut lengths = vec![by; self.mesh.face_count()];
        let mut last = None;
        for gradings in 1..=GRADINGS {
            if best.untangled.faults() == 0 {
                break;
            }
            let seen = last.as_ref().unwrap_or(&best.untangled);
            grow_around(self.mesh, problem, seen, &mut lengths);
            let graded = problem.graded(self.mesh, &lengths, &mut self.kept)?;
            let found = self.solve(&graded, 1)?;
            last = Some(found.untangled.clone());
            if found.untangled.faults() < best.untangled.faults() {
                best = FoldFreeMap {
                    refinements: best.refinements,
                    gradings,
                    ..found
                };
            }
        }
        Ok(best)
    }

    /// A map of the size that the problem aims at, after which so many refinements are left.
    fn solve(&mut self, problem: &SeamlessProblem, refinements_left: usize) -> Result<FoldFreeMap> {
        let Sizes {
            mesh,
            monitor,
            kept,
            ..
        } = self;
        let solution = kept.solve_with(&self.solver, monitor())?;
        let map = problem.map(mesh, &solution)?;
        let structure = match &mut self.structure {
            Some(known) => known,
            unknown => unknown.insert(Structure::new(mesh, problem, &map, &mut monitor())?),
        };
        let held = structure.freedom.held();
        let near = problem.near_cones(mesh, &held);
        let isoline_triangles = problem.isoline_triangles(mesh, &held);
        let mut best = Decided {
            collapsed: Collapsed::find(&held, &near, &isoline_triangles, &map),
            solution,
            map,
        };
        let mut rounds = 0;
        let mut apart = problem.apart(mesh, &best.map, &best.collapsed);
        while !best.collapsed.is_empty() && rounds < self.options.rounds {
            let solved = solve_separated(kept, &mut apart, &self.solver, monitor)?;
            let Some(solution) = solved else {
                break;
            };
            rounds += 1;
            let map = problem.map(mesh, &solution)?;
            let found = Decided {
                collapsed: Collapsed::find(&held, &near, &isoline_triangles, &map),
                solution,
                map,
            };
            let before = apart.len();
            for constraint in problem.apart(mesh, &found.map, &found.collapsed) {
                if !apart.iter().any(|known| known.is_between(&constraint)) {
                    apart.push(constraint);
                }
            }
            if found.collapsed.count() < best.collapsed.count() {
                best = found;
            }
            if apart.len() == before {
                break;
            }
        }
        let mut effort = *self.options;
        if refinements_left > 0 {
            let few = PASSES_BEFORE_REFINING + FACES_BEFORE_REFINING / mesh.face_count().max(1);
            effort.passes = effort.passes.min(few);
            if !best.collapsed.is_empty() {
                effort.passes /= PART_OF_PASSES;
            }
        }
        let map = &best.map;
        Ok(FoldFreeMap {
            untangled: untangle_in(structure, mesh, problem, map, &effort, &mut monitor())?,
            solution: best.solution,
            rounds,
            refinements: 0,
            gradings: 0,
            collapsed: best.collapsed,
        })
    }
}

/// Integers, and what they collapse.
struct Decided {
    solution: Solution,
    map: SeamlessMap,
    collapsed: Collapsed,
}
