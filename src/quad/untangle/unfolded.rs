//! From the problem to a map without folds: decide, hold apart, decide anew, untangle.

use super::{Collapsed, UntangleOptions, Untangled, untangle};
use crate::mesh::TriangleMesh;
use crate::quad::{SeamlessMap, SeamlessProblem};
use crate::{Error, Monitor, Options, Result, Solution, Strategy, solve_with};

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
/// The problem keeps the constraints that were added. With [`Strategy::Relax`] there are no integers
/// to speak of, and the map is that of the relaxation.
///
/// # Errors
/// Those of [`solve`](crate::solve) for the first solve and of [`untangle`]; a later solve that fails
/// for constraints that contradict each other ends the rounds.
pub fn solve_unfolded<'a>(
    mesh: &TriangleMesh,
    problem: &mut SeamlessProblem,
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
    while !collapsed.is_empty() && rounds < options.rounds {
        let stated = problem.clone();
        problem.separate(mesh, &collapsed)?;
        solution = match solve_with(problem.problem(), solver, monitor()) {
            Ok(better) => better,
            Err(Error::Infeasible { .. } | Error::NoIntegerSolution { .. }) => {
                *problem = stated;
                break;
            }
            Err(error) => return Err(error),
        };
        rounds += 1;
        map = problem.map(mesh, &solution)?;
        collapsed = Collapsed::find(mesh, &map);
    }
    Ok(Unfolded {
        untangled: untangle(mesh, problem, &map, options, &mut monitor())?,
        solution,
        rounds,
        collapsed,
    })
}
