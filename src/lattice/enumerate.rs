//! Enumeration of the lattice points within a radius of the target, or of the closest point alone.
//!
//! This is the algorithm of `schnorr1994`, section 2, with the zig-zag order from the centre of each level.
//! The distance of the best point found becomes the new radius. The tree itself is in [`super::tree`].
//!
//! This is a proof for the following reasons. The candidates of a level come in order of their distance.
//! Once one is outside the radius, all later ones are outside too. A single candidate is also skipped if
//! the lower bound for its undecided coordinates exceeds the radius (see [`super::Diagonals`]). Distances
//! are sums of squares, so they do not cancel. Offsets are computed near the target, where all numbers are
//! small.

use super::near_points::NearPoints;
use super::tree::Tree;
use super::{Basis, Diagonals, Target};

/// The number of nodes between two calls of `stop`.
pub(super) const WATCH: u64 = 1 << 14;

/// The limits of an enumeration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The squared radius. Points at this distance or beyond are ignored.
    pub radius: f64,
    /// Points are kept if their squared distance exceeds the best one's by at most this. With 0, only the
    /// best point is kept.
    pub margin: f64,
    /// The largest number of nodes.
    pub nodes: u64,
}

/// The result of an enumeration.
#[derive(Debug, Clone, PartialEq)]
pub struct Enumerated {
    /// The steps to the closest point within the radius and to the points within the margin of it, with
    /// their squared distances, the nearest first. If there are more than
    /// [`MOST`](super::near_points::MOST), only the closest one.
    pub near: Vec<(Vec<i64>, f64)>,
    /// The number of nodes visited.
    pub nodes: u64,
    /// Whether the whole ball was searched.
    pub complete: bool,
    /// No lattice point outside `near` has a smaller squared distance (up to [`NEARER`](super::NEARER)).
    pub bound: f64,
}

/// Searches the ball around `target` for its closest lattice point, with bounds from `diagonals` if they
/// exist. From time to time, `stop` gets the number of nodes so far and says whether to end.
pub fn enumerate(
    basis: &Basis,
    target: &Target,
    diagonals: Option<&Diagonals>,
    limits: Limits,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Enumerated {
    let m = basis.rank();
    if m == 0 {
        return Enumerated {
            near: (limits.radius > 0.0)
                .then(|| (Vec::new(), 0.0))
                .into_iter()
                .collect(),
            nodes: 0,
            complete: true,
            bound: 0.0,
        };
    }
    let mut tree = Tree::new(basis, target, diagonals, limits.radius);
    let mut found = NearPoints::new(limits.radius, limits.margin);
    let mut nodes = 0;
    let mut complete = false;
    while !complete && nodes < limits.nodes && !stop(nodes) {
        let some = WATCH.min(limits.nodes - nodes);
        let (visited, end) = tree.walk(&mut found, some);
        nodes += visited;
        complete = end;
    }
    let bound = if complete {
        found.radius
    } else {
        tree.unexplored().min(found.radius)
    };
    Enumerated {
        near: (found.nearest_first().into_iter())
            .map(|(z, d)| (whole(&z), d))
            .collect(),
        nodes,
        complete,
        bound,
    }
}

pub(super) fn whole(z: &[f64]) -> Vec<i64> {
    z.iter().map(|&v| v as i64).collect()
}
