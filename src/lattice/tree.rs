//! The search tree of an enumeration, stored as the path from the root to the current node.
//!
//! Each level keeps the real minimiser of the coordinates that are undecided there. A decision moves the
//! other coordinates along a fixed direction, so a node costs one multiplication for each of them. The same
//! loop computes a lower bound on their contribution to the distance (see [`super::Diagonals`]).

use super::near_points::NearPoints;
use super::{Basis, Diagonals, Target};

/// Rows are padded to whole vectors of this length.
const LANES: usize = 8;

/// Adding and subtracting 1.5 * 2^52 rounds to the nearest integer without a function call.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// A path from the root of the tree.
pub(super) struct Tree {
    m: usize,
    stride: usize,
    /// The level at the end of the path. Its candidate `z[k]` has not been visited yet.
    k: usize,
    square: Vec<f64>,
    z: Vec<f64>,
    step: Vec<f64>,
    /// The squared distance of the levels from this one up. There is one entry more than levels.
    distance: Vec<f64>,
    /// Row `k`: the minimiser of coordinates 0 to k, given the decided coordinates above.
    minimiser: Vec<f64>,
    /// Row `k`: the direction in which coordinates 0 to k - 1 move with coordinate k.
    direction: Vec<f64>,
    /// Row `k`: the diagonal for coordinates 0 to k - 1, or nothing if there is none.
    diagonal: Vec<f64>,
    /// By level: the largest rounding error of the bound.
    slack: Vec<f64>,
}

impl Tree {
    pub fn new(basis: &Basis, target: &Target, diagonals: Option<&Diagonals>, radius: f64) -> Self {
        let m = basis.rank();
        let stride = m.div_ceil(LANES) * LANES;
        let mut direction = vec![0.0; m * stride];
        for k in 0..m {
            let row = &mut direction[k * stride..][..k];
            row.copy_from_slice(&basis.column(k)[..k]);
            for j in (0..k).rev() {
                row[j] /= basis.r(j, j);
                let own = row[j];
                let column = &basis.column(j)[..j];
                row.iter_mut().zip(column).for_each(|(x, r)| *x -= own * r);
            }
        }
        let mut tree = Tree {
            m,
            stride,
            k: m - 1,
            square: (0..m).map(|k| basis.r(k, k).powi(2)).collect(),
            z: vec![0.0; m],
            step: vec![0.0; m],
            distance: vec![0.0; m + 1],
            minimiser: vec![0.0; m * stride],
            direction,
            diagonal: Vec::new(),
            slack: Vec::new(),
        };
        tree.minimiser[(m - 1) * stride..][..m].copy_from_slice(&target.rest);
        if let Some(diagonals) = diagonals {
            tree.diagonal = vec![0.0; m * stride];
            for k in 0..m {
                tree.diagonal[k * stride..][..k].copy_from_slice(diagonals.level(k));
            }
            tree.slack = tree.rounding(basis, radius);
        }
        tree.begin(m - 1);
        tree
    }

    /// Computes the largest rounding error of the bound on each level, in advance.
    ///
    /// The error of a coordinate grows with each decision above it. It grows by the error of the direction
    /// (`higham2002`, theorem 8.5, with the growth of the triangular solve), by the error of the offset
    /// that multiplies the direction, and by the rounding of the sum.
    fn rounding(&self, basis: &Basis, radius: f64) -> Vec<f64> {
        let (m, stride) = (self.m, self.stride);
        let growth = solve_growth(basis);
        let unit = f64::EPSILON * m as f64 * (1.0 + growth);
        let mut error = vec![f64::EPSILON; m];
        let mut size = vec![1.0; m];
        let mut slack = vec![0.0; m];
        for k in (0..m).rev() {
            let offset = (radius / self.square[k]).sqrt() + error[k];
            let direction = &self.direction[k * stride..][..k];
            let diagonal = &self.diagonal[k * stride..][..k];
            for i in 0..k {
                let moves = direction[i].abs();
                size[i] += moves * offset;
                error[i] += moves * (error[k] + unit * offset) + f64::EPSILON * size[i];
            }
            let terms = diagonal.iter().zip(&error);
            slack[k] = terms.map(|(d, e)| d * (2.0 * e + e * e)).sum();
        }
        slack
    }

    /// Starts level `k` at the integer nearest to its centre.
    #[inline(always)]
    fn begin(&mut self, k: usize) {
        let centre = self.minimiser[k * self.stride + k];
        let z = (centre + ROUND) - ROUND;
        self.z[k] = z;
        self.step[k] = if centre < z { -1.0 } else { 1.0 };
    }

