//! The motorcycle graph: separatrices that stop where they meet the trail of another.
//!
//! `eppstein2008`. All start at once from the irregular vertices and advance by an edge at a time. Where
//! two arrive together at a vertex that no trail has reached, at a right angle, the one that has the other on its
//! right goes on; two that come from opposite sides stop, and so do three or four.

use super::QuadSurface;
use super::walls::Walls;

/// The walls of the motorcycle graph.
pub(super) fn walls(surface: &QuadSurface) -> Walls<'_> {
    let mut walls = Walls::boundary(surface);
    let mut is_reached: Vec<bool> = (0..surface.positions().len())
        .map(|v| surface.is_irregular(v) || surface.is_boundary(v))
        .collect();
    let irregular = (0..is_reached.len()).filter(|&v| surface.is_irregular(v));
    let starts = irregular.flat_map(|v| surface.around(v));
    let mut moving: Vec<usize> = starts.filter(|&h| !walls.contains(h)).collect();
    while !moving.is_empty() {
        moving.iter().for_each(|&h| walls.add(h));
        moving.retain(|&h| !is_reached[surface.to(h) as usize]);
        moving.sort_unstable_by_key(|&h| (surface.to(h), h));
        moving
            .iter()
            .for_each(|&h| is_reached[surface.to(h) as usize] = true);
        let arrivals = moving.chunk_by(|&a, &b| surface.to(a) == surface.to(b));
        let going_on = arrivals.filter_map(|together| surface.straight(winner(surface, together)?));
        moving = going_on.collect();
    }
    walls
}

/// The one of those that arrive at a vertex together that goes on, if one does.
fn winner(surface: &QuadSurface, together: &[usize]) -> Option<usize> {
    match *together {
        [only] => Some(only),
        [a, b] => {
            // The half-edge that arrives from the right of `h`.
            let from_right = |h: usize| surface.before(surface.twin(h));
            match (from_right(a) == b, from_right(b) == a) {
                (true, _) => Some(a),
                (_, true) => Some(b),
                _ => None,
            }
        }
        _ => None,
    }
}
