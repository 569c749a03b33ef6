//! The assembly tree of a supernodal factor, and its division into tasks that several threads can do.
//!
//! A supernode needs the supernodes of its subtree only (`liu1990`, section 5). Subtrees with a fixed part of
//! the work are one task each; a supernode above them is a task of its own, which waits for its children. Near the
//! root there are fewer tasks than threads, and they are large: these are done one after another, each by all threads.
//! The tasks depend on the pattern alone, so the number of threads changes no result.

use std::collections::BinaryHeap;
use std::ops::Range;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use super::ordering::NONE;
use super::supernodes::Supernodes;
use crate::error::{Error, Result};
use crate::monitor::{allowed_threads, in_parts, is_simulated, simulate_graph};

/// A task has at most one in so many parts of the work, unless it is a single supernode.
const PARTS: u64 = 32;

/// All threads share a supernode with at least one in so many parts of the work, ...
const SHARED_PARTS: u64 = 64;

/// ... and at least this much: less is not worth their start.
const SHARED: u64 = 1 << 23;

/// The tree and its tasks.
#[derive(Debug)]
pub(super) struct AssemblyTree {
    /// The parent of each supernode, or [`NONE`].
    parent: Vec<u32>,
    /// The children of supernode `s` are `children[first_child[s]..first_child[s + 1]]`, increasing.
    children: Vec<u32>,
    first_child: Vec<u32>,
    /// The supernodes of each task. A task comes after all that it needs.
    tasks: Vec<Range<usize>>,
    /// How many tasks each one waits for.
    waits: Vec<u32>,
    /// The tasks that are done at the same time.
    apart: TaskGraph,
    /// The tasks that all threads share, after these, increasing.
    shared: Vec<usize>,
}

/// Some tasks, and what they need of each other.
#[derive(Debug)]
struct TaskGraph {
    tasks: Vec<usize>,
    /// How many of these tasks each one waits for, and which ones wait for it, by their places in the list.
    waits: Vec<u32>,
    followers: Vec<Vec<u32>>,
    /// The work of each task and of those that wait for it, along the longest path. Of the tasks that are ready,
    /// the one with the longest path is done first.
    path: Vec<u64>,
}

impl TaskGraph {
    fn new(tasks: Vec<usize>, of_all: &[Vec<u32>], work: impl Fn(usize) -> u64) -> Self {
        let mut place = vec![NONE; of_all.len()];
        (tasks.iter().zip(0..)).for_each(|(&task, at)| place[task] = at);
        let mut waits = vec![0; tasks.len()];
        let mut path = vec![0; tasks.len()];
        let mut followers = vec![Vec::new(); tasks.len()];
        for (k, &task) in tasks.iter().enumerate().rev() {
            let others = of_all[task].iter().map(|&f| place[f as usize]);
            followers[k] = others.filter(|&at| at != NONE).collect();
            let longest = followers[k].iter().map(|&f| path[f as usize]).max();
            path[k] = work(task) + longest.unwrap_or(0);
            followers[k].iter().for_each(|&f| waits[f as usize] += 1);
        }
        TaskGraph {
            tasks,
            waits,
            followers,
            path,
        }
    }
}

impl AssemblyTree {
    pub fn new(factor: &Supernodes) -> Self {
        let count = factor.count();
        let mut supernode_of = vec![0u32; factor.dim()];
        for s in 0..count {
            supernode_of[factor.columns(s)].fill(s as u32);
        }
        let of_first_row = |s: usize| factor.rows(s).first();
        let parent: Vec<u32> = (0..count)
            .map(|s| of_first_row(s).map_or(NONE, |&row| supernode_of[row as usize]))
            .collect();
        let work = |s: usize| {
            let columns = factor.width(s) as u64;
            let rows = columns + factor.rows(s).len() as u64;
            columns * rows * rows + 2000
        };
        let work: Vec<u64> = (0..count).map(work).collect();
        Self::of_work(parent, &work)
    }

