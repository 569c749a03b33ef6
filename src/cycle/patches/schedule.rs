//! Bounds and lists of all patches, from the leaves upward, in rounds of growing limits.
//!
//! `list(P, T)`, the charges of patch P with energy at most T, needs only `list(A, T - bound(B))` and
//! `list(B, T - bound(A))` of its children A and B, where the bound of a patch is the least energy in its
//! list, or T if that is empty. A patch's cap is the incumbent's energy less the bounds of all patches
//! beside its ancestors and itself. Beyond its cap, no entry is part of a better solution. So the bound of
//! the root holds at any moment, and the first list of the root that is not empty holds the optimum.
//!
//! In each round the thresholds of all patches rise, the small patches' first, until their lists are no
//! longer empty or exceed the limits. Without the rounds, one hard patch would take all the time.

use super::conditions::Conditions;
use super::dissect::NO_PATCH;
use super::join::{Limits, Overflow, Targets, enumerate, join};
use super::list::{List, PatchData};
use super::local::dot;
use super::tree::PatchTree;
use crate::monitor::{is_room_for, room_up_to, span};

/// The largest number of entries of a list, by round.
const ENTRIES: [usize; 7] = [300, 2_000, 10_000, 40_000, 150_000, 500_000, 1_500_000];

/// Conditions of optimality drop most entries, so this many times more are enumerated.
const RAW: usize = 4;

/// While a list is made, its entries take so many times their memory: as they are found, valued and sorted.
const MADE: usize = 4;

/// The multiplications for one list, for each entry of the limit.
const WORK_PER_ENTRY: u64 = 40_000;

/// The first rise of a threshold, in squared steps times weight.
const FIRST: f64 = 0.008;

/// The growth of the rises.
const GROWTH: f64 = 1.5;

/// The memory of all lists, in bytes.
const MEMORY: usize = 1 << 30;

/// What a proof tells, and asks, while it goes on.
pub(super) trait Watch {
    /// Counts multiplications. Returns whether to end.
    fn ends(&mut self, work: u64) -> bool;
    /// The nodes that may still be visited.
    fn nodes(&self) -> u64;
    /// Counts nodes.
    fn visited(&mut self, nodes: u64);
    /// No charges have less energy.
    fn raised(&mut self, bound: f64);
}

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
    /// The patches whose bounds have changed since those above them were updated.
    changed: Vec<usize>,
    bytes: usize,
    round: usize,
    entries: usize,
}

#[derive(Debug, Clone, Default)]
struct State {
    bound: f64,
    /// The list is complete up to this threshold, which is negative without a list.
    threshold: f64,
    /// A threshold at which the list overflowed in this round.
    overflow: f64,
    list: List,
}

