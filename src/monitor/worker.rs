//! Work on other threads, while the thread of the call does its own part.
//!
//! A monitor belongs to the thread of the call, and so does its callback. A worker therefore has monitors of its
//! own, which know the limits of the call's monitor and a flag that the thread of the call sets when its own
//! monitor asks to end. What is computed never depends on the number of threads: each task has its own result,
//! and results are joined in the order of the tasks.

use std::io::ErrorKind;
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread::{Builder, Scope, ScopedJoinHandle};
use std::time::{Duration, Instant};

use super::Monitor;
use super::cancel::{CancelToken, Stop};
use super::run::Run;
use super::threads::{SharedThreads, allowed_threads, with_threads};
use super::trace;
use super::watch::Limits;
use crate::error::{Error, Result};

/// How often the thread of the call asks its monitor while it waits.
const WAIT: Duration = Duration::from_millis(5);

#[cfg(test)]
thread_local! {
    /// The threads that this one has started.
    static SPAWNED: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// The threads that the calls of a test have started.
#[cfg(test)]
pub(crate) fn spawned(calls: impl FnOnce()) -> usize {
    let before = SPAWNED.get();
    calls();
    SPAWNED.get() - before
}

pub(super) fn spawn<'scope, T: Send + 'scope>(
    scope: &'scope Scope<'scope, '_>,
    number: usize,
    task: impl FnOnce() -> T + Send + 'scope,
) -> std::io::Result<ScopedJoinHandle<'scope, T>> {
    if !Limits::current().has_room_for_a_thread() {
        return Err(ErrorKind::OutOfMemory.into());
    }
    let (task, limits) = (trace::on_thread(number, task), Limits::current());
    let there = move || {
        let _watch = limits.watch();
        task()
    };
    let handle = Builder::new().spawn_scoped(scope, there)?;
    #[cfg(test)]
    SPAWNED.set(SPAWNED.get() + 1);
    Ok(handle)
}

/// What the monitors of other threads have of the call's monitor.
#[derive(Debug, Clone)]
pub(crate) struct Worker {
    token: CancelToken,
    started: Instant,
    limit: Option<Duration>,
    finish_at: Option<Instant>,
    is_optional: bool,
    has_solution: bool,
    /// The threads that a task may use, with its own.
    threads: usize,
    shared: Option<SharedThreads>,
}

impl Worker {
    /// A task may use so many of these threads, instead of its own alone.
    pub(crate) fn with_threads(self, threads: usize, shared: &SharedThreads) -> Self {
        let shared = Some(shared.clone());
        Worker {
            threads,
            shared,
            ..self
        }
    }

    /// What is done with these monitors is optional, because the run has a result without it as well.
    pub(crate) fn optional(mut self) -> Self {
        (self.is_optional, self.has_solution) = (true, true);
        self
    }

    /// A monitor of the worker's thread.
    fn monitor(&self, run: &Run) -> Monitor<'static> {
        Monitor {
            token: Some(self.token.clone()),
            started: self.started,
            limit: self.limit,
            finish_at: self.finish_at,
            ..Monitor::default().of_run(run)
        }
    }

    /// The run of the worker's monitors.
    fn run(&self) -> Run {
        let run = Run::new();
        run.set_optional(self.is_optional);
        if self.has_solution {
            run.has_solved();
        }
        run
    }

    /// Starts a task on a thread of its own, `number` after this one. The thread that waits for it does it instead if
    /// no other can be started.
    pub(crate) fn start<'scope, T, F>(
        self,
        scope: &'scope Scope<'scope, '_>,
        number: usize,
        task: F,
    ) -> Started<'scope, T, F>
    where
        T: Send + 'scope,
        F: FnOnce(&mut Monitor) -> T + Send + Clone + 'scope,
    {
        let (threads, shared) = (self.threads, self.shared.clone());
        if trace::is_simulated() {
            let start = trace::start_of_thread();
            return Started::Simulated(task, [number, threads], shared, start);
        }
        let (sender, result) = channel();
        let token = Ends(self.token.clone());
        let there = task.clone();
        let there = move || {
            let mut monitor = self.monitor(&self.run());
            let _watch = monitor.watch();
            let done = on_threads(threads, shared.as_ref(), || there(&mut monitor));
            // Nobody receives it where nobody waits.
            let _ = sender.send(done);
        };
        match spawn(scope, number, there) {
            Ok(handle) => Started::There(result, handle, token),
            Err(_) => Started::Here(task),
        }
    }
}

/// Ends the tasks of a token that nobody waits for.
pub(crate) struct Ends(CancelToken);

