//! From the half-integral optimum to the integral one: a perfect matching of half units.
//!
//! Let x be the half-integral optimum rounded down, and `r` what it lacks at the vertices. A *unit* is a step
//! of one edge by one, up or down, from one integer to the next; its cost is the difference of the cost, so
//! the units of an edge cost more and more. Each unit has two *halves*, one for each end. A half adds one to
//! its vertex or takes one away. A set of units is a solution if the halves of its units that add at a vertex
//! can be matched with those that take away, and with |r_v| *fillers*. So a solution is a perfect matching in
//! the graph of halves and fillers: the two halves of a unit not used are matched with each other, at minus
//! the unit's cost; at each vertex, all pairs of opposite sign may be matched, at no cost. (This is the walk
//! form of the reduction of bidirected flows to matchings, `edmonds1970`, `gabow1983`.)
//!
//! The multipliers of the flow are feasible for the matching: y = -s pi - c / 2 for a half of sign s with
//! multiplier pi of its vertex, where c >= 0 is the unit's reduced cost, and y = -s pi for a filler. All pairs
//! of the halves of a unit are tight. So only the fillers start unmatched: two for each odd cycle of halves,
//! or a few more that match at no cost.
//!
//! Only units near x are in the graph. The multipliers price the others (see [`certificate`](super::certificate)):
//! those that could improve the solution are added, and the matching starts again.

use super::blossoms::NONE;
use super::certificate;
use super::flow::Halves;
use super::graph::{End, FARTHEST, Network};
use super::matching::{Graph, Matching, Stage};

/// More pairs at the vertices than this do not fit.
const MOST_PAIRS: usize = 20_000_000;

/// The halves at a vertex.
#[derive(Debug, Clone, Default)]
pub(super) struct Place {
    /// Those that add, and those that take away.
    pub halves: [Vec<u32>; 2],
}

/// A step of one edge, with the number of its first half. The second half has the next number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unit {
    pub edge: u32,
    pub rises: bool,
    pub cost: i128,
}

/// The graph of halves.
pub(super) struct Halved {
    pub units: Vec<Unit>,
    pub places: Vec<Place>,
    pub graph: Graph,
}

/// An optimal flow.
#[derive(Debug)]
pub(super) struct Optimum {
    pub x: Vec<i64>,
    /// No flow costs less.
    pub bound: i128,
}

#[derive(Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// No integral flow was found near the half-integral one.
    NotFound,
    TooLarge,
    Stopped,
}

/// Finds the integral optimum and proves it.
pub(super) fn integral(
    network: &Network,
    halves: &Halves,
    ends: &mut dyn FnMut(u64) -> bool,
) -> Result<Optimum, Failure> {
    let base = halves.base();
    if !network.fits(&base, &halves.potential) {
        return Err(Failure::TooLarge);
    }
    let missing = network.missing(&base);
    let mut reach = vec![[1i64, 1]; base.len()];
    loop {
        let halved = Halved::new(network, &base, &reach, &missing).ok_or(Failure::TooLarge)?;
        let (y, mate) = halved.start(network, halves, &missing);
        let mut matching = Matching::new(&halved.graph, y, mate);
        match matching.complete(ends) {
            Stage::Augmented => {}
            Stage::Stopped => return Err(Failure::Stopped),
            Stage::Stuck => {
                if reach.iter().flatten().any(|k| *k >= FARTHEST) {
                    return Err(Failure::NotFound);
                }
                reach.iter_mut().flatten().for_each(|k| *k *= 2);
                continue;
            }
        }
        let proof = certificate::Proof {
            network,
            halved: &halved,
            base: &base,
            potential: &halves.potential,
            y: &matching.y,
            blossoms: &matching.blossoms,
        };
        let wanted = proof.units_wanted(&reach);
        if !wanted.is_empty() {
            if reach.iter().flatten().any(|k| *k >= FARTHEST) {
                return Err(Failure::NotFound);
            }
            for (edge, rises) in wanted {
                reach[edge as usize][usize::from(!rises)] += 1;
            }
            continue;
        }
        let bound = proof.bound().ok_or(Failure::NotFound)?;
        let mut x = base;
        for (k, unit) in halved.units.iter().enumerate() {
            if matching.mate[2 * k] != k as u32 {
                x[unit.edge as usize] += if unit.rises { 1 } else { -1 };
            }
        }
        return Ok(Optimum { x, bound });
    }
}

