//! The map size for a wanted number of quads.
//!
//! A map whose gradients cannot all be as asked covers less area than it should, because least squares
//! shrink what they cannot fit. The relaxation is linear in the size that is asked for, so its area tells
//! how much more to ask for. Only linear terms change, and the solver keeps its factors.

use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem, Sizing};
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, may_continue};
use crate::search::{Options, Strategy};
use crate::solve::Solver;

/// The most quads to ask for, as a multiple of the wanted number.
const MOST: f64 = 2.0;

/// Asks for a number of quads for which the relaxation covers as many unit squares as quads are wanted,
/// and returns the energy of a map of that many squares. Sizes other than a number of quads stay.
pub(super) fn aim(
    mesh: &TriangleMesh,
    problem: &mut SeamlessProblem,
    solver: &mut Solver,
    sizing: &Sizing,
    monitor: Monitor,
) -> Result<f64> {
    let solution = solver.solve_with(&relaxation(), monitor)?;
    may_continue()?;
    let map = problem.map(mesh, &solution)?;
    may_continue()?;
    let squares = area(mesh, &map);
    may_continue()?;
    let Some(wanted) = sizing.quads() else {
        return Ok(solution.energy());
    };
    let more = (wanted as f64 / squares).clamp(1.0, MOST);
    let asked = (more * wanted as f64).round() as usize;
    if asked != wanted {
        problem.resize(mesh, &sizing.with_quads(asked), solver)?;
    }
    Ok(solution.energy() / squares * wanted as f64)
}

/// The options of the relaxation.
pub(super) fn relaxation() -> Options {
    Options {
        strategy: Strategy::Relax,
        ..Options::default()
    }
}

/// The area of a map in unit squares.
pub(super) fn area(mesh: &TriangleMesh, map: &SeamlessMap) -> f64 {
    (0..mesh.face_count()).map(|f| squares(map.uv(f))).sum()
}

/// The number of unit squares that a triangle of a map covers; negative where it is folded.
pub(super) fn squares([a, b, c]: [[f64; 2]; 3]) -> f64 {
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
}
