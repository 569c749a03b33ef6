//! Enumeration: every lattice point closer to the target than a radius, or the closest of all.
//!
//! `schnorr1994`, section 2, with the zig-zag order from the centre of each level and
//! the distance of the best point found as the new radius. The tree itself is in [`super::tree`].
//!
//! Why this is a proof: the candidates of a level come in order of their distance. Once one is outside the
//! radius, all later ones are. A candidate is also skipped, alone, if the lower bound for its undecided
//! coordinates takes it outside (see [`super::Diagonals`]). Distances are sums of squares and cannot
//! cancel; offsets are computed near the target, where all numbers are small.

use super::near_points::NearPoints;
use super::tree::Tree;
use super::{Basis, Diagonals, Target};

/// Nodes between two looks at who may stop the enumeration.
const WATCH: u64 = 1 << 14;

/// How far an enumeration may go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Squared distance from which on points are not wanted.
    pub radius: f64,
    /// Squared distance beyond the best point's up to which points are kept as well: 0 where
    /// only the best one is wanted.
    pub margin: f64,
    /// Nodes to visit at most.
    pub nodes: u64,
}

/// What an enumeration found out.
#[derive(Debug, Clone, PartialEq)]
pub struct Enumerated {
    /// Steps to the points within the radius that are the closest or within the margin of it, with their
    /// squared distances, nearest first. Were they more than [`MOST`](super::near_points::MOST), only
    /// the closest.
    pub near: Vec<(Vec<i64>, f64)>,
    /// Nodes visited.
    pub nodes: u64,
    /// Whether the whole ball was searched.
    pub complete: bool,
    /// No lattice point but those in `near` has a smaller squared distance (up to [`NEARER`](super::NEARER)).
    pub bound: f64,
}

/// Searches the ball around `target` for its closest lattice point, with the help of `diagonals`
/// where there are any. `stop` is asked now and then, with the nodes so far, whether to end.
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

fn whole(z: &[f64]) -> Vec<i64> {
    z.iter().map(|&v| v as i64).collect()
}
