//! The values of the unknowns that are pinned.

use std::ops::Index;
use std::sync::Arc;

use super::shared::own;
use crate::error::Result;

/// The value of each pinned unknown, and `None` for each that is free. Unknowns after the last one that was pinned take
/// no memory. Copies share the values until they are changed.
#[derive(Debug, Clone)]
pub struct Pins {
    unknowns: usize,
    /// All unknowns that follow are free.
    values: Arc<Vec<Option<f64>>>,
}

impl Pins {
    /// So many unknowns, all free.
    pub(super) fn free(unknowns: usize) -> Self {
        Pins {
            unknowns,
            values: Arc::default(),
        }
    }

    /// Pins an unknown to a value, or frees it.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn set(
        &mut self,
        unknown: usize,
        value: Option<f64>,
        what: &'static str,
    ) -> Result<()> {
        let more = (unknown + 1).saturating_sub(self.values.len());
        if more > 0 && value.is_none() {
            return Ok(());
        }
        let values = own(&mut self.values, more, what)?;
        values.resize(values.len() + more, None);
        values[unknown] = value;
        Ok(())
    }

    /// The value of an unknown if it is pinned. One that the problem does not have is not.
    pub fn get(&self, unknown: usize) -> Option<f64> {
        self.values.get(unknown).copied().flatten()
    }

    /// All of them, by unknown.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Option<f64>> + Clone {
        (0..self.unknowns).map(|unknown| &self[unknown])
    }

    /// The same unknowns pinned to zero.
    pub(super) fn at_zero(&self) -> Self {
        let zero = self.values.iter().map(|pin| pin.map(|_| 0.0));
        Pins {
            unknowns: self.unknowns,
            values: Arc::new(zero.collect()),
        }
    }
}

impl Index<usize> for Pins {
    type Output = Option<f64>;

    fn index(&self, unknown: usize) -> &Option<f64> {
        debug_assert!(unknown < self.unknowns);
        self.values.get(unknown).unwrap_or(&None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_take_no_memory_after_the_last_and_tell_each_unknown() {
        let mut pins = Pins::free(3);
        pins.set(1, None, "pins").unwrap();
        assert!(pins.values.is_empty());
        assert!(pins.iter().eq(&[None; 3]) && pins[2].is_none());
        pins.set(1, Some(2.5), "pins").unwrap();
        let copy = pins.clone();
        pins.set(0, Some(-1.0), "pins").unwrap();
        assert!(pins.iter().eq(&[Some(-1.0), Some(2.5), None]));
        assert_eq!(pins.values.len(), 2);
        assert!(copy.iter().eq(&[None, Some(2.5), None]));
        assert!(pins.at_zero().iter().eq(&[Some(0.0), Some(0.0), None]));
        pins.set(1, None, "pins").unwrap();
        assert_eq!((pins[0], pins[1]), (Some(-1.0), None));
        assert!(Pins::free(2).at_zero().iter().eq(&[None; 2]));
    }
}
