//! What an update of Gauss-Seidel reads and writes of one unknown, in half a cache line.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use super::ring::Ring;
use super::shared_float::SharedFloat;

/// Flags of an unknown. One that waits in a queue.
pub(super) const QUEUED: u32 = 1;
/// One that is fixed for good.
pub(super) const FIXED: u32 = 2;
/// One that is among those that have moved.
pub(super) const MOVED: u32 = 4;
/// An integer.
pub(super) const INTEGER: u32 = 8;
/// A local integer.
pub(super) const LOCAL: u32 = 16;
/// One that has a minimum while all others stay where they are and free local integers follow.
pub(super) const DETERMINED: u32 = 32;

/// The bits of the flags.
const FLAGS: u32 = 8;

/// The most entries of a row.
pub(super) const MOST_ACTIVE: usize = (u32::MAX >> FLAGS) as usize;

/// An unknown and its row of the condensed matrix.
#[derive(Debug)]
#[repr(align(32))]
pub(super) struct Unknown {
    /// The current value, except for a free local integer, whose value is computed on demand.
    pub value: SharedFloat,
    /// The slope of the condensed objective. Unused for local integers.
    pub residual: SharedFloat,
    /// The curvature along the unknown if the free local integers follow.
    pub curvature: SharedFloat,
    /// Where its row begins.
    pub start: u32,
    /// The flags, and above them the number of entries of the row that may differ from zero.
    state: AtomicU32,
}

impl Unknown {
    pub fn new(value: f64, curvature: f64, start: u32, flags: u32) -> Self {
        Unknown {
            value: SharedFloat::new(value),
            residual: SharedFloat::new(0.0),
            curvature: SharedFloat::new(curvature),
            start,
            state: AtomicU32::new(flags),
        }
    }

    pub fn has(&self, flag: u32) -> bool {
        self.state.load(Relaxed) & flag != 0
    }

    pub fn set(&self, flag: u32) {
        self.state.store(self.state.load(Relaxed) | flag, Relaxed);
    }

    pub fn clear(&self, flag: u32) {
        self.state.store(self.state.load(Relaxed) & !flag, Relaxed);
    }

    /// The number of entries of the row that may differ from zero. They come first.
    pub fn active(&self) -> usize {
        (self.state.load(Relaxed) >> FLAGS) as usize
    }

    pub fn set_active(&self, count: usize) {
        let flags = self.state.load(Relaxed) & ((1 << FLAGS) - 1);
        self.state.store(flags | (count as u32) << FLAGS, Relaxed);
    }

    /// Changes the slope of unknown `i`, which is this one, by the step of a neighbour, and queues it if its own step
    /// would exceed `tolerance`, unless it is fixed. The queue must have room.
    pub fn pull(&self, i: u32, coupling: f64, step: f64, tolerance: f64, queue: &mut Ring) {
        let residual = self.residual.get() + coupling * step;
        self.residual.set(residual);
        let state = self.state.load(Relaxed);
        let moves = residual.abs() > tolerance * self.curvature.get();
        let enters = moves & (state & (QUEUED | FIXED) == 0);
        queue.push_if(i, enters);
        self.state
            .store(state | (u32::from(enters) * QUEUED), Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_waits_once_and_only_for_a_step_beyond_the_tolerance() {
        let unknown = Unknown::new(0.0, 4.0, 0, 0);
        let mut queue = Ring::default();
        let waiting = |coupling: f64, queue: &mut Ring| {
            queue.reserve(1);
            unknown.pull(7, coupling, 1.0, 0.5, queue);
            queue.len()
        };
        assert_eq!(waiting(-1.5, &mut queue), 0);
        assert_eq!(waiting(-0.5, &mut queue), 0);
        assert_eq!(waiting(-0.5, &mut queue), 1);
        assert_eq!(waiting(-9.0, &mut queue), 1);
        assert_eq!((queue.pop(), unknown.residual.get()), (Some(7), -11.5));
        unknown.clear(QUEUED);
        unknown.set(FIXED);
        assert_eq!(waiting(-9.0, &mut queue), 0);
    }
}
