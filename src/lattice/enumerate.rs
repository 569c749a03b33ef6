//! Enumeration: every lattice point closer to the target than a radius, or the closest of all.
//!
//! Schnorr and Euchner 1994, section 2, with the zig-zag order from the centre of each level and
//! the distance of the best point found as the new radius. The tree itself is in [`super::tree`].
//!
//! Why it proves: the candidates of a level come in order of their distance, so that with the
//! first one outside the radius all later ones are outside too; and one whose undecided coordinates
//! must take it outside is left out alone (see [`super::Diagonals`]). Distances are sums of squares
//! and cannot cancel; the offsets are computed near the target, where everything is small.

use super::tree::Tree;
use super::{Basis, Diagonals, Target};

/// Points are looked for that are closer than the best one by at least this part of its squared
/// distance: far above the rounding errors of a sum of squares, far below
/// what a proof is allowed to lack.
pub const NEARER: f64 = 2e-12;

/// Points that are kept at most.
pub const MOST: usize = 64;

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
    /// Steps to the points within the radius that are the closest or within the margin of it,
    /// with their squared distances, nearest first. Were they more than [`MOST`], only the closest.
    pub near: Vec<(Vec<i64>, f64)>,
    /// Nodes visited.
    pub nodes: u64,
    /// Whether the whole ball was searched.
    pub complete: bool,
    /// No lattice point but those in `near` has a smaller squared distance (up to [`NEARER`]).
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
    let mut found = Found {
        radius: limits.radius,
        margin: limits.margin,
        near: Vec::new(),
    };
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
    let mut near = found.near;
    near.retain(|(_, d)| *d <= found.radius || found.margin == 0.0);
    near.sort_by(|a, b| a.1.total_cmp(&b.1));
    Enumerated {
        near: near.into_iter().map(|(z, d)| (whole(&z), d)).collect(),
        nodes,
        complete,
        bound,
    }
}

fn whole(z: &[f64]) -> Vec<i64> {
    z.iter().map(|&v| v as i64).collect()
}

/// The best points so far.
pub(super) struct Found {
    pub radius: f64,
    margin: f64,
    near: Vec<(Vec<f64>, f64)>,
}

impl Found {
    /// Takes a point within the radius, which shrinks with it.
    #[cold]
    pub fn take(&mut self, z: &[f64], distance: f64) {
        if self.margin > 0.0 {
            self.radius = self.radius.min(distance + self.margin);
            let radius = self.radius;
            self.near.retain(|(_, d)| *d <= radius);
            self.near.push((z.to_vec(), distance));
            if self.near.len() <= MOST {
                return;
            }
            self.margin = 0.0;
        } else {
            self.near.push((z.to_vec(), distance));
        }
        // Only the closest, the first of equals.
        let closest = self.near.iter().map(|n| n.1).fold(f64::INFINITY, f64::min);
        self.near.retain(|n| n.1 == closest);
        self.near.truncate(1);
        self.radius = closest * (1.0 - NEARER);
    }
}
