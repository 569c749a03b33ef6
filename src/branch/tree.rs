//! Branch and bound: best bound first, diving into one child of each node.
//!
//! A node is a set of bounds. Its relaxation is solved from the active rows of its parent. It is cut off where
//! its bound reaches the incumbent's energy, where its relaxation has no point, or where its minimiser is
//! integer. Else one unknown is branched on; the child that looks better is searched next, and the other
//! waits. When a dive ends, the waiting node of the lowest bound is next. A large tree is searched in
//! [rounds](super::rounds) of several nodes at the same time.

use std::collections::BinaryHeap;

use super::branching::{Branching, child_limits, floor_between};
use super::dual_active_set::Active;
use super::form::{Form, Interval};
use super::lazy::LazyRows;
use super::node::{Node, keep_last};
use super::propagate::Propagator;
use super::pseudo_costs::PseudoCosts;
use super::record::Record;
use super::relaxation::{Relaxation, Relaxed, regularization};
use super::rounds::{Pause, Rounds};
use super::safe_bound::is_contradiction;
use super::shared::Shared;
use crate::error::Result;
use crate::monitor::Monitor;
use crate::proof::Visited;
use crate::search::StoppedBy;

/// What ends a search early.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    pub nodes: u64,
    pub work: u64,
    /// The relative gap that is enough.
    pub gap: f64,
    /// The energy of what is not in the form, to which the gap refers as well.
    pub elsewhere: f64,
    /// Whether the first point is enough.
    pub first: bool,
    /// Whether the search is a part of another one, and makes no smaller ones itself.
    pub inner: bool,
    /// Whether to record all nodes for a proof.
    pub recorded: bool,
}

impl Limits {
    /// Those of a search of so many nodes within another one.
    pub fn inner(nodes: u64) -> Self {
        Limits {
            nodes,
            work: u64::MAX,
            gap: 0.0,
            elsewhere: 0.0,
            first: false,
            inner: true,
            recorded: false,
        }
    }
}

/// The dives without an incumbent after which the search goes on at the lowest bound.
const DIVES: u64 = 50;

/// The nodes before the first smaller problem is searched.
const FIRST_PART: u64 = 50;

/// The nodes before the first run of simulated annealing.
const FIRST_RUN: u64 = 100;

/// The multiplications that a node takes time for, apart from those of its relaxation.
const NODE: u64 = 5000;

/// The search for a first point may take this many times the work of the search for a better one.
const FIRST: u64 = 10;

/// A bound that is lower by this part of the energy, or of this number, is not due to the rounding errors of closed
/// nodes.
const DOUBT: f64 = 1e-6;

/// A gap below this part of the energy is none.
const CLOSED: f64 = 5e-10;

/// What a search has found.
#[derive(Debug, Clone)]
pub(super) struct Found {
    /// The best point and its energy.
    pub best: Option<(Vec<f64>, f64)>,
    /// No point has less energy.
    pub bound: f64,
    /// Whether nothing is left to search.
    pub is_complete: bool,
    pub nodes: u64,
    pub work: u64,
    /// A direction in which the energy of the relaxation falls for ever.
    pub ray: Option<Vec<f64>>,
    /// Why the search ended before it was complete.
    pub stopped_by: StoppedBy,
    /// The rows that contradict each other at the last node that had no point.
    pub conflict: Vec<(u32, f64)>,
    /// All nodes, if they are recorded.
    pub visited: Vec<Visited>,
}

