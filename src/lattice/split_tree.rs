//! Enumeration with the splits of a bound: see [`super::splits`] for the notation.
//!
//! The squared distance of a point is the sum of three parts: the bound, the squared distance from the minimiser
//! of Q in the norm of Q, and `d (a'z - k) (a'z - k - 1)` for each split. None is negative. (This is the
//! reformulation of `billionnet2012`.) So the enumeration of `schnorr1994`, section 2, can use Q: its sums start
//! at the bound instead of at zero, and each split adds its part on the level that decides the last of its
//! coordinates. On every level the sum is a convex quadratic function of the coordinate decided there, so the
//! candidates come in order.
//!
//! Coordinates of points in the ball are bounded by the diagonal of the inverse Gram matrix. Other candidates
//! are left out. With these bounds, the largest rounding error of a sum is known in advance. It enlarges the
//! radius of the search, and the distances of the points found are computed from the basis.

use faer::Mat;
use faer::traits::pulp::Arch;

use super::enumerate::{Enumerated, Limits, WATCH, whole};
use super::near_points::NearPoints;
use super::splits::Splits;
use super::{Basis, Target};
use crate::linalg::with_wide_registers;

/// Sums are computed in this many parts, for vector instructions.
const LANES: usize = 8;

/// Searches the ball around `target` as [`enumerate`](super::enumerate), with `splits` for the same basis and
/// target. None if rounding errors prevent it.
pub fn enumerate_split(
    basis: &Basis,
    target: &Target,
    splits: &Splits,
    limits: Limits,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Option<Enumerated> {
    let mut tree = SplitTree::new(target, splits, limits.radius)?;
    let mut found = NearPoints::new(limits.radius, limits.margin);
    let mut nodes = 0;
    let mut complete = false;
    let arch = Arch::new();
    while !complete && nodes < limits.nodes && !stop(nodes) {
        let some = WATCH.min(limits.nodes - nodes);
        let distance = |z: &[f64]| target.distance(basis, &whole(z));
        let (visited, end) = arch.dispatch(|| tree.walk(&mut found, &distance, some));
        nodes += visited;
        complete = end;
    }
    let bound = if complete {
        found.radius
    } else {
        splits.bound.min(found.radius)
    };
    let near = found.nearest_first().into_iter();
    Some(Enumerated {
        near: near.map(|(z, d)| (whole(&z), d)).collect(),
        nodes,
        complete,
        bound,
    })
}

/// A split on the level of its lowest coordinate.
struct Part {
    multiplier: f64,
    floor: f64,
    /// The entry of the lowest coordinate.
    own: f64,
    /// The range of the others in `others` of the tree.
    others: std::ops::Range<usize>,
    /// The value of the others minus the floor, on the current path.
    rest: f64,
}

/// The path from the root of the tree to the current node.
struct SplitTree<'a> {
    n: usize,
    stride: usize,
    centre: &'a [f64],
    /// The triangular factor of the slack by rows.
    rows: Vec<f64>,
    /// What the last coordinate of the slack, which is 1, adds to each row.
    fixed: Vec<f64>,
    pivot: Vec<f64>,
    /// The curvature of the sum on each level.
    curvature: Vec<f64>,
    parts: Vec<Part>,
    others: Vec<(usize, f64)>,
    /// By level: its range in `parts`.
    first: Vec<usize>,
    /// The largest distance of a coordinate from the centre.
    reach: Vec<f64>,
    /// The largest rounding error of a sum.
    error: f64,
    k: usize,
    z: Vec<f64>,
    step: Vec<f64>,
    /// By level: the minimiser of the sum.
    least: Vec<f64>,
    /// By level: what the decided coordinates add to the row.
    above: Vec<f64>,
    /// `z - centre`.
    offset: Vec<f64>,
    sum: Vec<f64>,
}

impl<'a> SplitTree<'a> {
    fn new(target: &'a Target, splits: &Splits, radius: f64) -> Option<Self> {
        let n = target.rest.len();
        let stride = n.div_ceil(LANES) * LANES;
        // The order of elimination is that of the levels, with the constant coordinate decided first.
        let upper = upper_factor(&splits.slack)?;
        let mut rows = vec![0.0; n * stride];
        for k in 0..n {
            for j in k + 1..n {
                rows[k * stride + j] = upper[(k, j)];
            }
        }
        let reach = |i: usize| (radius * splits.inverse[i]).sqrt() * (1.0 + 1e-6) + 1e-6;
        let mut tree = SplitTree {
            n,
            stride,
            centre: &target.rest,
            rows,
            fixed: (0..n).map(|k| upper[(k, n)]).collect(),
            pivot: (0..n).map(|k| upper[(k, k)]).collect(),
            curvature: (0..n).map(|k| upper[(k, k)].powi(2)).collect(),
            parts: Vec::new(),
            others: Vec::new(),
            first: Vec::new(),
            reach: (0..n).map(reach).collect(),
            error: 0.0,
            k: n - 1,
            z: vec![0.0; n],
            step: vec![0.0; n],
            least: vec![0.0; n],
            above: vec![0.0; n],
            offset: vec![0.0; stride],
            sum: vec![0.0; n + 1],
        };
        tree.place(splits);
        tree.error = tree.rounding(splits, radius);
        tree.sum[n] = splits.constant + upper[(n, n)].powi(2);
        tree.begin(n - 1);
        Some(tree)
    }

