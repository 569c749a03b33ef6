//! Stereolithography files (3D Systems, 1989): triangles whose corners are positions.
//!
//! Each corner is a vertex of its own; repair welds those of equal position. Normals and attributes are
//! passed over. `stl_io` was looked at: it takes a binary file that starts with `solid` for text, knows
//! one solid a file and one spelling of its words, refuses `nan` as a normal, rounds coordinates of text
//! to single precision, and names neither line nor byte in an error.

mod binary;
mod text;

use crate::soup::{PolygonSoup, SoupError};

pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, SoupError> {
    if is_text(bytes) {
        text::parse(bytes)
    } else {
        binary::parse(bytes)
    }
}

/// Whether the contents are as long as a binary file says.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    binary::declared_length(bytes) == Some(bytes.len() as u64)
}

/// Whether the contents are text: they start with `solid`, and are not a binary file whose header does.
/// No text has a zero byte, and the count of a binary file has one below 16 million triangles.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let start = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start);
    let word = start.get(..5).unwrap_or_default();
    let head = &bytes[..bytes.len().min(binary::HEADER)];
    word.eq_ignore_ascii_case(b"solid") && !head.contains(&0) && !is_binary(bytes)
}
