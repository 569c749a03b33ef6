//! The half-integral optimum: a minimum-cost flow on the double cover of the bidirected graph.
//!
//! Each vertex v becomes v' and v'', the second with negated row. Each edge becomes two arcs, each with one
//! positive and one negative end, so the cover is an ordinary network (`edmonds1970`). The mean of an edge's
//! two arcs is the optimum of the relaxation by chords: each cost is linear between integers. Half the
//! difference of the two potentials of a vertex is its multiplier.
//!
//! The potentials start at the optimum of the continuous relaxation, approximately: coordinate ascent of its
//! dual (`bertsekas1997`). Each arc starts at its cheapest flow for these potentials. Shortest augmenting
//! paths then bring what is left over at some nodes to where it is missing (`ahuja1993`, section 14.5, with
//! unit steps). Potentials remain optimal for the arcs all the time.

use super::graph::{Edge, Network, UNITS};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Sweeps of the coordinate ascent.
const SWEEPS: usize = 400;

/// The optimum of the relaxation by chords.
#[derive(Debug)]
pub(super) struct Halves {
    /// Twice the flow of each edge.
    pub twice: Vec<i64>,
    /// The multiplier of each vertex.
    pub potential: Vec<i128>,
}

impl Halves {
    /// The flow of each edge, rounded down.
    pub fn base(&self) -> Vec<i64> {
        self.twice.iter().map(|x| x.div_euclid(2)).collect()
    }
}

#[derive(Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// No flow, not even a fractional one, as multipliers of the vertices show: whatever the flow, the sum of what
    /// they make of the demands is more than what they make of it.
    Infeasible(Vec<i128>),
    /// An edge may be without limit, or has huge values.
    Unsuited,
    Stopped,
}

struct Arc {
    edge: u32,
    plus: u32,
    minus: u32,
}

struct Cover<'a> {
    network: &'a Network,
    arcs: Vec<Arc>,
    offsets: Vec<usize>,
    incident: Vec<u32>,
    flow: Vec<i64>,
    /// Demand minus what the flow brings.
    missing: Vec<i64>,
    potential: Vec<i128>,
}

/// Finds the optimum. `ends` is told the work since it was last asked.
pub(super) fn half_integral(
    network: &Network,
    ends: &mut dyn FnMut(u64) -> bool,
) -> Result<Halves, Failure> {
    half_integral_from(network, &ascend(network), ends)
}

/// Finds the optimum from multipliers near those of it, in multiples of [`UNITS`].
pub(super) fn half_integral_from(
    network: &Network,
    first: &[i128],
    ends: &mut dyn FnMut(u64) -> bool,
) -> Result<Halves, Failure> {
    let zero = vec![0; network.demand.len()];
    let cover = Cover::new(network, first).or_else(|| Cover::new(network, &zero));
    let mut cover = cover.ok_or(Failure::Unsuited)?;
    let nodes = cover.missing.len();
    let mut distance: Vec<Option<i128>> = vec![None; nodes];
    let mut by = vec![0; nodes];
    for direction in [1, -1] {
        for source in 0..nodes as u32 {
            while cover.missing[source as usize] * direction > 0 && !cover.is_root(source) {
                let (work, closed) = cover.augment(source, direction, &mut distance, &mut by);
                if ends(work) {
                    return Err(Failure::Stopped);
                }
                if !closed.is_empty() {
                    return Err(Failure::Infeasible(cover.cut(&closed, direction)));
                }
            }
        }
    }
    let pairs = cover.flow.chunks(2);
    let potentials = cover.potential.chunks(2);
    Ok(Halves {
        twice: pairs.map(|x| x[0] + x[1]).collect(),
        potential: potentials.map(|p| (p[0] - p[1]) / 2).collect(),
    })
}

