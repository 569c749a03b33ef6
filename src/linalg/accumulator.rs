//! A sparse vector that is being summed: dense storage, and a list of the entries in use (`gustavson1978`).

/// One slot for each index. A slot that was never used holds the default value.
#[derive(Debug)]
pub(crate) struct Accumulator<T> {
    slots: Vec<T>,
    is_present: Vec<bool>,
    present: Vec<u32>,
}

impl<T: Default + Clone> Accumulator<T> {
    /// An empty vector of length `len`.
    pub fn new(len: usize) -> Self {
        Accumulator {
            slots: vec![T::default(); len],
            is_present: vec![false; len],
            present: Vec::new(),
        }
    }

    /// The slot of `index`. The entry counts as present from now on.
    #[inline]
    pub fn slot(&mut self, index: u32) -> &mut T {
        let i = index as usize;
        if !self.is_present[i] {
            self.is_present[i] = true;
            self.present.push(index);
        }
        &mut self.slots[i]
    }

    pub fn get(&self, index: u32) -> &T {
        &self.slots[index as usize]
    }

    /// The number of entries that are present.
    pub fn len(&self) -> usize {
        self.present.len()
    }

    /// Sorts the entries by index. Without this call they are in the order of their first use.
    pub fn sort(&mut self) {
        self.present.sort_unstable();
    }

    /// Passes every entry to `take` and empties the vector.
    pub fn drain(&mut self, mut take: impl FnMut(u32, T)) {
        for index in self.present.drain(..) {
            self.is_present[index as usize] = false;
            take(index, std::mem::take(&mut self.slots[index as usize]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drained_sum_starts_from_zero() {
        let mut sum = Accumulator::new(6);
        let mut drained = |entries: &[(u32, i64)]| {
            for &(i, v) in entries {
                *sum.slot(i) += v;
            }
            assert_eq!(sum.len(), 2);
            sum.sort();
            let mut list = Vec::new();
            sum.drain(|i, v| list.push((i, v)));
            list
        };
        assert_eq!(drained(&[(4, 3), (1, 5), (4, -1)]), [(1, 5), (4, 2)]);
        assert_eq!(drained(&[(4, 1), (0, 0)]), [(0, 0), (4, 1)]);
    }
}
