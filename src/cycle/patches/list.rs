//! The list of a patch: all charges of its cycles whose energy in the patch is at most a threshold.

use std::ops::Range;

use super::conditions::Conditions;
use super::factor::Front;
use super::local::{Local, dot};
use crate::monitor::{for_each_part, parts_of, sort_in_parts_by};

/// The least number of multiplications for which entries are divided among threads: they take about half a
/// millisecond.
const WORTH_A_THREAD: usize = 1 << 19;

/// The least number of entries to sort, and that of values to copy, for which another thread is worth it.
const SORTED: usize = 1 << 13;
const COPIED: usize = 1 << 18;

/// The charges of a patch, sorted by what they are worth. An entry refers to entries of the children's
/// lists. These are sorted in the same way however far they go, so the references stay valid when a list
/// grows.
#[derive(Debug, Clone, Default)]
pub(super) struct List {
    /// A lower bound on the energy in the patch of any optimum with these charges.
    pub worth: Vec<f64>,
    pub energy: Vec<f64>,
    pub from: Vec<[u32; 2]>,
    /// By entry: the own charges in the reduced basis.
    pub steps: Vec<i32>,
    /// By entry: what the patch sends to each of the ancestors' cycles that meet it.
    pub sent: Vec<f64>,
    /// By entry: the flows of all edges of the patch, if its parent needs them.
    pub flows: Vec<f32>,
}

/// Entries that are not yet sorted.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub energy: Vec<f64>,
    pub from: Vec<[u32; 2]>,
    pub steps: Vec<i32>,
}

impl Found {
    pub fn push(&mut self, energy: f64, from: [u32; 2], steps: &[f64]) {
        self.energy.push(energy);
        self.from.push(from);
        self.steps.extend(steps.iter().map(|&z| z as i32));
    }

    pub fn extend(&mut self, other: Found) {
        self.energy.extend(other.energy);
        self.from.extend(other.from);
        self.steps.extend(other.steps);
    }
}

impl List {
    pub fn len(&self) -> usize {
        self.energy.len()
    }

    /// The entries worth at most `threshold`, sorted, with what they send.
    pub fn new(found: &Found, threshold: f64, patch: &PatchData, children: &[&List]) -> Self {
        let (front, local) = (patch.front, patch.local);
        let n = local.own;
        let (worth, flows) = patch.worths(found, children);
        let kept = (0..found.energy.len() as u32).filter(|&k| worth[k as usize] <= threshold);
        let mut order: Vec<u32> = kept.collect();
        let steps = |k: u32| &found.steps[k as usize * n..][..n];
        sort_in_parts_by(&mut order, SORTED, |&a, &b| {
            let (i, j) = (a as usize, b as usize);
            (worth[i].total_cmp(&worth[j]))
                .then_with(|| found.from[i].cmp(&found.from[j]))
                .then_with(|| steps(a).cmp(steps(b)))
        });
        let width = front.above.len();
        let mut list = List {
            worth: order.iter().map(|&k| worth[k as usize]).collect(),
            energy: order.iter().map(|&k| found.energy[k as usize]).collect(),
            from: order.iter().map(|&k| found.from[k as usize]).collect(),
            steps: in_order(&order, &found.steps, n),
            sent: Vec::new(),
            flows: in_order(&order, &flows, patch.kept_flows()),
        };
        drop(flows);
        let sent = |first: usize, sent: &mut [f64]| {
            let mut all = vec![0.0; n + width];
            for (k, sent) in (first..).zip(sent.chunks_exact_mut(width.max(1))) {
                patch.receive(&mut all, list.from[k], children);
                let (own, above) = all.split_at_mut(n);
                patch.own_values(own, &list.steps[k * n..(k + 1) * n]);
                for (i, (sent, before)) in sent.iter_mut().zip(above).enumerate() {
                    *sent = *before + dot(&front.below[i * n..(i + 1) * n], own);
                }
            }
        };
        list.sent = filled(order.len(), width, patch.worth_a_thread(), sent);
        list
    }
}

/// `width` values of each of so many items, which `fill` sets for some of them from a first one on. Each thread has at
/// least `least` items.
fn filled<T: Copy + Default + Send>(
    count: usize,
    width: usize,
    least: usize,
    fill: impl Fn(usize, &mut [T]) + Sync,
) -> Vec<T> {
    let mut values = vec![T::default(); count * width];
    let mut rest = &mut values[..];
    let part = |range: Range<usize>| {
        let part = rest.split_off_mut(..width * range.len());
        (range.start, part.unwrap_or_default())
    };
    let parts = parts_of(count, least).into_iter().map(part).collect();
    for_each_part(parts, |(first, part)| fill(first, part));
    values
}

