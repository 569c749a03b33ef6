//! How many threads a call may use. All layers know it, so that no function has to pass it on.

use std::cell::RefCell;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::SeqCst};
use std::sync::{Arc, OnceLock};
use std::thread::available_parallelism;

use super::trace;

thread_local! {
    /// What this thread may use. None where nothing was said.
    static ALLOWED: RefCell<Option<Allowed>> = const { RefCell::new(None) };
}

/// The threads that a call may use, its own included.
#[derive(Debug, Clone)]
struct Allowed {
    own: usize,
    /// The most with those that other tasks have left.
    most: usize,
    shared: Option<SharedThreads>,
}

/// The most threads that the current call may use, its own included. Where nothing was said, there is one for each
/// core. The number grows when tasks that are done at the same time end.
#[must_use]
pub fn allowed_threads() -> usize {
    // The system is asked once, because that takes longer than many a task.
    static CORES: OnceLock<usize> = OnceLock::new();
    ALLOWED.with_borrow(|allowed| match allowed {
        None => *CORES.get_or_init(|| available_parallelism().map_or(1, usize::from)),
        Some(Allowed { own, most, shared }) => {
            let left = shared.as_ref().map_or(0, SharedThreads::left);
            (own + left).min(*most)
        }
    })
}

/// Makes a call that may use so many threads, its own included. 0 stands for one for each core. A call within
/// another one never gets more than that one has.
pub fn with_threads<T>(threads: usize, call: impl FnOnce() -> T) -> T {
    let allowed = ALLOWED.with_borrow(|allowed| match (threads, allowed) {
        (0, allowed) => allowed.clone(),
        (_, None) => Some(Allowed {
            own: threads,
            most: threads,
            shared: None,
        }),
        (_, Some(given)) => Some(Allowed {
            own: given.own.min(threads),
            most: given.most.min(threads),
            shared: given.shared.clone(),
        }),
    });
    allowing(allowed, call)
}

fn allowing<T>(allowed: Option<Allowed>, call: impl FnOnce() -> T) -> T {
    struct Before(Option<Allowed>);
    impl Drop for Before {
        fn drop(&mut self) {
            ALLOWED.set(self.0.take());
        }
    }
    let _before = Before(ALLOWED.replace(allowed));
    call()
}

/// The threads of tasks that are done at the same time. Those of a task that has ended are left to the others.
#[derive(Debug, Clone)]
pub(crate) struct SharedThreads(Arc<Counts>);

#[derive(Debug)]
struct Counts {
    /// All threads.
    threads: usize,
    /// The numbers of the threads in a trace, of all tasks around these as well.
    numbers: Range<usize>,
    /// The tasks that have not ended.
    tasks: AtomicUsize,
    /// The threads of those that have.
    left: AtomicUsize,
    /// When the last of these has ended, in seconds of simulated threads, as the bits of a number.
    since: AtomicU64,
}

impl SharedThreads {
    /// All threads that are allowed, for so many tasks.
    pub fn among(tasks: usize) -> Self {
        let (first, threads) = (trace::thread(), allowed_threads());
        SharedThreads(Arc::new(Counts {
            threads,
            numbers: Self::numbers().unwrap_or(first..first + threads),
            tasks: AtomicUsize::new(tasks),
            left: AtomicUsize::new(0),
            since: AtomicU64::new(0),
        }))
    }

    /// Does one of the tasks, which begins with so many threads.
    pub fn task<T>(&self, threads: usize, task: impl FnOnce() -> T) -> T {
        struct Ends<'a>(&'a Counts, usize);
        impl Drop for Ends<'_> {
            fn drop(&mut self) {
                self.0.since.store(trace::now().to_bits(), SeqCst);
                self.0.left.fetch_add(self.1, SeqCst);
                self.0.tasks.fetch_sub(1, SeqCst);
            }
        }
        let _ends = Ends(&self.0, threads);
        let allowed = Allowed {
            own: threads,
            most: self.0.threads,
            shared: Some(self.clone()),
        };
        allowing(Some(allowed), task)
    }

    /// The numbers in a trace of the threads that the current task may share, if it shares some.
    pub(super) fn numbers() -> Option<Range<usize>> {
        ALLOWED.with_borrow(|allowed| {
            let shared = allowed.as_ref()?.shared.as_ref()?;
            Some(shared.0.numbers.clone())
        })
    }

    /// The threads that each of the tasks may use besides its own.
    fn left(&self) -> usize {
        let since = f64::from_bits(self.0.since.load(SeqCst));
        if trace::is_simulated() && trace::now() < since {
            return 0;
        }
        self.0.left.load(SeqCst) / self.0.tasks.load(SeqCst).max(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_within_another_gets_no_more_threads() {
        let all = allowed_threads();
        assert!(all >= 1);
        with_threads(3, || {
            assert_eq!(allowed_threads(), 3);
            assert_eq!(with_threads(2, allowed_threads), 2);
            assert_eq!(with_threads(5, allowed_threads), 3);
            assert_eq!(with_threads(0, allowed_threads), 3);
        });
        assert_eq!(allowed_threads(), all);
    }

    #[test]
    fn a_task_has_the_threads_of_those_that_have_ended() {
        with_threads(6, || {
            let shared = SharedThreads::among(3);
            assert_eq!(shared.task(2, allowed_threads), 2);
            let (own, limited, within) = shared.task(2, || {
                let limited = with_threads(1, allowed_threads);
                (allowed_threads(), limited, with_threads(6, allowed_threads))
            });
            assert_eq!((own, limited, within), (3, 1, 3));
            let panics = || shared.task(2, || assert_eq!(allowed_threads(), 5));
            assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(panics)).is_err());
            assert_eq!(allowed_threads(), 6);
        });
    }

    #[test]
    fn what_was_allowed_returns_after_a_panic() {
        let all = allowed_threads();
        let panics = || with_threads(7, || panic!("within a call"));
        assert!(std::panic::catch_unwind(panics).is_err());
        assert_eq!(allowed_threads(), all);
    }
}
