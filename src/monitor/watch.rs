//! The end of the current call, for loops that have no monitor. All layers know it, as they know how many threads
//! a call may use.
//!
//! A call ends as its monitor asks, and where there is not enough memory left. Rust ends the program where a
//! vector cannot grow, so every loop asks beforehand whether there is room for all that it may allocate before it
//! asks again, an amount that follows from the size of the problem.

use std::cell::RefCell;
use std::hint::black_box;
use std::marker::PhantomData;
use std::time::Instant;

use super::Monitor;
use super::cancel::{CancelToken, Stop};
use crate::error::Error;

thread_local! {
    static CURRENT: RefCell<Limits> = RefCell::default();
}

/// What ends the current call.
#[derive(Debug, Clone, Default)]
pub(super) struct Limits {
    token: Option<CancelToken>,
    /// Whether a caller who wants the results so far ends the call as well, because there are none.
    ends_to_finish: bool,
    deadline: Option<Instant>,
    room: Room,
}

/// The memory that there must be between one question and the next.
#[derive(Debug, Clone, Copy, Default)]
struct Room {
    bytes: usize,
    /// The questions so far.
    questions: u32,
    /// Whether the system grants it whenever it is asked, so that it is not asked any more.
    is_granted: bool,
}

/// The questions of a call after which it pays to ask the system for its limits.
const QUESTIONS: u32 = 8;

impl Room {
    /// Whether there is room. The limits of the system are those since the call began.
    fn is_there(&mut self) -> bool {
        if self.bytes == 0 || self.is_granted {
            return true;
        }
        self.questions += 1;
        self.is_granted = self.questions == QUESTIONS && is_memory_unlimited();
        has_room(self.bytes)
    }

    /// The room of a call within one of the room `before`: more than that is asked for anew.
    fn within(self, before: Room) -> Self {
        if self.bytes > before.bytes {
            self
        } else {
            before
        }
    }
}

/// Whether the system sets no limit to the addresses of this process, and grants all that it is asked for.
fn is_memory_unlimited() -> bool {
    let read = |path| std::fs::read_to_string(path).unwrap_or_default();
    let limits = read("/proc/self/limits");
    let is_unlimited = |name: &str| {
        let line = limits.lines().find_map(|line| line.strip_prefix(name));
        line.is_some_and(|line| line.trim_start().starts_with("unlimited"))
    };
    let commit = read("/proc/sys/vm/overcommit_memory");
    // 2 stands for no more than there is.
    ["0", "1"].contains(&commit.trim())
        && ["Max address space", "Max data size"]
            .into_iter()
            .all(is_unlimited)
}

/// While this lives, calls of its thread end as its monitor asks, also those that take no monitor: they return
/// [`Error::Cancelled`](crate::Error::Cancelled) or [`Error::TimeLimit`](crate::Error::TimeLimit) where they
/// return errors of the library. It ends before those that were made earlier.
#[derive(Debug)]
#[must_use = "it ends when it is dropped"]
pub struct Watch {
    before: Limits,
    /// It belongs to its thread.
    _thread: PhantomData<*const ()>,
}

impl Limits {
    /// Whether another thread can be started.
    pub(super) fn has_room_for_a_thread(&self) -> bool {
        let bytes = self.room.bytes.saturating_mul(2).saturating_add(THREAD);
        self.room.is_granted || has_room(bytes)
    }

    /// What ends the current call of this thread.
    pub(super) fn current() -> Self {
        CURRENT.with_borrow(Limits::clone)
    }

    /// Makes these the limits of the current call, as far as an earlier one is not nearer.
    pub(super) fn watch(self) -> Watch {
        let before = Limits::current();
        let deadlines = [self.deadline, before.deadline];
        let has_token = self.token.is_some();
        let ends_to_finish = if has_token { &self } else { &before }.ends_to_finish;
        CURRENT.set(Limits {
            token: self.token.or_else(|| before.token.clone()),
            ends_to_finish,
            deadline: deadlines.into_iter().flatten().min(),
            room: self.room.within(before.room),
        });
        Watch {
            before,
            _thread: PhantomData,
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let mut before = std::mem::take(&mut self.before);
        CURRENT.with_borrow_mut(|limits| {
            // What a call within another one has asked need not be asked again.
            if before.room.bytes > 0 {
                before.room.questions = before.room.questions.max(limits.room.questions);
                before.room.is_granted |= limits.room.is_granted;
            }
            *limits = before;
        });
    }
}

impl Monitor<'_> {
    /// Lets calls without a monitor end as this one asks: when its token is cancelled, and when the time limit of the
    /// solve that it watches has passed.
    pub fn watch(&self) -> Watch {
        self.limits().watch()
    }