impl<'a> Cover<'a> {
    /// The cover with the cheapest flow for these multipliers, if there is one.
    fn new(network: &'a Network, potential: &[i128]) -> Option<Self> {
        let node = |vertex: u32, second: bool| 2 * vertex + u32::from(second);
        let mut arcs = Vec::with_capacity(2 * network.edges.len());
        for (edge, e) in network.edges.iter().enumerate() {
            let [a, b] = e.ends;
            for second in [false, true] {
                let first = node(a.vertex, second);
                let other = node(b.vertex, second != (a.sign == b.sign));
                let adds = (a.sign > 0) != second;
                let (plus, minus) = if adds { (first, other) } else { (other, first) };
                let edge = edge as u32;
                arcs.push(Arc { edge, plus, minus });
            }
        }
        let nodes = 2 * potential.len();
        let mut offsets = vec![0; nodes + 1];
        for arc in &arcs {
            offsets[arc.plus as usize + 1] += 1;
            offsets[arc.minus as usize + 1] += 1;
        }
        for k in 0..nodes {
            offsets[k + 1] += offsets[k];
        }
        let mut next = offsets.clone();
        let mut incident = vec![0; 2 * arcs.len()];
        for (k, arc) in arcs.iter().enumerate() {
            for end in [arc.plus, arc.minus] {
                incident[next[end as usize]] = k as u32;
                next[end as usize] += 1;
            }
        }
        let potential: Vec<i128> = potential.iter().flat_map(|p| [*p, -p]).collect();
        let mut missing: Vec<i64> = network.demand.iter().flat_map(|b| [*b, -b]).collect();
        let mut flow = Vec::with_capacity(arcs.len());
        for arc in &arcs {
            let price = potential[arc.plus as usize] - potential[arc.minus as usize];
            let x = network.edges[arc.edge as usize].minimiser(price)?;
            missing[arc.plus as usize] -= x;
            missing[arc.minus as usize] += x;
            flow.push(x);
        }
        Some(Cover {
            network,
            arcs,
            offsets,
            incident,
            flow,
            missing,
            potential,
        })
    }

    fn is_root(&self, node: u32) -> bool {
        node / 2 == self.network.root()
    }

    /// Multipliers of the vertices that show that these nodes lack flow, or have too much of it, and can get no more.
    fn cut(&self, nodes: &[u32], direction: i64) -> Vec<i128> {
        let mut multipliers = vec![0; self.network.demand.len()];
        for node in nodes {
            let sign = if node % 2 == 0 { 1 } else { -1 };
            multipliers[*node as usize / 2] += sign * i128::from(direction);
        }
        multipliers
    }

    /// Moves one unit from `source` to the nearest node that lacks it or to the root. In direction 1, the
    /// source lacks flow and the path ends where there is too much. Gives the work, and if there is no path, all nodes
    /// that can be reached.
    fn augment(
        &mut self,
        source: u32,
        direction: i64,
        distance: &mut [Option<i128>],
        by: &mut [u32],
    ) -> (u64, Vec<u32>) {
        let mut heap = BinaryHeap::new();
        let mut seen = vec![source];
        let mut work = 0;
        distance[source as usize] = Some(0);
        heap.push(Reverse((0i128, source)));
        let mut end = None;
        while let Some(Reverse((d, node))) = heap.pop() {
            if distance[node as usize] != Some(d) {
                continue;
            }
            if self.is_root(node) || self.missing[node as usize] * direction < 0 {
                end = Some((d, node));
                break;
            }
            for k in self.offsets[node as usize]..self.offsets[node as usize + 1] {
                work += 1;
                let arc = self.incident[k];
                let Some((other, cost)) = self.residual(arc, node, direction) else {
                    continue;
                };
                debug_assert!(cost >= 0);
                let own = &mut distance[other as usize];
                if own.is_none() {
                    seen.push(other);
                }
                if own.is_none_or(|own| d + cost < own) {
                    *own = Some(d + cost);
                    by[other as usize] = arc;
                    heap.push(Reverse((d + cost, other)));
                }
            }
        }
        if let Some((least, mut node)) = end {
            for &other in &seen {
                let d = distance[other as usize].unwrap_or(least).min(least);
                self.potential[other as usize] += i128::from(direction) * (least - d);
            }
            self.missing[node as usize] += direction;
            self.missing[source as usize] -= direction;
            while node != source {
                let arc = &self.arcs[by[node as usize] as usize];
                let rises = (arc.minus == node) == (direction > 0);
                self.flow[by[node as usize] as usize] += if rises { 1 } else { -1 };
                node = arc.plus + arc.minus - node;
            }
        }
        for &node in &seen {
            distance[node as usize] = None;
        }
        if end.is_some() {
            seen.clear();
        }
        (work, seen)
    }

