//! Input from C: pointers, lengths, indices and texts, checked before use.

use std::ffi::{CStr, c_char};
use std::path::Path;

use super::failure::{Failure, Outcome};
use crate::error::Error;

/// Checks that a pointer is neither NULL nor misaligned.
pub(super) fn aligned<T>(what: &'static str, pointer: *const T) -> Outcome {
    if pointer.is_null() {
        return Err(Failure::Null(what));
    }
    if !pointer.is_aligned() {
        return Err(Failure::Library(Error::InvalidArgument {
            what: format!("{what} is not aligned for its type"),
            index: None,
        }));
    }
    Ok(())
}

/// Checks that `len` values of type `T` at `pointer` can be an array. NULL may stand for an empty array.
fn array<T>(what: &'static str, pointer: *const T, len: usize) -> Outcome {
    aligned(what, pointer)?;
    let fits = |bytes: usize| isize::try_from(bytes).is_ok();
    if !len.checked_mul(size_of::<T>()).is_some_and(fits) {
        return Err(Failure::Library(Error::Overflow {
            what: format!("{what}: {len} entries are more than memory can hold"),
            index: None,
        }));
    }
    Ok(())
}

/// The caller's array.
///
/// # Safety
/// `pointer` is NULL or points to `len` values that nobody writes to.
pub(super) unsafe fn slice<'a, T>(
    what: &'static str,
    pointer: *const T,
    len: usize,
) -> Outcome<&'a [T]> {
    if len == 0 {
        return Ok(&[]);
    }
    array(what, pointer, len)?;
    // SAFETY: not NULL, aligned and not too long by `array`; live by the caller's word.
    Ok(unsafe { std::slice::from_raw_parts(pointer, len) })
}

/// The caller's array, to be written to.
///
/// # Safety
/// `pointer` is NULL or points to `len` values that nobody else uses.
pub(super) unsafe fn slice_mut<'a, T>(
    what: &'static str,
    pointer: *mut T,
    len: usize,
) -> Outcome<&'a mut [T]> {
    if len == 0 {
        return Ok(&mut []);
    }
    array(what, pointer, len)?;
    // SAFETY: not NULL, aligned and not too long by `array`; live by the caller's word.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, len) })
}

/// The caller's text.
///
/// # Safety
/// `pointer` is NULL or points to bytes that end in a NUL.
pub(super) unsafe fn text<'a>(what: &'static str, pointer: *const c_char) -> Outcome<&'a str> {
    aligned(what, pointer)?;
    // SAFETY: not NULL by the line above; ends in a NUL by the caller's word.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| {
        Failure::Library(Error::InvalidArgument {
            what: format!("{what} is not UTF-8"),
            index: None,
        })
    })
}

/// The caller's name of a file: any bytes where the system takes them, else UTF-8.
///
/// # Safety
/// As [`text`].
pub(super) unsafe fn path<'a>(what: &'static str, pointer: *const c_char) -> Outcome<&'a Path> {
    aligned(what, pointer)?;
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        // SAFETY: not NULL by the line above; ends in a NUL by the caller's word.
        let bytes = unsafe { CStr::from_ptr(pointer) }.to_bytes();
        Ok(Path::new(std::ffi::OsStr::from_bytes(bytes)))
    }
    #[cfg(not(unix))]
    {
        // SAFETY: handed on.
        unsafe { text(what, pointer) }.map(Path::new)
    }
}

/// The two integer types that indices come in.
pub(super) trait Index: Copy + Into<i64> {}
impl Index for i32 {}
impl Index for i64 {}

/// The caller's indices, each from 0 to below `bound`.
///
/// # Safety
/// As [`slice`].
pub(super) unsafe fn indices<I: Index>(
    what: &'static str,
    pointer: *const I,
    count: usize,
    bound: usize,
) -> Outcome<Vec<usize>> {
    // SAFETY: handed on.
    let given = unsafe { slice(what, pointer, count) }?;
    let mut result = Vec::new();
    result
        .try_reserve_exact(count)
        .map_err(|_| Error::OutOfMemory { what })?;
    for (position, &i) in given.iter().enumerate() {
        let value = i.into();
        match usize::try_from(value) {
            Ok(index) if index < bound => result.push(index),
            _ => {
                return Err(Failure::Library(Error::IndexOutOfRange {
                    what,
                    position,
                    value,
                    len: bound,
                }));
            }
        }
    }
    Ok(result)
}

/// One index given by value, from 0 to below `bound`.
pub(super) fn index(what: &'static str, value: i64, bound: usize) -> Outcome<usize> {
    match usize::try_from(value) {
        Ok(index) if index < bound => Ok(index),
        _ => Err(Failure::Library(Error::IndexOutOfRange {
            what,
            position: 0,
            value,
            len: bound,
        })),
    }
}
