//! Lists of cycles as signed edges, and sums around them.

use crate::error::{Error, Result};

/// Cycles as signed edges: 1 where the cycle runs through an edge from tail to head, -1 where it runs
/// backwards.
#[derive(Debug, Clone)]
pub(super) struct Cycles {
    offsets: Vec<usize>,
    edges: Vec<(u32, i8)>,
}

impl Cycles {
    /// No cycles.
    pub fn new() -> Self {
        Cycles {
            offsets: vec![0],
            edges: Vec::new(),
        }
    }

    /// Number of cycles.
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The edges of cycle `k`.
    pub fn get(&self, k: usize) -> &[(u32, i8)] {
        &self.edges[self.offsets[k]..self.offsets[k + 1]]
    }

    /// Adds a cycle.
    pub fn push(&mut self, cycle: impl Iterator<Item = (u32, i8)>) {
        self.edges.extend(cycle);
        self.offsets.push(self.edges.len());
    }

    /// Makes room for a cycle of so many edges.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn make_room(&mut self, edges: usize) -> Result<()> {
        let edges = self.edges.try_reserve(edges);
        let has_room = edges.and_then(|()| self.offsets.try_reserve(1));
        has_room.map_err(|_| Error::OutOfMemory {
            what: "a basis of cycles",
        })
    }

    /// The signed sum of `values` around each cycle. Each value belongs to an edge from tail to head.
    pub fn collect(&self, values: &[f64]) -> Vec<f64> {
        let sum = |k: usize| {
            let edges = self.get(k).iter();
            edges.map(|&(e, sign)| f64::from(sign) * values[e as usize])
        };
        (0..self.len()).map(|k| sum(k).sum()).collect()
    }
}
