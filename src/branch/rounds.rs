//! Rounds of the search: several nodes at the same time.
//!
//! A round deals the waiting nodes of the lowest bounds to tasks. Each searches below its nodes as the whole is
//! searched, until it has made a number of multiplications that is the same for all; a dive that it has not ended
//! goes on in the next round. What the tasks leave is joined in their order. Their number and their length depend on
//! the problem alone, and all begin with the same incumbent and the same pseudo-costs: so the search has the same
//! bits at any number of threads.

use std::sync::{Mutex, PoisonError};

use super::form::Form;
use super::node::Node;
use super::propagate::Propagator;
use super::pseudo_costs::PseudoCosts;
use super::relaxation::Relaxation;
use super::shared::Shared;
use super::tree::{Found, Limits, Tree};
use crate::monitor::{Monitor, span, tasks};

/// The nodes before the first round. Until then, pseudo-costs are learned and good incumbents are found: with rounds
/// after 200 nodes, one thread took up to a fifth longer for facility layouts of some thousand nodes.
const AFTER: u64 = 500;

/// The tasks of a round: enough to keep eight threads busy, and not more, because with every further dive at the same
/// time the tree has more nodes.
const WIDTH: usize = 8;

/// The nodes for which a task has time. A round of fewer takes hardly longer than its threads take to start.
const NODES: u64 = 6;

/// A task ends after so many times the nodes for which it has time, where these take less time than usual.
const MOST: u64 = 2;

/// A round in which one task searches a smaller problem is longer by this factor, so that two threads are busy until
/// its end.
const LONG: u64 = 4;

/// The sizes of rounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rounds {
    /// The nodes before the first round.
    pub after: u64,
    /// The largest number of tasks of a round.
    pub width: usize,
    /// The nodes for which a task has time.
    pub nodes: u64,
}

impl Default for Rounds {
    fn default() -> Self {
        Rounds {
            after: AFTER,
            width: WIDTH,
            nodes: NODES,
        }
    }
}

/// Where a search that has an incumbent pauses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pause {
    /// After so many nodes,
    pub nodes: u64,
    /// or so many multiplications, with those for which nodes take time.
    pub work: u64,
}

impl Pause {
    pub const NEVER: Pause = Pause {
        nodes: u64::MAX,
        work: u64::MAX,
    };

    pub fn is_at(&self, nodes: u64, work: u64) -> bool {
        nodes >= self.nodes || work >= self.work
    }
}

/// What all tasks of a round begin with.
struct Round<'a, 't> {
    form: &'a Form,
    shared: &'a Shared,
    limits: Limits,
    best: &'t Option<(Vec<f64>, f64)>,
    rounding: f64,
    costs: &'t PseudoCosts,
    work: u64,
    created: u64,
}

/// The counts of a task that tell when its longer steps are due.
#[derive(Debug, Clone, Copy)]
struct Counts {
    nodes: u64,
    next_part: u64,
    next_run: u64,
}

/// A task, which is made once and goes on from round to round: so what its solvers remember depends on no thread.
struct Task<'a> {
    solvers: Option<(Relaxation<'a>, Propagator)>,
    /// The node at which it has ended in the last round. The solvers have its bounds.
    last: Option<Node>,
    /// The nodes that wait when a round begins, and when it has ended.
    waiting: Vec<Node>,
    counts: Counts,
    pause: Pause,
    left: Option<Left>,
}

/// What a task has found in a round.
struct Left {
    best: Option<(Vec<f64>, f64)>,
    rounding: f64,
    done: f64,
    counts: Counts,
    work: u64,
    created: u64,
    costs: PseudoCosts,
    ray: Option<Vec<f64>>,
}

