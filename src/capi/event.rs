//! The monitor of a solve: one callback for all events, and a cancel token.

use std::ffi::{CString, c_char, c_void};
use std::mem::offset_of;

use super::cancel::roundel_cancel_token;
use super::failure::{Failure, Outcome};
use super::guard;
use super::input::{aligned, slice};
use crate::error::Error;
use crate::monitor::{Event, Flow, Monitor};
use crate::monitor::{EventKind, Phase, Run, Stage};

/// The kind of an event.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_event_kind {
    /// A part of the solve has progressed: see `phase` and `fraction`.
    ROUNDEL_EVENT_PROGRESS = 1,
    /// A line for a log: see `text`.
    ROUNDEL_EVENT_LOG = 2,
    /// A better solution than all before: see `energy`.
    ROUNDEL_EVENT_IMPROVED = 3,
    /// A better lower bound than all before: see `lower_bound` and `gap`.
    ROUNDEL_EVENT_RAISED = 4,
}

/// A part of the solve.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_phase {
    /// Not a progress event.
    ROUNDEL_PHASE_NONE = 0,
    /// Elimination of the constraints.
    ROUNDEL_PHASE_ELIMINATE = 1,
    /// Ordering and factorization.
    ROUNDEL_PHASE_FACTOR = 2,
    /// The search for integers.
    ROUNDEL_PHASE_ROUND = 3,
    /// Motion of the continuous unknowns while the integers are fixed.
    ROUNDEL_PHASE_UNTANGLE = 4,
    /// Extraction of quads from a map, and their smoothing.
    ROUNDEL_PHASE_QUADS = 5,
}

/// A stage of the whole computation.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_stage {
    /// A problem is solved.
    ROUNDEL_STAGE_SOLVE = 0,
    /// The orientation field is solved for.
    ROUNDEL_STAGE_FIELD = 1,
    /// The map is solved for, and untangled.
    ROUNDEL_STAGE_MAP = 2,
    /// Quads are extracted from the map.
    ROUNDEL_STAGE_QUADS = 3,
    /// Quads are smoothed.
    ROUNDEL_STAGE_SMOOTH = 4,
}

/// What the callback may return. Any other value cancels.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_flow {
    /// Go on.
    ROUNDEL_FLOW_CONTINUE = 0,
    /// End the solve, which keeps its best solution. A call of several solves, such as roundel_quads_new,
    /// fails with ROUNDEL_ERROR_CANCELLED.
    ROUNDEL_FLOW_CANCEL = 1,
    /// Finish the call with the best integers so far: the search ends, later solves of the call round
    /// their relaxation, and what is not needed for a result is left out. Before a first solution this
    /// cancels.
    ROUNDEL_FLOW_FINISH = 2,
}

/// One event for the callback, with the state of the solve. It is valid until the callback returns.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct roundel_event {
    /// Size of this struct in the linked library, in bytes: later versions add members at its end.
    pub size: usize,
    /// What happened, a roundel_event_kind.
    pub kind: i32,
    /// The part of the solve, a roundel_phase.
    pub phase: i32,
    /// How much of the part is done, from 0 to 1.
    pub fraction: f64,
    /// A line of UTF-8 text; empty where there is none, never NULL.
    pub text: *const c_char,
    /// Seconds since the solve began.
    pub seconds: f64,
    /// Energy of the best solution so far; infinite before the first.
    pub energy: f64,
    /// The best lower bound so far; minus infinity before the first.
    pub lower_bound: f64,
    /// (energy - lower_bound) / |energy|: 0 where they are equal, and infinite while either is infinite or
    /// an energy of 0 is above the bound.
    pub gap: f64,
    /// The share of the whole call that is done, from 0 to 1, by the times that such calls take. It never
    /// falls.
    pub share: f64,
    /// The stage of the whole call, a roundel_stage.
    pub stage: i32,
    /// Reserved: 0.
    pub reserved: i32,
}

/// Receives progress, log lines and better solutions, on the thread that called solve. It returns a
/// roundel_flow: 0 to go on. It must return: no exception and no longjmp may leave it.
pub type roundel_callback =
    Option<unsafe extern "C" fn(event: *const roundel_event, user_data: *mut c_void) -> i32>;

/// The monitor of a solve.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct roundel_monitor {
    /// sizeof(roundel_monitor), which tells a later library which members the caller knows.
    pub size: usize,
    /// Called for every event; may be NULL.
    pub callback: roundel_callback,
    /// Passed to the callback unchanged.
    pub user_data: *mut c_void,
    /// Ends or finishes the call when it is set; may be NULL.
    pub cancel_token: *const roundel_cancel_token,
}

const CONTINUE: i32 = roundel_flow::ROUNDEL_FLOW_CONTINUE as i32;
const FINISH: i32 = roundel_flow::ROUNDEL_FLOW_FINISH as i32;

/// A longer struct is taken for one whose size was never set.
const LARGEST: usize = 4096;

const _: () = {
    let word = size_of::<usize>();
    assert!(size_of::<roundel_monitor>() == 4 * word);
    assert!(offset_of!(roundel_monitor, callback) == word);
    assert!(offset_of!(roundel_monitor, user_data) == 2 * word);
    assert!(offset_of!(roundel_monitor, cancel_token) == 3 * word);
    assert!(offset_of!(roundel_event, kind) == word);
    assert!(offset_of!(roundel_event, phase) == word + 4);
    assert!(offset_of!(roundel_event, fraction) == word + 8);
    assert!(offset_of!(roundel_event, text) == word + 16);
    assert!(offset_of!(roundel_event, share) == if word == 8 { 64 } else { 56 });
    assert!(offset_of!(roundel_event, stage) == if word == 8 { 72 } else { 64 });
    assert!(size_of::<roundel_event>() == if word == 8 { 80 } else { 72 });
};

