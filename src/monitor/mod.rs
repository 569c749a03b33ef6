//! The monitor: progress, log lines, better solutions, cancellation and time limit for all loops.
//!
//! There are two kinds of ends. A loop that has no result yet asks `Monitor::check`, and its error ends the
//! call. A search, which has a result at any time, asks `Monitor::ends`. They differ when the caller wants
//! a run to finish with what it has: then searches end, and all that a result needs goes on.
//!
//! Loops without a monitor, as those of meshes, ask `may_continue`, whose error ends the call as well. It knows the
//! monitor by `Monitor::watch`.

mod cancel;
mod event;
mod parts;
mod run;
mod threads;
mod trace;
mod watch;
mod worker;

use std::time::{Duration, Instant};

use crate::error::Error;
pub use cancel::CancelToken;
pub(crate) use cancel::Stop;
pub use event::{Event, EventKind, Flow, Phase, Stage};
pub(crate) use parts::{
    both, change_in_parts, collect_if_wanted, collect_in_parts, collect_in_turn, filter_in_parts,
    for_each_part, in_blocks, joined, of_each_part, parts_of, sort_in_parts, sort_in_parts_by,
    write_lines,
};
pub use run::Run;
pub(crate) use threads::SharedThreads;
pub use threads::{allowed_threads, with_threads};
pub use trace::{Span, Trace, traced};
pub(crate) use trace::{is_simulated, simulate_graph, span};
pub use watch::Watch;
pub(crate) use watch::{
    is_room_for, is_wanted, is_wanted_at, may_continue, may_continue_at, room_for, room_up_to,
    watch_memory,
};
#[cfg(test)]
pub(crate) use worker::spawned;
pub(crate) use worker::{Started, in_parts, side_by_side, tasks};

type Callback<'a> = Box<dyn FnMut(&Event) -> Flow + 'a>;

/// The observer of a solve: a callback, a cancel token, both, or neither (the default).
///
/// The callback runs on the thread that called the solve.
pub struct Monitor<'a> {
    callback: Option<Callback<'a>>,
    token: Option<CancelToken>,
    run: Run,
    /// The share of the run that the current step has.
    step: Option<[f64; 2]>,
    /// Why the caller wants the results so far.
    finishing: Option<Stop>,
    finish_at: Option<Instant>,
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
            run: Run::new(),
            step: None,
            finishing: None,
            finish_at: None,
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

    /// Ends or finishes the run when `token` asks for it.
    #[must_use]
    pub fn cancel_token(mut self, token: CancelToken) -> Self {
        self.token = Some(token);
        self
    }

    /// Finishes the run at this time with the best integers so far, as [`Flow::Finish`] does.
    #[must_use]
    pub fn finish_at(mut self, time: Instant) -> Self {
        self.finish_at = Some(time);
        self
    }

    /// Makes this a monitor of a run that has others.
    #[must_use]
    pub fn of_run(mut self, run: &Run) -> Self {
        self.run = run.clone();
        self
    }

    /// A monitor that ends when this one does and tells nobody.
    pub(crate) fn silent(&self) -> Monitor<'static> {
        Monitor {
            token: self.token.clone(),
            finishing: self.finishing,
            finish_at: self.finish_at,
            started: self.started,
            limit: self.limit,
            ..Monitor::default()
        }
    }

    /// The run, which other monitors may share.
    pub(crate) fn run(&self) -> Run {
        self.run.clone()
    }

    /// Starts the clock of a solve that may take at most `limit` seconds.
    pub(crate) fn start(&mut self, limit: f64) {
        self.step = None;
        self.started = Instant::now();
        // A limit that the clock cannot represent is no limit.
        self.limit = Duration::try_from_secs_f64(limit).ok();
    }

    /// Lets what follows the search of a solve go on until `limit` seconds from its start.
    pub(crate) fn extend(&mut self, limit: f64) {
        self.limit = Duration::try_from_secs_f64(limit).ok();
        if self.stopped == Some(Stop::TimeLimit) {
            self.stopped = None;
        }
    }

    /// A step that may take half of the time that is left.
    pub(crate) fn in_half_of_the_time<T>(&mut self, step: impl FnOnce(&mut Self) -> T) -> T {
        let limit = self.limit;
        let spent = self.started.elapsed();
        self.limit = limit.map(|limit| spent + limit.saturating_sub(spent) / 2);
        let result = step(self);
        self.limit = limit;
        if self.stopped == Some(Stop::TimeLimit) {
            self.stopped = None;
        }
        result
    }

    pub(crate) fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// The reason why the solve was told to end, if it was.
    pub(crate) fn stopped(&self) -> Option<Stop> {
        self.stopped.or(self.finishing)
    }

    /// Whether a step that a result needs may continue. Every loop of the library that may run long calls
    /// this or [`Self::ends`].
    pub(crate) fn check(&mut self) -> Result<(), Stop> {
        if self.stopped.is_none() {
            self.stopped = self.hard_stop();
        }
        if self.stopped.is_none()
            && self.finishes()
            && (self.run.is_optional() || !self.run.has_solution())
        {
            self.stopped = self.finishing;
        }
        match self.stopped {
            Some(stop) => Err(stop),
            None => Ok(()),
        }
    }

    /// Whether a search is to end with the best that it has.
    pub(crate) fn ends(&mut self) -> bool {
        self.check().is_err() || self.finishing.is_some()
    }

    /// Whether the caller wants the results so far.
    pub(crate) fn finishes(&mut self) -> bool {
        if self.finishing.is_none() {
            let token = self.token.as_ref();
            if self.run.is_finishing() || token.is_some_and(CancelToken::is_finishing) {
                self.finishing = Some(Stop::Cancelled);
            } else if self.finish_at.is_some_and(|time| Instant::now() >= time) {
                self.finishing = Some(Stop::TimeLimit);
            }
        }
        self.finishing.is_some()
    }

    /// Whether the caller wants the results so far, and there are some. A caller who cancels does not.
    pub(crate) fn has_result_to_finish(&mut self) -> bool {
        self.hard_stop().is_none() && self.finishes() && self.run.has_solution()
    }

    /// Whether the caller still waits for a result: the token is not cancelled, and the time limit has not passed.
    pub(crate) fn is_awaited(&self) -> Result<(), Stop> {
        self.hard_stop().map_or(Ok(()), Err)
    }

    fn hard_stop(&self) -> Option<Stop> {
        let is_late = |limit: Duration| self.started.elapsed() >= limit;
        if self.token.as_ref().is_some_and(CancelToken::is_cancelled) {
            Some(Stop::Cancelled)
        } else if self.limit.is_some_and(is_late) {
            Some(Stop::TimeLimit)
        } else {
            None
        }
    }

    /// Reports the progress of `phase`. Returns whether a step that a result needs may continue.
    pub(crate) fn progress(&mut self, phase: Phase, fraction: f64) -> Result<(), Stop> {
        self.report(phase, fraction);
        self.check()
    }

    /// Reports the progress of `phase`. Returns whether a search is to end with the best that it has.
    pub(crate) fn ends_at(&mut self, phase: Phase, fraction: f64) -> bool {
        self.report(phase, fraction);
        self.ends()
    }

    fn report(&mut self, phase: Phase, fraction: f64) {
        if self.callback.is_none() {
            return;
        }
        let [from, to] = *self.step.get_or_insert_with(|| self.run.step());
        self.run
            .reach(from + run::of_step(phase, fraction) * (to - from));
        let now = Instant::now();
        let edge = fraction <= 0.0 || fraction >= 1.0;
        let due = |last: Instant| now - last >= PROGRESS_INTERVAL;
        if edge || self.last_progress.is_none_or(due) {
            self.last_progress = Some(now);
            self.tell(EventKind::Progress { phase, fraction });
        }
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
        self.run.has_solved();
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
            stage: self.run.stage(),
            share: self.run.share(),
            seconds: self.started.elapsed().as_secs_f64(),
            energy: self.energy,
            lower_bound: self.lower_bound,
            gap,
        };
        let flow = callback(&event);
        self.ask(flow);
    }

    /// Does what a callback of the caller asks for.
    pub(crate) fn ask(&mut self, flow: Flow) {
        match flow {
            Flow::Continue => {}
            Flow::Cancel => self.stopped = self.stopped.or(Some(Stop::Cancelled)),
            Flow::Finish => self.run.finish(),
        }
    }
}

