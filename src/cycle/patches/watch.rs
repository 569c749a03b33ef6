//! The limits of a proof, those of tasks that are done at the same time, and who hears of its bounds.

use crate::monitor::{Monitor, tasks};

/// What a proof tells, and asks, while it goes on.
pub(super) trait Watch {
    /// Counts multiplications. Returns whether to end.
    fn ends(&mut self, work: u64) -> bool;
    /// The multiplications that may still be spent.
    fn left(&self) -> u64;
    /// The nodes that may still be visited: `u64::MAX` without a limit.
    fn nodes(&self) -> u64;
    /// Counts nodes.
    fn visited(&mut self, nodes: u64);
    /// No charges have less energy.
    fn raised(&mut self, bound: f64);
    /// Does tasks at the same time, each of which may take all that is left. Counts what they took, in their order,
    /// and returns whether to end.
    fn at_once(&mut self, count: usize, task: &Task) -> bool;
}

/// A task with its number. Returns whether the watch ended it.
pub(super) type Task<'a> = dyn Fn(usize, &mut Counted) -> bool + Sync + 'a;

/// The watch of a task, which counts what it takes.
pub(super) struct Counted<'a, 'm> {
    pub monitor: &'a mut Monitor<'m>,
    /// The multiplications and the nodes that it may take.
    most: (u64, u64),
    pub work: u64,
    pub nodes: u64,
}

impl<'a, 'm> Counted<'a, 'm> {
    /// Nothing is taken so far, of `most` multiplications and nodes.
    pub fn new(monitor: &'a mut Monitor<'m>, most: (u64, u64)) -> Self {
        Counted {
            monitor,
            most,
            work: 0,
            nodes: 0,
        }
    }

    /// Does tasks at the same time, each of which may take so many multiplications and nodes.
    pub fn tasks(count: usize, most: (u64, u64), monitor: &mut Monitor, task: &Task) -> Vec<Took> {
        tasks(count, monitor, |k, monitor| {
            let mut watch = Counted::new(monitor, most);
            let ended = task(k, &mut watch);
            Took {
                work: watch.work,
                nodes: watch.nodes,
                ended,
            }
        })
    }
}

/// The multiplications and nodes of a task, and whether its watch ended it.
pub(super) struct Took {
    work: u64,
    nodes: u64,
    ended: bool,
}

/// Counts what tasks took. Returns whether to end.
pub(super) fn counted(watch: &mut dyn Watch, tasks: &[Took]) -> bool {
    let mut ended = false;
    for task in tasks {
        watch.visited(task.nodes);
        ended |= watch.ends(task.work) || task.ended;
    }
    ended
}

impl Watch for Counted<'_, '_> {
    fn ends(&mut self, work: u64) -> bool {
        self.work += work;
        self.work >= self.most.0 || self.monitor.ends()
    }

    fn left(&self) -> u64 {
        self.most.0.saturating_sub(self.work)
    }

    fn nodes(&self) -> u64 {
        match self.most.1 {
            u64::MAX => u64::MAX,
            most => most.saturating_sub(self.nodes),
        }
    }

    fn visited(&mut self, nodes: u64) {
        self.nodes = self.nodes.saturating_add(nodes);
    }

    fn raised(&mut self, _: f64) {}

    fn at_once(&mut self, count: usize, task: &Task) -> bool {
        let most = (self.left(), self.nodes());
        let done = Counted::tasks(count, most, self.monitor, task);
        counted(self, &done)
    }
}
