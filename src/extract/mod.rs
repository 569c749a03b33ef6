//! Quad extraction: the integer lines of an integer-grid map bound quads.
//!
//! The task and the order of the steps are those of `ebke2013`: make the map exact, find its integer points,
//! trace the integer lines between them, and walk around faces. The method differs in how it becomes robust.
//! Coordinates are fixed-point numbers, and parity keeps every vertex but the irregular ones off the integer
//! lines (`grid_map`), so that a line crosses edges only in their interior. The only geometric decisions are
//! the side of a vertex and the order of two crossings along an edge. All other steps (`arrangement`) are the
//! combinatorics of chords in a triangle, which is consistent for every map, even if triangles are folded or
//! collapsed. Folds appear as lines that cross twice in opposite directions. Moves that keep the topology
//! remove them (`fold_removal`) and turn the cells that remain into quads (`repair`).

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
mod manifold;
mod place;
mod quad_mesh;
mod quad_obj;
mod refined;
mod repair;
#[cfg(test)]
mod repair_tests;
mod trace;

pub use faults::QuadFaults;
pub use figures::QuadFigures;
pub use grid_map::{IntegerGridMap, RANGE, SEAM_TOLERANCE};
pub use quad_mesh::{Origin, QuadMesh};

use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, may_continue};
use crate::monitor::{Phase, span};
use arrangement::Arrangement;
use refined::Refined;

/// The quads of an integer-grid map.
///
/// The result has the orientation of the mesh. [`QuadMesh::is_conforming`] tells whether all its faces are
/// conforming quads, and [`QuadMesh::faults`] lists the faulty elements. The monitor is asked between steps.
///
/// # Errors
/// [`Error::LengthMismatch`](crate::Error::LengthMismatch) for the map of another mesh,
/// [`Error::Overflow`](crate::Error::Overflow) for a map with more crossings of edges and integer
/// lines than there are 32-bit numbers, [`Error::Cancelled`](crate::Error::Cancelled).
pub fn extract(
    mesh: &TriangleMesh,
    map: &IntegerGridMap,
    monitor: &mut Monitor,
) -> Result<QuadMesh> {
    let _span = span("extract");
    let (_watch, _memory) = (monitor.watch(), mesh.watch_memory());
    may_continue()?;
    map.check_mesh(mesh)?;
    let refined = Refined::new(mesh, map);
    may_continue()?;
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
