//! Output to C: results and texts, written only after everything has succeeded.

use std::ffi::c_char;
use std::ptr;

use super::failure::{Failure, Outcome};
use super::input::{aligned, slice_mut};
use crate::error::Error;

/// The place of one required result.
#[derive(Clone, Copy)]
pub(super) struct Out<T>(*mut T);

impl<T> Out<T> {
    /// # Safety
    /// `pointer` is NULL or points to a writable `T`, and does so until [`set`](Self::set).
    pub(super) unsafe fn new(what: &'static str, pointer: *mut T) -> Outcome<Self> {
        aligned(what, pointer)?;
        Ok(Out(pointer))
    }

    pub(super) fn set(self, value: T) {
        // SAFETY: not NULL, aligned and writable by `new`.
        unsafe { ptr::write(self.0, value) }
    }
}

/// The place of an optional result, which may be NULL.
///
/// # Safety
/// As [`Out::new`].
pub(super) unsafe fn optional<T>(what: &'static str, pointer: *mut T) -> Outcome<Option<Out<T>>> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: handed on.
    unsafe { Out::new(what, pointer) }.map(Some)
}

/// Copies `text` and a NUL to a buffer of `capacity` bytes, cut between characters if need be.
///
/// # Safety
/// `buffer` is NULL or has `capacity` writable bytes.
pub(super) unsafe fn copy_truncated(text: &str, buffer: *mut c_char, capacity: usize) {
    if buffer.is_null() || capacity == 0 {
        return;
    }
    let mut len = text.len().min(capacity - 1);
    while !text.is_char_boundary(len) {
        len -= 1;
    }
    // SAFETY: len + 1 <= capacity bytes are writable by the caller's word, and the library's own
    // text cannot overlap them.
    unsafe {
        ptr::copy_nonoverlapping(text.as_ptr().cast(), buffer, len);
        buffer.add(len).write(0);
    }
}

/// Copies all of `text`, or fails; tells its length without the NUL where `length` is not NULL.
/// With no buffer at all, only tells the length.
///
/// # Safety
/// `buffer` is NULL or has `capacity` writable bytes; `length` as in [`Out::new`].
pub(super) unsafe fn copy_whole(
    text: &str,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> Outcome {
    // SAFETY: handed on.
    let length = unsafe { optional("length", length) }?;
    if buffer.is_null() && (capacity > 0 || length.is_none()) {
        return Err(Failure::Null("buffer"));
    }
    if !buffer.is_null() {
        if capacity <= text.len() {
            return Err(Failure::Library(Error::LengthMismatch {
                what: "text buffer",
                expected: text.len() + 1,
                actual: capacity,
            }));
        }
        // SAFETY: handed on.
        unsafe { copy_truncated(text, buffer, capacity) };
    }
    if let Some(length) = length {
        length.set(text.len());
    }
    Ok(())
}

/// The caller's array, which must have exactly `expected` places.
///
/// # Safety
/// `to` is NULL or has `length` writable numbers, which are in no other array that is open.
pub(super) unsafe fn places<'a, T>(
    what: &'static str,
    expected: usize,
    to: *mut T,
    length: usize,
) -> Outcome<&'a mut [T]> {
    if length != expected {
        return Err(Failure::Library(Error::LengthMismatch {
            what,
            expected,
            actual: length,
        }));
    }
    // SAFETY: handed on.
    unsafe { slice_mut(what, to, length) }
}

/// Copies values to as many places.
pub(super) fn fill<T>(places: &mut [T], values: impl Iterator<Item = T>) {
    for (place, value) in places.iter_mut().zip(values) {
        *place = value;
    }
}

/// Copies all of `values` to the caller's array, which must have exactly their number.
///
/// # Safety
/// `to` is NULL or has `length` writable numbers.
pub(super) unsafe fn copy_numbers<T>(
    what: &'static str,
    values: impl ExactSizeIterator<Item = T>,
    to: *mut T,
    length: usize,
) -> Outcome {
    // SAFETY: handed on.
    let places = unsafe { places(what, values.len(), to, length) }?;
    fill(places, values);
    Ok(())
}