/// The end of a unit: that of its edge, turned round if the edge falls.
pub(super) fn end_of(network: &Network, unit: Unit, side: usize) -> End {
    let End { vertex, sign } = network.edges[unit.edge as usize].ends[side];
    let sign = if unit.rises { sign } else { -sign };
    End { vertex, sign }
}

/// The unit number `k` of an edge from `base`, if the bounds allow it.
pub(super) fn unit(
    network: &Network,
    base: &[i64],
    edge: u32,
    rises: bool,
    k: i64,
) -> Option<Unit> {
    let e = &network.edges[edge as usize];
    let x = base[edge as usize];
    let cost = if rises {
        e.may_rise(x + k).then(|| e.step(x + k))?
    } else {
        e.may_fall(x - k).then(|| -e.step(x - k - 1))?
    };
    Some(Unit { edge, rises, cost })
}

impl Halved {
    fn new(network: &Network, base: &[i64], reach: &[[i64; 2]], missing: &[i64]) -> Option<Self> {
        let mut units = Vec::new();
        for (edge, reach) in reach.iter().enumerate() {
            for (rises, count) in [(true, reach[0]), (false, reach[1])] {
                units.extend((0..count).map_while(|k| unit(network, base, edge as u32, rises, k)));
            }
        }
        let mut places = vec![Place::default(); missing.len()];
        for (k, &unit) in units.iter().enumerate() {
            for side in 0..2 {
                let End { vertex, sign } = end_of(network, unit, side);
                places[vertex as usize].halves[usize::from(sign < 0)].push((2 * k + side) as u32);
            }
        }
        let mut count = 2 * units.len();
        let fillers: u64 = missing.iter().map(|r| r.unsigned_abs()).sum();
        if fillers > MOST_PAIRS as u64 {
            return None;
        }
        for (place, &missing) in places.iter_mut().zip(missing) {
            for _ in 0..missing.abs() {
                place.halves[usize::from(missing > 0)].push(count as u32);
                count += 1;
            }
        }
        let root = &mut places[network.root() as usize].halves;
        let taking = std::mem::take(&mut root[1]);
        root[0].extend(taking);
        if count % 2 == 1 {
            root[0].push(count as u32);
            count += 1;
        }
        let pairs = |place: &Place| place.halves[0].len() * place.halves[1].len();
        let at_root = root[0].len() * root[0].len() / 2;
        let count_of_pairs = places.iter().map(pairs).sum::<usize>() + at_root;
        if count_of_pairs > MOST_PAIRS {
            return None;
        }
        let mut ends: Vec<[u32; 2]> = Vec::new();
        ends.try_reserve(units.len() + count_of_pairs).ok()?;
        ends.extend((0..units.len() as u32).map(|k| [2 * k, 2 * k + 1]));
        let mut weights: Vec<i128> = units.iter().map(|unit| -unit.cost).collect();
        for place in &places {
            let [adding, taking] = &place.halves;
            let pairs = adding.iter().flat_map(|a| taking.iter().map(|b| [*a, *b]));
            ends.extend(pairs);
        }
        let root = &places[network.root() as usize].halves[0];
        for (k, a) in root.iter().enumerate() {
            let both = |b: &&u32| *a >= 2 * units.len() as u32 || *b / 2 != *a / 2;
            ends.extend(root[k + 1..].iter().filter(both).map(|b| [*a, *b]));
        }
        weights.resize(ends.len(), 0);
        let graph = Graph::new(count, ends, weights);
        Some(Halved {
            units,
            places,
            graph,
        })
    }

    /// The multipliers of the flow, and the matching of all units not used.
    fn start(&self, network: &Network, halves: &Halves, missing: &[i64]) -> (Vec<i128>, Vec<u32>) {
        let mut y = Vec::with_capacity(self.graph.vertices());
        let mut mate = Vec::with_capacity(self.graph.vertices());
        for (k, &unit) in self.units.iter().enumerate() {
            let prices = [0, 1].map(|side| {
                let End { vertex, sign } = end_of(network, unit, side);
                i128::from(sign) * halves.potential[vertex as usize]
            });
            let reduced = unit.cost - prices[0] - prices[1];
            debug_assert!(reduced >= 0 && reduced % 4 == 0);
            y.extend(prices.map(|price| -price - reduced / 2));
            mate.extend([k as u32; 2]);
        }
        for (vertex, &r) in missing.iter().enumerate() {
            for _ in 0..r.abs() {
                y.push(i128::from(r.signum()) * halves.potential[vertex]);
            }
        }
        y.resize(self.graph.vertices(), 0);
        mate.resize(self.graph.vertices(), NONE);
        (y, mate)
    }
}
