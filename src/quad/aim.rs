//! Aiming at a number of quads.
//!
//! A map whose gradients cannot all be what they are asked to be covers less than it should: least
//! squares shrink what they cannot fit. The relaxation is linear in the size asked for, so its area
//! says by how much to ask for more; only linear terms change, and the solver keeps its factors.

use crate::map::{SeamlessMap, SeamlessProblem, Sizing};
use crate::mesh::TriangleMesh;
use crate::{Monitor, Options, Result, Solver, Strategy};

/// No more than so many times as many are asked for.
const MOST: f64 = 2.0;

/// What the relaxation is like for the size that was asked for.
pub(super) struct Relaxed {
    pub(super) energy: f64,
    /// How many unit squares it covers.
    pub(super) squares: f64,
}

/// Asks for so many quads that the relaxation covers as many as were wanted. Other sizes stay.
pub(super) fn aim(
    mesh: &TriangleMesh,
    problem: &mut SeamlessProblem,
    solver: &mut Solver,
    sizing: &Sizing,
    monitor: Monitor,
) -> Result<Relaxed> {
    let options = Options {
        strategy: Strategy::Relax,
        ..Options::default()
    };
    let solution = solver.solve_with(&options, monitor)?;
    let relaxed = Relaxed {
        energy: solution.energy(),
        squares: area(mesh, &problem.map(mesh, &solution)?),
    };
    if let &Sizing::Quads(wanted) = sizing {
        let more = (wanted as f64 / relaxed.squares).clamp(1.0, MOST);
        let asked = (more * wanted as f64).round() as usize;
        if asked != wanted {
            problem.resize(mesh, &Sizing::Quads(asked), solver)?;
        }
    }
    Ok(relaxed)
}

/// How many unit squares a map covers.
fn area(mesh: &TriangleMesh, map: &SeamlessMap) -> f64 {
    let area = |face: usize| {
        let [a, b, c] = map.uv(face);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    };
    (0..mesh.face_count()).map(area).sum()
}
