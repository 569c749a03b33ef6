//! Progress: one line on stderr if it is a terminal, nothing otherwise.
//!
//! The line tells the stage, how much of the whole run is done, the energy and the gap where they mean
//! something, the time so far and about how long the rest takes. What is done never falls. How long further
//! tries take is not known, so once a stage is tried again the line says so instead of telling the rest.

use std::cell::Cell;
use std::fmt::Write;
use std::ops::Range;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use roundel::monitor::{EventKind, Run, Stage};
use roundel::{CancelToken, Event, Flow, Monitor, Options, Result};

use crate::free_memory::FreeMemory;
use crate::interrupt;
use crate::summary::telling_gap;

/// The line. It disappears when this is dropped.
pub struct Progress {
    bar: ProgressBar,
    run: Run,
    token: CancelToken,
    finish_at: Option<Instant>,
    tries: Tries,
    memory: FreeMemory,
}

/// Often enough to look alive, seldom enough to cost nothing.
const TICK: Duration = Duration::from_millis(100);

/// The steps of the line from nothing to all.
const LENGTH: u64 = 1_000;

/// The share of a run that reading and repair take.
const READ: f64 = 0.03;

/// The rest is estimated while the share that is done is in this range, once this time has passed. At the end
/// nobody knows what else is tried.
const TELLING: (Range<f64>, Duration) = (0.05..0.95, Duration::from_secs(2));

const LINE: &str = "{prefix:<6} {bar:20} {percent:>3} %  {elapsed}{rest}{msg}";

impl Progress {
    /// Starts the line with reading a file, catches Ctrl-C, and starts the clock of the run. indicatif draws on
    /// terminals only.
    pub fn start(quiet: bool) -> Result<Self> {
        let target = match quiet {
            true => ProgressDrawTarget::hidden(),
            false => ProgressDrawTarget::stderr(),
        };
        let bar = ProgressBar::with_draw_target(Some(LENGTH), target);
        bar.set_style(style(true));
        bar.set_prefix("repair");
        if !bar.is_hidden() {
            bar.enable_steady_tick(TICK);
        }
        let run = Run::new();
        run.next_call(READ, 1.0);
        Ok(Progress {
            bar,
            run,
            token: interrupt::cancel_token()?,
            finish_at: None,
            tries: Tries::default(),
            memory: FreeMemory::default(),
        })
    }

    /// Takes the time limit of the options as that of the whole run, which began at `started`.
    pub fn limit(&mut self, options: &mut Options, started: Instant) {
        let limit = Duration::try_from_secs_f64(options.time_limit).ok();
        self.finish_at = limit.and_then(|limit| started.checked_add(limit));
        if self.finish_at.is_some() {
            // A single solve ends with the run. It still knows that its time is limited.
            options.time_limit = f64::MAX;
        }
    }

    /// Gives the next call of the library the share from `from` to `to` of what follows reading.
    pub fn next_call(&self, from: f64, to: f64) {
        let of = |share: f64| READ + share * (1.0 - READ);
        self.run.next_call(of(from), of(to));
    }

    /// A monitor that keeps the line up to date, has free memory given back, and ends with the run.
    pub fn monitor(&self) -> Monitor<'_> {
        let mut monitor = Monitor::default()
            .of_run(&self.run)
            .cancel_token(self.token.clone());
        if let Some(time) = self.finish_at {
            monitor = monitor.finish_at(time);
        }
        monitor.on_event(|event| {
            match event.kind {
                EventKind::Log(line) => self.bar.println(line),
                EventKind::Progress { phase, .. } => self.memory.enter(phase),
                _ => {}
            }
            if self.tries.enter(event.stage) {
                self.bar.set_style(style(false));
            }
            self.bar.set_prefix(event.stage.name());
            self.bar.set_position((event.share * LENGTH as f64) as u64);
            self.bar.set_message(found(event));
            Flow::Continue
        })
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// The style of the line, with or without the rest.
fn style(tells_rest: bool) -> ProgressStyle {
    let style = ProgressStyle::with_template(LINE).expect("a template of indicatif");
    let style = match tells_rest {
        true => style.with_key("rest", rest),
        false => style.with_key("rest", |_: &ProgressState, line: &mut dyn Write| {
            // The line is drawn without it.
            let _ = line.write_str(", trying again");
        }),
    };
    style.progress_chars("=> ")
}

/// Whether a stage is tried again.
#[derive(Debug, Default)]
struct Tries {
    /// The rank of the last stage.
    last: Cell<usize>,
    are_several: Cell<bool>,
}

impl Tries {
    /// Enters a stage. Returns whether this is the first time that an earlier one is entered again.
    fn enter(&self, stage: Stage) -> bool {
        let rank = match stage {
            Stage::Map => 1,
            Stage::Quads => 2,
            Stage::Smooth => 3,
            _ => 0,
        };
        let is_again = rank < self.last.replace(rank);
        is_again && !self.are_several.replace(true)
    }
}

/// About how long the rest takes, once that can be told.
fn rest(state: &ProgressState, line: &mut dyn Write) {
    let (share, elapsed) = (f64::from(state.fraction()), state.elapsed());
    if TELLING.0.contains(&share) && elapsed >= TELLING.1 {
        let seconds = elapsed.as_secs_f64() * (1.0 - share) / share;
        // The line is drawn without it.
        let _ = write!(line, ", about {} left", duration(seconds));
    }
}

/// Seconds and minutes, no more exact than an estimate is.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 90.0 => format!("{:.0} s", s.max(1.0)),
        s if s < 5_400.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3_600.0),
    }
}

/// What has been found so far, if anything has.
fn found(event: &Event) -> String {
    if !event.energy.is_finite() {
        return String::new();
    }
    match telling_gap(Some(event.gap)) {
        Some(gap) => format!(", energy {:.6}, gap {:.2} %", event.energy, 100.0 * gap),
        None => format!(", energy {:.6}", event.energy),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_stage_before_the_last_one_is_another_try() {
        let tries = Tries::default();
        let first = [Stage::Field, Stage::Field, Stage::Map, Stage::Quads];
        assert_eq!(first.map(|stage| tries.enter(stage)), [false; 4]);
        assert!(tries.enter(Stage::Map));
        // It is told once.
        let others = [Stage::Quads, Stage::Field, Stage::Smooth];
        assert_eq!(others.map(|stage| tries.enter(stage)), [false; 3]);
    }

    #[test]
    fn phases_are_entered_where_no_line_is_drawn_as_well() {
        let progress = Progress::start(true).unwrap();
        let mut problem = roundel::Problem::new(1).unwrap();
        problem.add_least_squares(&[0], &[1.0], 0.3, 1.0).unwrap();
        problem.set_integers(&[0]).unwrap();
        assert_eq!(progress.memory.entered(), None);
        roundel::solve_with(&problem, &Options::default(), progress.monitor()).unwrap();
        assert!(progress.memory.entered().is_some());
    }

    #[test]
    fn an_estimate_is_told_in_seconds_minutes_or_hours() {
        let told = [0.2, 42.4, 150.0, 9_000.0].map(duration);
        assert_eq!(told, ["1 s", "42 s", "2 min", "2.5 h"]);
    }
}
