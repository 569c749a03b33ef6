//! A float in data that threads share.

use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

/// A float that several threads may hold, of which one at a time changes it.
#[derive(Debug)]
pub(super) struct SharedFloat(AtomicU64);

impl SharedFloat {
    pub fn new(value: f64) -> Self {
        SharedFloat(AtomicU64::new(value.to_bits()))
    }

    pub fn get(&self) -> f64 {
        f64::from_bits(self.0.load(Relaxed))
    }

    pub fn set(&self, value: f64) {
        self.0.store(value.to_bits(), Relaxed);
    }

    /// Adds to it. If another thread changes it at the same time, one of the changes is lost.
    pub fn add(&self, change: f64) {
        self.set(self.get() + change);
    }
}
