//! Strict reading and writing of mesh files of every [`Format`], told apart by extension.
//!
//! Vertices and faces keep the numbers of the file; only in STL, whose triangles are positions, are
//! equal ones made one vertex. Only triangles are read: any other polygon is an error that names its
//! face. Normals, texture coordinates, colours, materials and groups are ignored.
//! [`soup::io`](crate::soup::io) reads the same files, and takes what is not a mesh too.

mod drawing;
mod obj;
mod obj_uv;
mod off;
mod ply;
mod strict;

use std::io::Write;
use std::path::Path;

use super::{MeshError, TriangleMesh};
use crate::soup::io as soup;

pub use crate::soup::io::Format;
pub use drawing::Drawing;
pub use obj_uv::{TexturedMesh, parse_textured, read_textured};

/// Reads a mesh; the extension tells the format.
///
/// # Errors
///
/// First those of the file ([`MeshError::UnknownFormat`], [`MeshError::Io`],
/// [`MeshError::Parse`], [`MeshError::Malformed`], [`MeshError::NotATriangle`],
/// [`MeshError::IndexOutOfRange`]), then those of [`TriangleMesh::new`].
pub fn read(path: impl AsRef<Path>) -> Result<TriangleMesh, MeshError> {
    let path = path.as_ref();
    let format = Format::of(path)?;
    strict::mesh(&soup::read_as(path, format)?, format)
}

/// The mesh that the contents of a file describe.
///
/// # Errors
///
/// As [`read`].
pub fn parse(bytes: &[u8], format: Format) -> Result<TriangleMesh, MeshError> {
    strict::mesh(&soup::parse(bytes, format)?, format)
}

/// Writes a mesh or any other [`Drawing`]; the extension tells the format.
///
/// Coordinates are written so that reading gives back the same numbers. PLY is binary, little
/// endian.
///
/// # Errors
///
/// [`MeshError::UnknownFormat`], [`MeshError::Io`], and [`MeshError::InvalidArgument`] where
/// colours and elements differ in number.
pub fn write<'a>(path: impl AsRef<Path>, drawing: impl Into<Drawing<'a>>) -> Result<(), MeshError> {
    let path = path.as_ref();
    let format = Format::of(path)?;
    let drawing = drawing.into();
    drawing.check()?;
    let bytes = encode(&drawing, format)?;
    std::fs::File::create(path)
        .and_then(|mut file| file.write_all(&bytes))
        .map_err(|e| MeshError::of_file(path, &e))
}

fn encode(drawing: &Drawing, format: Format) -> Result<Vec<u8>, MeshError> {
    match format {
        Format::Obj => Ok(obj::encode(drawing)),
        Format::Off => Ok(off::encode(drawing)),
        Format::Ply => Ok(ply::encode(drawing)),
        other => Err(MeshError::UnknownFormat {
            extension: other.name().to_owned(),
            known: "obj, off and ply",
        }),
    }
}

#[cfg(test)]
mod tests;