    /// [`watch`](Self::watch) for a search, whose parts end as well when the caller wants the results so far.
    pub(crate) fn watch_search(&self) -> Watch {
        let mut limits = self.limits();
        limits.ends_to_finish = true;
        limits.deadline = limits.deadline.into_iter().chain(self.finish_at).min();
        limits.watch()
    }

    /// Makes a step whose parts without a monitor end as this one asks, also when the caller wants the results so far
    /// and there are none when the step begins.
    pub(crate) fn watching<T>(&self, step: impl FnOnce() -> T) -> T {
        let mut limits = self.limits();
        if self.run.is_optional() || !self.run.has_solution() {
            limits.ends_to_finish = true;
            limits.deadline = limits.deadline.into_iter().chain(self.finish_at).min();
        }
        let _watch = limits.watch();
        step()
    }

    fn limits(&self) -> Limits {
        let of_solve = |limit| self.started.checked_add(limit);
        Limits {
            token: self.token.clone(),
            deadline: self.limit.and_then(of_solve),
            ..Limits::default()
        }
    }
}

/// The room of a problem without unknowns, in bytes.
const LEAST_ROOM: usize = 1 << 22;

/// The room of each unknown, coefficient or triangle of what a call works on, in bytes.
const ROOM: usize = 60;

/// The bytes of a thread: its stack, and the heap of its own for which the C library of Linux takes 64 megabytes
/// of addresses, and twice as much for a moment. Rust ends the program where a thread cannot be set up.
const THREAD: usize = 160 << 20;

/// Lets a call that works on this many unknowns, coefficients or triangles end where there is no memory for its
/// next step.
pub(crate) fn watch_memory(items: usize) -> Watch {
    let limits = Limits {
        room: Room {
            bytes: items.saturating_mul(ROOM).saturating_add(LEAST_ROOM),
            ..Room::default()
        },
        ..Limits::default()
    };
    limits.watch()
}

/// Fails where `what` does not fit into memory: `count` items of which each needs so many bytes in all.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub(crate) fn room_for(what: &'static str, count: usize, bytes: usize) -> Result<(), Error> {
    match is_room_for(count, bytes) {
        true => Ok(()),
        false => Err(Error::OutOfMemory { what }),
    }
}

/// Whether there is room for `count` items of which each needs so many bytes in all.
pub(crate) fn is_room_for(count: usize, bytes: usize) -> bool {
    has_room(count.saturating_mul(bytes).saturating_add(LEAST_ROOM))
}

/// How many items, at most `count`, have room if each needs so many bytes: all, or a half, a quarter and so on.
pub(crate) fn room_up_to(count: usize, bytes: usize) -> usize {
    let mut count = count;
    while count > 0 && !is_room_for(count, bytes) {
        count /= 2;
    }
    count
}

/// Whether this many bytes can be allocated now.
fn has_room(bytes: usize) -> bool {
    let mut room = Vec::<u8>::new();
    let found = room.try_reserve_exact(bytes).is_ok();
    // What nobody sees need not be allocated.
    black_box(&mut room);
    found
}

/// Whether a step that a result needs may continue: what loops without a monitor ask, once in a millisecond or
/// so.
pub(crate) fn may_continue() -> Result<(), Stop> {
    is_wanted()?;
    match CURRENT.with_borrow_mut(|limits| limits.room.is_there()) {
        true => Ok(()),
        false => Err(Stop::OutOfMemory),
    }
}

/// [`may_continue`] without a question for memory, for loops that ask every few microseconds.
pub(crate) fn is_wanted() -> Result<(), Stop> {
    CURRENT.with_borrow(|limits| {
        let ends = |token: &CancelToken| {
            token.is_cancelled() || limits.ends_to_finish && token.is_finishing()
        };
        if limits.token.as_ref().is_some_and(ends) {
            Err(Stop::Cancelled)
        } else if limits.deadline.is_some_and(|end| Instant::now() >= end) {
            Err(Stop::TimeLimit)
        } else {
            Ok(())
        }
    })
}

/// [`may_continue`] in a loop over small items, which asks at each 4096th.
pub(crate) fn may_continue_at(item: usize) -> Result<(), Stop> {
    match item % 4096 {
        0 => may_continue(),
        _ => Ok(()),
    }
}

