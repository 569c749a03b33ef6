//! Bisection of a graph by multilevel refinement.
//!
//! The scheme is that of `karypis1998`: coarsen, grow one half from several seeds on the coarsest graph,
//! then refine from level to level. Refinement moves single nodes and keeps the best prefix of the moves
//! (`fiduccia1982`). The gains are real numbers, so a heap takes the place of the buckets.
//!
//! Balance is not a constraint but part of the measure: `(cut + some) (1 / (2 share))^balance`, where
//! `share` is that of the smaller half.

use std::collections::BinaryHeap;

use super::coarsen::Weighted;
use crate::linalg::Random;
use crate::monitor::{Stop, is_wanted};

/// Graphs of at most this many nodes are not coarsened further.
const COARSEST: usize = 48;

/// The number of halves grown on the coarsest graph.
const SEEDS: usize = 6;

/// The largest number of passes of refinement on a level.
const PASSES: usize = 5;

/// A pass ends after this many moves without an improvement.
const PATIENCE: usize = 120;

/// The least share of a half.
const LEAST_SHARE: f64 = 0.08;

/// How bisections are measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// The exponent of the imbalance.
    pub balance: f64,
}

impl Measure {
    /// The measure of a bisection with this cut. The less, the better.
    pub fn of(self, cut: f64, share: f64) -> f64 {
        match share < LEAST_SHARE {
            true => f64::INFINITY,
            false => (cut.max(0.0) + f64::MIN_POSITIVE) * (0.5 / share).powf(self.balance),
        }
    }
}

/// A bisection: by node, whether it is in the second half. All nodes are in one half if the graph has no
/// bisection with two halves of the least share.
///
/// # Errors
/// The end of the call.
pub(super) fn bisect(
    graph: &Weighted,
    measure: Measure,
    random: &mut Random,
) -> Result<Vec<bool>, Stop> {
    let total: f64 = graph.size.iter().sum();
    let mut levels: Vec<(Weighted, Vec<u32>)> = Vec::new();
    loop {
        is_wanted()?;
        let finest = levels.last().map_or(graph, |l| &l.0);
        if finest.nodes() <= COARSEST {
            break;
        }
        let (coarse, map) = finest.coarsen(total / 12.0, random);
        if coarse.nodes() * 20 > finest.nodes() * 19 {
            break;
        }
        levels.push((coarse, map));
    }
    let coarsest = levels.last().map_or(graph, |l| &l.0);
    let mut best: Option<(f64, Vec<bool>)> = None;
    for _ in 0..SEEDS {
        let mut halves = Halves::new(coarsest, grow(coarsest, total, random), measure);
        halves.refine()?;
        let value = halves.value();
        if best.as_ref().is_none_or(|b| value < b.0) {
            best = Some((value, halves.side));
        }
    }
    let mut side = best.map_or_else(Vec::new, |b| b.1);
    while let Some((_, map)) = levels.pop() {
        let finer = levels.last().map_or(graph, |l| &l.0);
        let projected = map.iter().map(|&c| side[c as usize]).collect();
        let mut halves = Halves::new(finer, projected, measure);
        halves.refine()?;
        side = halves.side;
    }
    Ok(side)
}

/// Grows the second half from a random seed by the node with the heaviest edges to it, until it has half
/// the size. It starts from another seed where a component ends.
fn grow(graph: &Weighted, total: f64, random: &mut Random) -> Vec<bool> {
    let n = graph.nodes();
    let mut side = vec![false; n];
    let mut heap: BinaryHeap<Entry> = BinaryHeap::new();
    let mut pull = vec![0.0; n];
    let (mut size, mut next) = (0.0, (random.next() % n.max(1) as u64) as usize);
    while size < 0.5 * total {
        let node = loop {
            match heap.pop() {
                Some(e) if side[e.node as usize] || e.gain != pull[e.node as usize] => {}
                Some(e) => break Some(e.node as usize),
                None => break None,
            }
        };
        let node = node.unwrap_or_else(|| {
            while side[next] {
                next = (next + 1) % n;
            }
            next
        });
        side[node] = true;
        size += graph.size[node];
        for &(j, w) in graph.row(node) {
            pull[j as usize] += w;
            heap.push(Entry {
                gain: pull[j as usize],
                node: j,
            });
        }
    }
    side
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    gain: f64,
    node: u32,
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let by_gain = self.gain.total_cmp(&other.gain);
        by_gain.then(other.node.cmp(&self.node))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

struct Halves<'a> {
    graph: &'a Weighted,
    measure: Measure,
    side: Vec<bool>,
    /// By node: how much less the cut is after its move.
    gain: Vec<f64>,
    cut: f64,
    total: f64,
    second: f64,
}

