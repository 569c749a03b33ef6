//! From the problem to a map without folds: decide, hold apart, decide anew, untangle.

use super::separate::Apart;
use super::{Collapsed, UntangleOptions, Untangled, untangle};
use crate::mesh::TriangleMesh;
use crate::quad::{SeamlessMap, SeamlessProblem};
use crate::{Error, Monitor, Options, Problem, Result, Solution, Strategy, solve_with};

/// A map, the solution that its integers are from, and what became of it.
#[derive(Debug)]
pub struct Unfolded {
    /// The solution: of the problem with the constraints that were added.
    pub solution: Solution,
    /// The map after untangling.
    pub untangled: Untangled,
    /// How often integers were decided anew.
    pub rounds: usize,
    /// What the integers still collapse.
    pub collapsed: Collapsed,
}

impl Unfolded {
    /// A map that nothing was done to.
    pub fn as_it_is(solution: Solution, map: SeamlessMap) -> Self {
        Unfolded {
            untangled: Untangled::as_it_is(map),
            solution,
            rounds: 0,
            collapsed: Collapsed::default(),
        }
    }
}

/// Solves the problem, holds apart the cones that its integers collapse and solves again, at most
/// `options.rounds` times, and untangles the map. `monitor` watches each solve and the untangling.
///
/// A round that collapses as much as the one before is the last, and not kept. With
/// [`Strategy::Relax`] there are no integers to speak of, and the map is that of the relaxation.
///
/// # Errors
/// Those of [`solve`](crate::solve) for the first solve and of [`untangle`]; a later solve that fails
/// for constraints that contradict each other ends the rounds.
pub fn solve_unfolded<'a>(
    mesh: &TriangleMesh,
    problem: &SeamlessProblem,
    solver: &Options,
    options: &UntangleOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<Unfolded> {
    let mut solution = solve_with(problem.problem(), solver, monitor())?;
    let mut map = problem.map(mesh, &solution)?;
    let mut collapsed = Collapsed::find(mesh, &map);
    let mut rounds = 0;
    if solver.strategy == Strategy::Relax {
        return Ok(Unfolded::as_it_is(solution, map));
    }
    let mut apart = Vec::new();
    while !collapsed.is_empty() && rounds < options.rounds {
        apart.extend(problem.apart(mesh, &collapsed));
        let Some(found) = solve_apart(problem.problem(), &mut apart, solver, &monitor)? else {
            break;
        };
        rounds += 1;
        let found_map = problem.map(mesh, &found)?;
        let left = Collapsed::find(mesh, &found_map);
        if left.count() >= collapsed.count() {
            break;
        }
        (solution, map, collapsed) = (found, found_map, left);
    }
    Ok(Unfolded {
        untangled: untangle(mesh, problem, &map, options, &mut monitor())?,
        solution,
        rounds,
        collapsed,
    })
}

/// Solves with constraints that hold cones apart, without those found to contradict the others.
///
/// None where what contradicts is not one of them.
fn solve_apart<'a>(
    stated: &Problem,
    apart: &mut Vec<Apart>,
    solver: &Options,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Option<Solution>> {
    loop {
        let mut problem = stated.clone();
        for constraint in apart.iter() {
            constraint.add_to(&mut problem)?;
        }
        let row = match solve_with(&problem, solver, monitor()) {
            Ok(solution) => return Ok(Some(solution)),
            Err(
                Error::Infeasible { constraint, .. } | Error::NoIntegerSolution { constraint, .. },
            ) => constraint,
            Err(error) => return Err(error),
        };
        match row.checked_sub(stated.constraints()) {
            Some(k) => drop(apart.remove(k)),
            None => match apart.pop() {
                Some(_) => {}
                None => return Ok(None),
            },
        }
    }
}
