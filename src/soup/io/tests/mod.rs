//! Properties of the readers, on contents that the tests make.

mod binary;
mod damage;
mod gltf;
mod names;
mod text;

use super::{Format, parse};
use crate::soup::{PolygonSoup, SoupError};

/// Faces of a soup as lists.
fn faces(soup: &PolygonSoup) -> Vec<Vec<i64>> {
    soup.polygons().map(<[i64]>::to_vec).collect()
}

fn read(contents: impl AsRef<[u8]>, format: Format) -> PolygonSoup {
    let contents = contents.as_ref();
    parse(contents, format).unwrap_or_else(|error| {
        panic!("{error}: {}", String::from_utf8_lossy(contents));
    })
}

/// The line at fault.
fn line_of(contents: impl AsRef<[u8]>, format: Format) -> usize {
    match parse(contents.as_ref(), format) {
        Err(SoupError::Parse { line, .. }) => line,
        other => panic!("{other:?}"),
    }
}

/// The message about contents without lines.
fn refusal(contents: impl AsRef<[u8]>, format: Format) -> String {
    match parse(contents.as_ref(), format) {
        Err(SoupError::Malformed { message }) => message,
        other => panic!("{other:?}"),
    }
}
