//! Enumeration: every lattice point closer to the target than a radius, or the closest of all.
//!
//! Schnorr and Euchner 1994, section 2, with the zig-zag order from the centre of each level and
//! the distance of the best point found as the new radius; the centres from cached partial sums
//! (Gama, Nguyen, Regev 2010, appendix B). With the levels r_kk^2, a node at level k costs what
//! of its partial sums changed, which is little more than one term.
//!
//! Why it proves: the candidates of a level come in order of their distance, so that with the
//! first one outside the radius all later ones are outside too. Distances are sums of squares and
//! cannot cancel; the offsets are computed near the target, where everything is small.

use super::{Basis, Target};

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

/// Searches the ball around `target` for its closest lattice point. `stop` is asked now and then,
/// with the nodes so far, whether to end.
pub fn enumerate(
    basis: &Basis,
    target: &Target,
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
    let mut tree = Tree::new(basis, target);
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
struct Found {
    radius: f64,
    margin: f64,
    near: Vec<(Vec<f64>, f64)>,
}

impl Found {
    /// Takes a point within the radius, which shrinks with it.
    #[cold]
    fn take(&mut self, z: &[f64], distance: f64) {
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

/// A path from the root, and what is known along it.
struct Tree {
    m: usize,
    /// Where the path ends: candidate `z[k]` has not been looked at yet.
    k: usize,
    /// `r_kj / r_kk`, by rows.
    mu: Vec<f64>,
    square: Vec<f64>,
    rest: Vec<f64>,
    z: Vec<f64>,
    step: Vec<f64>,
    centre: Vec<f64>,
    /// `rest - z` of the levels above.
    offset: Vec<f64>,
    /// Squared distance of the levels from here up; one more entry than levels.
    distance: Vec<f64>,
    /// Row `k`: entry j is the centre of level `k` as far as levels j and up move it.
    partial: Vec<f64>,
    /// The highest level that changed since row `k` of `partial` was computed.
    changed: Vec<usize>,
}

impl Tree {
    fn new(basis: &Basis, target: &Target) -> Self {
        let m = basis.rank();
        let mut mu = vec![0.0; m * m];
        for i in 0..m {
            for j in i + 1..m {
                mu[i * m + j] = basis.r(i, j) / basis.r(i, i);
            }
        }
        let mut tree = Tree {
            m,
            k: m - 1,
            mu,
            square: (0..m).map(|k| basis.r(k, k).powi(2)).collect(),
            rest: target.rest.clone(),
            z: vec![0.0; m],
            step: vec![0.0; m],
            centre: vec![0.0; m],
            offset: vec![0.0; m],
            distance: vec![0.0; m + 1],
            partial: vec![0.0; m * (m + 1)],
            changed: vec![m - 1; m],
        };
        for k in 0..m {
            tree.partial[k * (m + 1) + m] = target.rest[k];
        }
        tree.begin(m - 1, target.rest[m - 1]);
        tree
    }

    /// Starts level `k` at the integer nearest to its centre.
    #[inline(always)]
    fn begin(&mut self, k: usize, centre: f64) {
        // Adding and taking away 1.5 * 2^52 rounds to the nearest integer without a call.
        const ROUND: f64 = 6_755_399_441_055_744.0;
        let z = (centre + ROUND) - ROUND;
        self.centre[k] = centre;
        self.z[k] = z;
        self.step[k] = if centre < z { -1.0 } else { 1.0 };
    }

    /// The next nearest integer of level `k`.
    #[inline(always)]
    fn next(&mut self, k: usize) {
        let step = self.step[k];
        self.z[k] += step;
        self.step[k] = -step - step.signum();
    }

    /// Visits up to `nodes` nodes; returns how many, and whether the tree ended.
    fn walk(&mut self, found: &mut Found, nodes: u64) -> (u64, bool) {
        let m = self.m;
        let mut k = self.k;
        for node in 0..nodes {
            let off = self.centre[k] - self.z[k];
            let distance = self.distance[k + 1] + off * off * self.square[k];
            if distance < found.radius {
                if k > 0 {
                    self.distance[k] = distance;
                    self.offset[k] = self.rest[k] - self.z[k];
                    k -= 1;
                    let centre = self.descend(k);
                    self.begin(k, centre);
                    continue;
                }
                found.take(&self.z, distance);
                self.next(0);
                continue;
            }
            k += 1;
            if k == m {
                return (node + 1, true);
            }
            self.next(k);
            self.changed[k - 1] = self.changed[k - 1].max(k);
        }
        self.k = k;
        (nodes, false)
    }

    /// Brings the partial sums of level `k` up to date and returns its centre.
    #[inline(always)]
    fn descend(&mut self, k: usize) -> f64 {
        let m = self.m;
        let top = self.changed[k].max(k + 1);
        if k > 0 {
            self.changed[k - 1] = self.changed[k - 1].max(top);
        }
        self.changed[k] = k;
        let partial = &mut self.partial[k * (m + 1) + k + 1..k * (m + 1) + top + 2];
        let mu = &self.mu[k * m + k + 1..k * m + top + 1];
        let offset = &self.offset[k + 1..top + 1];
        let (sums, last) = partial.split_at_mut(partial.len() - 1);
        let mut sum = last[0];
        for ((s, u), d) in sums.iter_mut().zip(mu).zip(offset).rev() {
            sum += u * d;
            *s = sum;
        }
        sum
    }

    /// A lower bound on the distance of all points that were not reached: the least distance of a
    /// candidate not looked at, on any level of the path.
    fn unexplored(&self) -> f64 {
        let here =
            |k: usize, z: f64| self.distance[k + 1] + (self.centre[k] - z).powi(2) * self.square[k];
        let above = (self.k + 1..self.m).map(|k| here(k, self.z[k] + self.step[k]));
        above.fold(here(self.k, self.z[self.k]), f64::min)
    }
}