    /// Goes to the next nearest integer of level `k`.
    #[inline(always)]
    fn next(&mut self, k: usize) {
        let step = self.step[k];
        self.z[k] += step;
        self.step[k] = -step - step.signum();
    }

    /// Visits up to `nodes` nodes. Returns the number of nodes visited and whether the tree is finished.
    pub fn walk(&mut self, found: &mut NearPoints, nodes: u64) -> (u64, bool) {
        let mut k = self.k;
        for node in 0..nodes {
            let off = self.minimiser[k * self.stride + k] - self.z[k];
            let distance = self.distance[k + 1] + off * off * self.square[k];
            if distance < found.radius {
                if k == 0 {
                    found.take(&self.z, distance);
                    self.next(0);
                    continue;
                }
                let least = if self.diagonal.is_empty() {
                    self.descend(k, off);
                    0.0
                } else {
                    self.descend_bounded(k, off) - self.slack[k]
                };
                if distance + least >= found.radius {
                    self.next(k);
                } else {
                    self.distance[k] = distance;
                    k -= 1;
                    self.begin(k);
                }
                continue;
            }
            k += 1;
            if k == self.m {
                return (node + 1, true);
            }
            self.next(k);
        }
        self.k = k;
        (nodes, false)
    }

    /// Moves the minimiser of the coordinates below `k` for coordinate k at `off` from its own minimiser.
    #[inline(always)]
    fn descend(&mut self, k: usize, off: f64) {
        let (below, here) = self.minimiser.split_at_mut(k * self.stride);
        let to = &mut below[(k - 1) * self.stride..][..k];
        let direction = &self.direction[k * self.stride..][..k];
        for ((t, h), d) in to.iter_mut().zip(&here[..k]).zip(direction) {
            *t = h + d * off;
        }
    }

    /// The same, and returns the bound on the contribution of the coordinates below.
    #[inline(always)]
    fn descend_bounded(&mut self, k: usize, off: f64) -> f64 {
        let stride = self.stride;
        let whole = k.div_ceil(LANES) * LANES;
        let (below, here) = self.minimiser.split_at_mut(k * stride);
        let to = &mut below[(k - 1) * stride..][..whole];
        let direction = &self.direction[k * stride..][..whole];
        let diagonal = &self.diagonal[k * stride..][..whole];
        let mut sums = [0.0; LANES];
        let rows = to.chunks_exact_mut(LANES).zip(here.chunks_exact(LANES));
        let fixed = direction
            .chunks_exact(LANES)
            .zip(diagonal.chunks_exact(LANES));
        for ((to, here), (direction, diagonal)) in rows.zip(fixed) {
            for l in 0..LANES {
                let at = here[l] + direction[l] * off;
                let rest = at - ((at + ROUND) - ROUND);
                to[l] = at;
                sums[l] += diagonal[l] * (rest * rest);
            }
        }
        sums.iter().sum()
    }

    /// A lower bound on the distance of all points that were not reached: the least distance of an
    /// unvisited candidate on any level of the path.
    pub fn unexplored(&self) -> f64 {
        let here = |k: usize, z: f64| {
            let off = self.minimiser[k * self.stride + k] - z;
            self.distance[k + 1] + off * off * self.square[k]
        };
        let above = (self.k + 1..self.m).map(|k| here(k, self.z[k] + self.step[k]));
        above.fold(here(self.k, self.z[self.k]), f64::min)
    }
}

/// The largest row sum of `|R^-1| |R|`, which bounds the growth of rounding errors in a triangular solve.
fn solve_growth(basis: &Basis) -> f64 {
    let m = basis.rank();
    // x = |R^-1| |R| 1, where the inverse is bounded by that of the comparison matrix.
    let mut x = vec![0.0; m];
    for j in 0..m {
        for (x, r) in x.iter_mut().zip(basis.column(j)) {
            *x += r.abs();
        }
    }
    let mut inverse = vec![0.0; m];
    let mut growth: f64 = 0.0;
    for i in 0..m {
        // Row i of R^-1, starting at the diagonal.
        inverse[i] = 1.0 / basis.r(i, i);
        for j in i + 1..m {
            let column = basis.column(j);
            let sum: f64 = (i..j).map(|k| inverse[k] * column[k]).sum();
            inverse[j] = -sum / column[j];
        }
        let row: f64 = (i..m).map(|j| inverse[j].abs() * x[j]).sum();
        growth = growth.max(row);
    }
    growth
}
