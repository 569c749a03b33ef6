//! The lists of a patch and of all patches below it, which change together.

use std::sync::{Mutex, PoisonError};

use super::conditions::Conditions;
use super::dissect::NO_PATCH;
use super::join::{Limits, Overflow, Targets, enumerate, join};
use super::list::{List, PatchData};
use super::local::dot;
use super::tree::PatchTree;
use super::watch::Watch;
use crate::monitor::{is_room_for, room_up_to, span};

/// Conditions of optimality drop most entries, so this many times more are enumerated.
const RAW: usize = 4;

/// While a list is made, its entries take so many times their memory: as they are found, valued and sorted.
const MADE: usize = 4;

/// The multiplications for one list, for each entry of the limit.
const WORK_PER_ENTRY: u64 = 40_000;

/// Lists of both children of a patch that have so many entries grow at the same time.
const WORTH_A_THREAD: usize = 500;

/// The growth of the rises.
const GROWTH: f64 = 1.5;

/// The state of a patch.
#[derive(Debug, Clone)]
pub(super) struct State {
    /// No charges of the patch have less energy.
    pub bound: f64,
    /// The list is complete up to this threshold, which is negative without a list.
    pub threshold: f64,
    /// A threshold at which the list overflowed in this round.
    pub overflow: f64,
    pub list: List,
}

impl Default for State {
    fn default() -> Self {
        State {
            bound: 0.0,
            threshold: -1.0,
            overflow: f64::INFINITY,
            list: List::default(),
        }
    }
}

/// A patch with all below it.
pub(super) struct Subtree<'t, 's> {
    tree: &'t PatchTree,
    conditions: &'t [Option<Conditions>],
    /// The number of the first patch.
    first: usize,
    states: &'s mut [State],
    /// The patches whose bounds have changed since those above them were updated.
    changed: Vec<usize>,
    /// The most entries of a list.
    entries: usize,
    /// The memory that lists may take besides those that there are, in bytes.
    room: isize,
    /// The memory that they take less than at first.
    freed: isize,
}