impl Drop for Ends {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

/// A task that another thread does, or that is left to the one that waits for it.
pub(crate) enum Started<'scope, T, F> {
    There(Receiver<T>, ScopedJoinHandle<'scope, ()>, Ends),
    Here(F),
    /// As another thread, this many after this one, would do it with so many threads from this time on.
    Simulated(F, [usize; 2], Option<SharedThreads>, f64),
}

/// Does a task with so many threads, which may be some of these.
fn on_threads<T>(threads: usize, shared: Option<&SharedThreads>, task: impl FnOnce() -> T) -> T {
    match shared {
        Some(shared) => shared.task(threads, task),
        None => with_threads(threads, task),
    }
}

impl<T, F: FnOnce(&mut Monitor) -> T> Started<'_, T, F> {
    /// The result, once there is one. The worker hears what the monitor asks for until then.
    pub(crate) fn wait(self, monitor: &mut Monitor) -> T {
        let (result, handle, token) = match self {
            Started::Here(task) => return task(monitor),
            Started::Simulated(task, [number, threads], shared, start) => {
                let there = || on_threads(threads, shared.as_ref(), || task(monitor));
                let (found, end) = trace::as_thread(number, start, there);
                trace::wait_until(end);
                return found;
            }
            Started::There(result, handle, token) => (result, handle, token),
        };
        loop {
            match result.recv_timeout(WAIT) {
                Ok(found) => return found,
                Err(RecvTimeoutError::Timeout) => monitor.pass_on(&token.0),
                Err(RecvTimeoutError::Disconnected) => match handle.join() {
                    Err(panic) => resume_unwind(panic),
                    Ok(()) => unreachable!("a worker sends its result"),
                },
            }
        }
    }
}

/// Does `count` tasks on the threads that are allowed and gives their results in the order of the tasks. A task
/// gets its number, and a function that makes its monitors. An error of one ends all. Tasks at the same time share
/// the threads; where no task is left, those that are not done get them.
///
/// The thread of the call does the first one, with monitors of the call. All others are optional, because the
/// run has a result without them as well. `begins` hears, on the thread of the call, how many are done.
///
/// # Errors
/// Those of the tasks.
pub(crate) fn side_by_side<'m, T: Send>(
    count: usize,
    monitor: &impl Fn() -> Monitor<'m>,
    begins: impl Fn(usize),
    task: impl for<'x> Fn(usize, &dyn Fn() -> Monitor<'x>) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let threads = allowed_threads().min(count);
    if threads <= 1 {
        let each = |k: usize| {
            begins(k);
            task(k, &|| monitor())
        };
        return (0..count).map(each).collect();
    }
    let share = allowed_threads() / threads;
    if trace::is_simulated() {
        let each = |k: usize| {
            begins(k);
            with_threads(share, || task(k, &|| monitor()))
        };
        let done = trace::simulate(count, threads, share, each);
        return done.into_iter().collect();
    }
    let shared = SharedThreads::among(threads);
    let mut of_call = monitor();
    let worker = of_call.worker().optional();
    let limits = Limits::current();
    let token = Ends(worker.token.clone());
    let [next, done] = [AtomicUsize::new(1), AtomicUsize::new(0)];
    let take = || Some(next.fetch_add(1, Relaxed)).filter(|&k| k < count);
    let (sender, results) = channel();
    let mut found: Vec<(usize, Result<T>)> = Vec::with_capacity(count);
    std::thread::scope(|scope| {
        for number in 1..threads {
            let (sender, worker) = (sender.clone(), worker.clone());
            let (limits, shared) = (limits.clone(), shared.clone());
            let (task, take, next, done) = (&task, &take, &next, &done);
            let all = move || {
                while let Some(k) = take() {
                    let run = worker.run();
                    let _watch = worker.monitor(&run).watch();
                    let result = task(k, &|| worker.monitor(&run));
                    done.fetch_add(1, Relaxed);
                    let is_last = result.is_err();
                    if is_last {
                        next.store(count, Relaxed);
                    }
                    if sender.send((k, result)).is_err() || is_last {
                        break;
                    }
                }
            };
            let there = move || {
                let _watch = limits.watch();
                shared.task(share, all);
            };
            if spawn(scope, number * share, there).is_err() {
                break;
            }
        }
        drop(sender);
        shared.task(share, || {
            let mut own = Some(0);
            while let Some(k) = own {
                begins(done.load(Relaxed));
                match task(k, &|| monitor()) {
                    Ok(result) => found.push((k, Ok(result))),
                    Err(error) => {
                        token.0.cancel();
                        return Err(error);
                    }
                }
                done.fetch_add(1, Relaxed);
                of_call.pass_on(&token.0);
                own = take();
            }
            Ok(())
        })?;
        loop {
            match results.recv_timeout(WAIT) {
                Ok(result) => found.push(result),
                Err(RecvTimeoutError::Timeout) => of_call.pass_on(&token.0),
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        Ok::<(), Error>(())
    })?;
    found.sort_by_key(|(k, _)| *k);
    found.into_iter().map(|(_, result)| result).collect()
}

/// Does `count` tasks on the threads that are allowed, and gives their results in the order of the tasks. A task
/// gets its number and a monitor. Tasks at the same time share the threads; where no task is left, those that are not
/// done get them.
pub(crate) fn tasks<T: Send>(
    count: usize,
    monitor: &mut Monitor,
    task: impl Fn(usize, &mut Monitor) -> T + Sync,
) -> Vec<T> {
    let threads = allowed_threads().min(count);
    if threads <= 1 {
        return (0..count).map(|k| task(k, monitor)).collect();
    }
    let each_has = allowed_threads() / threads;
    if trace::is_simulated() {
        let each = |k: usize| with_threads(each_has, || task(k, monitor));
        return trace::simulate(count, threads, each_has, each);
    }
    let shared = SharedThreads::among(threads);
    let next = AtomicUsize::new(0);
    let share = |monitor: &mut Monitor| {
        let mut done = Vec::new();
        loop {
            let k = next.fetch_add(1, Relaxed);
            if k >= count {
                return done;
            }
            done.push((k, task(k, monitor)));
        }
    };
    let share = &share;
    let mut done = std::thread::scope(|scope| {
        // Each has a token of its own, which ends it when nobody waits for it any more.
        let others: Vec<_> = (1..threads)
            .map(|number| {
                let worker = monitor.worker().with_threads(each_has, &shared);
                worker.start(scope, number * each_has, share)
            })
            .collect();
        let mut done = shared.task(each_has, || share(monitor));
        for other in others {
            done.extend(other.wait(monitor));
        }
        done
    });
    done.sort_unstable_by_key(|(k, _)| *k);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Does parts of `0..count` on the threads that are allowed, and gives their results in order. Each part has at
/// least so many items, and the thread of the call does the first one.
pub(crate) fn in_parts<T: Send>(
    count: usize,
    least: usize,
    part: impl Fn(Range<usize>) -> T + Sync,
) -> Vec<T> {
    let threads = allowed_threads().min(count / least.max(1)).max(1);
    if threads == 1 {
        return vec![part(0..count)];
    }
    let of = |k: usize| k * count / threads..(k + 1) * count / threads;
    let part = |k: usize| {
        let _part = trace::span("part");
        with_threads(1, || part(of(k)))
    };
    if trace::is_simulated() {
        return trace::simulate(threads, threads, 1, part);
    }
    let part = &part;
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads)
            .map(|k| (k, spawn(scope, k, move || part(k))))
            .collect();
        let mut found = vec![part(0)];
        found.extend(others.into_iter().map(|(k, other)| match other {
            Ok(handle) => handle.join().unwrap_or_else(|panic| resume_unwind(panic)),
            Err(_) => part(k),
        }));
        found
    })
}

