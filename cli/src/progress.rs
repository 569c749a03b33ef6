//! Progress: one line on stderr if it is a terminal, nothing otherwise.

use std::borrow::Cow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use roundel::monitor::{EventKind, Phase};
use roundel::{Event, Flow, Monitor};

use crate::summary::telling_gap;

/// The line. It disappears when this is dropped.
pub struct Progress(ProgressBar);

/// Often enough to look alive, seldom enough to cost nothing.
const TICK: Duration = Duration::from_millis(100);

impl Progress {
    /// Starts the line with the word for reading a file. indicatif draws on terminals only.
    pub fn start() -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        bar.set_style(ProgressStyle::default_spinner());
        if !bar.is_hidden() {
            bar.enable_steady_tick(TICK);
        }
        bar.set_message("read");
        Progress(bar)
    }

    /// Shows the current step, for steps without a monitor.
    pub fn say(&self, what: &'static str) {
        self.0.set_message(what);
    }

    /// A monitor that keeps the line up to date.
    pub fn monitor(&self) -> Monitor<'_> {
        if self.0.is_hidden() {
            return Monitor::default();
        }
        let mut phase = "";
        Monitor::default().on_event(move |event| {
            match event.kind {
                EventKind::Progress {
                    phase: now,
                    fraction,
                } => {
                    phase = word(now);
                    self.0.set_message(format!(
                        "{phase} {:.0} %{}",
                        100.0 * fraction,
                        found(event)
                    ));
                }
                EventKind::Improved | EventKind::Raised => {
                    self.0.set_message(format!("{phase}{}", found(event)))
                }
                EventKind::Log(line) => self.0.println(line),
                _ => {}
            }
            Flow::Continue
        })
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

fn word(phase: Phase) -> &'static str {
    match phase {
        Phase::Eliminate => "eliminate",
        Phase::Factor => "factor",
        Phase::Round => "round",
        Phase::Untangle => "untangle",
        Phase::Quads => "quads",
        _ => "solve",
    }
}

/// What has been found so far, if anything has.
fn found(event: &Event) -> Cow<'static, str> {
    if !event.energy.is_finite() {
        return "".into();
    }
    match telling_gap(Some(event.gap)) {
        Some(gap) => format!(", energy {:.6}, gap {:.2} %", event.energy, 100.0 * gap).into(),
        None => format!(", energy {:.6}", event.energy).into(),
    }
}