impl<'a> Task<'a> {
    fn new(solvers: (Relaxation<'a>, Propagator)) -> Self {
        Task {
            solvers: Some(solvers),
            last: None,
            waiting: Vec::new(),
            counts: Counts {
                nodes: 0,
                next_part: u64::MAX,
                next_run: u64::MAX,
            },
            pause: Pause::NEVER,
            left: None,
        }
    }

    fn has_nodes(&self) -> bool {
        self.last.is_some() || !self.waiting.is_empty()
    }

    /// Searches below its nodes.
    fn run(&mut self, round: &Round<'a, '_>, monitor: &Monitor) {
        let Some((mut relaxation, propagator)) = self.solvers.take() else {
            return;
        };
        let _span = span("nodes");
        // What the task finds may be worse than what another one has found: the caller hears of it when all are done.
        let mut monitor = monitor.silent();
        let _watch = monitor.watch_search();
        let &Round {
            form,
            shared,
            limits,
            ..
        } = round;
        relaxation.solver.count_from(round.work);
        let solvers = (relaxation, propagator);
        let mut tree = Tree {
            costs: round.costs.copy(),
            waiting: std::mem::take(&mut self.waiting).into(),
            best: round.best.clone(),
            rounding: round.rounding,
            created: round.created,
            nodes: self.counts.nodes,
            next_part: self.counts.next_part,
            next_run: self.counts.next_run,
            pause: self.pause,
            ..Tree::with_solvers(form, shared, solvers, limits, &mut monitor)
        };
        self.last = tree.run_from(self.last.take());
        self.waiting = tree.waiting.into_vec();
        self.waiting.append(&mut tree.stack);
        self.left = Some(Left {
            best: tree.best,
            rounding: tree.rounding,
            done: tree.done,
            counts: Counts {
                nodes: tree.nodes,
                next_part: tree.next_part,
                next_run: tree.next_run,
            },
            work: tree.relaxation.solver.work,
            created: tree.created,
            costs: tree.costs,
            ray: tree.ray,
        });
        self.solvers = Some((tree.relaxation, tree.propagator));
    }
}

impl<'a> Tree<'a, '_, '_> {
    /// Searches from the root, in rounds once there are enough nodes.
    pub fn found_in_rounds(mut self, rounds: &Rounds) -> Found {
        self.pause.nodes = rounds.after;
        self.stack.push(Node::root());
        self.run();
        self.run_in_rounds(rounds);
        self.result()
    }

    /// Goes on with a search that has paused, or does nothing where it has ended.
    fn run_in_rounds(&mut self, rounds: &Rounds) {
        self.pause = Pause::NEVER;
        self.waiting.extend(self.stack.drain(..));
        let mut tasks: Vec<Task<'a>> = Vec::new();
        while self.has_nodes(&mut tasks) {
            let is_ended = self.is_ended();
            let left = self.limits.nodes.saturating_sub(self.nodes);
            let width = rounds
                .width
                .min(usize::try_from(left).unwrap_or(usize::MAX));
            let width = if is_ended { 0 } else { width };
            for task in tasks.drain(width.min(tasks.len())..) {
                self.waiting.extend(task.last);
            }
            if is_ended {
                return;
            }
            self.deal(&mut tasks, width, rounds.nodes);
            self.prepare(&mut tasks, rounds);
            tasks = self.do_tasks(tasks);
        }
    }

    /// Whether nodes below the cutoff wait or are in a task. The others are dropped.
    fn has_nodes(&mut self, tasks: &mut [Task]) -> bool {
        let cutoff = self.cutoff();
        let is_dropped = |node: &Node| node.bound >= cutoff;
        // Where one that waits is dropped, no other one has a lower bound.
        let waiting = match self.waiting.peek().is_some_and(is_dropped) {
            true => std::mem::take(&mut self.waiting).into_vec(),
            false => Vec::new(),
        };
        let last = tasks
            .iter_mut()
            .filter_map(|task| task.last.take_if(|node| is_dropped(node)));
        self.done = waiting
            .into_iter()
            .chain(last)
            .fold(self.done, |done, node| done.min(node.bound));
        !self.waiting.is_empty() || tasks.iter().any(Task::has_nodes)
    }

    /// Gives the waiting nodes of the lowest bounds to so many tasks in turn, those without a node first: to each as
    /// many as it may have time for.
    fn deal(&mut self, tasks: &mut Vec<Task<'a>>, width: usize, each: u64) {
        let mut order: Vec<usize> = (0..width).collect();
        order.sort_by_key(|&k| tasks.get(k).is_some_and(Task::has_nodes));
        for _ in 0..each {
            for &k in &order {
                let Some(node) = self.waiting.pop() else {
                    return;
                };
                while tasks.len() <= k {
                    let relaxation = self.relaxation.another(self.shared);
                    tasks.push(Task::new((relaxation, self.propagator.another())));
                }
                tasks[k].waiting.push(node);
            }
        }
    }

