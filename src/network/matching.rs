//! Minimum-weight perfect matching in a general graph, grown from a given dual: the blossom algorithm.
//!
//! The linear program is that of `edmonds1965`, with a multiplier y of any sign for each vertex and one z >= 0
//! for each blossom (an odd set of vertices):
//!
//! ```text
//! maximise   sum_v y_v - sum_B z_B (|B| - 1) / 2
//! subject to y_i + y_j - sum_{B contains i, j} z_B <= w_ij
//! ```
//!
//! The matching and the multipliers start as the caller has them: matched edges are tight and no edge is
//! violated. Each stage (`galil1986`, section 5) grows one alternating tree from an exposed vertex. The
//! multipliers of its even (`Even`) vertices go up and those of its odd ones go down until the tree reaches
//! another exposed vertex. A heap holds the amounts at which edges get tight and odd blossoms empty. Vertices
//! outside the tree are not touched, so a stage costs what its tree costs.
//!
//! All numbers are integers. If the weights are multiples of four and the first multipliers are even, all
//! multipliers stay even. So half a slack between two even vertices of one tree is an integer.

use super::blossoms::{Blossoms, NONE};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A graph with weights.
#[derive(Debug, Default)]
pub(super) struct Graph {
    pub ends: Vec<[u32; 2]>,
    pub weights: Vec<i128>,
    offsets: Vec<usize>,
    incident: Vec<u32>,
}

impl Graph {
    pub fn new(vertices: usize, ends: Vec<[u32; 2]>, weights: Vec<i128>) -> Self {
        let mut offsets = vec![0; vertices + 1];
        for v in ends.iter().flatten() {
            offsets[*v as usize + 1] += 1;
        }
        for v in 0..vertices {
            offsets[v + 1] += offsets[v];
        }
        let mut next = offsets.clone();
        let mut incident = vec![0; 2 * ends.len()];
        for (e, v) in ends
            .iter()
            .enumerate()
            .flat_map(|(e, [a, b])| [(e, *a), (e, *b)])
        {
            incident[next[v as usize]] = e as u32;
            next[v as usize] += 1;
        }
        Graph {
            ends,
            weights,
            offsets,
            incident,
        }
    }

    pub fn vertices(&self) -> usize {
        self.offsets.len() - 1
    }

    fn other(&self, edge: u32, v: u32) -> u32 {
        let [a, b] = self.ends[edge as usize];
        if a == v { b } else { a }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Label {
    Outside,
    Even,
    Odd,
}

/// How a stage ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    Augmented,
    /// No perfect matching exists.
    Stuck,
    /// The caller asked to stop.
    Stopped,
}

/// A matching with its multipliers.
pub(super) struct Matching<'a> {
    graph: &'a Graph,
    /// The multipliers of the vertices.
    pub y: Vec<i128>,
    /// The matched edge of each vertex.
    pub mate: Vec<u32>,
    pub blossoms: Blossoms,
    label: Vec<Label>,
    /// The edge by which the tree reached an outermost blossom.
    reached_by: Vec<u32>,
    /// The growth at which the multipliers of a vertex, or of a blossom, were brought up to date.
    since: Vec<i128>,
    since_blossom: Vec<i128>,
    /// By how much the multipliers of the tree have changed in this stage.
    growth: i128,
    labelled: Vec<u32>,
    unscanned: Vec<u32>,
    events: BinaryHeap<Reverse<(i128, u32)>>,
    stamp: Vec<u32>,
    stamps: u32,
    /// Edges and vertices visited.
    pub work: u64,
}

impl<'a> Matching<'a> {
    /// `mate` names the matched edge of each vertex, or [`NONE`].
    pub fn new(graph: &'a Graph, y: Vec<i128>, mate: Vec<u32>) -> Self {
        let n = graph.vertices();
        Matching {
            graph,
            y,
            mate,
            blossoms: Blossoms::new(n),
            label: vec![Label::Outside; n],
            reached_by: vec![NONE; n],
            since: vec![0; n],
            since_blossom: vec![0; n],
            growth: 0,
            labelled: Vec::new(),
            unscanned: Vec::new(),
            events: BinaryHeap::new(),
            stamp: vec![0; n],
            stamps: 0,
            work: 0,
        }
    }

