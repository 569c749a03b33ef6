//! Short cycles: for every two edges that meet in a node, the shortest cycle through both.
//!
//! The second step of the cycle method: candidates for the basis. On the dual of a mesh these cycles are
//! the rings around the vertices, since two edges of a triangle meet at one corner. The mesh itself is not
//! needed. Cycles through the ground are candidates as well; they are the unknown parts of rings that
//! contain known nodes. Pairs of edges on a hinted cycle are skipped.

use super::cycles::Cycles;
use super::graph::{Graph, NONE};
use crate::error::Result;
use crate::monitor::may_continue_at;

/// The largest number of edges of a short cycle.
pub(super) const LONGEST: usize = 12;

/// At a node of higher degree, only this many edges are paired.
const PAIRED: usize = 8;

/// The `hinted` cycles, and the shortest cycles through the pairs of edges that no cycle contains yet.
pub(super) fn short_cycles(graph: &Graph, hinted: Cycles) -> Result<Cycles> {
    let mut search = Search {
        graph,
        cycles: hinted,
        covered: vec![0; graph.nodes()],
        seen: vec![0; graph.nodes()],
        came_by: vec![0; graph.nodes()],
        round: 0,
        queue: Vec::new(),
    };
    for k in 0..search.cycles.len() {
        may_continue_at(k)?;
        search.cover(k);
    }
    for node in 0..graph.ground() {
        may_continue_at(node as usize)?;
        let edges = graph.incident(node);
        for q in 1..edges.len().min(PAIRED) {
            for p in 0..q {
                if search.covered[node as usize] & bit(p, q) == 0 {
                    search.corner(node, edges[p], edges[q]);
                }
            }
        }
    }
    Ok(search.cycles)
}

/// The bit of an unordered pair of places.
fn bit(p: usize, q: usize) -> u64 {
    1 << (p.min(q) * PAIRED + p.max(q))
}

struct Search<'g> {
    graph: &'g Graph,
    cycles: Cycles,
    /// By node: the pairs of its edges that are on a cycle already.
    covered: Vec<u64>,
    /// By node: the last round that reached it, and the edge from which it did.
    seen: Vec<u32>,
    came_by: Vec<u32>,
    round: u32,
    /// The nodes reached, with their distances.
    queue: Vec<(u32, u32)>,
}

impl Search<'_> {
    /// Adds the shortest cycle through two edges at `node`, if it is short.
    fn corner(&mut self, node: u32, out: u32, back: u32) {
        let graph = self.graph;
        let far = |e: u32| graph.edges[e as usize].other(node);
        // Every node is near the ground, so the walk goes towards the ground and not away from it.
        let (out, back) = match far(out) == graph.ground() {
            true => (back, out),
            false => (out, back),
        };
        let (start, target) = (far(out), far(back));
        if start != target && !self.walk(node, start, target) {
            return;
        }
        let mut cycle = Vec::with_capacity(LONGEST);
        let mut at = target;
        while at != start {
            let e = self.came_by[at as usize];
            let edge = &graph.edges[e as usize];
            cycle.push((e, edge.sign_from(at)));
            at = edge.other(at);
        }
        cycle.push((out, graph.edges[out as usize].sign_from(start)));
        cycle.push((back, graph.edges[back as usize].sign_from(node)));
        self.cycles.push(cycle.into_iter());
        self.cover(self.cycles.len() - 1);
    }

    /// Breadth-first search from `start` to `target` without `node`. Returns whether it reached `target`.
    fn walk(&mut self, node: u32, start: u32, target: u32) -> bool {
        let graph = self.graph;
        self.round += 1;
        self.seen[node as usize] = self.round;
        self.seen[start as usize] = self.round;
        self.queue.clear();
        self.queue.push((start, 0));
        let mut next = 0;
        while let Some(&(at, distance)) = self.queue.get(next) {
            next += 1;
            if at == graph.ground() {
                continue;
            }
            if distance as usize + 3 > LONGEST {
                break;
            }
            for &e in graph.incident(at) {
                let to = graph.edges[e as usize].other(at);
                if self.seen[to as usize] == self.round {
                    continue;
                }
                self.seen[to as usize] = self.round;
                self.came_by[to as usize] = e;
                if to == target {
                    return true;
                }
                self.queue.push((to, distance + 1));
            }
        }
        false
    }

    /// Marks the pairs of consecutive edges of a cycle.
    fn cover(&mut self, k: usize) {
        let graph = self.graph;
        self.round += 1;
        for &(e, _) in self.cycles.get(k) {
            let edge = &graph.edges[e as usize];
            for node in [edge.tail, edge.head] {
                let at = node as usize;
                if node == graph.ground() {
                    continue;
                }
                if self.seen[at] != self.round {
                    self.seen[at] = self.round;
                    self.came_by[at] = e;
                    continue;
                }
                let edges = graph.incident(node);
                let place = |e: u32| edges.iter().take(PAIRED).position(|&other| other == e);
                if let (Some(p), Some(q)) = (place(self.came_by[at]), place(e)) {
                    self.covered[at] |= bit(p, q);
                }
                self.came_by[at] = NONE;
            }
        }
    }
}
