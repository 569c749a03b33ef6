//! Lists of numbers, one for each key, in two arrays.

/// No number.
pub(super) const NONE: u32 = u32::MAX;

/// For each key the numbers that have it, in increasing order.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Lists {
    start: Vec<u32>,
    numbers: Vec<u32>,
}

impl Lists {
    /// Sorts numbers by key, in linear time; those with the key [`NONE`] are in no list.
    pub(super) fn by_key(keys: usize, key_of: impl ExactSizeIterator<Item = u32> + Clone) -> Lists {
        let mut start = vec![0u32; keys + 2];
        for key in key_of.clone().filter(|&key| key != NONE) {
            start[key as usize + 2] += 1;
        }
        for key in 2..start.len() {
            start[key] += start[key - 1];
        }
        let mut numbers = vec![0; start[keys + 1] as usize];
        for (number, key) in key_of.enumerate().filter(|&(_, key)| key != NONE) {
            let slot = &mut start[key as usize + 1];
            numbers[*slot as usize] = number as u32;
            *slot += 1;
        }
        start.pop();
        Lists { start, numbers }
    }

    pub(super) fn of(&self, key: usize) -> &[u32] {
        match self.start.get(key + 1) {
            Some(&end) => &self.numbers[self.start[key] as usize..end as usize],
            None => &[],
        }
    }
}
