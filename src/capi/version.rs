//! Which library this is.

use std::ffi::{CStr, c_char};

use super::abi::ROUNDEL_ABI_VERSION;

/// First number of the version that this header belongs to.
pub const ROUNDEL_VERSION_MAJOR: i32 = 0;
/// Second number of the version that this header belongs to.
pub const ROUNDEL_VERSION_MINOR: i32 = 1;
/// Third number of the version that this header belongs to.
pub const ROUNDEL_VERSION_PATCH: i32 = 0;

const VERSION: &CStr =
    match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(text) => text,
        Err(_) => panic!("a version has no NUL"),
    };

/// Version of the library that is linked, such as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn roundel_version_string() -> *const c_char {
    VERSION.as_ptr()
}

/// First number of the version of the library that is linked.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_version_major() -> i32 {
    ROUNDEL_VERSION_MAJOR
}

/// Second number of the version of the library that is linked.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_version_minor() -> i32 {
    ROUNDEL_VERSION_MINOR
}

/// Third number of the version of the library that is linked.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_version_patch() -> i32 {
    ROUNDEL_VERSION_PATCH
}

/// ROUNDEL_ABI_VERSION of the library that is linked.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_abi_version() -> i32 {
    ROUNDEL_ABI_VERSION
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_headers_version_is_the_crates() {
        let numbers = [
            ROUNDEL_VERSION_MAJOR,
            ROUNDEL_VERSION_MINOR,
            ROUNDEL_VERSION_PATCH,
        ];
        let text = numbers.map(|n| n.to_string()).join(".");
        assert_eq!(text, env!("CARGO_PKG_VERSION"));
    }
}