    /// Matches all vertices. `ends` is told the work since it was last asked.
    pub fn complete(&mut self, ends: &mut dyn FnMut(u64) -> bool) -> Stage {
        for root in 0..self.graph.vertices() as u32 {
            if self.mate[root as usize] == NONE {
                let stage = self.stage(root, ends);
                if stage != Stage::Augmented {
                    return stage;
                }
            }
        }
        Stage::Augmented
    }

    fn stage(&mut self, root: u32, ends: &mut dyn FnMut(u64) -> bool) -> Stage {
        self.growth = 0;
        self.events.clear();
        let mut asked = self.work;
        let top = self.blossoms.top(root);
        self.make_even(top, NONE);
        loop {
            self.scan();
            if self.work - asked > 1 << 16 {
                if ends(self.work - asked) {
                    return Stage::Stopped;
                }
                asked = self.work;
            }
            let Some(Reverse((at, event))) = self.events.pop() else {
                return Stage::Stuck;
            };
            debug_assert!(at >= self.growth);
            self.growth = at;
            match (event as usize).checked_sub(self.graph.ends.len()) {
                Some(blossom) => {
                    let b = blossom as u32;
                    if self.blossoms.is_top(b)
                        && self.label[blossom] == Label::Odd
                        && self.z(b) == 0
                    {
                        self.expand(b);
                    }
                }
                None => {
                    if self.reach(event) {
                        self.settle();
                        return if ends(self.work - asked) {
                            Stage::Stopped
                        } else {
                            Stage::Augmented
                        };
                    }
                }
            }
        }
    }

    /// Handles an edge that may have become tight. Returns whether the matching was augmented.
    fn reach(&mut self, edge: u32) -> bool {
        let [mut i, mut j] = self.graph.ends[edge as usize];
        let (mut a, mut b) = (self.blossoms.top(i), self.blossoms.top(j));
        if a == b {
            return false;
        }
        if self.label[a as usize] != Label::Even {
            (i, j, a, b) = (j, i, b, a);
        }
        if self.label[a as usize] != Label::Even || self.label[b as usize] == Label::Odd {
            return false;
        }
        if self.slack(edge) > 0 {
            self.announce(edge, b);
        } else if self.label[b as usize] == Label::Even {
            self.shrink(edge, a, b);
        } else {
            let matched = self.mate[self.blossoms.base(b) as usize];
            if matched == NONE {
                self.blossoms.rebase(self.graph, &mut self.mate, b, j);
                self.mate[j as usize] = edge;
                self.augment(i, edge);
                return true;
            }
            self.make_odd(b, edge);
            let next = self.graph.other(matched, self.blossoms.base(b));
            let next = self.blossoms.top(next);
            self.make_even(next, matched);
        }
        false
    }

    /// y_i + y_j as it is now, against the weight. Not for edges within a blossom.
    fn slack(&mut self, edge: u32) -> i128 {
        let [i, j] = self.graph.ends[edge as usize];
        self.graph.weights[edge as usize] - self.current(i) - self.current(j)
    }

    fn current(&mut self, v: u32) -> i128 {
        let top = self.blossoms.top(v) as usize;
        let grown = self.growth - self.since[v as usize];
        match self.label[top] {
            Label::Outside => self.y[v as usize],
            Label::Even => self.y[v as usize] + grown,
            Label::Odd => self.y[v as usize] - grown,
        }
    }

    fn z(&self, b: u32) -> i128 {
        let grown = self.growth - self.since_blossom[b as usize];
        match self.label[b as usize] {
            Label::Outside => self.blossoms.z(b),
            Label::Even => self.blossoms.z(b) + 2 * grown,
            Label::Odd => self.blossoms.z(b) - 2 * grown,
        }
    }

