//! Points of a curve inside a face, left out where the curve is almost straight: the rule of Douglas and Peucker.

use super::cut_along::Piece;
use crate::mesh::vector::{norm, sub};
use crate::mesh::{TriangleMesh, closest_on_segment};

/// The pieces of a curve without the points inside a face that are not needed to keep it within a distance. Points on
/// edges of the mesh stay.
pub(super) fn simplified(
    mesh: &TriangleMesh,
    pieces: &[Piece],
    within: impl Fn(usize) -> f64,
) -> Vec<Piece> {
    let is_one_run = |a: &Piece, b: &Piece| a.face == b.face && a.to.iter().all(|&w| w > 0.0);
    let mut kept = Vec::with_capacity(pieces.len());
    for run in pieces.chunk_by(is_one_run) {
        let mut points = vec![run[0].ends(mesh)[0]];
        points.extend(run.iter().map(|piece| piece.ends(mesh)[1]));
        let mut open = vec![[0, run.len()]];
        while let Some([first, last]) = open.pop() {
            let chord = [points[first], points[last]];
            let off = |i: usize| norm(sub(points[i], closest_on_segment(chord, points[i])));
            let farthest = (first + 1..last).max_by(|&a, &b| off(a).total_cmp(&off(b)));
            match farthest.filter(|&i| off(i) > within(run[first].face)) {
                Some(i) => open.extend([[i, last], [first, i]]),
                None => kept.push(Piece {
                    to: run[last - 1].to,
                    ..run[first]
                }),
            }
        }
    }
    kept
}