    /// Sets what the tasks begin with and where they end. The first two, which are started first, do the longer steps
    /// that are due.
    fn prepare(&self, tasks: &mut [Task<'a>], rounds: &Rounds) {
        let with_nodes = || tasks.iter().filter(|task| task.has_nodes());
        let count = with_nodes().count() as u64;
        let left = (self.limits.nodes - self.nodes) / count;
        let has_part = self.nodes >= self.next_part;
        let each = rounds.nodes.saturating_mul(if has_part { LONG } else { 1 });
        let most = left.min(each.saturating_mul(MOST));
        let spent = self.spent();
        let budget = (spent / self.nodes.max(1)).saturating_mul(each);
        // At least one node.
        let budget = budget
            .min(self.limits.work.saturating_sub(spent) / count)
            .max(1);
        let due = |is_due: bool, next: u64| if is_due { next } else { u64::MAX };
        for (k, task) in (0..).zip(tasks.iter_mut().filter(|task| task.has_nodes())) {
            let before = k * most;
            task.counts = Counts {
                nodes: self.nodes + before,
                next_part: due(k == 0 && has_part, self.next_part),
                next_run: due(k + 1 == count.min(2), self.next_run),
            };
            task.pause = Pause {
                nodes: self.nodes + before + most,
                work: self.spent_with(before).saturating_add(budget),
            };
        }
    }

    /// Does the tasks that have nodes, and joins what they leave.
    fn do_tasks(&mut self, all: Vec<Task<'a>>) -> Vec<Task<'a>> {
        let (work, created) = (self.relaxation.solver.work, self.created);
        let round = Round {
            form: self.form,
            shared: self.shared,
            limits: self.limits,
            best: &self.best,
            rounding: self.rounding,
            costs: &self.costs,
            work,
            created,
        };
        let all: Vec<_> = all.into_iter().map(Mutex::new).collect();
        // Nobody else asks for these locks.
        let of = |k: usize| all[k].lock().unwrap_or_else(PoisonError::into_inner);
        let with_nodes = (0..all.len()).filter(|&k| of(k).has_nodes());
        let with_nodes: Vec<usize> = with_nodes.collect();
        tasks(with_nodes.len(), self.monitor, |k, monitor| {
            of(with_nodes[k]).run(&round, monitor);
        });
        let own = |task: Mutex<_>| task.into_inner().unwrap_or_else(PoisonError::into_inner);
        let mut all: Vec<Task<'a>> = all.into_iter().map(own).collect();
        for task in &mut all {
            self.join(task, work, created);
        }
        all
    }

    /// Joins what a task leaves that began at these counts of multiplications and of nodes that were made.
    fn join(&mut self, task: &mut Task, work: u64, created: u64) {
        let Some(left) = task.left.take() else {
            return;
        };
        // Numbers of new nodes follow those of the tasks before.
        let shift = self.created - created;
        self.created += left.created - created;
        for node in task.waiting.iter_mut().chain(&mut task.last) {
            if node.number > created {
                node.number += shift;
            }
        }
        self.waiting.extend(task.waiting.drain(..));
        self.nodes += left.counts.nodes - task.counts.nodes;
        self.relaxation.solver.work += left.work - work;
        self.done = self.done.min(left.done);
        self.costs.join(&left.costs);
        self.ray = self.ray.take().or(left.ray);
        if task.counts.next_part < u64::MAX {
            self.next_part = left.counts.next_part;
        }
        if task.counts.next_run < u64::MAX {
            self.next_run = left.counts.next_run;
        }
        let energy = |best: &Option<(Vec<f64>, f64)>| best.as_ref().map(|(_, energy)| *energy);
        if let Some(found) = energy(&left.best)
            && energy(&self.best).is_none_or(|best| found < best)
        {
            self.best = left.best;
            self.rounding = left.rounding;
            self.monitor.improved(found);
        }
    }
}

#[cfg(test)]
#[path = "rounds_tests.rs"]
mod tests;
