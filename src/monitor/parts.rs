//! Loops over the elements of a list on the threads that are allowed.
//!
//! The results never depend on the number of threads: the value of an element depends on nothing but its number,
//! and sums are those of blocks of a fixed length, which are joined in order.

use std::io::{self, Write};
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::Stop;
use super::threads::{SharedThreads, allowed_threads};
use super::trace;
use super::watch::is_wanted;
use super::worker::{in_parts, spawn};

/// The elements of a block of [`in_blocks`]: enough to be worth a thread.
const BLOCK: usize = 1 << 14;

/// The elements after which [`collect_if_wanted`] asks.
const ASKS: usize = 1 << 12;

/// The lines of a block of text, and the blocks that are in memory at the same time.
const LINES: usize = 1 << 11;
const TEXTS: usize = 64;

/// Room for a line, in bytes: three numbers as long as numbers can be.
const LINE: usize = 1 << 10;

/// The values of all numbers below `count`, in order. Each thread has at least `least` of them.
pub(crate) fn collect_in_parts<T: Send>(
    count: usize,
    least: usize,
    value: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let parts = in_parts(count, least, |part| {
        // The values of all other parts are appended to those of the first.
        let room = if part.start == 0 { count } else { part.len() };
        let mut values = Vec::with_capacity(room);
        values.extend(part.map(&value));
        values
    });
    joined(parts)
}

