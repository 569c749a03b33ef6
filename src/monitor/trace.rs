//! Where the time of a call goes: which thread did what, and when.
//!
//! A trace can also be that of a machine with more cores than this one has. Then the tasks of all threads are done
//! one after another, and a clock for each of the threads tells when it would have begun and ended them. A section of
//! tasks ends when the last of its threads has no more to do, so that the end of the whole is the length of the
//! critical path. What threads that really run at the same time cost each other, as in the caches, is not in it.

use std::cell::RefCell;
use std::sync::{Arc, Mutex};
use std::time::Instant;

use super::threads::SharedThreads;

/// What starting a thread takes, in seconds. Simulated threads take it as well.
const START: f64 = 30e-6;

/// A step that a thread has done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// What was done.
    pub name: &'static str,
    /// The number of the thread. That of the call is 0.
    pub thread: usize,
    /// When it began, in seconds after the start of the call.
    pub start: f64,
    /// When it ended.
    pub end: f64,
}

/// The steps of a call.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    /// In the order of their ends.
    pub spans: Vec<Span>,
    /// The seconds of the call.
    pub seconds: f64,
}

/// The spans so far, and the thread's own clock.
struct Clock {
    started: Instant,
    spans: Arc<Mutex<Vec<Span>>>,
    thread: usize,
    is_simulated: bool,
    /// The seconds that this clock is behind, because threads are simulated.
    behind: f64,
}

impl Clock {
    fn now(&self) -> f64 {
        self.started.elapsed().as_secs_f64() - self.behind
    }
}

thread_local! {
    static CLOCK: RefCell<Option<Clock>> = const { RefCell::new(None) };
}

fn with_clock<T>(of: impl FnOnce(&mut Clock) -> T) -> Option<T> {
    CLOCK.with_borrow_mut(|clock| clock.as_mut().map(of))
}

/// Makes a call and tells where its time goes. With `simulated`, the call is made by one thread, and the trace is
/// that of as many as the call [is allowed](super::with_threads).
pub fn traced<T>(simulated: bool, call: impl FnOnce() -> T) -> (T, Trace) {
    let spans = Arc::new(Mutex::new(Vec::new()));
    let clock = Clock {
        started: Instant::now(),
        spans: Arc::clone(&spans),
        thread: 0,
        is_simulated: simulated,
        behind: 0.0,
    };
    let within = Within::new(Some(clock));
    let result = call();
    let seconds = with_clock(|clock| clock.now()).unwrap_or(0.0);
    drop(within);
    let spans = match spans.lock() {
        Ok(mut spans) => std::mem::take(&mut *spans),
        Err(_) => Vec::new(),
    };
    (result, Trace { spans, seconds })
}

/// A clock that this thread has until this is dropped.
struct Within(Option<Clock>);

impl Within {
    fn new(clock: Option<Clock>) -> Self {
        Within(CLOCK.replace(clock))
    }
}

impl Drop for Within {
    fn drop(&mut self) {
        CLOCK.set(self.0.take());
    }
}

/// The step from here to where the result is dropped.
pub(crate) fn span(name: &'static str) -> Open {
    Open {
        name,
        start: with_clock(|clock| clock.now()),
    }
}

/// A step that is being done.
pub(crate) struct Open {
    name: &'static str,
    /// None without a trace.
    start: Option<f64>,
}

impl Drop for Open {
    fn drop(&mut self) {
        let Some(start) = self.start else {
            return;
        };
        with_clock(|clock| {
            let span = Span {
                name: self.name,
                thread: clock.thread,
                start,
                end: clock.now(),
            };
            if let Ok(mut spans) = clock.spans.lock() {
                spans.push(span);
            }
        });
    }
}

/// The number of the thread that is so many after this one. Tasks that share threads have those of tasks that have
/// ended.
fn after(thread: usize, number: usize) -> usize {
    match SharedThreads::numbers() {
        Some(all) => all.start + (thread - all.start + number) % all.len(),
        None => thread + number,
    }
}

/// The number of this thread. 0 without a trace.
pub(super) fn thread() -> usize {
    with_clock(|clock| clock.thread).unwrap_or(0)
}

/// The task of another thread, `number` after this one, with a clock of its own.
pub(super) fn on_thread<T>(number: usize, task: impl FnOnce() -> T) -> impl FnOnce() -> T {
    let clock = with_clock(|clock| Clock {
        started: clock.started,
        spans: Arc::clone(&clock.spans),
        thread: after(clock.thread, number),
        ..*clock
    });
    move || {
        let _within = Within::new(clock);
        task()
    }
}