/// [`is_wanted`] in a loop over the rows of a dense matrix, each with `width` entries of which each takes as many
/// operations. It asks at the first row, and then once in some thousand entries.
pub(crate) fn is_wanted_at(row: usize, width: usize) -> Result<(), Stop> {
    match row * width % 4096 < width {
        true => is_wanted(),
        false => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{in_parts, with_threads};

    #[test]
    fn calls_end_while_they_are_watched_and_not_afterwards() {
        let token = CancelToken::new();
        token.cancel();
        assert_eq!(may_continue(), Ok(()));
        let watch = Monitor::default().cancel_token(token.clone()).watch();
        assert_eq!(may_continue(), Err(Stop::Cancelled));
        assert_eq!(may_continue_at(8192), Err(Stop::Cancelled));
        assert_eq!(may_continue_at(8193), Ok(()));
        let asks = |width: usize| (0..100).filter(move |&row| is_wanted_at(row, width).is_err());
        assert_eq!(asks(50).collect::<Vec<_>>(), [0, 82]);
        assert_eq!(asks(5_000).count(), 100);
        drop(watch);
        assert_eq!(may_continue(), Ok(()));
    }

    #[test]
    fn a_call_within_another_ends_with_it() {
        let token = CancelToken::new();
        let outer = Monitor::default().cancel_token(token.clone()).watch();
        let mut limited = Monitor::default();
        limited.start(0.0);
        let inner = limited.watch();
        assert_eq!(may_continue(), Err(Stop::TimeLimit));
        token.cancel();
        assert_eq!(may_continue(), Err(Stop::Cancelled));
        drop(inner);
        assert_eq!(may_continue(), Err(Stop::Cancelled));
        drop(outer);
        assert_eq!(may_continue(), Ok(()));
    }

    #[test]
    fn a_caller_who_wants_the_results_so_far_ends_what_has_none() {
        let token = CancelToken::new();
        let mut monitor = Monitor::default().cancel_token(token.clone());
        token.finish();
        assert_eq!(monitor.watching(may_continue), Err(Stop::Cancelled));
        monitor.improved(1.0);
        assert_eq!(monitor.watching(may_continue), Ok(()));
    }

    #[test]
    fn a_watch_that_began_without_results_does_not_end_what_has_some() {
        let token = CancelToken::new();
        let _watch = Monitor::default().cancel_token(token.clone()).watch();
        token.finish();
        assert_eq!(may_continue(), Ok(()));
        token.cancel();
        assert_eq!(may_continue(), Err(Stop::Cancelled));
    }

    #[test]
    fn a_call_ends_where_there_is_no_memory_for_its_next_step() {
        let _some = watch_memory(1_000);
        assert_eq!(may_continue(), Ok(()));
        let all = watch_memory(usize::MAX);
        assert_eq!(may_continue(), Err(Stop::OutOfMemory));
        drop(all);
        assert_eq!(room_up_to(1 << 10, 4), 1 << 10);
        assert!((1..usize::MAX).contains(&room_up_to(usize::MAX, 2)));
        assert!(room_for("all that there is", usize::MAX, 1).is_err());
        assert_eq!(may_continue(), Ok(()));
    }

    #[test]
    fn a_system_without_limits_is_asked_no_more_than_a_few_times_a_call() {
        let is_granted = || CURRENT.with_borrow(|limits| limits.room.is_granted);
        let ask = || (0..QUESTIONS).for_each(|_| assert_eq!(may_continue(), Ok(())));
        let outer = watch_memory(1_000);
        assert!(!is_granted());
        let inner = watch_memory(10);
        ask();
        assert_eq!(is_granted(), is_memory_unlimited());
        drop(inner);
        assert_eq!(is_granted(), is_memory_unlimited());
        let more = watch_memory(2_000);
        assert!(!is_granted());
        drop(more);
        assert_eq!(is_granted(), is_memory_unlimited());
        drop(outer);
        let _another = watch_memory(1_000);
        assert!(!is_granted());
    }

    #[test]
    fn all_threads_of_a_call_end_with_it() {
        let token = CancelToken::new();
        token.cancel();
        let _watch = Monitor::default().cancel_token(token).watch();
        let asked = with_threads(3, || in_parts(3, 1, |_| may_continue()));
        assert_eq!(asked, [Err(Stop::Cancelled); 3]);
    }
}