    /// The node that an arc leads to from `node`, and the reduced cost of one step.
    fn residual(&self, arc: u32, node: u32, direction: i64) -> Option<(u32, i128)> {
        let Arc { edge, plus, minus } = self.arcs[arc as usize];
        let edge: &Edge = &self.network.edges[edge as usize];
        let x = self.flow[arc as usize];
        let price = self.potential[plus as usize] - self.potential[minus as usize];
        let other = plus + minus - node;
        if (plus == node) == (direction > 0) {
            edge.may_rise(x).then(|| (other, edge.step(x) - price))
        } else {
            edge.may_fall(x).then(|| (other, price - edge.step(x - 1)))
        }
    }
}

/// Approximate multipliers of the continuous relaxation. Nothing depends on them but the time.
fn ascend(network: &Network) -> Vec<i128> {
    let vertices = network.demand.len();
    let mut ends_of: Vec<Vec<(u32, u8)>> = vec![Vec::new(); vertices];
    for (k, e) in network.edges.iter().enumerate() {
        for (side, end) in e.ends.iter().enumerate() {
            ends_of[end.vertex as usize].push((k as u32, side as u8));
        }
    }
    let curvature: Vec<f64> = network.edges.iter().map(|e| e.curvature as f64).collect();
    let slope: Vec<f64> = network.edges.iter().map(|e| e.slope as f64).collect();
    let mut potential = vec![0.0; vertices];
    for _ in 0..SWEEPS {
        let mut largest: f64 = 0.0;
        for v in 0..vertices - 1 {
            let (mut missing, mut rate) = (network.demand[v] as f64, 0.0);
            for &(k, side) in &ends_of[v] {
                let (k, side) = (k as usize, side as usize);
                let e = &network.edges[k];
                let price: f64 = e
                    .ends
                    .iter()
                    .map(|end| f64::from(end.sign) * potential[end.vertex as usize])
                    .sum();
                let lower = e.lower.map_or(f64::NEG_INFINITY, |x| x as f64);
                let upper = e.upper.map_or(f64::INFINITY, |x| x as f64);
                if curvature[k] == 0.0 {
                    let x = if price > slope[k] { upper } else { lower };
                    missing -= f64::from(e.ends[side].sign) * if x.is_finite() { x } else { 0.0 };
                    continue;
                }
                let x = (price - slope[k]) / curvature[k];
                missing -= f64::from(e.ends[side].sign) * x.clamp(lower, upper);
                if lower < x && x < upper {
                    rate += 1.0 / curvature[k];
                }
            }
            if rate == 0.0 {
                // All edges are at bounds: the price must change to move one.
                let steepest = ends_of[v].iter().map(|(k, _)| curvature[*k as usize]);
                rate = 1.0 / steepest.fold(1.0, f64::max);
            }
            potential[v] += missing / rate;
            largest = largest.max(missing.abs());
        }
        if largest < 0.125 {
            break;
        }
    }
    let rounded = |p: &f64| (p.clamp(-1e30, 1e30)) as i128 * UNITS;
    potential.iter().map(rounded).collect()
}
