//! The handle of repair options.

use std::ffi::c_char;

use super::failure::Outcome;
use super::guard::{self, Guarded, boundary, object};
use super::input::text;
use super::output::Out;
use super::status::roundel_status;
use crate::search::OptionValue;
use crate::soup::RepairOptions;

/// The options of repair, which roundel_repair_option_info lists: what it may do beyond what a mesh needs.
/// New repair options weld vertices of equal position only, drop no component and fill no hole.
pub struct roundel_repair_options(Guarded<RepairOptions>);

object!(roundel_repair_options, RepairOptions, "repair options");

/// Makes repair options. To be freed with roundel_repair_options_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_options_new(
    options: *mut *mut roundel_repair_options,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("repair options", options) }?;
        out.set(guard::handle(RepairOptions::default()));
        Ok(())
    })
}

/// Frees repair options. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_options_free(
    options: *mut roundel_repair_options,
) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(options) }
}

/// # Safety
/// `options` is NULL or a live handle that nobody else uses, `name` is NULL or a text.
unsafe fn set(
    options: *mut roundel_repair_options,
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

/// Sets a repair option, which roundel_repair_option_info lists, to a whole number. Options of type real take
/// whole numbers too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_options_set_int(
    options: *mut roundel_repair_options,
    name: *const c_char,
    value: i64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe { set(options, name, || Ok(OptionValue::Integer(value))) }
}

/// Sets a repair option, which roundel_repair_option_info lists, to a real number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_options_set_real(
    options: *mut roundel_repair_options,
    name: *const c_char,
    value: f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe { set(options, name, || Ok(OptionValue::Real(value))) }
}

/// Sets a repair option, which roundel_repair_option_info lists, to a text. No repair option has type text so
/// far.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_options_set_text(
    options: *mut roundel_repair_options,
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
