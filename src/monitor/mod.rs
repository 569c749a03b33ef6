//! The monitor: progress, log lines, better solutions, cancellation and time limit for all loops.

mod cancel;
mod event;

use std::time::{Duration, Instant};

pub use cancel::CancelToken;
pub(crate) use cancel::Stop;
pub use event::{Event, EventKind, Flow, Phase};

type Callback<'a> = Box<dyn FnMut(&Event) -> Flow + 'a>;

/// The observer of a solve: a callback, a cancel token, both, or neither (the default).
///
/// The callback runs on the thread that called the solve.
pub struct Monitor<'a> {
    callback: Option<Callback<'a>>,
    token: Option<CancelToken>,
    stopped: Option<Stop>,
    started: Instant,
    limit: Option<Duration>,
    energy: f64,
    lower_bound: f64,
    /// Energy and bound of the parts of the problem that are not searched at present.
    elsewhere: (f64, f64),
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
            elsewhere: (0.0, 0.0),
            last_progress: None,
        }
    }
}

/// The least time between two reports of progress, so that a callback never dominates a loop.
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

    /// Starts the clock of a solve that may take at most `limit` seconds.
    pub(crate) fn start(&mut self, limit: f64) {
        self.started = Instant::now();
        // A limit that the clock cannot represent is no limit.
        self.limit = Duration::try_from_secs_f64(limit).ok();
    }

    pub(crate) fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// The reason why the solve was told to end, if it was.
    pub(crate) fn stopped(&self) -> Option<Stop> {
        self.stopped
    }

    /// Whether to continue. Every loop of the library that may run long calls this.
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

    /// Reports the progress of `phase`. Returns whether to continue.
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

    /// Reports one line of text.
    pub(crate) fn log(&mut self, line: &str) {
        self.tell(EventKind::Log(line));
    }

    /// Sets the energy and the bound of all parts of the problem but the one that is searched next.
    pub(crate) fn elsewhere(&mut self, energy: f64, lower_bound: f64) {
        self.elsewhere = (energy, lower_bound);
    }

    /// Reports a better solution.
    pub(crate) fn improved(&mut self, energy: f64) {
        self.energy = self.elsewhere.0 + energy;
        self.tell(EventKind::Improved);
    }

    /// Records a better bound and reports it.
    pub(crate) fn raised(&mut self, lower_bound: f64) {
        self.bounded(lower_bound);
        self.tell(EventKind::Raised);
    }

    /// Records a better bound.
    pub(crate) fn bounded(&mut self, lower_bound: f64) {
        self.lower_bound = self.elsewhere.1 + lower_bound;
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
            gap,
        };
        if callback(&event) == Flow::Cancel && self.stopped.is_none() {
            self.stopped = Some(Stop::Cancelled);
        }
    }
}

/// `(energy - lower_bound) / |energy|`. It is 0 where the bound has reached the energy, also for an energy of
/// 0, and infinite without an energy, without a bound, and for an energy of 0 above the bound.
pub(crate) fn relative_gap(energy: f64, lower_bound: f64) -> f64 {
    if !energy.is_finite() {
        f64::INFINITY
    } else if energy <= lower_bound {
        0.0
    } else {
        (energy - lower_bound) / energy.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::relative_gap;

    #[test]
    fn the_gap_is_relative_at_every_scale() {
        for scale in [2f64.powi(-1000), 2f64.powi(-40), 1.0, 2f64.powi(40)] {
            assert_eq!(relative_gap(1.5 * scale, 0.75 * scale), 0.5);
            assert_eq!(relative_gap(-1.5 * scale, -3.0 * scale), 1.0);
        }
    }

    #[test]
    fn the_gap_of_an_energy_of_zero_is_zero_or_infinite() {
        assert_eq!(relative_gap(0.0, 0.0), 0.0);
        assert_eq!(relative_gap(0.0, -1e-300), f64::INFINITY);
    }

    #[test]
    fn without_an_energy_or_a_bound_the_gap_is_infinite() {
        const NONE: f64 = f64::INFINITY;
        assert_eq!(relative_gap(NONE, -NONE), NONE);
        assert_eq!(relative_gap(NONE, 1.0), NONE);
        assert_eq!(relative_gap(1.0, -NONE), NONE);
    }
}
