//! The options handle: set and read by name, from the library's one table.

use std::ffi::c_char;

use super::failure::{Failure, Outcome};
use super::guard::{self, Guarded, boundary, object};
use super::input::text;
use super::output::{Out, copy_whole};
use super::status::roundel_status;
use crate::error::Error;
use crate::search::OptionValue;
use crate::search::Options;

/// The options of a solve. roundel_option_info lists them.
///
/// An unknown name, a value of the wrong type and a value out of range are three different errors.
pub struct roundel_options(Guarded<Options>);

object!(roundel_options, Options, "options");

/// Makes a set of options with their default values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_new(options: *mut *mut roundel_options) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("options", options) }?;
        out.set(guard::handle(Options::default()));
        Ok(())
    })
}

/// Frees options. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_free(options: *mut roundel_options) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(options) }
}

/// # Safety
/// `options` is NULL or a live handle, `name` is NULL or a text.
unsafe fn set(
    options: *mut roundel_options,
    name: *const c_char,
    value: impl FnOnce() -> Outcome<OptionValue>,
) -> roundel_status {
    // SAFETY: handed on.
    unsafe {
        guard::write(options, |all| {
            Ok(all.set(text("option name", name)?, &value()?)?)
        })
    }
}

/// Sets an option to a whole number. Options of type real take whole numbers too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_set_int(
    options: *mut roundel_options,
    name: *const c_char,
    value: i64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe { set(options, name, || Ok(OptionValue::Integer(value))) }
}

/// Sets an option to a real number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_set_real(
    options: *mut roundel_options,
    name: *const c_char,
    value: f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe { set(options, name, || Ok(OptionValue::Real(value))) }
}

/// Sets an option to a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_set_text(
    options: *mut roundel_options,
    name: *const c_char,
    value: *const c_char,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and texts, or NULL.
    unsafe {
        set(options, name, || {
            Ok(OptionValue::Text(text("option value", value)?.into()))
        })
    }
}

/// The value of an option. `pick` checks that it has the type asked for.
///
/// # Safety
/// `name` is NULL or a text.
unsafe fn get<T>(
    options: &Options,
    name: *const c_char,
    pick: impl FnOnce(OptionValue) -> Option<T>,
) -> Outcome<T> {
    // SAFETY: handed on.
    let name = unsafe { text("option name", name) }?;
    let value = options.get(name)?;
    let (name, expected) = (name_of(name), described(&value));
    pick(value).ok_or(Failure::Library(Error::OptionType { name, expected }))
}

fn name_of(name: &str) -> &'static str {
    let mut names = crate::search::OPTIONS.iter().map(|info| info.name);
    names.find(|&known| known == name).unwrap_or_default()
}

fn described(value: &OptionValue) -> &'static str {
    match value {
        OptionValue::Integer(_) => "a whole number",
        OptionValue::Real(_) => "a real number",
        OptionValue::Text(_) => "a word",
    }
}

/// Reads an option whose value is a whole number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_get_int(
    options: *const roundel_options,
    name: *const c_char,
    value: *mut i64,
) -> roundel_status {
    let pick = |v| match v {
        OptionValue::Integer(n) => Some(n),
        _ => None,
    };
    // SAFETY: the caller gives a live handle, a text and a place for the value, or NULL.
    unsafe {
        guard::read(options, |all| {
            let out = Out::new("value", value)?;
            out.set(get(all, name, pick)?);
            Ok(())
        })
    }
}

/// Reads an option whose value is a real number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_get_real(
    options: *const roundel_options,
    name: *const c_char,
    value: *mut f64,
) -> roundel_status {
    let pick = |v| match v {
        OptionValue::Real(x) => Some(x),
        _ => None,
    };
    // SAFETY: the caller gives a live handle, a text and a place for the value, or NULL.
    unsafe {
        guard::read(options, |all| {
            let out = Out::new("value", value)?;
            out.set(get(all, name, pick)?);
            Ok(())
        })
    }
}

/// Reads an option whose value is a text into `buffer`, which has `capacity` bytes, with the terminating
/// NUL. Its length without the NUL is written to `length`, which may be NULL. If `buffer` is NULL and
/// `capacity` 0, only the length is written.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH if the buffer is too small.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_get_text(
    options: *const roundel_options,
    name: *const c_char,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> roundel_status {
    let pick = |v| match v {
        OptionValue::Text(word) => Some(word),
        _ => None,
    };
    // SAFETY: the caller gives a live handle, a text, a buffer of `capacity` bytes and a place for
    // the length, or NULL.
    unsafe {
        guard::read(options, |all| {
            copy_whole(&get(all, name, pick)?, buffer, capacity, length)
        })
    }
}