/// The library's monitor for the caller's. The caller's may be NULL: then nobody watches.
///
/// # Safety
/// `monitor` is NULL or points to a struct of the size that its first member says, whose token is
/// NULL or live; its callback may be called until `'a` ends.
pub(super) unsafe fn monitor<'a>(monitor: *const roundel_monitor) -> Outcome<Monitor<'a>> {
    if monitor.is_null() {
        return Ok(Monitor::default());
    }
    aligned("monitor", monitor)?;
    // SAFETY: not NULL and aligned by the lines above; it has at least its first member.
    let size = unsafe { (&raw const (*monitor).size).read() };
    let known = size_of::<roundel_monitor>();
    if !(known..=LARGEST).contains(&size) {
        return Err(Failure::Library(Error::InvalidArgument {
            what: format!("monitor: size is {size}, not sizeof(roundel_monitor)"),
            index: None,
        }));
    }
    // SAFETY: the struct has `size` bytes by the caller's word, at least the ones read here.
    let (given, rest) = unsafe {
        let rest = monitor.cast::<u8>().add(known);
        (monitor.read(), slice("monitor", rest, size - known)?)
    };
    if rest.iter().any(|&byte| byte != 0) {
        return Err(Failure::Library(Error::NotSupported {
            what: "a member of roundel_monitor that this library does not know".into(),
            index: None,
            line: None,
        }));
    }
    let mut result = Monitor::default();
    if !given.cancel_token.is_null() {
        // SAFETY: a live token by the caller's word.
        let token = unsafe { guard::value(given.cancel_token) }?;
        result = result.cancel_token(token.clone());
    }
    if let Some(callback) = given.callback {
        result = result.on_event(move |event| {
            let text = text_of(event);
            let event = for_c(event, text.as_ptr());
            // SAFETY: a function by the caller's word; the event outlives the call.
            flow_of(unsafe { callback(&raw const event, given.user_data) })
        });
    }
    Ok(result)
}

/// What a callback asks for by the number that it returns.
pub(super) fn flow_of(returned: i32) -> Flow {
    match returned {
        CONTINUE => Flow::Continue,
        FINISH => Flow::Finish,
        _ => Flow::Cancel,
    }
}

/// The text of an event with the NUL that C wants.
fn text_of(event: &Event) -> CString {
    match event.kind {
        // A NUL inside a line, for example in a variable's name, must not truncate it.
        EventKind::Log(line) => CString::new(line.replace('\0', " ")).unwrap_or_default(),
        _ => CString::default(),
    }
}

fn for_c(event: &Event, text: *const c_char) -> roundel_event {
    use roundel_event_kind::*;
    let (kind, phase, fraction) = match event.kind {
        EventKind::Progress { phase, fraction } => (ROUNDEL_EVENT_PROGRESS, phase.into(), fraction),
        EventKind::Log(_) => (ROUNDEL_EVENT_LOG, roundel_phase::ROUNDEL_PHASE_NONE, 0.0),
        EventKind::Improved => (
            ROUNDEL_EVENT_IMPROVED,
            roundel_phase::ROUNDEL_PHASE_NONE,
            0.0,
        ),
        EventKind::Raised => (ROUNDEL_EVENT_RAISED, roundel_phase::ROUNDEL_PHASE_NONE, 0.0),
    };
    roundel_event {
        size: size_of::<roundel_event>(),
        kind: kind as i32,
        phase: phase as i32,
        fraction,
        text,
        seconds: event.seconds,
        energy: event.energy,
        lower_bound: event.lower_bound,
        gap: event.gap,
        share: event.share,
        stage: roundel_stage::from(event.stage) as i32,
        reserved: 0,
    }
}

impl From<Stage> for roundel_stage {
    fn from(stage: Stage) -> Self {
        match stage {
            Stage::Solve => roundel_stage::ROUNDEL_STAGE_SOLVE,
            Stage::Field => roundel_stage::ROUNDEL_STAGE_FIELD,
            Stage::Map => roundel_stage::ROUNDEL_STAGE_MAP,
            Stage::Quads => roundel_stage::ROUNDEL_STAGE_QUADS,
            Stage::Smooth => roundel_stage::ROUNDEL_STAGE_SMOOTH,
        }
    }
}

impl From<Phase> for roundel_phase {
    fn from(phase: Phase) -> Self {
        match phase {
            Phase::Eliminate => roundel_phase::ROUNDEL_PHASE_ELIMINATE,
            Phase::Factor => roundel_phase::ROUNDEL_PHASE_FACTOR,
            Phase::Round => roundel_phase::ROUNDEL_PHASE_ROUND,
            Phase::Untangle => roundel_phase::ROUNDEL_PHASE_UNTANGLE,
            Phase::Quads => roundel_phase::ROUNDEL_PHASE_QUADS,
        }
    }
}

/// A watcher for every step of one call, all with the caller's callback and token.
///
/// # Safety
/// As [`watched_by`], for as long as the result is used.
pub(super) unsafe fn watchers<'a>(
    monitor: *const roundel_monitor,
) -> Outcome<impl Fn() -> Monitor<'a>> {
    // Errors in the monitor are reported before any work is done.
    // SAFETY: handed on.
    unsafe { self::monitor(monitor) }?;
    // SAFETY: handed on.
    let one = move || unsafe { self::monitor(monitor) }.unwrap_or_default();
    let run = Run::new();
    Ok(move || one().of_run(&run))
}
