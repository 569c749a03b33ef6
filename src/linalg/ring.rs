//! A queue of unknowns that is entered without a branch.
//!
//! Whether a neighbour waits in the queue already is next to unpredictable, and processors lose more time with a
//! wrong guess than with a store that has no effect.

/// A first-in, first-out queue.
#[derive(Debug, Default)]
pub(super) struct Ring {
    /// A power of two of places, or none.
    places: Vec<u32>,
    /// How many were taken and how many were entered so far.
    taken: usize,
    entered: usize,
}

impl Ring {
    pub fn len(&self) -> usize {
        self.entered - self.taken
    }

    pub fn is_empty(&self) -> bool {
        self.entered == self.taken
    }

    /// Those that wait, the first one first.
    pub fn iter(&self) -> impl Iterator<Item = u32> + '_ {
        (self.taken..self.entered).map(|at| self.places[at & (self.places.len() - 1)])
    }

    pub fn clear(&mut self) {
        self.taken = self.entered;
    }

    /// Makes room for so many calls of [`push_if`](Self::push_if).
    pub fn reserve(&mut self, more: usize) {
        if self.len() + more > self.places.len() {
            self.grow(more);
        }
    }

    #[cold]
    fn grow(&mut self, more: usize) {
        let mut places: Vec<u32> = self.iter().collect();
        (self.taken, self.entered) = (0, places.len());
        places.resize(2 * (places.len() + more).next_power_of_two(), 0);
        self.places = places;
    }

    /// Enters an unknown under a condition. There must be [room](Self::reserve) even if it does not hold.
    pub fn push_if(&mut self, unknown: u32, condition: bool) {
        let mask = self.places.len() - 1;
        self.places[self.entered & mask] = unknown;
        self.entered += usize::from(condition);
    }

    pub fn pop(&mut self) -> Option<u32> {
        if self.is_empty() {
            return None;
        }
        let first = self.places[self.taken & (self.places.len() - 1)];
        self.taken += 1;
        Some(first)
    }
}

impl FromIterator<u32> for Ring {
    fn from_iter<T: IntoIterator<Item = u32>>(unknowns: T) -> Self {
        let mut ring = Ring::default();
        for unknown in unknowns {
            ring.reserve(1);
            ring.push_if(unknown, true);
        }
        ring
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_entered_leaves_in_its_order_however_often_the_ring_grows() {
        let mut ring = Ring::default();
        let mut expected = std::collections::VecDeque::new();
        for k in 0..1000u32 {
            ring.reserve(3);
            for (unknown, enters) in [(3 * k, true), (3 * k + 1, k % 3 == 0), (3 * k + 2, true)] {
                ring.push_if(unknown, enters);
                expected.extend(enters.then_some(unknown));
            }
            for _ in 0..k % 4 {
                assert_eq!(ring.pop(), expected.pop_front());
            }
            assert_eq!(ring.len(), expected.len());
        }
        assert!(ring.iter().eq(expected.iter().copied()));
        let again: Ring = ring.iter().collect();
        assert!(again.iter().eq(ring.iter()));
        ring.clear();
        assert!(ring.is_empty() && ring.pop().is_none());
    }
}