impl Monitor<'_> {
    /// What monitors of other threads have of this one.
    pub(crate) fn worker(&mut self) -> Worker {
        let token = CancelToken::new();
        self.pass_on(&token);
        Worker {
            token,
            started: self.started,
            limit: self.limit,
            finish_at: self.finish_at,
            is_optional: self.run.is_optional(),
            has_solution: self.run.has_solution(),
            threads: 1,
            shared: None,
        }
    }

    /// Tells a worker what is asked for. It knows the limits of time itself.
    fn pass_on(&mut self, to: &CancelToken) {
        let is_cancelled = self.token.as_ref().is_some_and(CancelToken::is_cancelled);
        if is_cancelled || self.stopped == Some(Stop::Cancelled) {
            to.cancel();
        } else if self.finishes() {
            to.finish();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::monitor::{Event, Flow, Phase};
    use std::collections::HashSet;
    use std::sync::atomic::AtomicBool;
    use std::sync::{Barrier, Mutex};
    use std::thread::{current, scope};

    #[test]
    fn tasks_run_at_the_same_time_and_keep_their_order() {
        // Each waits for the other three.
        let barrier = Barrier::new(4);
        let seen = Mutex::new(HashSet::new());
        let squares = with_threads(4, || {
            side_by_side(
                4,
                &Monitor::default,
                |_| {},
                |k, _| {
                    assert_eq!(allowed_threads(), 1);
                    barrier.wait();
                    seen.lock().unwrap().insert(current().id());
                    Ok(k * k)
                },
            )
        });
        assert_eq!(squares, Ok(vec![0, 1, 4, 9]));
        assert_eq!(seen.lock().unwrap().len(), 4);
        for threads in [0, 1, 2, 16] {
            let squares = || side_by_side(9, &Monitor::default, |_| {}, |k, _| Ok(k * k));
            let squares = with_threads(threads, squares);
            assert_eq!(squares, Ok(vec![0, 1, 4, 9, 16, 25, 36, 49, 64]));
        }
        let none = side_by_side(0, &Monitor::default, |_| {}, |k, _| Ok(k));
        assert_eq!(none, Ok(Vec::new()));
    }

    #[test]
    fn the_callback_stays_on_the_thread_of_the_call_and_stops_all() {
        let caller = current().id();
        let on_event = |_: &Event| {
            assert_eq!(current().id(), caller);
            Flow::Cancel
        };
        let run = Run::new();
        let monitor = || Monitor::default().of_run(&run).on_event(on_event);
        let ends: Result<Vec<()>> = with_threads(2, || {
            side_by_side(
                2,
                &monitor,
                |_| {},
                |_, monitor| {
                    let mut monitor = monitor();
                    loop {
                        monitor.progress(Phase::Round, 0.0)?;
                        std::thread::yield_now();
                    }
                },
            )
        });
        assert_eq!(ends, Err(Error::Cancelled));
    }

    #[test]
    fn a_token_stops_the_tasks_of_all_threads() {
        let token = CancelToken::new();
        let monitor = || Monitor::default().cancel_token(token.clone());
        let ends = with_threads(2, || {
            side_by_side(
                2,
                &monitor,
                |_| {},
                |k, monitor| {
                    let mut monitor = monitor();
                    if k == 0 {
                        token.cancel();
                    }
                    while monitor.check().is_ok() {
                        std::thread::yield_now();
                    }
                    Ok(monitor.stopped())
                },
            )
        });
        assert_eq!(ends, Ok(vec![Some(Stop::Cancelled); 2]));
    }

    #[test]
    fn a_task_beside_another_ends_with_it_or_is_waited_for() {
        let mut monitor = Monitor::default();
        let sum = scope(|scope| {
            let there = monitor.worker().start(scope, 1, |_: &mut Monitor| 40);
            2 + there.wait(&mut monitor)
        });
        assert_eq!(sum, 42);
        let threads = with_threads(5, || {
            let (shared, begun) = (SharedThreads::among(2), AtomicBool::new(false));
            scope(|scope| {
                let worker = monitor.worker().with_threads(3, &shared);
                let until_all = |_: &mut Monitor| {
                    let first = allowed_threads();
                    begun.store(true, Relaxed);
                    while allowed_threads() < 5 {
                        std::thread::yield_now();
                    }
                    first
                };
                let there = worker.start(scope, 1, until_all);
                while !begun.load(Relaxed) {
                    std::thread::yield_now();
                }
                // The other task gets these two when this one ends.
                assert_eq!(shared.task(2, allowed_threads), 2);
                there.wait(&mut monitor)
            })
        });
        assert_eq!(threads, 3);
        let here = Started::Here(|_: &mut Monitor| 40);
        assert_eq!(here.wait(&mut monitor), 40);
        // Nobody waits: it would never end by itself.
        scope(|scope| {
            monitor.worker().start(scope, 1, |monitor: &mut Monitor| {
                while monitor.check().is_ok() {
                    std::thread::yield_now();
                }
            });
        });
    }

    #[test]
    fn no_thread_ends_before_its_tasks_are_done() {
        // Each thread does one task, and waits until all have begun. The thread of the call is done at once, and waits
        // for the others in the order in which they were started. They are done one after another, in both orders of
        // the tasks, so that the first one is not always the last to be done.
        let (caller, barrier) = (current().id(), Barrier::new(8));
        for is_reversed in [false, true, false, true] {
            let is_ended = |k: usize, monitor: &mut Monitor| {
                barrier.wait();
                let steps = match is_reversed {
                    _ if current().id() == caller => 0,
                    true => 8 - k,
                    false => k + 1,
                };
                let until = Instant::now() + Duration::from_millis(8 * steps as u64);
                let mut ends = false;
                while Instant::now() < until {
                    ends |= monitor.ends();
                    std::thread::sleep(Duration::from_millis(1));
                }
                ends
            };
            let ended = with_threads(8, || tasks(8, &mut Monitor::default(), is_ended));
            assert_eq!(ended, [false; 8]);
        }
    }

    #[test]
    fn parts_cover_everything_once_and_in_order() {
        for (count, threads) in [(0, 4), (1, 4), (10, 3), (10, 1), (1000, 0)] {
            let parts = || in_parts(count, 2, |part| part.collect::<Vec<_>>());
            let parts = with_threads(threads, parts);
            assert!(parts.len() <= (count / 2).max(1));
            assert_eq!(parts.concat(), (0..count).collect::<Vec<_>>());
        }
    }

    #[test]
    #[should_panic(expected = "a task that panics")]
    fn a_panic_reaches_the_thread_that_waits() {
        let mut monitor = Monitor::default();
        let worker = monitor.worker();
        scope(|scope| {
            let there = worker.start(scope, 1, |_: &mut Monitor| panic!("a task that panics"));
            there.wait(&mut monitor);
        });
    }
}
