//! How many threads a call may use. All layers know it, so that no function has to pass it on.

use std::cell::Cell;
use std::sync::OnceLock;
use std::thread::available_parallelism;

thread_local! {
    /// The threads that this one and those that it starts may be; 0 where nothing was said.
    static ALLOWED: Cell<usize> = const { Cell::new(0) };
}

/// The most threads that the current call may use, its own included. Where nothing was said, there is one for each
/// core.
#[must_use]
pub fn allowed_threads() -> usize {
    // The system is asked once, because that takes longer than many a task.
    static CORES: OnceLock<usize> = OnceLock::new();
    match ALLOWED.get() {
        0 => *CORES.get_or_init(|| available_parallelism().map_or(1, usize::from)),
        given => given,
    }
}

/// Makes a call that may use so many threads, its own included. 0 stands for one for each core. A call within
/// another one never gets more than that one has.
pub fn with_threads<T>(threads: usize, call: impl FnOnce() -> T) -> T {
    struct Before(usize);
    impl Drop for Before {
        fn drop(&mut self) {
            ALLOWED.set(self.0);
        }
    }
    let before = Before(ALLOWED.get());
    if threads > 0 {
        ALLOWED.set(match before.0 {
            0 => threads,
            given => threads.min(given),
        });
    }
    call()
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
    fn what_was_allowed_returns_after_a_panic() {
        let all = allowed_threads();
        let panics = || with_threads(7, || panic!("within a call"));
        assert!(std::panic::catch_unwind(panics).is_err());
        assert_eq!(allowed_threads(), all);
    }
}
