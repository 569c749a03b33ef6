//! Progress, log lines, better solutions, cancel and time limit: one object for all loops.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::Error;

/// What the callback answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// End the solve; the best solution so far is kept.
    Cancel,
}

/// A part of the solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Elimination of the constraints.
    Eliminate,
    /// Ordering and factorization.
    Factor,
    /// The search for integers.
    Round,
    /// Motion of what is continuous around integers that are held.
    Untangle,
    /// Extraction of quads from a map, and their smoothing.
    Quads,
}

/// What an event tells.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum EventKind<'a> {
    /// A part of the solve has got so far: `fraction` from 0 to 1.
    Progress {
        /// The part.
        phase: Phase,
        /// How much of it is done.
        fraction: f64,
    },
    /// Something worth a line in a log.
    Log(&'a str),
    /// A better solution than any before.
    Improved,
    /// A better lower bound than any before.
    Raised,
}

/// One message to the callback, with where the solve stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event<'a> {
    /// What happened.
    pub kind: EventKind<'a>,
    /// Seconds since the solve began.
    pub seconds: f64,
    /// Energy of the best solution so far; infinite before the first.
    pub energy: f64,
    /// The best lower bound so far; minus infinity before the first.
    pub lower_bound: f64,
    /// `(energy - lower_bound) / max(1, |energy|)`, infinite while either is.
    pub gap: f64,
}

/// A flag by which any thread may cancel a solve.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A token that is not set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks every solve that holds this token to end.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Takes the request back, so that the token can be used again.
    pub fn reset(&self) {
        self.0.store(false, Ordering::Relaxed);
    }

    /// Whether the token is set.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Why a loop has to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    Cancelled,
    TimeLimit,
}

impl From<Stop> for Error {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Cancelled => Error::Cancelled,
            Stop::TimeLimit => Error::TimeLimit,
        }
    }
}

type Callback<'a> = Box<dyn FnMut(&Event) -> Flow + 'a>;

/// Who watches a solve: a callback, a cancel token, or nobody (the default).
///
/// The callback runs on the thread that called solve.
pub struct Monitor<'a> {
    callback: Option<Callback<'a>>,
    token: Option<CancelToken>,
    stopped: Option<Stop>,
    started: Instant,
    limit: Option<Duration>,
    energy: f64,
    lower_bound: f64,
    last_progress: Option<Instant>,
}

impl Default for Monitor<'_> {
    fn default() -> Self {
        Monitor {
            callback: None,
            token: None,
            stopped: None,
            started: Instant::now(),
            limit: None,
            energy: f64::INFINITY,
            lower_bound: f64::NEG_INFINITY,
            last_progress: None,
        }
    }
}

/// Progress is told at most this often, so that a callback never dominates a loop.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(20);

impl<'a> Monitor<'a> {
    /// Calls `callback` for every event.
    #[must_use]
    pub fn on_event(mut self, callback: impl FnMut(&Event) -> Flow + 'a) -> Self {
        self.callback = Some(Box::new(callback));
        self
    }

    /// Ends the solve when `token` is set.
    #[must_use]
    pub fn cancel_token(mut self, token: CancelToken) -> Self {
        self.token = Some(token);
        self
    }

    /// Starts the clock of a solve that may take `limit` seconds.
    pub(crate) fn start(&mut self, limit: f64) {
        self.started = Instant::now();
        // A limit beyond what a clock can hold is no limit.
        self.limit = Duration::try_from_secs_f64(limit).ok();
    }

    pub(crate) fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// Why the solve was told to end, if it was.
    pub(crate) fn stopped(&self) -> Option<Stop> {
        self.stopped
    }

    /// Whether to go on. Every loop of the library that may run long asks this.
    pub(crate) fn check(&mut self) -> Result<(), Stop> {
        if self.stopped.is_none() {
            if self.token.as_ref().is_some_and(CancelToken::is_cancelled) {
                self.stopped = Some(Stop::Cancelled);
            } else if self
                .limit
                .is_some_and(|limit| self.started.elapsed() >= limit)
            {
                self.stopped = Some(Stop::TimeLimit);
            }
        }
        match self.stopped {
            Some(stop) => Err(stop),
            None => Ok(()),
        }
    }

    /// Tells how far `phase` has got, and asks whether to go on.
    pub(crate) fn progress(&mut self, phase: Phase, fraction: f64) -> Result<(), Stop> {
        if self.callback.is_some() {
            let now = Instant::now();
            let edge = fraction <= 0.0 || fraction >= 1.0;
            let due = |last: Instant| now - last >= PROGRESS_INTERVAL;
            if edge || self.last_progress.is_none_or(due) {
                self.last_progress = Some(now);
                self.tell(EventKind::Progress { phase, fraction });
            }
        }
        self.check()
    }

    /// Tells one line of text.
    pub(crate) fn log(&mut self, line: &str) {
        self.tell(EventKind::Log(line));
    }

    /// Tells of a better solution.
    pub(crate) fn improved(&mut self, energy: f64) {
        self.energy = energy;
        self.tell(EventKind::Improved);
    }

    /// Takes note of a better bound and tells of it.
    pub(crate) fn raised(&mut self, lower_bound: f64) {
        self.bounded(lower_bound);
        self.tell(EventKind::Raised);
    }

    /// Takes note of a better bound.
    pub(crate) fn bounded(&mut self, lower_bound: f64) {
        self.lower_bound = lower_bound;
    }

    fn tell(&mut self, kind: EventKind) {
        let Some(callback) = &mut self.callback else {
            return;
        };
        let gap = relative_gap(self.energy, self.lower_bound);
        let event = Event {
            kind,
            seconds: self.started.elapsed().as_secs_f64(),
            energy: self.energy,
            lower_bound: self.lower_bound,
            gap: if gap.is_nan() { f64::INFINITY } else { gap },
        };
        if callback(&event) == Flow::Cancel && self.stopped.is_none() {
            self.stopped = Some(Stop::Cancelled);
        }
    }
}

/// `(energy - lower_bound) / max(1, |energy|)`.
pub(crate) fn relative_gap(energy: f64, lower_bound: f64) -> f64 {
    (energy - lower_bound) / energy.abs().max(1.0)
}