/// The `width` values of each of these items.
fn in_order<T: Copy + Default + Send + Sync>(order: &[u32], values: &[T], width: usize) -> Vec<T> {
    let least = COPIED / width.max(1);
    filled(order.len(), width, least, |first, part| {
        let items = part.chunks_exact_mut(width.max(1));
        for (to, &k) in items.zip(&order[first..]) {
            to.copy_from_slice(&values[k as usize * width..][..width]);
        }
    })
}

/// What the entries of a patch are computed with.
#[derive(Clone, Copy)]
pub(super) struct PatchData<'a> {
    pub front: &'a Front,
    pub local: &'a Local,
    pub conditions: Option<&'a Conditions>,
    /// Whether the parent has conditions too.
    pub passes_flows: bool,
}

impl PatchData<'_> {
    fn kept_flows(&self) -> usize {
        let edges = self.conditions.map_or(0, Conditions::len);
        if self.passes_flows { edges } else { 0 }
    }

    /// The memory of a list with this many entries, in bytes.
    pub fn bytes(&self, entries: usize) -> usize {
        let each = 24 + 4 * self.front.own + 8 * self.front.above.len() + 4 * self.kept_flows();
        entries * each
    }

    /// The least number of entries that are worth a thread.
    fn worth_a_thread(&self) -> usize {
        let edges = self.conditions.map_or(0, Conditions::len);
        let each = self.local.own * self.local.own + self.front.above.len() + edges;
        WORTH_A_THREAD / each.max(1)
    }

    /// By entry, what it is worth, and its flows if the parent needs them.
    fn worths(&self, found: &Found, children: &[&List]) -> (Vec<f64>, Vec<f32>) {
        let (count, edges) = (found.energy.len(), self.kept_flows());
        let (mut worth, mut flows) = (vec![0.0; count], vec![0.0; count * edges]);
        let (mut worths, mut kept) = (&mut worth[..], &mut flows[..]);
        let part = |range: Range<usize>| {
            let worth = worths.split_off_mut(..range.len()).unwrap_or_default();
            let kept = kept
                .split_off_mut(..edges * range.len())
                .unwrap_or_default();
            (range, worth, kept)
        };
        let parts = parts_of(count, self.worth_a_thread()).into_iter().map(part);
        for_each_part(parts.collect(), |(range, worth, kept)| {
            self.worths_of(found, range, children, (worth, kept));
        });
        (worth, flows)
    }

    /// The same of some entries.
    fn worths_of(
        &self,
        found: &Found,
        part: Range<usize>,
        children: &[&List],
        (worth, kept): (&mut [f64], &mut [f32]),
    ) {
        let n = self.local.own;
        let edges = self.kept_flows();
        let mut all = vec![0.0; n + self.front.above.len()];
        let mut flows: Vec<f32> = Vec::new();
        for (place, (k, worth)) in part.zip(worth).enumerate() {
            let from = found.from[k];
            let of_children = children.iter().zip(from);
            let below: f64 = of_children.map(|(c, at)| c.worth[at as usize]).sum();
            let mut own = found.energy[k];
            if let Some(conditions) = self.conditions {
                self.receive(&mut all, from, children);
                self.own_values(&mut all[..n], &found.steps[k * n..(k + 1) * n]);
                flows.clear();
                for (child, at) in children.iter().zip(from) {
                    let edges = child.flows.len() / child.energy.len().max(1);
                    flows.extend_from_slice(&child.flows[at as usize * edges..][..edges]);
                }
                flows.resize(conditions.len(), 0.0);
                conditions.add_flows(&all[..n], &mut flows);
                own += conditions.price(&flows);
                kept[place * edges..][..edges].copy_from_slice(&flows[..edges]);
            }
            *worth = own.max(below);
        }
    }

    /// Sums up what the children's entries send, to the own cycles first.
    fn receive(&self, all: &mut [f64], from: [u32; 2], children: &[&List]) {
        all.fill(0.0);
        for ((child, places), at) in children.iter().zip(&self.front.places).zip(from) {
            let of_child = &child.sent[at as usize * places.len()..][..places.len()];
            for (&place, s) in places.iter().zip(of_child) {
                all[place as usize] += s;
            }
        }
    }

    /// Replaces what the own cycles received by `w = G_SS^-1 (alpha - received + step n)`.
    fn own_values(&self, received: &mut [f64], steps: &[i32]) {
        let n = self.local.own;
        for i in 0..n {
            let charges = &self.local.charges[i * n..(i + 1) * n];
            let charge: f64 = charges
                .iter()
                .zip(steps)
                .map(|(u, &z)| u * f64::from(z))
                .sum();
            let row = &self.front.diagonal[i * n..=i * n + i];
            let sum = self.local.alpha[i] - received[i] + self.local.step * charge;
            received[i] = (sum - dot(&row[..i], &received[..i])) / row[i];
        }
    }
}