/// Makes a step of a run that has a result without it as well: `None` if the caller wants the results so far.
/// The monitors are of one run.
///
/// # Errors
/// Those of the step, except for its end for that reason.
pub(crate) fn optional<'a, T>(
    monitor: &impl Fn() -> Monitor<'a>,
    step: impl FnOnce() -> crate::error::Result<T>,
) -> crate::error::Result<Option<T>> {
    if monitor().has_result_to_finish() {
        return Ok(None);
    }
    let run = monitor().run();
    let before = run.set_optional(true);
    let made = step();
    run.set_optional(before);
    match made {
        Err(Error::Cancelled | Error::TimeLimit) if monitor().has_result_to_finish() => Ok(None),
        other => other.map(Some),
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
    use super::*;

    #[test]
    fn a_run_that_finishes_ends_its_searches_and_what_it_can_do_without() {
        let (run, token) = (Run::new(), CancelToken::new());
        let monitor = || {
            let monitor = Monitor::default().of_run(&run);
            monitor.cancel_token(token.clone())
        };
        let checked = || Ok(monitor().check()?);
        monitor().improved(1.0);
        assert_eq!(optional(&monitor, checked), Ok(Some(())));
        let during = || {
            token.finish();
            checked()
        };
        assert_eq!(optional(&monitor, during), Ok(None));
        assert_eq!(optional(&monitor, || Ok(())), Ok(None));
        assert!(monitor().ends());
        assert_eq!(monitor().check(), Ok(()));
        token.cancel();
        assert_eq!(optional(&monitor, checked), Err(Error::Cancelled));
        assert_eq!(monitor().check(), Err(Stop::Cancelled));
        token.finish();
        assert!(token.is_cancelled() && !token.is_finishing());
    }

    #[test]
    fn a_run_without_a_solution_cannot_be_finished() {
        let mut monitor = Monitor::default().finish_at(Instant::now());
        assert_eq!(monitor.check(), Err(Stop::TimeLimit));
    }

    #[test]
    fn a_callback_that_finishes_is_heard_by_the_next_monitor_of_the_run() {
        let run = Run::new();
        let mut first = Monitor::default().of_run(&run).on_event(|_| Flow::Finish);
        first.improved(1.0);
        assert!(first.ends());
        assert_eq!(first.stopped(), Some(Stop::Cancelled));
        assert!(Monitor::default().of_run(&run).ends());
        assert!(!Monitor::default().ends());
    }

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
