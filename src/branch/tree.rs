//! Branch and bound: best bound first, diving into one child of each node.
//!
//! A node is a set of bounds. Its relaxation is solved from the active rows of its parent. It is cut off where
//! its bound reaches the incumbent's energy, where its relaxation has no point, or where its minimiser is
//! integer. Else one unknown is branched on; the child that looks better is searched next, and the other
//! waits. When a dive ends, the waiting node of the lowest bound is next.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::branching::{Branching, INTEGRAL, child_limits, floor_between};
use super::dual_active_set::{Active, WarmStart};
use super::form::{Form, Interval};
use super::propagate::Propagator;
use super::pseudo_costs::{PseudoCosts, merit};
use super::record::Record;
use super::relaxation::{Relaxation, Relaxed, regularization};
use super::safe_bound::is_contradiction;
use super::shared::Shared;
use crate::error::Result;
use crate::monitor::Monitor;
use crate::proof::Visited;
use crate::search::StoppedBy;

/// Iterations of the dual active-set method for a child that strong branching looks at.
const PROBE: u64 = 25;

/// The largest number of unknowns that strong branching looks at in a node.
const CANDIDATES: usize = 12;

/// A node that waits.
struct Node {
    bound: f64,
    number: u64,
    /// The bounds that differ from the root's.
    limits: Vec<(u32, Interval)>,
    warm: WarmStart,
    branching: Option<Branching>,
    /// Its number in the record.
    visited: usize,
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Node {}
impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Node {
    /// The greatest node is the next: the lowest bound, then the newest.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .bound
            .total_cmp(&self.bound)
            .then(self.number.cmp(&other.number))
    }
}

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
    /// Whether the limits hold before there is a point.
    pub strict: bool,
    /// Whether to record all nodes for a proof.
    pub recorded: bool,
}

/// The dives without an incumbent after which the search goes on at the lowest bound.
const DIVES: u64 = 50;

/// The nodes before the first smaller problem is searched.
const FIRST_PART: u64 = 50;

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
    costs: PseudoCosts,
    pub root: Vec<Interval>,
    waiting: BinaryHeap<Node>,
    /// The nodes that wait while there is no incumbent, the newest last.
    stack: Vec<Node>,
    pub best: Option<(Vec<f64>, f64)>,
    /// The lowest bound of the nodes that are done.
    done: f64,
    created: u64,
    /// The dives since the search was last at the lowest bound.
    dives: u64,
    pub nodes: u64,
    /// The node after which the next smaller problem is searched.
    pub next_part: u64,
    pub limits: Limits,
    conflict: Vec<(u32, f64)>,
    ray: Option<Vec<f64>>,
    stopped_by: StoppedBy,
    /// The rounding errors of the incumbent's energy.
    pub rounding: f64,
    pub integers: Vec<u32>,
    record: Option<Record>,
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
    let shared = Shared::new(form, &regularization(form))?;
    let mut tree = Tree::new(form, &shared, limits, monitor);
    if let Some(start) = start {
        tree.round(&start);
    }
    Ok(tree.found())
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
        let integers = (0..form.dim() as u32).filter(|&j| form.integer[j as usize]);
        Tree {
            form,
            shared,
            relaxation: Relaxation::new(form, shared),
            propagator: Propagator::new(form),
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
            limits,
            conflict: Vec::new(),
            ray: None,
            stopped_by: StoppedBy::Nothing,
            rounding: 0.0,
            integers: integers.collect(),
            record: limits.recorded.then(Record::default),
            monitor,
        }
    }

    /// Searches from the root.
    pub fn found(mut self) -> Found {
        self.stack.push(Node {
            bound: f64::NEG_INFINITY,
            number: 0,
            limits: Vec::new(),
            warm: WarmStart::new(),
            branching: None,
            visited: 0,
        });
        self.run();
        let waiting = self.waiting.iter().chain(&self.stack);
        let is_empty = self.waiting.is_empty() && self.stack.is_empty();
        let bound = waiting.map(|node| node.bound).fold(self.done, f64::min);
        let energy = self.best.as_ref();
        let energy = energy.map_or(f64::INFINITY, |(_, energy)| *energy);
        // A search that ends at its first point leaves nodes out.
        let leaves_out = self.limits.first && self.best.is_some() && bound < self.enough(energy);
        let is_complete = is_empty && !leaves_out;
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

    fn run(&mut self) {
        while let Some(mut node) = self.next_node() {
            if node.bound >= self.cutoff() {
                self.done = self.done.min(node.bound);
                continue;
            }
            self.jump_to(&node);
            loop {
                match self.visit(node) {
                    Step::Done => break,
                    Step::Split(next, other) => {
                        self.wait(*other);
                        self.dive_to(&next);
                        node = *next;
                    }
                    Step::Ended(node) => {
                        self.wait(*node);
                        return;
                    }
                }
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
        self.relaxation.solver.start_from(&node.warm);
    }

    fn dive_to(&mut self, node: &Node) {
        for &(j, limits) in &node.limits {
            self.relaxation.solver.set_limits(j as usize, limits);
        }
    }

    /// Whether to end. Without a point only the caller ends the search.
    fn is_ended(&mut self) -> bool {
        let found = self.best.is_some() || self.limits.strict;
        if found && self.nodes >= self.limits.nodes {
            self.stopped_by = StoppedBy::Nodes;
        } else if found && self.relaxation.solver.work >= self.limits.work {
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
        let solved = self.relaxation.solve(cutoff, &boxes);
        let parent = node.bound;
        if let (Some(record), Some(kept)) = (&mut self.record, self.relaxation.kept.take()) {
            record.bounded(node.visited, parent, kept);
        }
        match solved {
            Relaxed::Infeasible(rows) => {
                if !is_contradiction(self.form, &boxes, &rows) {
                    // Rounding errors leave a doubt, and so the bound stays.
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
        let every = if self.best.is_none() { 5 } else { 20 };
        if self.nodes == 1 || self.nodes.is_multiple_of(every) || fractional.is_empty() {
            self.round(&point);
        }
        if self.nodes >= self.next_part && !fractional.is_empty() {
            self.search_part(&point);
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

    fn fractional(&self, point: &[f64]) -> Vec<u32> {
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
    fn undecided(&self, point: &[f64]) -> Vec<u32> {
        let free = |&&j: &&u32| !self.relaxation.solver.limits()[j as usize].is_point();
        let error = |j: u32| (point[j as usize] - point[j as usize].round()).abs();
        let free = self.integers.iter().filter(free);
        let worst = free.max_by(|&&a, &&b| error(a).total_cmp(&error(b)));
        worst.into_iter().copied().collect()
    }

    /// The unknown to branch on and its value. Strong branching may find that one side has no better point;
    /// its bound is then tightened at once, which makes the node's other child empty.
    fn choose(&mut self, node: &Node, fractional: &[u32], point: &[f64]) -> (u32, f64) {
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
            if self.costs.is_reliable(j as usize) {
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

    fn split(&mut self, node: Node, variable: u32, value: f64) -> Step {
        let before = self.relaxation.solver.limits()[variable as usize];
        let fraction = value - value.floor();
        let warm: Vec<Active> = self.relaxation.active().to_vec();
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
