//! What the contents of a file plainly are, so that a wrong name is told and nothing is misread.

use super::{Format, gltf, gzip, stl};
use crate::soup::SoupError;

/// Checks that the contents do not start as those of another format do.
pub(super) fn check(bytes: &[u8], format: Format) -> Result<(), SoupError> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = start.trim_ascii_start();
    let end = start.iter().position(u8::is_ascii_whitespace);
    let word = &start[..end.unwrap_or(start.len()).min(12)];
    let is_gltf = matches!(format, Format::Gltf | Format::Glb);
    let looks = if format == Format::Stl && stl::is_binary(bytes) {
        // The header of a binary file may say anything.
        None
    } else if bytes.starts_with(gltf::MAGIC) || start.starts_with(b"{") {
        (!is_gltf).then_some("glTF")
    } else if word == b"ply" {
        (format != Format::Ply).then_some("PLY")
    } else if word.ends_with(b"OFF") {
        (format != Format::Off).then_some("OFF")
    } else if word.eq_ignore_ascii_case(b"solid") {
        (format != Format::Stl).then_some("STL")
    } else if word.starts_with(b"#usda") || word.starts_with(b"PXR-USDC") {
        Some("USD")
    } else if bytes.starts_with(b"PK\x03\x04") {
        Some("a zip archive, as 3MF and USDZ are")
    } else if bytes.starts_with(gzip::MAGIC) {
        Some("a file compressed by gzip twice")
    } else if start.starts_with(b"<?xml") || start.starts_with(b"<!DOCTYPE") {
        Some("XML")
    } else {
        None
    };
    match looks {
        None => Ok(()),
        Some(looks) => Err(SoupError::Malformed {
            message: format!(
                "the file was to be {}, but looks like {looks}; name its format",
                format.name()
            ),
        }),
    }
}
