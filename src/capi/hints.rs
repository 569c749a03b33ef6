//! Hints about a problem's structure that only the caller knows.

use super::failure::Outcome;
use super::guard;
use super::input::{Index, indices, slice};
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::problem::Problem;

/// # Safety
/// The arrays are as the caller of the entry says.
unsafe fn hint<I: Index>(
    problem: &mut Problem,
    (offset_count, offsets): (usize, *const I),
    (count, rows): (usize, *const I),
    signs: *const i8,
) -> Outcome {
    // An offset may equal the number of entries.
    let end = count.saturating_add(1);
    // SAFETY: handed on.
    let (offsets, rows, signs) = unsafe {
        (
            indices("cycle offsets", offsets, offset_count, end)?,
            indices("cycle rows", rows, count, problem.least_squares_rows())?,
            slice("cycle signs", signs, count)?,
        )
    };
    Ok(problem.hint_cycles(&offsets, &rows, signs)?)
}

/// Passes known short cycles to the solver. A cycle is a sum of least-squares rows, each with sign 1 or
/// -1, in which all continuous variables cancel, such as the ring around a vertex of a mesh. Cycle k has
/// the entries from offsets[k] to before offsets[k + 1]. `offset_count` is one more than the number of
/// cycles, and `count` is the number of entries.
///
/// A hint never changes the problem. The solve ignores a wrong hint and reports it in a log event. A
/// later hint replaces an earlier one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_hint_cycles(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i32,
    count: usize,
    rows: *const i32,
    signs: *const i8,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe {
        guard::write(problem, |value| {
            hint(value, (offset_count, offsets), (count, rows), signs)
        })
    }
}

/// roundel_problem_hint_cycles with 64-bit indices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_hint_cycles_i64(
    problem: *mut roundel_problem,
    offset_count: usize,
    offsets: *const i64,
    count: usize,
    rows: *const i64,
    signs: *const i8,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and arrays of the lengths given, or NULL.
    unsafe {
        guard::write(problem, |value| {
            hint(value, (offset_count, offsets), (count, rows), signs)
        })
    }
}