    /// Brings the multipliers of an outermost blossom up to date.
    fn flush(&mut self, b: u32) {
        let z = self.z(b);
        self.blossoms.set_z(b, z);
        self.since_blossom[b as usize] = self.growth;
        for v in self.blossoms.vertices(b) {
            self.y[v as usize] = self.current(v);
            self.since[v as usize] = self.growth;
            self.work += 1;
        }
    }

    fn set_label(&mut self, b: u32, label: Label, edge: u32) {
        self.flush(b);
        self.label[b as usize] = label;
        self.reached_by[b as usize] = edge;
        self.labelled.push(b);
    }

    fn make_even(&mut self, b: u32, edge: u32) {
        self.set_label(b, Label::Even, edge);
        let vertices = self.blossoms.vertices(b);
        self.unscanned.extend(vertices);
    }

    fn make_odd(&mut self, b: u32, edge: u32) {
        self.set_label(b, Label::Odd, edge);
        if self.blossoms.is_blossom(b) {
            let at = self.growth + self.blossoms.z(b) / 2;
            let event = self.graph.ends.len() as u32 + b;
            self.events.push(Reverse((at, event)));
        }
    }

    /// Puts an edge from an even vertex to `b` into the heap.
    fn announce(&mut self, edge: u32, b: u32) {
        let slack = self.slack(edge);
        let wait = match self.label[b as usize] {
            Label::Outside => slack,
            Label::Even => slack / 2,
            Label::Odd => return,
        };
        debug_assert!(self.label[b as usize] != Label::Even || slack % 2 == 0);
        self.events.push(Reverse((self.growth + wait, edge)));
    }

    fn scan(&mut self) {
        while let Some(v) = self.unscanned.pop() {
            let own = self.blossoms.top(v);
            for k in self.graph.offsets[v as usize]..self.graph.offsets[v as usize + 1] {
                let edge = self.graph.incident[k];
                let other = self.graph.other(edge, v);
                let b = self.blossoms.top(other);
                self.work += 1;
                if b != own {
                    self.announce(edge, b);
                }
            }
        }
    }

    /// The blossoms from an even one up to the root, each with the edge towards the root.
    fn step_up(&mut self, b: u32) -> Option<u32> {
        let edge = self.reached_by[b as usize];
        if edge == NONE {
            return None;
        }
        let [i, j] = self.graph.ends[edge as usize];
        let (first, second) = (self.blossoms.top(i), self.blossoms.top(j));
        Some(if first == b { second } else { first })
    }

    fn shrink(&mut self, edge: u32, a: u32, b: u32) {
        self.stamps += 1;
        let mut ends = [Some(a), Some(b)];
        let mut side = 0;
        let meeting = loop {
            if let Some(c) = ends[side] {
                if self.stamp[c as usize] == self.stamps {
                    break c;
                }
                self.stamp[c as usize] = self.stamps;
                ends[side] = self.step_up(c);
                self.work += 1;
            }
            side = 1 - side;
        };
        let mut paths = [Vec::new(), Vec::new()];
        for (path, start) in paths.iter_mut().zip([a, b]) {
            let mut c = start;
            while c != meeting {
                path.push((c, self.reached_by[c as usize]));
                c = self.step_up(c).unwrap_or(meeting);
            }
        }
        let [down, up] = paths;
        let mut children = vec![meeting];
        let mut links = Vec::new();
        for &(c, link) in down.iter().rev() {
            links.push(link);
            children.push(c);
        }
        links.push(edge);
        for &(c, link) in &up {
            children.push(c);
            links.push(link);
        }
        let reached_by = self.reached_by[meeting as usize];
        for &c in &children {
            let was_odd = self.label[c as usize] == Label::Odd;
            if was_odd {
                self.flush(c);
                self.label[c as usize] = Label::Even;
                let vertices = self.blossoms.vertices(c);
                self.unscanned.extend(vertices);
            } else {
                let z = self.z(c);
                self.blossoms.set_z(c, z);
            }
        }
        let new = self.blossoms.join(children, links);
        let count = self.blossoms.capacity();
        self.label.resize(count, Label::Outside);
        self.reached_by.resize(count, NONE);
        self.since_blossom.resize(count, 0);
        self.stamp.resize(count, 0);
        self.label[new as usize] = Label::Even;
        self.reached_by[new as usize] = reached_by;
        self.since_blossom[new as usize] = self.growth;
        self.labelled.push(new);
    }