impl<'a> Rounds<'a> {
    /// A proof about the charges with energy at most `cap`. `unit` is the squared step times a typical
    /// weight.
    pub fn new(tree: &'a PatchTree, cap: f64, unit: f64) -> Self {
        let mut order: Vec<usize> = (0..tree.patches.len()).collect();
        order.sort_by_key(|&at| (tree.cycles[at], at));
        let state = State {
            threshold: -1.0,
            ..State::default()
        };
        Rounds {
            cap,
            rise: FIRST * unit,
            order,
            state: vec![state; tree.patches.len()],
            changed: Vec::new(),
            bytes: 0,
            round: 0,
            entries: 0,
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
        self.entries = ENTRIES[ENTRIES.len() - 1];
        self.spread();
        let most = threshold.min(self.cap);
        self.ensure(self.tree.root(), most, watch).is_ok()
    }

    /// Runs rounds up to the one numbered `last`.
    pub fn run(&mut self, last: usize, watch: &mut dyn Watch) -> Standing {
        while self.round < ENTRIES.len().min(last) {
            self.entries = ENTRIES[self.round];
            for state in &mut self.state {
                state.overflow = f64::INFINITY;
            }
            for k in 0..self.order.len() {
                let at = self.order[k];
                let before = self.bound();
                let ended = self.raise(at, watch);
                self.spread();
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

    fn is_decided(&self) -> bool {
        let root = &self.state[self.tree.root()];
        root.list.len() > 0 || root.bound >= self.cap
    }

    /// Raises the threshold of a patch until its list is not empty, or it reaches the cap or the limits.
    /// Returns whether the watch ended it.
    fn raise(&mut self, at: usize, watch: &mut dyn Watch) -> bool {
        let mut rise = self.rise;
        loop {
            self.spread();
            let (state, cap) = (&self.state[at], self.cap(at));
            if state.list.len() > 0 || state.threshold >= cap {
                return false;
            }
            let threshold = (state.bound + rise).min(cap);
            match self.ensure(at, threshold, watch) {
                Err(Overflow::Ended) => return true,
                Err(Overflow::Full) => return false,
                Ok(()) => {}
            }
            rise *= GROWTH;
        }
    }

    /// Updates the bounds of all patches above those whose bounds have changed.
    fn spread(&mut self) {
        for at in std::mem::take(&mut self.changed) {
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
    }

    /// The cap of a patch.
    fn cap(&self, at: usize) -> f64 {
        match self.tree.sibling(at) {
            None => self.cap,
            Some(other) => self.cap(self.tree.patches[at].parent) - self.state[other].bound,
        }
    }

    /// Completes the list of a patch up to a threshold.
    fn ensure(&mut self, at: usize, threshold: f64, watch: &mut dyn Watch) -> Result<(), Overflow> {
        if self.state[at].threshold >= threshold {
            return Ok(());
        }
        if threshold >= self.state[at].overflow {
            return Err(Overflow::Full);
        }
        let made = self.make(at, threshold, watch);
        let list = match made {
            Ok(list) => list,
            Err(why) => {
                if why == Overflow::Full {
                    self.state[at].overflow = threshold;
                }
                return Err(why);
            }
        };
        let data = self.data(at);
        let (before, after) = (
            data.bytes(self.state[at].list.len()),
            data.bytes(list.len()),
        );
        self.bytes = self.bytes - before + after;
        let state = &mut self.state[at];
        let least = list.worth.first().copied().unwrap_or(threshold);
        state.bound = state.bound.max(least.min(threshold));
        self.changed.push(at);
        (state.list, state.threshold) = (list, threshold);
        Ok(())
    }

    fn make(&mut self, at: usize, threshold: f64, watch: &mut dyn Watch) -> Result<List, Overflow> {
        let tree = self.tree;
        let (front, local) = (&tree.fronts[at], &tree.locals[at]);
        let held = self.data(at).bytes(1);
        let room = MEMORY.saturating_sub(self.bytes) / held;
        let entries = room_up_to((RAW * self.entries).min(room), MADE * held);
        let work = self.entries as u64 * WORK_PER_ENTRY;
        let Some([a, b]) = self.tree.patches[at].children else {
            let mut limits = Limits {
                entries,
                work,
                nodes: watch.nodes(),
                stop: &mut |work, nodes| {
                    watch.visited(nodes);
                    watch.ends(work)
                },
            };
            let _leaf = span("leaf");
            let found = enumerate(local, threshold, &mut limits)?;
            let list = List::new(&found, threshold, &self.data(at), &[]);
            return self.within_limit(list);
        };
        self.ensure(a, threshold - self.state[b].bound, watch)?;
        self.ensure(b, threshold - self.state[a].bound, watch)?;
        let bounds = [a, b].map(|c| self.state[c].bound);
        let targets = [0, 1].map(|k| {
            let child = [a, b][k];
            self.targets(at, k, child, threshold - bounds[1 - k])
        });
        let prepared: usize = targets.iter().map(|t| t.image.len()).sum();
        if watch.ends(prepared as u64 * 8) {
            return Err(Overflow::Ended);
        }
        let mut limits = Limits {
            entries,
            work,
            nodes: watch.nodes(),
            stop: &mut |work, nodes| {
                watch.visited(nodes);
                watch.ends(work)
            },
        };
        let both = [&targets[0], &targets[1]];
        let joined = span("join");
        let found = join(local, both, threshold, &mut limits)?;
        drop(joined);
        let tested = self.conditions[at]
            .as_ref()
            .map_or(0, |c| c.len() * (local.own + 16));
        let each = local.own * local.own + front.below.len() + front.above.len() + tested;
        if watch.ends((found.energy.len() * each) as u64) {
            return Err(Overflow::Ended);
        }
        if !is_room_for(found.energy.len(), MADE * held) {
            return Err(Overflow::Full);
        }
        let lists = [&self.state[a].list, &self.state[b].list];
        let _list = span("list");
        let list = List::new(&found, threshold, &self.data(at), &lists);
        self.within_limit(list)
    }

    fn within_limit(&self, list: List) -> Result<List, Overflow> {
        match list.len() > self.entries {
            true => Err(Overflow::Full),
            false => Ok(list),
        }
    }

    fn data(&self, at: usize) -> PatchData<'_> {
        let parent = self.tree.patches[at].parent;
        PatchData {
            front: &self.tree.fronts[at],
            local: &self.tree.locals[at],
            conditions: self.conditions[at].as_ref(),
            passes_flows: parent != NO_PATCH && self.conditions[parent].is_some(),
        }
    }

    /// The entries of a child up to a threshold, as targets of the patch.
    fn targets(&self, at: usize, place: usize, child: usize, threshold: f64) -> Targets {
        let local = &self.tree.locals[at];
        let n = local.own;
        let list = &self.state[child].list;
        let count = list.worth.partition_point(|&e| e <= threshold);
        let places = &self.tree.fronts[at].places[place];
        let width = places.len();
        let own = places.partition_point(|&p| (p as usize) < n);
        // The columns of M that the child sends to, by rows.
        let columns: Vec<f64> = (0..n)
            .flat_map(|i| {
                places[..own]
                    .iter()
                    .map(move |&p| local.map[i * n + p as usize])
            })
            .collect();
        let mut image = vec![0.0; count * n];
        for (k, image) in image.chunks_exact_mut(n.max(1)).enumerate() {
            let sent = &list.sent[k * width..k * width + own];
            for (i, value) in image.iter_mut().enumerate() {
                *value = dot(&columns[i * own..(i + 1) * own], sent);
            }
        }
        Targets {
            worth: list.worth[..count].to_vec(),
            energy: list.energy[..count].to_vec(),
            image,
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