pub(super) struct Tree<'a, 'm, 'e> {
    pub form: &'a Form,
    pub shared: &'a Shared,
    pub relaxation: Relaxation<'a>,
    pub propagator: Propagator,
    pub costs: PseudoCosts,
    pub root: Vec<Interval>,
    pub waiting: BinaryHeap<Node>,
    /// The nodes that wait while there is no incumbent, the newest last.
    pub stack: Vec<Node>,
    pub best: Option<(Vec<f64>, f64)>,
    /// The lowest bound of the nodes that are done.
    pub done: f64,
    pub created: u64,
    /// The dives since the search was last at the lowest bound.
    pub dives: u64,
    pub nodes: u64,
    /// The node after which the next smaller problem is searched.
    pub next_part: u64,
    /// The node after which simulated annealing runs next.
    pub next_run: u64,
    pub limits: Limits,
    pub pause: Pause,
    pub conflict: Vec<(u32, f64)>,
    pub ray: Option<Vec<f64>>,
    pub stopped_by: StoppedBy,
    /// The rounding errors of the incumbent's energy.
    pub rounding: f64,
    pub integers: Vec<u32>,
    pub lazy: Option<LazyRows<'m, 'e>>,
    pub record: Option<Record>,
    pub monitor: &'m mut Monitor<'e>,
}

/// Searches the form, all of whose unknowns are one component.
///
/// # Errors
/// [`Error::NotConvex`](crate::Error::NotConvex), [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the
/// end of the call.
pub(super) fn search(
    form: &Form,
    start: Option<Vec<f64>>,
    limits: Limits,
    monitor: &mut Monitor,
) -> Result<Found> {
    search_in_rounds(form, start, limits, &Rounds::default(), monitor)
}

/// [`search`] with other rounds.
pub(super) fn search_in_rounds(
    form: &Form,
    start: Option<Vec<f64>>,
    limits: Limits,
    rounds: &Rounds,
    monitor: &mut Monitor,
) -> Result<Found> {
    let shared = Shared::new(form, &regularization(form))?;
    let _watch = monitor.watch_search();
    let mut tree = Tree::new(form, &shared, limits, monitor);
    // A proof needs slopes of exactly zero where an unknown has no bound, which the interior-point method seldom finds.
    let is_open = || form.boxes.iter().any(|limits| !limits.width().is_finite());
    if limits.inner || (limits.recorded && is_open()) {
        tree.relaxation.interior = None;
    }
    if let Some(start) = start {
        tree.round(&start);
    }
    if limits.inner || limits.recorded || limits.first {
        return Ok(tree.found());
    }
    Ok(tree.found_in_rounds(rounds))
}

/// What became of a node.
enum Step {
    Done,
    /// Two children: the one to search next, and the other.
    Split(Box<Node>, Box<Node>),
    /// A limit ended the search in the middle of the node.
    Ended(Box<Node>),
}

impl<'a, 'm, 'e> Tree<'a, 'm, 'e> {
    pub fn new(
        form: &'a Form,
        shared: &'a Shared,
        limits: Limits,
        monitor: &'m mut Monitor<'e>,
    ) -> Self {
        let solvers = (Relaxation::new(form, shared), Propagator::new(form));
        Tree::with_solvers(form, shared, solvers, limits, monitor)
    }

