//! Labels for the flow, and moves of the integers where the flow is blocked.
//!
//! The set U of nodes from which no path with room leads to negative excess has only saturated edges to the
//! rest. If U holds excess, the energy falls by that excess when all integers of U go down by one step: each
//! edge that leaves U then has the opposite flow at its limit, that is, room. So distances to
//! negative excess, where an arc with room costs nothing and a saturated one costs one step, say at once how
//! far every node moves (`goldberg1997`: price updates; `ahuja2003`).

use super::network::Network;

const NONE: u32 = u32::MAX;

/// The labels of all nodes, and storage for their computation.
#[derive(Debug)]
pub(super) struct Labels {
    /// The number of arcs with room to the nearest negative excess, or the number of nodes.
    pub label: Vec<u32>,
    /// How many steps each node moves down.
    steps: Vec<u32>,
    order: Vec<u32>,
}

/// The result of an update.
#[derive(Debug, Clone, Copy)]
pub(super) struct Update {
    /// Whether no excess is left.
    pub done: bool,
    /// Whether integers have moved.
    pub moved: bool,
    /// Arcs scanned.
    pub work: u64,
}

impl Labels {
    /// Labels for this number of nodes.
    pub fn new(nodes: usize) -> Self {
        Labels {
            label: vec![0; nodes],
            steps: vec![0; nodes],
            order: Vec::with_capacity(nodes),
        }
    }

    /// Moves the integers so that all excess has paths, and computes the labels.
    pub fn update(&mut self, network: &mut Network) -> Update {
        let excesses = network.excess.iter().filter(|&&e| e > 0).count();
        let arcs = 2 * network.ends.len() as u64;
        let mut update = Update {
            done: excesses == 0,
            moved: false,
            work: arcs,
        };
        if update.done {
            return update;
        }
        let mut left = excesses - self.search(network);
        if left > 0 {
            update.moved = true;
            update.work += 3 * arcs;
            self.distances(network, &mut left);
            self.apply(network);
            self.search(network);
        }
        self.finish(network.nodes() as u32);
        update
    }

    /// Breadth-first search along arcs with room. Returns the number of nodes with excess that it reaches.
    fn search(&mut self, network: &Network) -> usize {
        self.label.fill(NONE);
        self.steps.fill(NONE);
        self.order.clear();
        for (i, &excess) in network.excess.iter().enumerate() {
            if excess < 0 {
                self.label[i] = 0;
                self.steps[i] = 0;
                self.order.push(i as u32);
            }
        }
        let mut left = usize::MAX;
        self.spread(network, 0, 0, &mut left);
        usize::MAX - left
    }

    /// Continues the search from place `from` of the order. Nodes that it reaches move by `steps`.
    fn spread(&mut self, network: &Network, mut from: usize, steps: u32, left: &mut usize) {
        while from < self.order.len() && *left > 0 {
            let j = self.order[from] as usize;
            for at in network.range(j) {
                let (edge, i, j_is_head) = network.arc(at);
                if self.label[i] == NONE && network.room(edge, !j_is_head) > 0 {
                    self.label[i] = self.label[j] + 1;
                    self.steps[i] = steps;
                    self.order.push(i as u32);
                    *left -= usize::from(network.excess[i] > 0);
                }
            }
            from += 1;
        }
    }

    /// The steps of the nodes that the search did not reach, until all excess has paths.
    fn distances(&mut self, network: &Network, left: &mut usize) {
        let mut steps = 0;
        let mut begin = 0;
        while *left > 0 && begin < self.order.len() {
            let end = self.order.len();
            steps += 1;
            for place in begin..end {
                let j = self.order[place] as usize;
                for at in network.range(j) {
                    let (_, i, _) = network.arc(at);
                    if self.label[i] == NONE {
                        self.label[i] = 0;
                        self.steps[i] = steps;
                        self.order.push(i as u32);
                        *left -= usize::from(network.excess[i] > 0);
                    }
                }
            }
            self.spread(network, end, steps, left);
            begin = end;
        }
        for s in &mut self.steps {
            *s = (*s).min(steps);
        }
    }

    /// Moves the integers. An edge between nodes of different steps turns its flow around.
    fn apply(&self, network: &mut Network) {
        for (edge, &[tail, head]) in network.ends.iter().enumerate() {
            if self.steps[tail as usize] != self.steps[head as usize] {
                network.flow[edge] = -network.flow[edge];
            }
        }
        for (moved, &steps) in network.moved.iter_mut().zip(&self.steps) {
            *moved -= i64::from(steps) << network.scale;
        }
    }

    fn finish(&mut self, nodes: u32) {
        for label in &mut self.label {
            *label = (*label).min(nodes);
        }
    }
}
