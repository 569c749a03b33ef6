//! A priority queue of the integers to round next, ordered by the distance from the nearest integer. Where there are
//! many, each range of distances has its own heap, so that a heap fits into the cache. Outdated entries are skipped.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::greedy::TIE;
use super::nearest;

/// The most ranges of distances.
const RANGES: usize = 1024;

/// The unknowns for each range: a heap of so many fits into the cache.
const UNKNOWNS_OF_RANGE: usize = 256;

/// The undecided integers, the closest to an integer first. If deviations agree up to [`TIE`], the lowest
/// unknown comes first.
///
/// The heaps contain a lower bound of each deviation. An unknown that moves closer to an integer is entered
/// again. An unknown that moves away is detected when its entry is first.
#[derive(Debug)]
pub(crate) struct Candidates {
    heaps: Vec<BinaryHeap<Reverse<(u64, u32)>>>,
    /// All heaps before this one are empty.
    lowest: usize,
    /// Deviations of a higher rank are left out.
    highest: u64,
    /// By unknown: the least rank among its entries in the heaps.
    entered: Vec<u64>,
}

impl Candidates {
    /// An empty queue for unknowns below `dim`.
    pub fn new(dim: usize) -> Self {
        Self::up_to(1.0, dim)
    }

    /// An empty queue for unknowns below `dim`, which leaves out those with a deviation above `ceiling`.
    pub fn up_to(ceiling: f64, dim: usize) -> Self {
        Candidates {
            heaps: vec![BinaryHeap::new(); (dim / UNKNOWNS_OF_RANGE).clamp(1, RANGES)],
            lowest: 0,
            highest: (ceiling / TIE) as u64,
            entered: vec![u64::MAX; dim],
        }
    }

    /// Adds an unknown, or enters it again after its value has changed.
    pub fn push(&mut self, unknown: u32, value: f64) {
        self.enter(rank(value), unknown);
    }

    fn enter(&mut self, rank: u64, unknown: u32) {
        let entered = &mut self.entered[unknown as usize];
        if rank < *entered && rank <= self.highest {
            *entered = rank;
            let range = range_of(rank, self.heaps.len());
            self.heaps[range].push(Reverse((rank, unknown)));
            self.lowest = self.lowest.min(range);
        }
    }

    /// The least entry, outdated or not, and its heap.
    fn least(&mut self) -> Option<(usize, u64, u32)> {
        let at = (self.lowest..self.heaps.len()).find(|&range| !self.heaps[range].is_empty())?;
        self.lowest = at;
        let &Reverse((rank, unknown)) = self.heaps[at].peek()?;
        Some((at, rank, unknown))
    }

    /// Takes the least deviations while their sum is at most `threshold`, but at least one.
    ///
    /// `value` gives the current value of an unknown, or none once it is decided.
    pub fn take(&mut self, threshold: f64, value: impl Fn(u32) -> Option<f64>) -> Vec<u32> {
        let mut taken = Vec::new();
        let mut sum = 0.0;
        while let Some((range, stored, unknown)) = self.least() {
            let stale = self.entered[unknown as usize] != stored;
            let current = value(unknown).filter(|_| !stale);
            if let Some(x) = current.filter(|&x| rank(x) == stored) {
                sum += (x - nearest(x)).abs();
                if sum > threshold && !taken.is_empty() {
                    break;
                }
                taken.push(unknown);
            }
            self.heaps[range].pop();
            if !stale {
                self.entered[unknown as usize] = u64::MAX;
            }
            if let Some(x) = current.filter(|&x| rank(x) != stored) {
                self.enter(rank(x), unknown);
            }
        }
        taken
    }
}

/// The heap for deviations of this rank, out of so many.
fn range_of(rank: u64, ranges: usize) -> usize {
    let deviation = rank as f64 * TIE;
    ((2.0 * deviation * ranges as f64) as usize).min(ranges - 1)
}

fn rank(value: f64) -> u64 {
    ((value - nearest(value)).abs() / TIE) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(values: &[f64], threshold: f64) -> Vec<u32> {
        let mut candidates = Candidates::new(4);
        for (i, &x) in values.iter().enumerate() {
            candidates.push(i as u32, 0.49);
            candidates.push(i as u32, x);
        }
        candidates.take(threshold, |i| Some(values[i as usize]))
    }

    #[test]
    fn deviations_are_taken_from_the_least_while_their_sum_fits() {
        assert_eq!(take(&[0.3, 1.1, 2.0, 4.8], 0.5), [2, 1, 3]);
        assert_eq!(take(&[0.3, 0.4], 0.1), [0], "at least one");
    }

    #[test]
    fn stale_and_decided_entries_are_passed_over() {
        let mut candidates = Candidates::new(4);
        candidates.push(0, 0.1);
        candidates.push(1, 0.2);
        candidates.push(2, 0.3);
        let now = [Some(0.4), None, Some(0.3)];
        assert_eq!(candidates.take(0.0, |i| now[i as usize]), [2]);
    }

    #[test]
    fn any_number_of_heaps_gives_the_same_order() {
        let value = |i: u32| 0.37 * f64::from(i) + 1e-3 * f64::from(i % 7);
        let order = |dim: usize| {
            let mut candidates = Candidates::new(dim);
            (0..300).for_each(|i| candidates.push(i, value(i + 1)));
            // Some have moved since, some have been decided.
            let now = |i: u32| (!i.is_multiple_of(5)).then(|| value(i + i % 2));
            (0..300).for_each(|i| candidates.push(i, value(i + i % 2)));
            let taken = std::iter::repeat_with(|| candidates.take(0.02, now));
            let taken: Vec<Vec<u32>> = taken.take_while(|batch| !batch.is_empty()).collect();
            (candidates.heaps.len(), taken)
        };
        let [one, some, most] = [300, 2_000, 1_000_000].map(order);
        assert_eq!([one.0, some.0, most.0], [1, 7, RANGES]);
        assert_eq!(one.1.concat().len(), 240);
        assert_eq!(one.1, some.1);
        assert_eq!(one.1, most.1);
    }
}
