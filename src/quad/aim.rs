//! Aiming at a number of quads.
//!
//! A map whose gradients cannot all be what they are asked to be covers less than it should: least
//! squares shrink what they cannot fit. The relaxation is linear in the size asked for, so its area
//! says by how much to ask for more; only linear terms change, and the solver keeps its factors.

use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem, Sizing};
use crate::mesh::TriangleMesh;
use crate::monitor::Monitor;
use crate::search::{Options, Strategy};
use crate::solve::Solver;

/// No more than so many times as many are asked for.
const MOST: f64 = 2.0;

/// Asks for so many quads that the relaxation covers as many as were wanted, and gives the energy of that
/// many unit squares. Other sizes stay.
pub(super) fn aim(
    mesh: &TriangleMesh,
    problem: &mut SeamlessProblem,
    solver: &mut Solver,
    sizing: &Sizing,
    monitor: Monitor,
) -> Result<f64> {
    let options = Options {
        strategy: Strategy::Relax,
        ..Options::default()
    };
    let solution = solver.solve_with(&options, monitor)?;
    let squares = area(mesh, &problem.map(mesh, &solution)?);
    let &Sizing::Quads(wanted) = sizing else {
        return Ok(solution.energy());
    };
    let more = (wanted as f64 / squares).clamp(1.0, MOST);
    let asked = (more * wanted as f64).round() as usize;
    if asked != wanted {
        problem.resize(mesh, &Sizing::Quads(asked), solver)?;
    }
    Ok(solution.energy() / squares * wanted as f64)
}

/// How many unit squares a map covers.
fn area(mesh: &TriangleMesh, map: &SeamlessMap) -> f64 {
    let area = |face: usize| {
        let [a, b, c] = map.uv(face);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    };
    (0..mesh.face_count()).map(area).sum()
}
