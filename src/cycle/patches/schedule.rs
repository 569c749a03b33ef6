//! Bounds and lists of all patches, from the leaves upward, in rounds of growing limits.
//!
//! `list(P, T)`, the charges of patch P with energy at most T, needs only `list(A, T - bound(B))` and
//! `list(B, T - bound(A))` of its children A and B, where the bound of a patch is the least energy in its
//! list, or T if that is empty. A patch's cap is the incumbent's energy less the bounds of all patches
//! beside its ancestors and itself. Beyond its cap, no entry is part of a better solution. So the bound of
//! the root holds at any moment, and the first list of the root that is not empty holds the optimum.
//!
//! In each round the thresholds of all patches rise, the small patches' first, until their lists are no
//! longer empty or exceed the limits. Without the rounds, one hard patch would take all the time. Some patches at a
//! time, of which none is part of another, rise at once, with caps and limits from before.

use std::sync::{Mutex, PoisonError};

use super::conditions::Conditions;
use super::dissect::NO_PATCH;
use super::local::dot;
use super::subtree::{State, Subtree};
use super::tree::PatchTree;
use super::watch::Watch;

/// The largest number of entries of a list, by round.
const ENTRIES: [usize; 7] = [300, 2_000, 10_000, 40_000, 150_000, 500_000, 1_500_000];

/// The first rise of a threshold, in squared steps times weight.
const FIRST: f64 = 0.008;

/// The memory of all lists, in bytes.
const MEMORY: usize = 1 << 30;

/// The most patches that rise at once.
const AT_ONCE: usize = 16;

/// How a proof stands after some rounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Standing {
    /// The root's list is complete up to its threshold and not empty, or up to the cap and empty.
    Decided,
    /// The watch ended it.
    Ended,
    /// All rounds are over.
    Open,
}

/// The state of a proof.
#[derive(Debug)]
pub(super) struct Rounds<'a> {
    tree: &'a PatchTree,
    conditions: Vec<Option<Conditions>>,
    /// The threshold above which energies do not matter.
    cap: f64,
    rise: f64,
    order: Vec<usize>,
    state: Vec<State>,
    /// The memory that lists may still take, in bytes.
    room: usize,
    round: usize,
}

impl<'a> Rounds<'a> {
    /// A proof about the charges with energy at most `cap`. `unit` is the squared step times a typical
    /// weight.
    pub fn new(tree: &'a PatchTree, cap: f64, unit: f64) -> Self {
        let mut order: Vec<usize> = (0..tree.patches.len()).collect();
        order.sort_by_key(|&at| (tree.cycles[at], at));
        Rounds {
            cap,
            rise: FIRST * unit,
            order,
            state: vec![State::default(); tree.patches.len()],
            room: MEMORY,
            round: 0,
            conditions: vec![None; tree.patches.len()],
            tree,
        }
    }

    /// Drops charges that violate these conditions. No list exists yet.
    pub fn hold(&mut self, conditions: Vec<Option<Conditions>>) {
        self.conditions = conditions;
    }

    /// The bound of the root.
    pub fn bound(&self) -> f64 {
        self.state[self.tree.root()].bound
    }

    /// What the entries of the root's list are worth.
    pub fn root_energies(&self) -> &[f64] {
        &self.state[self.tree.root()].list.worth
    }

    /// Completes the root's list up to `threshold`, or the cap.
    pub fn complete(&mut self, threshold: f64, watch: &mut dyn Watch) -> bool {
        let entries = ENTRIES[ENTRIES.len() - 1];
        let most = threshold.min(self.cap);
        let all = (0, &mut self.state[..]);
        let mut tree = Subtree::new(self.tree, &self.conditions, all, entries, self.room);
        tree.complete(most, watch).is_ok()
    }

    /// Runs rounds up to the one numbered `last`.
    pub fn run(&mut self, last: usize, watch: &mut dyn Watch) -> Standing {
        while self.round < ENTRIES.len().min(last) {
            for state in &mut self.state {
                state.overflow = f64::INFINITY;
            }
            let mut next = 0;
            while next < self.order.len() {
                // The nodes of a proof that may visit so many are counted list by list.
                let most = if watch.nodes() == u64::MAX {
                    AT_ONCE
                } else {
                    1
                };
                let patches = self.rising(&mut next, most);
                let before = self.bound();
                let ended = self.raise(&patches, watch);
                patches.iter().for_each(|&at| self.spread(at));
                if self.bound() > before {
                    watch.raised(self.bound());
                }
                if self.is_decided() {
                    return Standing::Decided;
                }
                if ended {
                    return Standing::Ended;
                }
            }
            self.round += 1;
        }
        Standing::Open
    }

