//! The change of coordinates over an edge, computed from the coordinates alone.
//!
//! By `bommes2012`, equation (6.1), the transition of an integer-grid map is a quarter turn and an integer
//! translation. Each of the two faces gives coordinates for both ends of the edge. A turn and a translation
//! map one pair to the other up to a residual. The turn with the least residual is chosen.

use crate::mesh::TriangleMesh;

/// The transition from the coordinates of an edge's first face to those of its second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    /// Quarter turns counter-clockwise, 0 to 3.
    pub quarters: u8,
    /// The difference between the turned edge and the edge in the other face.
    pub rotation_error: f64,
    /// The distance of the translation from integers.
    pub translation_error: f64,
}

/// The transition of an interior edge; `None` at the boundary.
///
/// An edge without length does not determine the turn. Of all turns that fit, the one with the translation
/// nearest to integers is taken.
pub(super) fn seen(
    mesh: &TriangleMesh,
    uv: &[[[f64; 2]; 3]],
    edge: usize,
    tolerance: f64,
) -> Option<Seen> {
    let edge = mesh.edge(edge);
    let ((i, k), (j, l)) = (edge.first, edge.second?);
    let here = [uv[i][k], uv[i][(k + 1) % 3]];
    let there = [uv[j][(l + 1) % 3], uv[j][l]];
    let turns = [0u8, 1, 2, 3].map(|quarters| {
        let turned = here.map(|point| turn(quarters, point));
        let shifts = [0, 1].map(|end| [0, 1].map(|a| there[end][a] - turned[end][a]));
        let shift = [0, 1].map(|a| 0.5 * (shifts[0][a] + shifts[1][a]));
        Seen {
            quarters,
            rotation_error: distance(shifts[0], shifts[1]),
            translation_error: shift
                .map(|x| (x - x.round()).abs())
                .into_iter()
                .fold(0.0, f64::max),
        }
    });
    let explains = |seen: &&Seen| seen.rotation_error <= tolerance;
    let by_translation = |a: &&Seen, b: &&Seen| a.translation_error.total_cmp(&b.translation_error);
    let by_rotation = |a: &&Seen, b: &&Seen| a.rotation_error.total_cmp(&b.rotation_error);
    let best = turns.iter().filter(explains).min_by(by_translation);
    best.or_else(|| turns.iter().min_by(by_rotation)).copied()
}

/// A point turned by quarters counter-clockwise about the origin.
fn turn(quarters: u8, [x, y]: [f64; 2]) -> [f64; 2] {
    [[x, y], [-y, x], [-x, -y], [y, -x]][usize::from(quarters)]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