    /// The tree of supernodes with these parents and this work each.
    fn of_work(parent: Vec<u32>, work: &[u64]) -> Self {
        let (children, first_child) = children(&parent);
        let tasks = tasks(&parent, work.to_vec());
        let (waits, followers) = dependencies(&parent, &tasks);
        let of_task = |k: usize| work[tasks[k].clone()].iter().sum::<u64>();
        let least = SHARED.max(work.iter().sum::<u64>() / SHARED_PARTS);
        let mut is_shared = vec![false; tasks.len()];
        for k in 0..tasks.len() {
            is_shared[k] |= tasks[k].len() == 1 && of_task(k) >= least;
            if is_shared[k] {
                (followers[k].iter()).for_each(|&f| is_shared[f as usize] = true);
            }
        }
        let (shared, apart) = (0..tasks.len()).partition(|&k| is_shared[k]);
        AssemblyTree {
            apart: TaskGraph::new(apart, &followers, of_task),
            shared,
            parent,
            children,
            first_child,
            tasks,
            waits,
        }
    }

    pub fn parent(&self, s: usize) -> u32 {
        self.parent[s]
    }

    pub fn children(&self, s: usize) -> &[u32] {
        &self.children[self.first_child[s] as usize..self.first_child[s + 1] as usize]
    }

    pub fn tasks(&self) -> &[Range<usize>] {
        &self.tasks
    }

    /// How many tasks each one waits for.
    pub fn waits(&self) -> &[u32] {
        &self.waits
    }

    /// Does all tasks on the threads that are allowed, each after those that it needs. Every thread has its own
    /// `scratch`. The last tasks are done on the thread of the call, and may use all threads.
    ///
    /// # Errors
    /// The first error of a task or of `scratch`, and the reason to end the current step.
    pub fn work<S>(
        &self,
        scratch: impl Fn() -> Result<S> + Sync,
        task: impl Fn(&mut S, usize) -> Result<()> + Sync,
    ) -> Result<()> {
        if allowed_threads() <= 1 {
            let mut scratch = scratch()?;
            return (0..self.tasks.len()).try_for_each(|k| task(&mut scratch, k));
        }
        self.apart.work(&scratch, &task)?;
        if !self.shared.is_empty() {
            let mut scratch = scratch()?;
            (self.shared.iter()).try_for_each(|&k| task(&mut scratch, k))?;
        }
        Ok(())
    }
}

impl TaskGraph {
    /// Does the tasks on the threads that are allowed.
    fn work<S>(
        &self,
        scratch: &(impl Fn() -> Result<S> + Sync),
        task: &(impl Fn(&mut S, usize) -> Result<()> + Sync),
    ) -> Result<()> {
        let count = self.tasks.len();
        let threads = allowed_threads().min(count);
        if threads > 1 && is_simulated() {
            let mut scratch = scratch()?;
            let task = |k: usize| task(&mut scratch, self.tasks[k]);
            return simulate_graph(threads, &self.waits, &self.followers, task);
        }
        let first = (0..count).filter(|&k| self.waits[k] == 0);
        let queue = Queue {
            path: &self.path,
            state: Mutex::new(State {
                ready: first.map(|k| (self.path[k], k as u32)).collect(),
                waits: self.waits.clone(),
                left: count,
                error: None,
            }),
            changed: Condvar::new(),
        };
        in_parts(threads, 1, |_| {
            let panics = EndsByPanic(&queue);
            match scratch() {
                Err(error) => queue.end(error),
                Ok(mut scratch) => {
                    while let Some(k) = queue.take() {
                        match task(&mut scratch, self.tasks[k]) {
                            Ok(()) => queue.done(&self.followers[k]),
                            Err(error) => queue.end(error),
                        }
                    }
                }
            }
            std::mem::forget(panics);
        });
        let state = queue.state.into_inner();
        match state.unwrap_or_else(PoisonError::into_inner).error {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }
}

/// The tasks that are ready, and what ends them all.
struct Queue<'a> {
    path: &'a [u64],
    state: Mutex<State>,
    changed: Condvar,
}

struct State {
    /// By the longest path.
    ready: BinaryHeap<(u64, u32)>,
    waits: Vec<u32>,
    left: usize,
    error: Option<Error>,
}

