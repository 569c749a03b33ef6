//! What waits to be passed on: vertices and half-edges, the nearest first, of equals the one of the lowest number.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A queue of items by distance.
#[derive(Debug, Default)]
pub(super) struct Queue {
    heap: BinaryHeap<Reverse<(u64, u32)>>,
}

impl Queue {
    pub(super) fn push(&mut self, key: f64, item: u32) {
        // Numbers that are not negative are ordered as their bits are.
        self.heap.push(Reverse((key.to_bits(), item)));
    }

    pub(super) fn pop(&mut self) -> Option<(f64, u32)> {
        let Reverse((key, item)) = self.heap.pop()?;
        Some((f64::from_bits(key), item))
    }
}
