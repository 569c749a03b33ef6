//! Quad extraction: from an integer-grid map to the quads that its integer lines bound.
//!
//! The task, and the order of its steps, are those of Ebke, Bommes, Campen, Kobbelt 2013, "QEx:
//! robust quad mesh extraction": make the map exact, find its integer points, trace the integer
//! lines between them, walk around faces. What differs is how robustness is had. Coordinates are
//! fixed-point numbers, and every vertex but the irregular ones is kept off the integer lines by
//! parity (`grid_map`), so a line meets triangles only through the interior of edges. All that
//! is ever decided is the sign of a vertex and the order of two crossings along one edge; the rest
//! (`arrangement`) is the combinatorics of chords in a triangle, which is consistent whatever the
//! map looks like, folded and collapsed triangles included. Folds then show up as lines that cross
//! once forth and once back, and are taken out by moves that keep the topology (`unfold`).

mod arrangement;
mod chords;
mod cones;
mod crossings;
mod faces;
mod faults;
mod figures;
mod fold_removal;
mod graph;
mod grid_map;
mod place;
mod quad_mesh;
mod quad_obj;
mod refined;
mod repair;
mod trace;

pub use faults::QuadFaults;
pub use figures::QuadFigures;
pub use grid_map::{IntegerGridMap, RANGE, SEAM_TOLERANCE};
pub use quad_mesh::{Origin, QuadMesh};

use crate::mesh::TriangleMesh;
use crate::monitor::Phase;
use crate::{Monitor, Result};
use arrangement::Arrangement;
use refined::Refined;

/// The quads of an integer-grid map.
///
/// The result has the orientation of the mesh. Whether it is made of nothing but quads, and where
/// it is not, it tells itself. The monitor is asked between steps.
///
/// # Errors
/// [`Error::LengthMismatch`](crate::Error::LengthMismatch) for the map of another mesh, [`Error::Overflow`](crate::Error::Overflow) for a map with more
/// crossings of edges and integer lines than there are 32-bit numbers, [`Error::Cancelled`](crate::Error::Cancelled).
pub fn extract(
    mesh: &TriangleMesh,
    map: &IntegerGridMap,
    monitor: &mut Monitor,
) -> Result<QuadMesh> {
    map.check_mesh(mesh)?;
    let refined = Refined::new(mesh, map);
    let mut arrangement = Arrangement::new(&refined)?;
    monitor.progress(Phase::Quads, 0.2)?;
    let mut graph = trace::graph(&refined, &mut arrangement);
    monitor.progress(Phase::Quads, 0.4)?;
    let removed = fold_removal::remove_folds(&mut graph);
    let repaired = repair::repair(&mut graph);
    monitor.progress(Phase::Quads, 0.8)?;
    let mut quads = faces::quad_mesh(mesh, &refined, &graph);
    (quads.folds_removed, quads.repaired) = (removed, repaired);
    quads.folded = map.folded();
    Ok(quads)
}