    /// Puts each split on its level.
    fn place(&mut self, splits: &Splits) {
        for k in 0..self.n {
            self.first.push(self.parts.len());
            // The entries are in the order of coordinates.
            for split in splits.splits.iter().filter(|s| s.vector[0].0 == k) {
                let start = self.others.len();
                let entries = split.vector[1..].iter();
                self.others.extend(entries.map(|&(i, e)| (i, f64::from(e))));
                let own = f64::from(split.vector[0].1);
                self.curvature[k] += split.multiplier * own * own;
                self.parts.push(Part {
                    multiplier: split.multiplier,
                    floor: split.floor,
                    own,
                    others: start..self.others.len(),
                    rest: 0.0,
                });
            }
        }
        self.first.push(self.parts.len());
    }

    /// A bound on the rounding error of a sum: the number of operations that a rounding can pass, times the
    /// size of all terms without their signs. The factor of the slack has the error of `higham2002`, theorem
    /// 10.3, and its rows are bounded by the diagonal of G.
    fn rounding(&self, splits: &Splits, radius: f64) -> f64 {
        let terms = (self.n + self.parts.len() + 8) as f64;
        let quarters: f64 = splits.splits.iter().map(|s| 0.25 * s.multiplier).sum();
        let constant = (quarters - splits.constant).sqrt();
        let row = |i: usize| self.reach[i] * (2.0 * splits.diagonal[i]).sqrt();
        let form = constant + (0..self.n).map(row).sum::<f64>();
        let split = |s: &super::splits::Split| {
            let entry = |&(i, e): &(usize, i32)| {
                f64::from(e).abs() * (self.reach[i] + self.centre[i].abs() + 1.0)
            };
            s.multiplier * (1.0 + s.vector.iter().map(entry).sum::<f64>()).powi(2)
        };
        let products: f64 = splits.splits.iter().map(split).sum();
        16.0 * terms * f64::EPSILON * (form * form + products + radius)
    }

    /// Starts level `k` at the integer nearest to the minimiser of its sum.
    #[inline(always)]
    fn begin(&mut self, k: usize) {
        let row = &self.rows[k * self.stride..][..self.stride];
        let from = (k + 1) / LANES * LANES;
        let mut lanes = [0.0; LANES];
        let chunks = row[from..].chunks_exact(LANES);
        for (r, y) in chunks.zip(self.offset[from..].chunks_exact(LANES)) {
            for l in 0..LANES {
                lanes[l] += r[l] * y[l];
            }
        }
        let above = self.fixed[k] + lanes.iter().sum::<f64>();
        let pivot = self.pivot[k];
        let mut slope = pivot * (pivot * self.centre[k] - above);
        for part in &mut self.parts[self.first[k]..self.first[k + 1]] {
            let mut rest = -part.floor;
            for &(i, e) in &self.others[part.others.clone()] {
                rest += e * self.z[i];
            }
            part.rest = rest;
            slope += part.multiplier * part.own * (0.5 - rest);
        }
        let least = slope / self.curvature[k];
        let z = least.round();
        self.above[k] = above;
        self.least[k] = least;
        self.z[k] = z;
        self.step[k] = if least < z { -1.0 } else { 1.0 };
    }

    /// Goes to the next nearest integer of level `k`.
    #[inline(always)]
    fn next(&mut self, k: usize) {
        let step = self.step[k];
        self.z[k] += step;
        self.step[k] = -step - step.signum();
    }

    /// The sum with the candidate of level `k`.
    #[inline(always)]
    fn with_candidate(&self, k: usize) -> f64 {
        let z = self.z[k];
        let row = self.pivot[k] * (z - self.centre[k]) + self.above[k];
        let mut sum = self.sum[k + 1] + row * row;
        for part in &self.parts[self.first[k]..self.first[k + 1]] {
            let at = part.own * z + part.rest;
            sum += part.multiplier * (at * (at - 1.0));
        }
        sum
    }

    /// Visits up to `nodes` nodes. Returns the number of nodes visited and whether the tree is finished.
    #[inline(always)]
    fn walk(
        &mut self,
        found: &mut NearPoints,
        distance: &dyn Fn(&[f64]) -> f64,
        nodes: u64,
    ) -> (u64, bool) {
        let mut k = self.k;
        for node in 0..nodes {
            let offset = self.z[k] - self.centre[k];
            let away = (self.z[k] - self.least[k]).abs();
            let beyond = away > self.reach[k] + (self.least[k] - self.centre[k]).abs() + 1.0;
            let sum = self.with_candidate(k);
            if beyond || sum - self.error >= found.radius {
                k += 1;
                if k == self.n {
                    return (node + 1, true);
                }
                self.next(k);
            } else if offset.abs() > self.reach[k] {
                self.next(k);
            } else if k == 0 {
                let exact = distance(&self.z);
                if exact < found.radius {
                    found.take(&self.z, exact);
                }
                self.next(0);
            } else {
                self.offset[k] = offset;
                self.sum[k] = sum;
                k -= 1;
                self.begin(k);
            }
        }
        self.k = k;
        (nodes, false)
    }
}

/// The upper triangular U with `U'U` equal to the matrix, whose lower triangle is read.
fn upper_factor(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    let lower = with_wide_registers(|| matrix.llt(faer::Side::Lower)).ok()?;
    Some(lower.L().transpose().to_owned())
}
