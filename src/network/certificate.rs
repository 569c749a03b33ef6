//! The lower bound of a dual solution of the matching, computed anew from the problem and the multipliers.
//!
//! For any perfect matching, the weight is at least `sum y - sum z (|B| - 1) / 2` if no pair violates its
//! constraint (see [`matching`](super::matching)). Units that are not in the graph get multipliers that can
//! be as negative as need be, since their halves, matched with each other, add nothing. They only need
//! `y_1 + y_2 >= -cost`, where each y is at most minus the multipliers of what it may be matched with. At a
//! vertex, that is at most `-max y` of the opposite sign, and a number `rho` for halves that add and `-rho`
//! for those that take away limits the units that are not in the graph among each other. The first unit of
//! an edge in each direction that is not in the graph decides, because costs are convex.

use super::blossoms::{Blossoms, NONE};
use super::graph::{End, Network};
use super::units::{Halved, Place, Unit, end_of, unit};

/// What a proof consists of.
pub(super) struct Proof<'a> {
    pub network: &'a Network,
    pub halved: &'a Halved,
    pub base: &'a [i64],
    pub potential: &'a [i128],
    pub y: &'a [i128],
    pub blossoms: &'a Blossoms,
}

impl Proof<'_> {
    /// The first units outside the graph that the multipliers do not exclude.
    pub fn units_wanted(&self, reach: &[[i64; 2]]) -> Vec<(u32, bool)> {
        let limits: Vec<[i128; 2]> = (0..self.halved.places.len())
            .map(|v| self.highest(v))
            .collect();
        let mut wanted = Vec::new();
        for (edge, reach) in reach.iter().enumerate() {
            for (rises, k) in [(true, reach[0]), (false, reach[1])] {
                let Some(next) = unit(self.network, self.base, edge as u32, rises, k) else {
                    continue;
                };
                if !self.is_excluded(next, &limits) {
                    wanted.push((edge as u32, rises));
                }
            }
        }
        wanted
    }

    fn is_excluded(&self, unit: Unit, limits: &[[i128; 2]]) -> bool {
        let [a, b] = [0, 1].map(|side| {
            let End { vertex, sign } = end_of(self.network, unit, side);
            limits[vertex as usize][usize::from(sign < 0)]
        });
        a + b >= -unit.cost
    }

    /// The highest multipliers at a vertex for halves outside the graph that add or take away.
    fn highest(&self, vertex: usize) -> [i128; 2] {
        let Place { halves } = &self.halved.places[vertex];
        let [adding, taking] = halves.each_ref().map(|halves| {
            let all = halves.iter().map(|h| self.y[*h as usize]);
            all.max()
        });
        if vertex == self.network.root() as usize {
            return [adding.map_or(0, |y| -y).min(0); 2];
        }
        let own = -self.potential[vertex];
        let rho = match (adding, taking) {
            (Some(a), Some(b)) if a > -b => (a - b) / 2,
            _ => own
                .max(adding.unwrap_or(own))
                .min(taking.map_or(own.max(adding.unwrap_or(own)), |b| -b)),
        };
        [
            taking.map_or(rho, |b| rho.min(-b)),
            adding.map_or(-rho, |a| (-rho).min(-a)),
        ]
    }

    /// The lower bound on the cost of all flows. None if the multipliers prove nothing.
    pub fn bound(&self) -> Option<i128> {
        let graph = &self.halved.graph;
        let nesting = Nesting::new(self.blossoms, graph.vertices());
        for (edge, &[i, j]) in graph.ends.iter().enumerate() {
            let excess = self.y[i as usize] + self.y[j as usize] - graph.weights[edge];
            // No multiplier of a blossom is negative, see below.
            if excess > 0 && excess > nesting.shared(i, j) {
                return None;
            }
        }
        let mut bound: i128 = self.network.cost(self.base);
        bound += self.halved.units.iter().map(|unit| unit.cost).sum::<i128>();
        bound += self.y.iter().sum::<i128>();
        for b in self.blossoms.all() {
            let (z, size) = (self.blossoms.z(b), self.blossoms.vertices(b).len());
            if z < 0 || size % 2 == 0 {
                return None;
            }
            bound -= z * (size as i128 / 2);
        }
        Some(bound)
    }
}

/// The nested blossoms as a forest: for each vertex and blossom its depth, and the sum of the multipliers of
/// it and of all around it.
struct Nesting<'a> {
    blossoms: &'a Blossoms,
    depth: Vec<u32>,
    sum: Vec<i128>,
}

impl<'a> Nesting<'a> {
    fn new(blossoms: &'a Blossoms, vertices: usize) -> Self {
        let mut nesting = Nesting {
            blossoms,
            depth: vec![0; blossoms.capacity()],
            sum: vec![0; blossoms.capacity()],
        };
        let all: Vec<u32> = (0..vertices as u32).chain(blossoms.all()).collect();
        for &b in &all {
            let mut chain = vec![b];
            let mut outer = blossoms.parent(b);
            // The depth of what has been visited is positive.
            while outer != NONE && nesting.depth[outer as usize] == 0 {
                chain.push(outer);
                outer = blossoms.parent(outer);
            }
            let (mut depth, mut sum) = match outer {
                NONE => (0, 0),
                _ => (nesting.depth[outer as usize], nesting.sum[outer as usize]),
            };
            for &b in chain.iter().rev() {
                depth += 1;
                sum += blossoms.z(b);
                nesting.depth[b as usize] = depth;
                nesting.sum[b as usize] = sum;
            }
        }
        nesting
    }

    /// The multipliers of all blossoms that contain both.
    fn shared(&self, mut i: u32, mut j: u32) -> i128 {
        while i != j {
            if self.depth[i as usize] < self.depth[j as usize] {
                (i, j) = (j, i);
            }
            i = self.blossoms.parent(i);
            if i == NONE {
                return 0;
            }
        }
        self.sum[i as usize]
    }
}