impl<'t, 's> Subtree<'t, 's> {
    /// The patches of `states`, whose first one has the number `first`.
    pub fn new(
        tree: &'t PatchTree,
        conditions: &'t [Option<Conditions>],
        (first, states): (usize, &'s mut [State]),
        entries: usize,
        room: usize,
    ) -> Self {
        Subtree {
            tree,
            conditions,
            first,
            states,
            changed: Vec::new(),
            entries,
            room: isize::try_from(room).unwrap_or(isize::MAX),
            freed: 0,
        }
    }

    /// The memory that the lists take less than at first, in bytes.
    pub fn freed(&self) -> isize {
        self.freed
    }

    /// The patch of which all others are parts.
    fn top(&self) -> usize {
        self.first + self.states.len() - 1
    }

    fn state(&self, at: usize) -> &State {
        &self.states[at - self.first]
    }

    /// Raises the threshold of the patch until its list is not empty, or it reaches the cap or the limits. The first
    /// rise is `rise`. Returns whether the watch ended it.
    pub fn raise(&mut self, mut rise: f64, cap: f64, watch: &mut dyn Watch) -> bool {
        let top = self.top();
        loop {
            let state = self.state(top);
            if state.list.len() > 0 || state.threshold >= cap {
                return false;
            }
            let threshold = (state.bound + rise).min(cap);
            let ensured = self.ensure(top, threshold, watch);
            self.spread();
            match ensured {
                Err(Overflow::Ended) => return true,
                Err(Overflow::Full) => return false,
                Ok(()) => {}
            }
            rise *= GROWTH;
        }
    }

    /// Completes the list of the patch up to a threshold.
    pub fn complete(&mut self, threshold: f64, watch: &mut dyn Watch) -> Result<(), Overflow> {
        self.ensure(self.top(), threshold, watch)
    }

    /// Updates the bounds of all patches above those whose bounds have changed.
    fn spread(&mut self) {
        for mut at in std::mem::take(&mut self.changed) {
            while at != self.top() {
                let parent = self.tree.patches[at].parent;
                let children = self.tree.patches[parent].children.iter().flatten();
                let sum = children.map(|&child| self.state(child).bound).sum();
                let bound = &mut self.states[parent - self.first].bound;
                if *bound >= sum {
                    break;
                }
                *bound = sum;
                at = parent;
            }
        }
    }

    /// Completes the list of a patch up to a threshold.
    fn ensure(&mut self, at: usize, threshold: f64, watch: &mut dyn Watch) -> Result<(), Overflow> {
        if self.state(at).threshold >= threshold {
            return Ok(());
        }
        if threshold >= self.state(at).overflow {
            return Err(Overflow::Full);
        }
        let made = self.make(at, threshold, watch);
        let list = match made {
            Ok(list) => list,
            Err(why) => {
                if why == Overflow::Full {
                    self.states[at - self.first].overflow = threshold;
                }
                return Err(why);
            }
        };
        let data = self.data(at);
        let (before, after) = (
            data.bytes(self.state(at).list.len()),
            data.bytes(list.len()),
        );
        self.freed += before as isize - after as isize;
        let state = &mut self.states[at - self.first];
        let least = list.worth.first().copied().unwrap_or(threshold);
        state.bound = state.bound.max(least.min(threshold));
        self.changed.push(at);
        (state.list, state.threshold) = (list, threshold);
        Ok(())
    }

    /// Completes the lists of both children of a patch as far as its own list up to a threshold needs them.
    fn ensure_both(
        &mut self,
        [a, b]: [usize; 2],
        threshold: f64,
        watch: &mut dyn Watch,
    ) -> Result<(), Overflow> {
        let limits = [b, a].map(|other| threshold - self.state(other).bound);
        // The list of the first child can raise its bound, which the second one needs, only while it is empty.
        let is_settled = self.state(a).list.len() > 0;
        let is_long = |(at, limit)| {
            let state = self.state(at);
            state.list.len() >= WORTH_A_THREAD && state.threshold < limit && limit < state.overflow
        };
        let at_once = is_settled && watch.nodes() == u64::MAX;
        if !(at_once && is_long((a, limits[0])) && is_long((b, limits[1]))) {
            self.ensure(a, limits[0], watch)?;
            return self.ensure(b, threshold - self.state(a).bound, watch);
        }
        let room = (self.room + self.freed).max(0) as usize / 2;
        let begin = self.tree.first[a];
        let states = &mut self.states[begin - self.first..=b - self.first];
        let (of_a, of_b) = states.split_at_mut(a + 1 - begin);
        let subtrees = [(begin, of_a), (a + 1, of_b)].map(|states| {
            let subtree = Subtree::new(self.tree, self.conditions, states, self.entries, room);
            Mutex::new((subtree, Ok(())))
        });
        let ended = watch.at_once(2, &|k, watch| {
            let mut both = subtrees[k].lock().unwrap_or_else(PoisonError::into_inner);
            both.1 = both.0.complete(limits[k], watch);
            both.1 == Err(Overflow::Ended)
        });
        let done = subtrees.map(|both| both.into_inner().unwrap_or_else(PoisonError::into_inner));
        let found = done.map(|(subtree, result)| (subtree.freed, subtree.changed, result));
        for (freed, changed, _) in &found {
            self.freed += freed;
            self.changed.extend(changed);
        }
        if ended {
            return Err(Overflow::Ended);
        }
        found.into_iter().try_for_each(|(_, _, result)| result)
    }

    fn make(&mut self, at: usize, threshold: f64, watch: &mut dyn Watch) -> Result<List, Overflow> {
        let tree = self.tree;
        let (front, local) = (&tree.fronts[at], &tree.locals[at]);
        let held = self.data(at).bytes(1);
        let room = (self.room + self.freed).max(0) as usize / held;
        let entries = room_up_to((RAW * self.entries).min(room), MADE * held);
        let work = self.entries as u64 * WORK_PER_ENTRY;
        let Some([a, b]) = self.tree.patches[at].children else {
            let mut limits = Limits {
                entries,
                work,
                watch,
            };
            let _leaf = span("leaf");
            let found = enumerate(local, threshold, &mut limits)?;
            let list = List::new(&found, threshold, &self.data(at), &[]);
            return self.within_limit(list);
        };
        self.ensure_both([a, b], threshold, watch)?;
        let bounds = [a, b].map(|c| self.state(c).bound);
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
            watch,
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
        let lists = [&self.state(a).list, &self.state(b).list];
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
        let list = &self.state(child).list;
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
}
