//! The unknown to branch on.
//!
//! Pseudo-costs tell how much each side of a branching raises the bound; where they know too little, both sides are
//! solved for a few iterations instead (reliability branching, `achterberg2005`).

use super::form::Interval;
use super::node::Node;
use super::pseudo_costs::merit;
use super::tree::Tree;

/// A value this close to an integer counts as one.
const INTEGRAL: f64 = 1e-6;

/// Iterations of the dual active-set method for a child that strong branching looks at.
const PROBE: u64 = 25;

/// The largest number of unknowns that strong branching looks at in a node.
const CANDIDATES: usize = 12;

/// How a node came from its parent.
#[derive(Clone, Copy)]
pub(super) struct Branching {
    pub variable: u32,
    /// 0 for down, 1 for up.
    pub direction: usize,
    pub distance: f64,
}

impl Tree<'_, '_, '_> {
    pub fn fractional(&self, point: &[f64]) -> Vec<u32> {
        let is_fractional = |&&j: &&u32| {
            let x = point[j as usize];
            (x - x.round()).abs() > INTEGRAL
        };
        self.integers
            .iter()
            .filter(is_fractional)
            .copied()
            .collect()
    }

    /// The integers whose bounds leave a choice, where all values are integers: the one with the largest
    /// error, if any.
    pub fn undecided(&self, point: &[f64]) -> Vec<u32> {
        let free = |&&j: &&u32| !self.relaxation.solver.limits()[j as usize].is_point();
        let error = |j: u32| (point[j as usize] - point[j as usize].round()).abs();
        let free = self.integers.iter().filter(free);
        let worst = free.max_by(|&&a, &&b| error(a).total_cmp(&error(b)));
        worst.into_iter().copied().collect()
    }

    /// The unknown to branch on and its value. Strong branching may find that one side has no better point;
    /// its bound is then tightened at once, which makes the node's other child empty.
    pub fn choose(&mut self, node: &Node, fractional: &[u32], point: &[f64]) -> (u32, f64) {
        let fraction = |j: u32| point[j as usize] - point[j as usize].floor();
        let mut scored: Vec<(f64, u32)> = fractional
            .iter()
            .map(|&j| (merit(self.costs.expected(j as usize, fraction(j))), j))
            .collect();
        scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut best = scored[0];
        if fractional.len() == 1 {
            return (best.1, point[best.1 as usize]);
        }
        let mut looked = 0;
        let mut first = true;
        let state = self.relaxation.solver.state();
        let cutoff = self.cutoff();
        let base = node.bound;
        for (expected, j) in scored {
            if self.costs.is_reliable(j as usize) || self.relaxation.interior.is_some() {
                if first || expected > best.0 {
                    best = (expected, j);
                    first = false;
                }
                continue;
            }
            if looked >= CANDIDATES {
                continue;
            }
            looked += 1;
            let (v, x) = (j as usize, point[j as usize]);
            let before = self.relaxation.solver.limits()[v];
            let mut rises = [0.0; 2];
            for direction in [0, 1] {
                let child = child_limits(before, x, direction);
                if child.is_empty() {
                    rises[direction] = f64::INFINITY;
                    continue;
                }
                self.relaxation.solver.set_limits(v, child);
                let bound = self.relaxation.probe(cutoff, PROBE);
                rises[direction] = (bound - base).max(0.0);
                self.relaxation.solver.go_back(&state);
                self.relaxation.solver.set_limits(v, before);
                if rises[direction].is_finite() {
                    let distance = if direction == 0 {
                        fraction(j)
                    } else {
                        1.0 - fraction(j)
                    };
                    self.costs.record(v, direction, distance, rises[direction]);
                }
            }
            let most = if cutoff.is_finite() {
                (cutoff - base).max(0.0)
            } else {
                1e300
            };
            let merit = merit(rises.map(|r| r.min(most.min(1e100))));
            if first || merit > best.0 {
                best = (merit, j);
                first = false;
            }
        }
        (best.1, point[best.1 as usize])
    }
}

/// The integer up to which the lower child goes. An integer value stays in the lower child.
pub(super) fn floor_between(limits: Interval, value: f64) -> f64 {
    if (value - value.round()).abs() <= INTEGRAL {
        let rounded = limits.nearest(value.round());
        if rounded == limits.upper {
            rounded - 1.0
        } else {
            rounded
        }
    } else {
        value.floor()
    }
}

/// The limits below (0) or above (1) a value.
pub(super) fn child_limits(limits: Interval, value: f64, direction: usize) -> Interval {
    let floor = floor_between(limits, value);
    if direction == 0 {
        Interval {
            upper: limits.upper.min(floor),
            ..limits
        }
    } else {
        Interval {
            lower: limits.lower.max(floor + 1.0),
            ..limits
        }
    }
}