    /// The patches that rise next, at most so many, from place `next` in the order on. None is part of another.
    fn rising(&self, next: &mut usize, most: usize) -> Vec<usize> {
        let mut patches: Vec<usize> = Vec::new();
        while let Some(&at) = self.order.get(*next) {
            let has_part = |part: &usize| (self.tree.first[at]..=at).contains(part);
            if patches.len() == most || patches.iter().any(has_part) {
                break;
            }
            let state = &self.state[at];
            if state.list.len() == 0 && state.threshold < self.cap(at) {
                patches.push(at);
            }
            *next += 1;
        }
        patches
    }

    /// Raises the thresholds of patches. Returns whether the watch ended it.
    fn raise(&mut self, patches: &[usize], watch: &mut dyn Watch) -> bool {
        let caps: Vec<f64> = patches.iter().map(|&at| self.cap(at)).collect();
        let (rise, entries) = (self.rise, ENTRIES[self.round]);
        let room = self.room / patches.len().max(1);
        let mut parts: Vec<usize> = (0..patches.len()).collect();
        parts.sort_unstable_by_key(|&k| patches[k]);
        let mut subtrees: Vec<Option<Mutex<Subtree>>> = patches.iter().map(|_| None).collect();
        let (mut rest, mut done) = (&mut self.state[..], 0);
        for k in parts {
            let (first, after) = (self.tree.first[patches[k]], patches[k] + 1);
            let (states, others) =
                std::mem::take(&mut rest)[first - done..].split_at_mut(after - first);
            (rest, done) = (others, after);
            let subtree = Subtree::new(self.tree, &self.conditions, (first, states), entries, room);
            subtrees[k] = Some(Mutex::new(subtree));
        }
        let subtrees: Vec<Mutex<Subtree>> = subtrees.into_iter().flatten().collect();
        let raise = |k: usize, watch: &mut dyn Watch| {
            let mut subtree = subtrees[k].lock().unwrap_or_else(PoisonError::into_inner);
            subtree.raise(rise, caps[k], watch)
        };
        let ended = match patches.len() {
            0 => false,
            1 => raise(0, watch),
            count => watch.at_once(count, &|k, watch| raise(k, watch)),
        };
        for subtree in subtrees {
            let subtree = subtree.into_inner().unwrap_or_else(PoisonError::into_inner);
            self.room = self.room.saturating_add_signed(subtree.freed());
        }
        ended
    }

    fn is_decided(&self) -> bool {
        let root = &self.state[self.tree.root()];
        root.list.len() > 0 || root.bound >= self.cap
    }

    /// Updates the bounds of all patches above one.
    fn spread(&mut self, at: usize) {
        let mut parent = self.tree.patches[at].parent;
        while parent != NO_PATCH {
            let children = self.tree.patches[parent].children.iter().flatten();
            let sum = children.map(|&child| self.state[child].bound).sum();
            if self.state[parent].bound >= sum {
                break;
            }
            self.state[parent].bound = sum;
            parent = self.tree.patches[parent].parent;
        }
    }

    /// The cap of a patch.
    fn cap(&self, at: usize) -> f64 {
        match self.tree.sibling(at) {
            None => self.cap,
            Some(other) => self.cap(self.tree.patches[at].parent) - self.state[other].bound,
        }
    }

    /// The charges of entry `k` of the root's list.
    pub fn charges(&self, k: usize) -> Vec<f64> {
        let mut charges = vec![0.0; self.tree.basis.len()];
        let mut open = vec![(self.tree.root(), k)];
        while let Some((at, k)) = open.pop() {
            let (local, list) = (&self.tree.locals[at], &self.state[at].list);
            let n = local.own;
            let steps: Vec<f64> = list.steps[k * n..(k + 1) * n]
                .iter()
                .map(|&z| z.into())
                .collect();
            let own = &mut charges[self.tree.basis.own[at].clone()];
            for (i, charge) in own.iter_mut().enumerate() {
                *charge = dot(&local.charges[i * n..(i + 1) * n], &steps);
            }
            if let Some(children) = self.tree.patches[at].children {
                let from = list.from[k].map(|j| j as usize);
                open.extend(children.into_iter().zip(from));
            }
        }
        charges
    }
}