/// The time on this thread's own clock. 0 without a trace.
pub(super) fn now() -> f64 {
    with_clock(|clock| clock.now()).unwrap_or(0.0)
}

/// Whether tasks of several threads are done one after another by this one.
pub(crate) fn is_simulated() -> bool {
    with_clock(|clock| clock.is_simulated).unwrap_or(false)
}

/// When a simulated thread that is started now begins.
pub(super) fn start_of_thread() -> f64 {
    with_clock(|clock| clock.now() + START).unwrap_or(0.0)
}

/// Does `task` as the thread `number` after this one, from the time `start` on. Returns when that thread ends.
pub(super) fn as_thread<T>(number: usize, start: f64, task: impl FnOnce() -> T) -> (T, f64) {
    let own = with_clock(|clock| {
        let now = clock.now();
        clock.behind += now - start;
        let there = after(clock.thread, number);
        (now, std::mem::replace(&mut clock.thread, there))
    });
    let result = {
        let _task = span("task");
        task()
    };
    let end = with_clock(|clock| {
        let end = clock.now();
        if let Some((now, thread)) = own {
            clock.behind += end - now;
            clock.thread = thread;
        }
        end
    });
    (result, end.unwrap_or(0.0))
}

/// Waits for a simulated thread that ends then.
pub(super) fn wait_until(end: f64) {
    with_clock(|clock| clock.behind -= (end - clock.now()).max(0.0));
}

/// Does `count` tasks as so many simulated threads, each of which takes the next task when it has done one. Their
/// numbers differ by `share`.
pub(super) fn simulate<T>(
    count: usize,
    threads: usize,
    share: usize,
    mut task: impl FnMut(usize) -> T,
) -> Vec<T> {
    let mut free = vec![start_of_thread(); threads];
    free[0] -= START;
    let each = (0..count).map(|k| {
        let next = (0..threads).min_by(|&a, &b| free[a].total_cmp(&free[b]));
        let next = next.unwrap_or(0);
        let (result, end) = as_thread(next * share, free[next], || task(k));
        free[next] = end;
        result
    });
    let results = each.collect();
    wait_until(free.iter().copied().fold(0.0, f64::max));
    results
}

