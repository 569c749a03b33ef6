//! Sets of options that belong together: listed, and chosen by name.

use std::ffi::{CString, c_char};
use std::sync::OnceLock;

use super::guard::{self, boundary};
use super::input::text;
use super::options::roundel_options;
use super::output::Out;
use super::status::roundel_status;
use crate::error::Error;
use crate::search::PRESETS;

/// The description of one preset. The texts live as long as the library is loaded.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct roundel_preset {
    /// Its name.
    pub name: *const c_char,
    /// Its purpose.
    pub text: *const c_char,
    /// Zero; reserved.
    pub reserved: [i64; 6],
}

const _: () = assert!(size_of::<roundel_preset>() == 2 * size_of::<usize>() + 48);

/// The table's texts with the NUL that C wants: name, text.
fn texts() -> &'static [[CString; 2]] {
    static TEXTS: OnceLock<Vec<[CString; 2]>> = OnceLock::new();
    TEXTS.get_or_init(|| {
        let texts = PRESETS.iter().map(|p| [p.name, p.text]);
        // The table is ours and holds no NUL, which would show as an empty text.
        texts
            .map(|t| t.map(|s| CString::new(s).unwrap_or_default()))
            .collect()
    })
}

/// The number of presets.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_preset_count() -> usize {
    PRESETS.len()
}

/// Describes preset number `index`, from 0 to below roundel_preset_count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_preset_info(
    index: usize,
    preset: *mut roundel_preset,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the description, or NULL.
        let out = unsafe { Out::new("preset", preset) }?;
        let Some(texts) = texts().get(index) else {
            Err(Error::IndexOutOfRange {
                what: "presets",
                position: 0,
                value: i64::try_from(index).unwrap_or(i64::MAX),
                len: PRESETS.len(),
            })?
        };
        let [name, text] = texts.each_ref().map(|t| t.as_ptr());
        out.set(roundel_preset {
            name,
            text,
            reserved: [0; 6],
        });
        Ok(())
    })
}

/// Sets all options of the preset of this name; others, such as the time limit, stay.
///
/// Fails with ROUNDEL_ERROR_OPTION_RANGE if there is no such preset.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_options_set_preset(
    options: *mut roundel_options,
    name: *const c_char,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe {
        guard::write(options, |all| {
            Ok(all.set_preset(text("preset name", name)?)?)
        })
    }
}