impl<'a> Halves<'a> {
    fn new(graph: &'a Weighted, side: Vec<bool>, measure: Measure) -> Self {
        let second = |i: &usize| side[*i];
        let mut halves = Halves {
            second: (0..side.len()).filter(second).map(|i| graph.size[i]).sum(),
            total: graph.size.iter().sum(),
            gain: vec![0.0; side.len()],
            cut: 0.0,
            graph,
            measure,
            side,
        };
        for i in 0..halves.side.len() {
            for &(j, w) in graph.row(i) {
                let is_cut = halves.side[i] != halves.side[j as usize];
                halves.gain[i] += if is_cut { w } else { -w };
                halves.cut += if is_cut { 0.5 * w } else { 0.0 };
            }
        }
        halves
    }

    fn share(&self, second: f64) -> f64 {
        second.min(self.total - second) / self.total
    }

    fn value(&self) -> f64 {
        self.measure.of(self.cut, self.share(self.second))
    }

    fn value_after(&self, i: usize) -> f64 {
        let size = self.graph.size[i];
        let second = match self.side[i] {
            true => self.second - size,
            false => self.second + size,
        };
        // A half that is too small is worse the smaller it is, so that refinement can mend it.
        let share = self.share(second);
        match self.measure.of(self.cut - self.gain[i], share) {
            value if value.is_finite() => value,
            _ => f64::MAX * (1.0 - share),
        }
    }

    fn refine(&mut self) -> Result<(), Stop> {
        for _ in 0..PASSES {
            is_wanted()?;
            let before = self.value();
            self.pass();
            if self.value() >= before {
                break;
            }
        }
        Ok(())
    }

    /// Moves nodes, each at most once, and takes back the moves after the best prefix.
    fn pass(&mut self) {
        let mut heaps = [BinaryHeap::new(), BinaryHeap::new()];
        for i in 0..self.side.len() {
            let row = self.graph.row(i);
            if row
                .iter()
                .any(|&(j, _)| self.side[j as usize] != self.side[i])
                || row.is_empty()
            {
                self.push(&mut heaps, i);
            }
        }
        let mut locked = vec![false; self.side.len()];
        let (mut moves, mut kept, mut best) = (Vec::new(), 0, self.value());
        while moves.len() < kept + PATIENCE {
            for (k, heap) in heaps.iter_mut().enumerate() {
                while heap.peek().is_some_and(|e: &Entry| {
                    let i = e.node as usize;
                    locked[i] || usize::from(self.side[i]) != k || e.gain != self.gain[i]
                }) {
                    heap.pop();
                }
            }
            let tops = heaps.iter().filter_map(|h| h.peek());
            let after = |e: &Entry| self.value_after(e.node as usize);
            let next = tops.min_by(|a, b| after(a).total_cmp(&after(b)));
            let Some(&Entry { node, .. }) = next else {
                break;
            };
            self.shift(node as usize);
            locked[node as usize] = true;
            moves.push(node);
            for &(j, _) in self.graph.row(node as usize) {
                if !locked[j as usize] {
                    self.push(&mut heaps, j as usize);
                }
            }
            let value = self.value();
            if value < best {
                (best, kept) = (value, moves.len());
            }
        }
        for &node in moves[kept..].iter().rev() {
            self.shift(node as usize);
        }
    }

    fn push(&self, heaps: &mut [BinaryHeap<Entry>; 2], i: usize) {
        heaps[usize::from(self.side[i])].push(Entry {
            gain: self.gain[i],
            node: i as u32,
        });
    }

    /// Moves node `i` to the other half.
    fn shift(&mut self, i: usize) {
        self.cut -= self.gain[i];
        self.gain[i] = -self.gain[i];
        self.side[i] = !self.side[i];
        let size = self.graph.size[i];
        self.second += if self.side[i] { size } else { -size };
        for &(j, w) in self.graph.row(i) {
            let is_cut = self.side[i] != self.side[j as usize];
            self.gain[j as usize] += if is_cut { 2.0 * w } else { -2.0 * w };
        }
    }
}