/// Does tasks that wait for others as so many simulated threads would: `waits` has the number of tasks that each one
/// waits for, and `followers` those that wait for it. A thread that is free takes the task that became ready last.
///
/// # Errors
/// The first one of a task.
pub(crate) fn simulate_graph<E>(
    threads: usize,
    waits: &[u32],
    followers: &[Vec<u32>],
    mut task: impl FnMut(usize) -> Result<(), E>,
) -> Result<(), E> {
    let mut waits = waits.to_vec();
    let mut free = vec![start_of_thread(); threads];
    free[0] -= START;
    // Tasks, and the times from which they can be done.
    let first = (0..waits.len()).rev().filter(|&k| waits[k] == 0);
    let mut ready: Vec<(usize, f64)> = first.map(|k| (k, 0.0)).collect();
    let mut since = vec![0.0f64; waits.len()];
    while !ready.is_empty() {
        let next = (0..threads).min_by(|&a, &b| free[a].total_cmp(&free[b]));
        let next = next.unwrap_or(0);
        let soonest = |at: usize| ready[at].1.max(free[next]);
        let at = (0..ready.len())
            .rev()
            .min_by(|&a, &b| soonest(a).total_cmp(&soonest(b)));
        let start = at.map_or(0.0, soonest);
        let (k, _) = ready.remove(at.unwrap_or(0));
        let (done, end) = as_thread(next, start, || task(k));
        done?;
        free[next] = end;
        for &f in &followers[k] {
            let f = f as usize;
            since[f] = since[f].max(end);
            waits[f] -= 1;
            if waits[f] == 0 {
                ready.push((f, since[f]));
            }
        }
    }
    wait_until(free.iter().copied().fold(0.0, f64::max));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::parts::both;
    use super::super::threads::{allowed_threads, with_threads};
    use super::super::worker::{in_parts, tasks};
    use super::*;
    use crate::monitor::Monitor;
    use std::collections::BTreeSet;
    use std::time::Duration;

    fn work(milliseconds: u64) {
        let end = Instant::now() + Duration::from_millis(milliseconds);
        while Instant::now() < end {
            std::hint::spin_loop();
        }
    }

    #[test]
    fn steps_are_told_with_their_threads() {
        let (sum, trace) = traced(false, || {
            let _all = span("all");
            let parts = with_threads(2, || in_parts(2, 1, |part| part.start));
            parts.iter().sum::<usize>()
        });
        assert_eq!(sum, 1);
        let mut of: Vec<_> = trace.spans.iter().map(|s| (s.name, s.thread)).collect();
        of.sort_unstable();
        assert_eq!(of, [("all", 0), ("part", 0), ("part", 1)]);
        for span in &trace.spans {
            assert!(0.0 <= span.start && span.start <= span.end && span.end <= trace.seconds);
        }
        let _nobody = span("without a trace");
    }

    #[test]
    fn a_simulated_task_gets_the_threads_of_one_that_has_ended() {
        let first = || {
            let (began, before) = (Instant::now(), allowed_threads());
            while allowed_threads() < 2 && began.elapsed() < Duration::from_secs(20) {
                std::hint::spin_loop();
            }
            (before, allowed_threads(), now())
        };
        let second = || {
            // Longer than a busy machine may keep the first one from looking.
            work(100);
            now()
        };
        let (((before, after, until), end), _) =
            with_threads(2, || traced(true, || both(true, first, second)));
        assert_eq!((before, after), (1, 2));
        assert!(until >= end, "{until} {end}");
    }

    #[test]
    fn threads_of_tasks_that_have_ended_keep_their_numbers() {
        for is_simulated in [true, false] {
            let ((), trace) = with_threads(4, || {
                traced(is_simulated, || {
                    let all = || {
                        work(5);
                        while allowed_threads() < 4 {
                            std::thread::yield_now();
                        }
                        in_parts(4, 1, |_| work(1));
                    };
                    // In a simulation the second task is done first, and never gets other threads.
                    match is_simulated {
                        true => both(true, all, || ()),
                        false => both(true, || (), all),
                    };
                })
            });
            let parts = of_name(&trace, "part");
            let threads: BTreeSet<usize> = parts.iter().map(|span| span.thread).collect();
            assert!(threads.into_iter().eq(0..4), "{parts:?}");
        }
    }

    fn duration(span: &Span) -> f64 {
        span.end - span.start
    }

    fn of_name(trace: &Trace, name: &str) -> Vec<Span> {
        let spans = trace.spans.iter().copied();
        spans.filter(|span| span.name == name).collect()
    }

    #[test]
    fn simulated_threads_take_the_next_task_when_they_are_free() {
        let milliseconds = [8, 2, 5, 2];
        let ((), trace) = with_threads(3, || {
            traced(true, || {
                tasks(4, &mut Monitor::default(), |k, _| {
                    let _work = span("work");
                    work(milliseconds[k]);
                });
            })
        });
        let spans = of_name(&trace, "work");
        let threads: Vec<usize> = spans[..3].iter().map(|s| s.thread).collect();
        assert_eq!(threads, [0, 1, 2]);
        // The last task follows the first one that ends, and all end with the last.
        let first = spans[..3].iter().min_by(|a, b| a.end.total_cmp(&b.end));
        let first = first.unwrap();
        assert!(spans[3].thread == first.thread && spans[3].start >= first.end);
        let end = spans.iter().map(|s| s.end).fold(0.0, f64::max);
        let all: f64 = spans.iter().map(duration).sum();
        assert!(end <= trace.seconds && trace.seconds < all, "{trace:?}");
    }

    #[test]
    fn simulated_tasks_begin_when_those_that_they_wait_for_have_ended() {
        // 2 waits for 0 and 1, and 3 for 1.
        let waits = [0, 0, 2, 1];
        let followers = [vec![2], vec![2, 3], vec![], vec![]];
        let ((), trace) = traced(true, || {
            let task = |k: usize| {
                let _task = span(["0", "1", "2", "3"][k]);
                work(3);
                Ok::<(), ()>(())
            };
            simulate_graph(2, &waits, &followers, task).unwrap();
        });
        let of = |name| of_name(&trace, name)[0];
        assert!(of("0").thread != of("1").thread);
        assert!(of("2").start >= of("0").end.max(of("1").end));
        assert!(of("3").start >= of("1").end);
        let all: f64 = of_name(&trace, "task").iter().map(duration).sum();
        assert!(of("2").end.max(of("3").end) <= trace.seconds && trace.seconds < all);
        assert_eq!(simulate_graph(2, &waits, &followers, Err), Err(0));
    }
}
