//! The last error of each thread: its text, and the element at fault as a number.

use std::ffi::c_char;

use super::failure::{Failure, last};
use super::guard::boundary;
use super::input::slice_mut;
use super::output::copy_truncated;
use super::status::roundel_status;
use crate::error::Error;

fn number(n: Option<usize>) -> i64 {
    n.and_then(|n| i64::try_from(n).ok()).unwrap_or(-1)
}

/// Copies the message of the last call that failed on this thread to `buffer`: at most `capacity` bytes
/// of UTF-8 with the terminating NUL, truncated if necessary. The message names the element at fault.
///
/// Returns the length of the whole message without its NUL, as snprintf does, or 0 if no call has failed.
/// `buffer` may be NULL if `capacity` is 0. Calls that succeed leave the message unchanged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_last_error_message(buffer: *mut c_char, capacity: usize) -> usize {
    last(|error| {
        // SAFETY: the caller gives `capacity` writable bytes, or NULL, which is checked.
        unsafe { copy_truncated(&error.message, buffer, capacity) };
        error.message.len()
    })
    .unwrap_or(0)
}

/// The element at fault in the last call that failed on this thread, counted from 0: a position
/// in the array given, a constraint, or a variable, as the status says. -1 if there is none.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_last_error_index() -> i64 {
    number(last(|error| error.index).flatten())
}

/// The line of the file at fault in the last call that failed on this thread, counted from 1.
/// -1 if there is none.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_last_error_line() -> i64 {
    number(last(|error| error.line).flatten())
}

/// Copies the direction that belongs to ROUNDEL_ERROR_UNBOUNDED and ROUNDEL_ERROR_NOT_CONVEX: one number
/// for each variable, the largest with absolute value 1. `length` must be the number of variables.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH if the last error had no direction, or one of another length.
/// This failure then replaces the last error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_last_error_direction(
    direction: *mut f64,
    length: usize,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives `length` writable numbers.
        let out = unsafe { slice_mut("direction", direction, length) }?;
        last(|error| {
            if error.direction.len() != out.len() || out.is_empty() {
                return Err(Failure::Library(Error::LengthMismatch {
                    what: "direction of the last error",
                    expected: error.direction.len(),
                    actual: out.len(),
                }));
            }
            out.copy_from_slice(&error.direction);
            Ok(())
        })
        .unwrap_or(Ok(()))
    })
}
