//! Reading of polygon soups from files of every format that people have.
//!
//! A reader gives what the file says: vertices and polygons keep the numbers of the file, polygons have
//! any number of corners, and corners that name no vertex are kept. Normals, texture coordinates,
//! colours, materials and groups are ignored; [`Attributes`] reads them. A file of points or lines gives a
//! soup without polygons.

mod attributes;
mod bytes;
mod format;
mod gltf;
mod gzip;
mod lines;
mod look;
mod obj;
mod obj_attributes;
mod off;
mod off_binary;
mod plain_obj;
mod ply;
mod polylines;
mod statements;
mod stl;
mod strips;

use std::path::Path;

use super::{PolygonSoup, SoupError};
use crate::monitor::span;

pub use attributes::{Attribute, Attributes};
pub use format::Format;
pub use polylines::{Polyline, polylines, read_polylines};

pub(crate) use format::is_compressed;
pub(crate) use statements::{Statement, Statements, corner_number};

/// Reads a file; its extension tells the format.
///
/// # Errors
///
/// [`SoupError::UnknownFormat`], [`SoupError::Io`], [`SoupError::Parse`] and [`SoupError::Malformed`].
pub fn read(path: impl AsRef<Path>) -> Result<PolygonSoup, SoupError> {
    let path = path.as_ref();
    read_as(path, Format::of(path)?)
}

/// Reads a file of this format, whatever its name.
///
/// # Errors
///
/// As [`read`].
pub fn read_as(path: impl AsRef<Path>, format: Format) -> Result<PolygonSoup, SoupError> {
    let path = path.as_ref();
    let bytes = std::fs::read(path).map_err(|reason| SoupError::of_file(path, &reason))?;
    parse_in(&bytes, format, path.parent())
}

/// The soup that the contents of a file describe.
///
/// # Errors
///
/// As [`read`].
pub fn parse(bytes: &[u8], format: Format) -> Result<PolygonSoup, SoupError> {
    parse_in(bytes, format, None)
}

/// The soup that the contents of a file in this folder describe. Only glTF names other files.
///
/// # Errors
///
/// As [`read`].
pub fn parse_in(
    bytes: &[u8],
    format: Format,
    folder: Option<&Path>,
) -> Result<PolygonSoup, SoupError> {
    let _span = span("read");
    let bytes = &gzip::inflated(bytes)?;
    look::check(bytes, format)?;
    match format {
        Format::Obj => obj::parse(bytes),
        Format::Off => off::parse(bytes),
        Format::Ply => ply::parse(bytes),
        Format::Stl => stl::parse(bytes),
        Format::Gltf | Format::Glb => gltf::parse(bytes, folder),
        Format::Usda => Err(SoupError::UnknownFormat {
            extension: format.name().to_owned(),
            known: Format::READ,
        }),
    }
}

#[cfg(test)]
mod tests;
