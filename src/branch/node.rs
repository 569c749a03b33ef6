//! The nodes of the tree.

use std::cmp::Ordering;

use super::branching::Branching;
use super::dual_active_set::WarmStart;
use super::form::Interval;

/// A node that waits.
pub(super) struct Node {
    pub bound: f64,
    pub number: u64,
    /// The bounds that differ from the root's.
    pub limits: Vec<(u32, Interval)>,
    pub warm: WarmStart,
    pub branching: Option<Branching>,
    /// Its number in the record.
    pub visited: usize,
}

impl Node {
    pub fn root() -> Self {
        Node {
            bound: f64::NEG_INFINITY,
            number: 0,
            limits: Vec::new(),
            warm: WarmStart::new(),
            branching: None,
            visited: 0,
        }
    }
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

/// Leaves only the last limits of each unknown, which replace those before. A deep tree without bounds repeats
/// each unknown at every level.
pub(super) fn keep_last(limits: &mut Vec<(u32, Interval)>, unknowns: usize) {
    let mut last = vec![usize::MAX; unknowns];
    for (at, (j, _)) in limits.iter().enumerate() {
        last[*j as usize] = at;
    }
    let mut at = 0;
    limits.retain(|(j, _)| {
        at += 1;
        last[*j as usize] == at - 1
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_limits_of_each_unknown_are_kept() {
        let at = |j: u32, value: f64| (j, Interval::point(value));
        let mut limits = vec![at(1, 0.0), at(0, 1.0), at(1, 2.0), at(3, 3.0), at(1, 4.0)];
        keep_last(&mut limits, 4);
        let kept: Vec<(u32, f64)> = limits.iter().map(|(j, l)| (*j, l.lower)).collect();
        assert_eq!(kept, [(0, 1.0), (3, 3.0), (1, 4.0)]);
    }
}