impl Queue<'_> {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next task, or None if there is nothing left to do.
    fn take(&self) -> Option<usize> {
        let mut state = self.lock();
        loop {
            if state.left == 0 || state.error.is_some() {
                return None;
            }
            if let Some((_, k)) = state.ready.pop() {
                return Some(k as usize);
            }
            let waited = self.changed.wait(state);
            state = waited.unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn done(&self, followers: &[u32]) {
        let mut state = self.lock();
        state.left -= 1;
        for &k in followers {
            state.waits[k as usize] -= 1;
            if state.waits[k as usize] == 0 {
                state.ready.push((self.path[k as usize], k));
            }
        }
        self.changed.notify_all();
    }

    fn end(&self, error: Error) {
        self.lock().error.get_or_insert(error);
        self.changed.notify_all();
    }
}

/// Ends the work of all threads if one panics, so that none waits for it.
struct EndsByPanic<'a>(&'a Queue<'a>);

impl Drop for EndsByPanic<'_> {
    fn drop(&mut self) {
        self.0.end(Error::Cancelled);
    }
}

fn children(parent: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut first = vec![0u32; parent.len() + 1];
    for &p in parent.iter().filter(|&&p| p != NONE) {
        first[p as usize + 1] += 1;
    }
    for s in 0..parent.len() {
        first[s + 1] += first[s];
    }
    let mut next = first.clone();
    let mut children = vec![0; first[parent.len()] as usize];
    for (s, &p) in parent.iter().enumerate().filter(|(_, p)| **p != NONE) {
        children[next[p as usize] as usize] = s as u32;
        next[p as usize] += 1;
    }
    (children, first)
}

/// Divides the supernodes into subtrees, neighbours together while they are small, and what is above them.
fn tasks(parent: &[u32], mut work: Vec<u64>) -> Vec<Range<usize>> {
    let limit = work.iter().sum::<u64>() / PARTS;
    // Of each subtree: its work, its first supernode, and how many it has.
    let mut first: Vec<usize> = (0..parent.len()).collect();
    let mut size = vec![1; parent.len()];
    for (s, &p) in parent.iter().enumerate().filter(|(_, p)| **p != NONE) {
        let p = p as usize;
        work[p] += work[s];
        first[p] = first[p].min(first[s]);
        size[p] += size[s];
    }
    let mut tasks: Vec<(Range<usize>, u64)> = Vec::new();
    let mut end = parent.len();
    while end > 0 {
        let root = end - 1;
        let is_subtree = work[root] <= limit && end - first[root] == size[root];
        let start = if is_subtree { first[root] } else { root };
        let joined = tasks.last_mut().filter(|(_, w)| w + work[root] <= limit);
        match joined {
            Some((range, sum)) => {
                range.start = start;
                *sum += work[root];
            }
            None => tasks.push((
                start..end,
                if is_subtree { work[root] } else { u64::MAX / 2 },
            )),
        }
        end = start;
    }
    tasks.into_iter().rev().map(|(range, _)| range).collect()
}

