//! The reasons to stop a loop: a cancel token, which any thread may set, and the time limit.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use crate::error::Error;

/// The states of a token, in the order in which they replace each other.
const UNSET: u8 = 0;
const FINISHING: u8 = 1;
const CANCELLED: u8 = 2;

/// A flag by which any thread may cancel a run, or ask for the results so far.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<AtomicU8>);

impl CancelToken {
    /// A token that is not set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks every solve with this token to end.
    pub fn cancel(&self) {
        self.0.fetch_max(CANCELLED, Ordering::Relaxed);
    }

    /// Asks every run with this token to finish with the best integers so far: see [`Flow::Finish`].
    ///
    /// [`Flow::Finish`]: super::Flow::Finish
    pub fn finish(&self) {
        self.0.fetch_max(FINISHING, Ordering::Relaxed);
    }

    /// Clears the token, so that it can be used again.
    pub fn reset(&self) {
        self.0.store(UNSET, Ordering::Relaxed);
    }

    /// Whether the token asks to end.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) == CANCELLED
    }

    /// Whether the token asks for the results so far. A later [`cancel`](Self::cancel) takes the place of
    /// this request.
    pub fn is_finishing(&self) -> bool {
        self.0.load(Ordering::Relaxed) == FINISHING
    }
}

/// The reason to stop a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    Cancelled,
    TimeLimit,
    /// There is no memory for the next step.
    OutOfMemory,
}

impl From<Stop> for Error {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Cancelled => Error::Cancelled,
            Stop::TimeLimit => Error::TimeLimit,
            Stop::OutOfMemory => Error::OutOfMemory {
                what: "the next step",
            },
        }
    }
}
