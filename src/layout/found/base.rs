//! The base complex: every separatrix runs straight on until it ends at an irregular vertex or the boundary.
//!
//! `bommes2011`. Where a separatrix crosses another, both go on, so that patches meet along whole sides.

use super::QuadSurface;
use super::walls::Walls;

/// The walls of the base complex.
pub(super) fn walls(surface: &QuadSurface) -> Walls<'_> {
    let mut walls = Walls::boundary(surface);
    for vertex in (0..surface.positions().len()).filter(|&v| surface.is_irregular(v)) {
        for first in surface.around(vertex) {
            // A wall that is there is the boundary, or was traced from its other end.
            let mut next = Some(first).filter(|&h| !walls.contains(h));
            while let Some(h) = next {
                walls.add(h);
                next = surface.straight(h);
            }
        }
    }
    walls
}