fn dependencies(parent: &[u32], tasks: &[Range<usize>]) -> (Vec<u32>, Vec<Vec<u32>>) {
    let mut task_of = vec![0u32; parent.len()];
    for (k, range) in tasks.iter().enumerate() {
        task_of[range.clone()].fill(k as u32);
    }
    let mut waits = vec![0; tasks.len()];
    let followers = tasks.iter().enumerate().map(|(k, range)| {
        let parents = parent[range.clone()].iter().filter(|&&p| p != NONE);
        let mut followers: Vec<u32> = parents.map(|&p| task_of[p as usize]).collect();
        followers.retain(|&f| f as usize != k);
        followers.sort_unstable();
        followers.dedup();
        followers.iter().for_each(|&f| waits[f as usize] += 1);
        followers
    });
    let followers = followers.collect();
    (waits, followers)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering::SeqCst};

    use super::*;
    use crate::monitor::{CancelToken, Monitor, may_continue, with_threads};

    /// A tree of supernodes with the given parents, each of the same work.
    fn tree(parent: Vec<u32>) -> AssemblyTree {
        let work = vec![1000; parent.len()];
        AssemblyTree::of_work(parent, &work)
    }

    /// A complete binary tree in post-order.
    fn binary(depth: u32) -> AssemblyTree {
        fn subtree(depth: u32, parent: &mut Vec<u32>) -> usize {
            let below = (0..2).filter(|_| depth > 0);
            let roots: Vec<usize> = below.map(|_| subtree(depth - 1, parent)).collect();
            let root = parent.len();
            roots.into_iter().for_each(|c| parent[c] = root as u32);
            parent.push(NONE);
            root
        }
        let mut parent = Vec::new();
        subtree(depth, &mut parent);
        tree(parent)
    }

    #[test]
    fn tasks_cover_all_supernodes_and_come_after_what_they_need() {
        // A post-ordered tree, one chain, roots alone, and children in no order.
        let shuffled = (0..300u32)
            .map(|s| (s + 1 + s * 7 % 50).min(300))
            .chain([NONE]);
        let chain = (1..300).chain([NONE]);
        let alone = vec![NONE; 300];
        for tree in [
            binary(9),
            binary_with_large_top(9),
            tree(chain.collect()),
            tree(alone),
            tree(shuffled.collect()),
        ] {
            let all: Vec<usize> = tree.tasks.iter().cloned().flatten().collect();
            assert_eq!(all, (0..tree.parent.len()).collect::<Vec<_>>());
            assert!(tree.tasks.len() >= PARTS as usize / 2);
            for threads in [1, 3, 8] {
                let done: Vec<AtomicUsize> = all.iter().map(|_| AtomicUsize::new(0)).collect();
                let task = |_: &mut (), k: usize| {
                    for s in tree.tasks[k].clone() {
                        let is_done = |&c: &u32| done[c as usize].load(SeqCst) == 1;
                        assert!(tree.children(s).iter().all(is_done));
                        done[s].fetch_add(1, SeqCst);
                    }
                    Ok(())
                };
                with_threads(threads, || tree.work(|| Ok(()), task)).unwrap();
                assert!(done.iter().all(|d| d.load(SeqCst) == 1));
            }
        }
    }

    /// The same, where the last 20 supernodes of the order, not all of which are near the root, take most of the work.
    fn binary_with_large_top(depth: u32) -> AssemblyTree {
        let parent = binary(depth).parent;
        let first = parent.len() - 20;
        let work: Vec<u64> = (0..parent.len())
            .map(|s| if s < first { 1000 } else { SHARED })
            .collect();
        AssemblyTree::of_work(parent, &work)
    }

    #[test]
    fn all_threads_share_the_large_tasks_and_those_that_wait_for_them() {
        assert!(binary(9).shared.is_empty());
        let tree = binary_with_large_top(9);
        assert!(tree.shared.len() >= 20 && !tree.apart.tasks.is_empty());
        let shared: Vec<usize> = tree.shared.iter().map(|&k| tree.tasks[k].start).collect();
        for &s in &shared {
            let parent = tree.parent(s);
            assert!(parent == NONE || shared.contains(&(parent as usize)));
        }
        let task = |_: &mut (), k: usize| {
            assert!(!tree.shared.contains(&k) || allowed_threads() == 3);
            Ok(())
        };
        with_threads(3, || tree.work(|| Ok(()), task)).unwrap();
    }

    #[test]
    fn an_error_ends_all_tasks() {
        let tree = binary(9);
        for threads in [1, 4] {
            let after = AtomicUsize::new(0);
            let last = tree.tasks.len() - 1;
            let task = |_: &mut (), k: usize| match k {
                3 => Err(Error::TimeLimit),
                k => {
                    after.fetch_add(usize::from(k == last), SeqCst);
                    Ok(())
                }
            };
            let ends = with_threads(threads, || tree.work(|| Ok(()), task));
            assert_eq!(ends, Err(Error::TimeLimit));
            assert_eq!(after.load(SeqCst), 0);
        }
    }

    #[test]
    fn a_token_ends_the_tasks_in_their_middle() {
        let tree = binary(9);
        for threads in [1, 4] {
            let token = CancelToken::new();
            let begun = AtomicUsize::new(0);
            let task = |_: &mut (), k: usize| {
                begun.fetch_add(1, SeqCst);
                if k == 3 {
                    token.cancel();
                }
                Ok(may_continue()?)
            };
            let monitor = Monitor::default().cancel_token(token.clone());
            let work = || with_threads(threads, || tree.work(|| Ok(()), task));
            assert_eq!(monitor.watching(work), Err(Error::Cancelled));
            assert!(begun.load(SeqCst) < tree.tasks.len());
        }
    }

    #[test]
    #[should_panic(expected = "a task that panics")]
    fn no_thread_waits_for_a_task_that_panics() {
        let tree = binary(9);
        let task = |_: &mut (), k: usize| match k {
            3 => panic!("a task that panics"),
            _ => Ok(()),
        };
        let _ = with_threads(4, || tree.work(|| Ok(()), task));
    }
}
