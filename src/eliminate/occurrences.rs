//! The waiting rows in which each unknown occurs.

/// Linked lists in one array, one list for each unknown. A row that loses the unknown stays in its list, so
/// that no list is ever searched. The counts are exact.
#[derive(Debug)]
pub(super) struct Occurrences {
    count: Vec<u32>,
    head: Vec<u32>,
    links: Vec<(u32, u32)>,
}

const END: u32 = u32::MAX;

impl Occurrences {
    pub fn new(unknowns: usize) -> Self {
        Occurrences {
            count: vec![0; unknowns],
            head: vec![END; unknowns],
            links: Vec::new(),
        }
    }

    /// Makes room for the unknowns introduced since the last call.
    pub fn resize(&mut self, unknowns: usize) {
        self.count.resize(unknowns, 0);
        self.head.resize(unknowns, END);
    }

    pub fn count(&self, unknown: u32) -> u32 {
        self.count[unknown as usize]
    }

    pub fn add(&mut self, unknown: u32, row: u32) {
        let u = unknown as usize;
        self.count[u] += 1;
        self.links.push((row, self.head[u]));
        self.head[u] = self.links.len() as u32 - 1;
    }

    pub fn remove(&mut self, unknown: u32) {
        self.count[unknown as usize] -= 1;
    }

    /// The rows that have or had the unknown. A row may appear twice.
    pub fn rows(&self, unknown: u32) -> impl Iterator<Item = u32> + '_ {
        let mut at = self.head[unknown as usize];
        std::iter::from_fn(move || {
            let &(row, next) = self.links.get(at as usize)?;
            at = next;
            Some(row)
        })
    }
}
