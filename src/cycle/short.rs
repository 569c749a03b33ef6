//! Short cycles: for every two edges that meet in a node, the shortest cycle through both.
//!
//! On the dual of a mesh these are the rings around vertices, found without knowing the mesh: two
//! edges of a triangle meet at one corner. Cycles through the ground are found as well; there they
//! are what is left of rings that pass known nodes. Pairs that a hinted cycle runs through are not
//! searched.

use super::cycles::Cycles;
use super::graph::{Graph, NONE};

/// A cycle of more edges is not looked for.
pub(super) const LONGEST: usize = 12;

/// At nodes of a higher degree only the first edges are paired.
const PAIRED: usize = 8;

/// `hinted`, and the shortest cycles through pairs of edges that none of these runs through.
pub(super) fn short_cycles(graph: &Graph, hinted: Cycles) -> Cycles {
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
        search.cover(k);
    }
    for node in 0..graph.ground() {
        let edges = graph.incident(node);
        for q in 1..edges.len().min(PAIRED) {
            for p in 0..q {
                if search.covered[node as usize] & bit(p, q) == 0 {
                    search.corner(node, edges[p], edges[q]);
                }
            }
        }
    }
    search.cycles
}

/// The bit of an unordered pair of places.
fn bit(p: usize, q: usize) -> u64 {
    1 << (p.min(q) * PAIRED + p.max(q))
}

struct Search<'g> {
    graph: &'g Graph,
    cycles: Cycles,
    /// By node: the pairs of its edges that a cycle already runs through.
    covered: Vec<u64>,
    /// By node: the last round that reached it, and by which edge.
    seen: Vec<u32>,
    came_by: Vec<u32>,
    round: u32,
    /// Nodes reached, with their distance.
    queue: Vec<(u32, u32)>,
}

impl Search<'_> {
    /// Adds the shortest cycle through two edges at `node`, if it is short.
    fn corner(&mut self, node: u32, out: u32, back: u32) {
        let graph = self.graph;
        let far = |e: u32| graph.edges[e as usize].other(node);
        // Everything is near the ground: walk towards it, not from it.
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

    /// Breadth first from `start` to `target` without `node`; whether it got there.
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

    /// Marks the pairs of edges that a cycle runs through.
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
