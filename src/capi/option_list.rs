//! The table of options, for C.

use std::ffi::{CString, c_char};
use std::sync::OnceLock;

use super::guard::boundary;
use super::output::Out;
use super::status::roundel_status;
use crate::error::Error;
use crate::field::GUIDANCE_OPTIONS;
use crate::quad::QUAD_OPTIONS;
use crate::search::{OPTIONS, OptionInfo, OptionKind};
use crate::soup::REPAIR_OPTIONS;

/// The type of an option's value.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_option_type {
    /// A whole number, set by a function whose name ends in set_int.
    ROUNDEL_OPTION_INT = 1,
    /// A real number, set by one that ends in set_real.
    ROUNDEL_OPTION_REAL = 2,
    /// One of several words, set by one that ends in set_text.
    ROUNDEL_OPTION_TEXT = 3,
}

/// The description of one option. The texts live as long as the library is loaded.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct roundel_option {
    /// Its name.
    pub name: *const c_char,
    /// Its default value; "unset" where it has none.
    pub default_value: *const c_char,
    /// The values allowed: an interval, which excludes its end at a round bracket, or words or numbers
    /// separated by bars.
    pub range: *const c_char,
    /// What it does.
    pub text: *const c_char,
    /// The type of its value, a roundel_option_type.
    pub value_type: i32,
    /// Zero; reserved.
    pub reserved: [i32; 7],
}

const _: () = assert!(size_of::<roundel_option>() == 4 * size_of::<usize>() + 32);

/// A table's texts with a terminating NUL: name, default, range, text.
type Texts = OnceLock<Vec<[CString; 4]>>;

/// Describes entry number `index` of a table, whose texts are kept in `texts`.
///
/// # Safety
/// `option` is NULL or a place for the description.
unsafe fn describe(
    table: &'static [OptionInfo],
    texts: &'static Texts,
    index: usize,
    option: *mut roundel_option,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: handed on.
        let out = unsafe { Out::new("option", option) }?;
        let texts = texts.get_or_init(|| {
            let texts = table.iter().map(|o| [o.name, o.default, o.range, o.text]);
            // The table is ours and holds no NUL, which would show as an empty text.
            texts
                .map(|t| t.map(|s| CString::new(s).unwrap_or_default()))
                .collect()
        });
        let Some((info, texts)) = table.iter().zip(texts).nth(index) else {
            Err(Error::IndexOutOfRange {
                what: "options",
                position: 0,
                value: i64::try_from(index).unwrap_or(i64::MAX),
                len: table.len(),
            })?
        };
        let [name, default_value, range, text] = texts.each_ref().map(|t| t.as_ptr());
        let value_type = match info.kind {
            OptionKind::Integer => roundel_option_type::ROUNDEL_OPTION_INT,
            OptionKind::Real => roundel_option_type::ROUNDEL_OPTION_REAL,
            OptionKind::Text => roundel_option_type::ROUNDEL_OPTION_TEXT,
        };
        out.set(roundel_option {
            name,
            default_value,
            range,
            text,
            value_type: value_type as i32,
            reserved: [0; 7],
        });
        Ok(())
    })
}

/// Gives the number of options of a solve.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_option_count() -> usize {
    OPTIONS.len()
}

/// Describes one of the options of a solve: number `index`, from 0 to below roundel_option_count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_option_info(
    index: usize,
    option: *mut roundel_option,
) -> roundel_status {
    static TEXTS: Texts = OnceLock::new();
    // SAFETY: the caller gives a place for the description, or NULL.
    unsafe { describe(OPTIONS, &TEXTS, index, option) }
}

/// Gives the number of options of a guidance.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_guidance_option_count() -> usize {
    GUIDANCE_OPTIONS.len()
}

/// Describes one of the options of a guidance: number `index`, from 0 to below roundel_guidance_option_count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_option_info(
    index: usize,
    option: *mut roundel_option,
) -> roundel_status {
    static TEXTS: Texts = OnceLock::new();
    // SAFETY: the caller gives a place for the description, or NULL.
    unsafe { describe(GUIDANCE_OPTIONS, &TEXTS, index, option) }
}

/// Gives the number of quad options.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_quad_option_count() -> usize {
    QUAD_OPTIONS.len()
}

/// Describes one of the quad options: number `index`, from 0 to below roundel_quad_option_count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_option_info(
    index: usize,
    option: *mut roundel_option,
) -> roundel_status {
    static TEXTS: Texts = OnceLock::new();
    // SAFETY: the caller gives a place for the description, or NULL.
    unsafe { describe(QUAD_OPTIONS, &TEXTS, index, option) }
}

/// Gives the number of repair options.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_repair_option_count() -> usize {
    REPAIR_OPTIONS.len()
}

/// Describes one of the repair options: number `index`, from 0 to below roundel_repair_option_count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_option_info(
    index: usize,
    option: *mut roundel_option,
) -> roundel_status {
    static TEXTS: Texts = OnceLock::new();
    // SAFETY: the caller gives a place for the description, or NULL.
    unsafe { describe(REPAIR_OPTIONS, &TEXTS, index, option) }
}