/// As [`collect_in_parts`], unless the call is to end: each thread asks once in a block.
///
/// # Errors
/// The reason to end.
pub(crate) fn collect_if_wanted<T: Send>(
    count: usize,
    least: usize,
    value: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, Stop> {
    let parts = in_parts(count, least, |part| {
        let mut values = Vec::with_capacity(part.len());
        for k in part {
            if values.len() % ASKS == 0 {
                is_wanted()?;
            }
            values.push(value(k));
        }
        Ok(values)
    });
    parts.into_iter().collect::<Result<_, _>>().map(joined)
}

/// The results of `count` tasks, in order. Each thread takes the next task when it has done one.
pub(crate) fn collect_in_turn<T: Send>(count: usize, task: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let threads = allowed_threads().min(count);
    if threads > 1 && trace::is_simulated() {
        return trace::simulate(count, threads, 1, task);
    }
    let next = AtomicUsize::new(0);
    let parts = in_parts(count, 1, |_| -> Vec<(usize, T)> {
        let take = || Some(next.fetch_add(1, Relaxed)).filter(|&k| k < count);
        std::iter::from_fn(take).map(|k| (k, task(k))).collect()
    });
    let mut done = joined(parts);
    done.sort_unstable_by_key(|(k, _)| *k);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The numbers below `count` for which `is_wanted` holds, in order. Each thread looks at `least` of them or more.
pub(crate) fn filter_in_parts(
    count: usize,
    least: usize,
    is_wanted: impl Fn(usize) -> bool + Sync,
) -> Vec<usize> {
    joined(in_parts(count, least, |part| {
        part.filter(|&k| is_wanted(k)).collect()
    }))
}

/// Lists one after the other.
pub(crate) fn joined<T>(lists: Vec<Vec<T>>) -> Vec<T> {
    let mut lists = lists.into_iter();
    let mut all = lists.next().unwrap_or_default();
    lists.for_each(|mut list| all.append(&mut list));
    all
}

/// The ranges of `0..count` of as many parts as there are threads allowed, each with at least `least` elements.
pub(crate) fn parts_of(count: usize, least: usize) -> Vec<Range<usize>> {
    let parts = allowed_threads().min(count / least.max(1)).max(1);
    let range = |k: usize| k * count / parts..(k + 1) * count / parts;
    (0..parts).map(range).collect()
}

/// Does a task with each of these parts at the same time. Each thread takes the next part when it has done one.
pub(crate) fn for_each_part<P: Send>(parts: Vec<P>, task: impl Fn(P) + Sync) {
    of_each_part(parts, task);
}

/// The same with the results, in order.
pub(crate) fn of_each_part<P: Send, T: Send>(
    parts: Vec<P>,
    task: impl Fn(P) -> T + Sync,
) -> Vec<T> {
    if parts.len() < 2 || allowed_threads() < 2 {
        return parts.into_iter().map(task).collect();
    }
    let parts: Vec<_> = parts
        .into_iter()
        .map(|part| Mutex::new(Some(part)))
        .collect();
    collect_in_turn(parts.len(), |k| {
        // Nobody else asks for this lock.
        let part = parts[k].lock().ok().and_then(|mut part| part.take());
        task(part.unwrap_or_else(|| unreachable!("each part is taken once")))
    })
}

/// Changes each value, which gets its number. Each thread has at least `least` of them.
pub(crate) fn change_in_parts<T: Send>(
    values: &mut [T],
    least: usize,
    change: impl Fn(usize, &mut T) + Sync,
) {
    for_each_part(split(values, least), |(range, part)| {
        range.zip(part).for_each(|(k, value)| change(k, value));
    });
}

/// Sorts values in increasing order. Each thread has at least `least` of them.
pub(crate) fn sort_in_parts<T: Ord + Send>(values: &mut [T], least: usize) {
    sort_in_parts_by(values, least, T::cmp);
}

/// The same by an order that tells all values apart.
pub(crate) fn sort_in_parts_by<T: Send>(
    values: &mut [T],
    least: usize,
    order: impl Fn(&T, &T) -> std::cmp::Ordering + Sync,
) {
    let parts = split(values, least);
    let is_whole = parts.len() == 1;
    for_each_part(parts, |(_, part)| part.sort_unstable_by(&order));
    if !is_whole {
        // This finds the parts, which are in order, and merges them.
        values.sort_by(order);
    }
}

/// The values of each part, and their numbers.
fn split<T>(values: &mut [T], least: usize) -> Vec<(Range<usize>, &mut [T])> {
    let ranges = parts_of(values.len(), least);
    let mut rest = values;
    let part = |range: Range<usize>| {
        let (part, others) = std::mem::take(&mut rest).split_at_mut(range.len());
        rest = others;
        (range, part)
    };
    ranges.into_iter().map(part).collect()
}

/// Does two tasks, at the same time where that is worth a thread and one is allowed. They share the threads, all of
/// which are the other's when one has ended. The first stays on the thread of the call.
pub(crate) fn both<A, B: Send>(
    is_worth_a_thread: bool,
    first: impl FnOnce() -> A,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    let threads = allowed_threads();
    if !is_worth_a_thread || threads < 2 {
        return (first(), second());
    }
    let (own, others) = (threads - threads / 2, threads / 2);
    let shared = SharedThreads::among(2);
    if trace::is_simulated() {
        let start = trace::start_of_thread();
        let there = || shared.task(others, second);
        let (second, end) = trace::as_thread(own, start, there);
        let first = shared.task(own, first);
        trace::wait_until(end);
        return (first, second);
    }
    let second = Mutex::new(Some(second));
    // It is taken once, by the other thread if there is one.
    let take = || second.lock().ok().and_then(|mut second| second.take());
    std::thread::scope(|scope| {
        let there = || {
            let _task = trace::span("task");
            take().map(|second| shared.task(others, second))
        };
        let there = spawn(scope, own, there);
        let first = shared.task(own, first);
        let there = match there {
            Ok(handle) => handle.join().unwrap_or_else(|panic| resume_unwind(panic)),
            Err(_) => None,
        };
        let second = there.or_else(|| take().map(|second| second()));
        (
            first,
            second.unwrap_or_else(|| unreachable!("one of both threads takes it")),
        )
    })
}

/// The results for blocks of a fixed number of elements out of `count`, in order.
pub(crate) fn in_blocks<T: Send>(count: usize, block: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    collect_in_parts(count.div_ceil(BLOCK), 1, |k| {
        block(k * BLOCK..count.min((k + 1) * BLOCK))
    })
}

/// Writes `count` lines, in order: `line` appends the text of one.
///
/// # Errors
/// Those of `line` and of `out`, and [`io::ErrorKind::OutOfMemory`].
pub(crate) fn write_lines(
    out: &mut impl Write,
    count: usize,
    line: impl Fn(usize, &mut Vec<u8>) -> io::Result<()> + Sync,
) -> io::Result<()> {
    let text = |lines: Range<usize>| -> io::Result<Vec<u8>> {
        let mut text = Vec::new();
        for k in lines {
            text.try_reserve(LINE)?;
            line(k, &mut text)?;
        }
        Ok(text)
    };
    let begin = |block: usize| count.min(block * LINES);
    let blocks = count.div_ceil(LINES);
    for first in (0..blocks).step_by(TEXTS) {
        let texts = collect_in_turn(TEXTS.min(blocks - first), |k| {
            text(begin(first + k)..begin(first + k + 1))
        });
        texts
            .into_iter()
            .try_for_each(|text| out.write_all(&text?))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::spawned;
    use super::super::threads::with_threads;
    use super::super::{CancelToken, Monitor, traced};
    use super::*;
    use std::sync::Barrier;

    #[test]
    fn any_number_of_threads_gives_the_same_lists() {
        for (count, threads) in [(0, 2), (1, 4), (10, 3), (10, 1), (1000, 0), (1000, 7)] {
            with_threads(threads, || {
                let all: Vec<usize> = (0..count).map(|k| 3 * k).collect();
                assert_eq!(collect_in_parts(count, 2, |k| 3 * k), all);
                assert_eq!(collect_in_turn(count, |k| 3 * k), all);
                let odd: Vec<usize> = (0..count).filter(|k| k % 2 == 1).collect();
                assert_eq!(filter_in_parts(count, 2, |k| k % 2 == 1), odd);
                let mut changed = vec![1; count];
                change_in_parts(&mut changed, 2, |k, value| *value *= 3 * k);
                assert_eq!(changed, all);
                let mut sorted: Vec<usize> = all.iter().map(|k| (k * 1009) % 3001).collect();
                let mut expected = sorted.clone();
                expected.sort_unstable();
                sort_in_parts(&mut sorted, 2);
                assert_eq!(sorted, expected);
            });
        }
    }

    #[test]
    fn both_tasks_are_done_at_the_same_time_if_that_is_worth_a_thread() {
        let barrier = Barrier::new(2);
        let meets = |result: u32| {
            let threads = allowed_threads();
            barrier.wait();
            (result, threads)
        };
        let found = with_threads(3, || both(true, || meets(1), || meets(2)));
        assert_eq!(found, ((1, 2), (2, 1)));
        for (threads, is_worth_it) in [(1, true), (2, false)] {
            let started = spawned(|| {
                let found = with_threads(threads, || both(is_worth_it, || 1, || 2));
                assert_eq!(found, (1, 2));
            });
            assert_eq!(started, 0);
        }
    }

    #[test]
    fn the_task_that_is_left_gets_all_threads() {
        let until_all = || {
            while allowed_threads() < 3 {
                std::thread::yield_now();
            }
        };
        with_threads(3, || both(true, until_all, || ()));
        let ((), trace) = with_threads(3, || {
            traced(false, || {
                both(true, || (), until_all);
            })
        });
        assert!(
            trace
                .spans
                .iter()
                .any(|span| (span.name, span.thread) == ("task", 2))
        );
    }

    #[test]
    fn a_loop_ends_with_its_call() {
        let token = CancelToken::new();
        for threads in [1, 3] {
            token.reset();
            let _watch = Monitor::default().cancel_token(token.clone()).watch();
            let doubled = |k: usize| 2 * k;
            let done = with_threads(threads, || collect_if_wanted(10 * ASKS, 1, doubled));
            assert_eq!(done, Ok((0..10 * ASKS).map(doubled).collect()));
            let calls = AtomicUsize::new(0);
            let cancels = |_| {
                token.cancel();
                calls.fetch_add(1, Relaxed);
            };
            let done = with_threads(threads, || collect_if_wanted(10 * ASKS, 1, cancels));
            assert_eq!(done, Err(Stop::Cancelled));
            assert!(calls.load(Relaxed) <= threads * ASKS);
        }
    }

    #[test]
    fn lines_are_written_in_order() {
        let wanted = |count: usize| -> String { (0..count).map(|k| format!("{k}\n")).collect() };
        for count in [0, 1, LINES, LINES + 1, TEXTS * LINES + 7] {
            for threads in [1, 3] {
                let mut out = Vec::new();
                with_threads(threads, || {
                    write_lines(&mut out, count, |k, text| writeln!(text, "{k}")).unwrap();
                });
                assert!(out == wanted(count).as_bytes(), "{count} {threads}");
            }
        }
        let started = spawned(|| {
            let write = || write_lines(&mut Vec::new(), 3 * LINES, |_, _| Ok(()));
            with_threads(2, write).unwrap();
        });
        assert_eq!(started, 1);
    }

    #[test]
    fn an_error_of_a_line_ends_the_text() {
        let line = |k: usize, text: &mut Vec<u8>| match k {
            5000 => Err(io::Error::other("5000")),
            _ => writeln!(text, "{k}"),
        };
        let error = write_lines(&mut Vec::new(), 10_000, line).unwrap_err();
        assert_eq!(error.to_string(), "5000");
    }

    #[test]
    fn blocks_depend_on_the_count_alone() {
        for count in [0, 1, BLOCK, BLOCK + 1, 3 * BLOCK - 1] {
            let blocks = |threads| with_threads(threads, || in_blocks(count, |block| block));
            let one = blocks(1);
            assert_eq!(one.len(), count.div_ceil(BLOCK));
            assert_eq!(one.iter().cloned().flatten().count(), count);
            assert_eq!(one, blocks(3));
        }
    }
}