    /// Opens an odd blossom whose multiplier is zero. The even part of its cycle stays in the tree.
    fn expand(&mut self, b: u32) {
        self.flush(b);
        let entry = self.reached_by[b as usize];
        let [i, j] = self.graph.ends[entry as usize];
        let inner = if self.blossoms.top(i) == b { i } else { j };
        let first = self.blossoms.child_with(b, inner);
        self.label[b as usize] = Label::Outside;
        let (children, links) = self.blossoms.open(b);
        let len = children.len();
        let mut at = children.iter().position(|&c| c == first).unwrap_or(0);
        for &c in &children {
            self.label[c as usize] = Label::Outside;
            self.since_blossom[c as usize] = self.growth;
        }
        let forward = at % 2 == 1;
        let mut edge = entry;
        let mut in_tree = vec![false; len];
        let mut even = false;
        loop {
            in_tree[at] = true;
            if even {
                self.make_even(children[at], edge);
            } else {
                self.make_odd(children[at], edge);
            }
            if at == 0 {
                break;
            }
            even = !even;
            if forward {
                edge = links[at];
                at = (at + 1) % len;
            } else {
                at -= 1;
                edge = links[at];
            }
        }
        for (c, _) in children
            .iter()
            .zip(&in_tree)
            .filter(|(_, inside)| !**inside)
        {
            for v in self.blossoms.vertices(*c) {
                for k in self.graph.offsets[v as usize]..self.graph.offsets[v as usize + 1] {
                    let edge = self.graph.incident[k];
                    let other = self.graph.other(edge, v);
                    let top = self.blossoms.top(other);
                    self.work += 1;
                    if self.label[top as usize] == Label::Even {
                        self.announce(edge, *c);
                    }
                }
            }
        }
    }

    /// Exchanges matched and other edges from vertex `v`, newly matched by `edge`, to the root.
    fn augment(&mut self, mut v: u32, mut edge: u32) {
        loop {
            let b = self.blossoms.top(v);
            let up = self.reached_by[b as usize];
            self.blossoms.rebase(self.graph, &mut self.mate, b, v);
            self.mate[v as usize] = edge;
            if up == NONE {
                return;
            }
            let [i, j] = self.graph.ends[up as usize];
            let outer = if self.blossoms.top(i) == b { j } else { i };
            let odd = self.blossoms.top(outer);
            edge = self.reached_by[odd as usize];
            let [i, j] = self.graph.ends[edge as usize];
            let (inner, next) = if self.blossoms.top(i) == odd {
                (i, j)
            } else {
                (j, i)
            };
            self.blossoms.rebase(self.graph, &mut self.mate, odd, inner);
            self.mate[inner as usize] = edge;
            v = next;
        }
    }

    /// Ends the stage: all multipliers up to date, no labels, no even blossom without a multiplier.
    fn settle(&mut self) {
        for b in std::mem::take(&mut self.labelled) {
            if !self.blossoms.is_top(b) || self.label[b as usize] == Label::Outside {
                self.label[b as usize] = Label::Outside;
                continue;
            }
            self.flush(b);
            self.label[b as usize] = Label::Outside;
            self.blossoms.settle(b);
            let mut empty = vec![b];
            while let Some(c) = empty.pop() {
                if self.blossoms.is_blossom(c) && self.blossoms.z(c) == 0 {
                    let (children, _) = self.blossoms.open(c);
                    for &child in &children {
                        self.label[child as usize] = Label::Outside;
                    }
                    empty.extend(children);
                }
            }
        }
    }
}