    pub fn with_solvers(
        form: &'a Form,
        shared: &'a Shared,
        (relaxation, propagator): (Relaxation<'a>, Propagator),
        limits: Limits,
        monitor: &'m mut Monitor<'e>,
    ) -> Self {
        let integers = (0..form.dim() as u32).filter(|&j| form.integer[j as usize]);
        Tree {
            form,
            shared,
            relaxation,
            propagator,
            costs: PseudoCosts::new(form.dim()),
            root: form.limits.clone(),
            waiting: BinaryHeap::new(),
            stack: Vec::new(),
            best: None,
            done: f64::INFINITY,
            created: 0,
            dives: 0,
            nodes: 0,
            next_part: FIRST_PART,
            next_run: FIRST_RUN,
            limits,
            pause: Pause::NEVER,
            conflict: Vec::new(),
            ray: None,
            stopped_by: StoppedBy::Nothing,
            rounding: 0.0,
            integers: integers.collect(),
            lazy: None,
            record: limits.recorded.then(Record::default),
            monitor,
        }
    }

    /// Searches from the root.
    pub fn found(mut self) -> Found {
        self.stack.push(Node::root());
        self.run();
        self.result()
    }

    /// Whether rows of the caller cut off a point that the form allows.
    pub fn is_cut(&self) -> bool {
        self.lazy.as_ref().is_some_and(|lazy| lazy.cut)
    }

    /// What the search has found so far.
    pub fn result(self) -> Found {
        let waiting = self.waiting.iter().chain(&self.stack);
        let is_empty = self.waiting.is_empty() && self.stack.is_empty();
        let bound = waiting.map(|node| node.bound).fold(self.done, f64::min);
        let energy = self.best.as_ref().map_or(f64::INFINITY, |best| best.1);
        // A search that ends at its first point leaves nodes out, and so does one that takes a node for empty by
        // rounding errors alone.
        let doubt = match self.limits.first {
            true => 0.0,
            false => DOUBT * energy.abs().max(DOUBT) + 1e4 * self.rounding,
        };
        // Without an incumbent, a node that has a bound is not shown to be empty.
        let is_left_out = match self.best {
            None => bound < f64::INFINITY,
            Some(_) => bound < self.enough(energy) - doubt,
        };
        let is_complete = is_empty && !is_left_out;
        Found {
            bound: bound.min(energy),
            ray: self.ray,
            stopped_by: self.stopped_by,
            is_complete,
            best: self.best,
            nodes: self.nodes,
            work: self.relaxation.solver.work,
            conflict: self.conflict,
            visited: self.record.map(Record::into_nodes).unwrap_or_default(),
        }
    }

    /// The next node that waits: the lowest bound, or the newest node while there is no incumbent. Every
    /// [`DIVES`] nodes without one, the search goes on at the lowest bound, lest it stays where there is none.
    fn next_node(&mut self) -> Option<Node> {
        if self.best.is_some() || self.dives >= DIVES {
            self.dives = 0;
            self.waiting.extend(self.stack.drain(..));
        }
        self.dives += 1;
        self.stack.pop().or_else(|| self.waiting.pop())
    }

    fn wait(&mut self, node: Node) {
        if self.best.is_some() {
            self.waiting.push(node);
        } else {
            self.stack.push(node);
        }
    }

    pub fn run(&mut self) {
        if let Some(node) = self.run_from(None) {
            self.wait(node);
        }
    }

    /// Searches, first from a node at which an earlier run has ended. Returns the node at which this one ends, if it
    /// does before nothing waits.
    pub fn run_from(&mut self, mut last: Option<Node>) -> Option<Node> {
        loop {
            let is_last = last.is_some();
            let node = last.take().or_else(|| self.next_node())?;
            if node.bound >= self.cutoff() {
                self.done = self.done.min(node.bound);
                continue;
            }
            if !is_last {
                self.jump_to(&node);
            }
            if let Some(node) = self.dive(node) {
                return Some(node);
            }
        }
    }

    /// Searches from a node, one child after the other. Returns the node at which a limit ends that.
    fn dive(&mut self, mut node: Node) -> Option<Node> {
        loop {
            match self.visit(node) {
                Step::Done => return None,
                Step::Split(next, other) => {
                    self.wait(*other);
                    self.dive_to(&next);
                    node = *next;
                }
                Step::Ended(node) => return Some(*node),
            }
        }
    }

    /// The bound from which on a node is of no interest.
    pub fn cutoff(&self) -> f64 {
        match &self.best {
            None => f64::INFINITY,
            Some(_) if self.limits.first => f64::NEG_INFINITY,
            Some((_, energy)) => self.enough(*energy),
        }
    }

    /// The bound that proves a point of this energy.
    fn enough(&self, energy: f64) -> f64 {
        let gap = self.limits.gap.max(CLOSED);
        energy - gap * (energy + self.limits.elsewhere).abs() - self.rounding
    }

    fn jump_to(&mut self, node: &Node) {
        for (j, &limits) in self.root.iter().enumerate() {
            self.relaxation.solver.set_limits(j, limits);
        }
        self.dive_to(node);
        self.relaxation.start_from(&node.warm);
    }

    fn dive_to(&mut self, node: &Node) {
        for &(j, limits) in &node.limits {
            self.relaxation.solver.set_limits(j as usize, limits);
        }
    }

    /// The multiplications so far, with those for which nodes take time.
    pub fn spent(&self) -> u64 {
        self.spent_with(0)
    }

    /// [`spent`](Self::spent) after so many more nodes that took no multiplications.
    pub fn spent_with(&self, nodes: u64) -> u64 {
        self.relaxation.solver.work + (self.nodes + nodes) * NODE
    }

    /// Whether to end.
    pub fn is_ended(&mut self) -> bool {
        let work = self.spent();
        if self.best.is_some() && self.pause.is_at(self.nodes, work) {
            return true;
        }
        let most = match self.best.is_some() || self.limits.inner {
            true => self.limits.work,
            false => self.limits.work.saturating_mul(FIRST),
        };
        if self.nodes >= self.limits.nodes {
            self.stopped_by = StoppedBy::Nodes;
        } else if work >= most {
            self.stopped_by = StoppedBy::Budget;
        } else if self.ray.is_none() && !self.monitor.ends() {
            return false;
        }
        true
    }

    fn visit(&mut self, mut node: Node) -> Step {
        if self.is_ended() {
            return Step::Ended(Box::new(node));
        }
        self.nodes += 1;
        if !self.tighten(&mut node) {
            return Step::Done;
        }
        let boxes = self.boxes();
        let cutoff = self.cutoff();
        self.relaxation.kept = self.record.as_ref().map(|_| Default::default());
        let solved = self.solve(cutoff, &boxes);
        let parent = node.bound;
        if let (Some(record), Some(kept)) = (&mut self.record, self.relaxation.kept.take()) {
            record.solved(node.visited, parent, kept, self.form.dim());
        }
        match solved {
            Relaxed::Infeasible(rows) => {
                if self.is_in_doubt(&rows, &boxes) {
                    self.done = self.done.min(node.bound);
                }
                if let Some(record) = &mut self.record {
                    record.contradiction(node.visited, &rows, self.form.dim());
                }
                self.conflict = rows;
                return Step::Done;
            }
            Relaxed::Unbounded(direction) => {
                self.ray = Some(direction);
                return Step::Ended(Box::new(node));
            }
            Relaxed::Cutoff { bound } => {
                node.bound = node.bound.max(bound);
                self.learn(&node, parent);
                self.done = self.done.min(node.bound.max(cutoff.min(bound)));
                return Step::Done;
            }
            Relaxed::Solved { bound } | Relaxed::Stopped { bound } => {
                node.bound = node.bound.max(bound);
            }
        }
        self.learn(&node, parent);
        if node.bound >= self.cutoff() {
            self.done = self.done.min(node.bound);
            return Step::Done;
        }
        let point = self.relaxation.solver.point().to_vec();
        let mut fractional = self.fractional(&point);
        if !fractional.is_empty() && self.cuts_off(&point, self.form.energy(&point)) {
            return Step::Ended(Box::new(node));
        }
        let every = if self.best.is_none() { 5 } else { 20 };
        if self.nodes == 1 || self.nodes.is_multiple_of(every) || fractional.is_empty() {
            self.find_near(&point);
        }
        if self.nodes >= self.next_part && !fractional.is_empty() {
            self.search_part(&point);
        }
        if self.nodes >= self.next_run {
            self.anneal();
        }
        if self.is_cut() {
            return Step::Ended(Box::new(node));
        }
        if node.bound >= self.cutoff() {
            self.done = self.done.min(node.bound);
            return Step::Done;
        }
        if fractional.is_empty() {
            fractional = self.undecided(&point);
            if fractional.is_empty() {
                // All integers are fixed: the point was offered.
                self.done = self.done.min(node.bound);
                return Step::Done;
            }
        }
        let (variable, at) = self.choose(&node, &fractional, &point);
        self.split(node, variable, at)
    }

    /// Solves the relaxation of a node; again from no active rows, if what shows that it has no point does not hold.
    fn solve(&mut self, cutoff: f64, boxes: &[Interval]) -> Relaxed {
        let solved = self.relaxation.solve(cutoff, boxes);
        match &solved {
            Relaxed::Infeasible(rows) if self.is_in_doubt(rows, boxes) => {
                self.relaxation.start_from(&[]);
                self.relaxation.solve(cutoff, boxes)
            }
            _ => solved,
        }
    }

    /// Whether rounding errors leave a doubt about what these rows show. The bound of such a node stays.
    fn is_in_doubt(&self, rows: &[(u32, f64)], boxes: &[Interval]) -> bool {
        !rows.is_empty() && !is_contradiction(self.form, boxes, rows)
    }

    /// Whether the caller cuts off a point that the form allows.
    pub fn cuts_off(&mut self, point: &[f64], energy: f64) -> bool {
        let lazy = self.lazy.as_mut();
        lazy.is_some_and(|lazy| lazy.cuts_off(point, energy, self.monitor))
    }

    /// Bounds on all unknowns at a node.
    pub fn boxes(&self) -> Vec<Interval> {
        let limits = self.relaxation.solver.limits().iter();
        limits
            .zip(&self.form.boxes)
            .map(|(l, b)| l.and(*b))
            .collect()
    }

    /// Tightens the integers' bounds at a node. Returns whether points are left.
    fn tighten(&mut self, node: &mut Node) -> bool {
        let mut limits = self.relaxation.solver.limits().to_vec();
        self.propagator.steps = self.record.as_ref().map(|_| Vec::new());
        let changed = match (&node.branching, node.limits.last()) {
            (Some(branching), _) => {
                let changed = [branching.variable];
                self.propagator
                    .from(self.form, &mut limits, &changed, false)
            }
            (None, _) => self.propagator.all(self.form, &mut limits, false, 20),
        };
        let steps = self.propagator.steps.take();
        if let (Some(record), Some(steps)) = (&mut self.record, steps) {
            record.tightened(node.visited, steps, changed.as_ref().err().copied());
        }
        let Ok(changed) = changed else {
            return false;
        };
        for &j in &changed {
            self.relaxation
                .solver
                .set_limits(j as usize, limits[j as usize]);
            node.limits.push((j, limits[j as usize]));
        }
        true
    }

    /// Records the rise of the bound for the unknown that was branched on.
    fn learn(&mut self, node: &Node, parent: f64) {
        if let (Some(branching), true) = (node.branching, parent.is_finite()) {
            let rise = node.bound - parent;
            let Branching {
                variable,
                direction,
                distance,
            } = branching;
            self.costs
                .record(variable as usize, direction, distance, rise);
        }
    }

    fn split(&mut self, mut node: Node, variable: u32, value: f64) -> Step {
        if node.limits.len() > 2 * self.form.dim() {
            keep_last(&mut node.limits, self.form.dim());
        }
        let before = self.relaxation.solver.limits()[variable as usize];
        let fraction = value - value.floor();
        let warm: Vec<Active> = match self.relaxation.interior {
            None => self.relaxation.active().to_vec(),
            Some(_) => Vec::new(),
        };
        let visited = match &mut self.record {
            None => [0; 2],
            Some(record) => record.branched(node.visited, variable, floor_between(before, value)),
        };
        let mut child = |direction: usize| {
            self.created += 1;
            let mut limits = node.limits.clone();
            limits.push((variable, child_limits(before, value, direction)));
            Box::new(Node {
                bound: node.bound,
                number: self.created,
                limits,
                warm: warm.clone(),
                branching: Some(Branching {
                    variable,
                    direction,
                    distance: if direction == 0 {
                        fraction
                    } else {
                        1.0 - fraction
                    },
                }),
                visited: visited[direction],
            })
        };
        let expected = self.costs.expected(variable as usize, fraction);
        let first = usize::from(expected[1] < expected[0]);
        let (next, other) = (child(first), child(1 - first));
        Step::Split(next, other)
    }
}

#[cfg(test)]
#[path = "tree_tests.rs"]
pub(super) mod tests;
