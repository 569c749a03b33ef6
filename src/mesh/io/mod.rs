//! Strict reading and writing of mesh files of every [`Format`], told apart by extension.
//!
//! Vertices and faces keep the numbers of the file; only in STL, whose triangles are positions, are
//! equal ones made one vertex. Only triangles are read: any other polygon is an error that names its
//! face. Normals, texture coordinates, colours, materials and groups are ignored.
//! [`soup::io`](crate::soup::io) reads the same files, and takes what is not a mesh too.

mod drawing;
mod figure;
mod gltf;
mod obj;
mod obj_uv;
mod off;
mod ply;
mod polygons;
mod stl;
mod strict;
mod usda;
mod usda_attributes;

use std::io::Write;
use std::path::Path;

use super::{MeshError, TriangleMesh};
use crate::soup::PolygonSoup;
use crate::soup::io as soup;

pub use crate::soup::io::Format;
use figure::Figure;

pub use drawing::Drawing;
pub use obj_uv::{TexturedMesh, parse_textured, read_textured};
pub use polygons::Polygons;

/// Reads a mesh; the extension tells the format.
///
/// # Errors
///
/// First those of the file ([`MeshError::UnknownFormat`], [`MeshError::Io`],
/// [`MeshError::Parse`], [`MeshError::Malformed`], [`MeshError::NotATriangle`],
/// [`MeshError::IndexOutOfRange`]), then those of [`TriangleMesh::new`].
pub fn read(path: impl AsRef<Path>) -> Result<TriangleMesh, MeshError> {
    let path = path.as_ref();
    read_as(path, Format::of(path)?)
}

/// Reads a mesh from a file of this format, whatever its name.
///
/// # Errors
///
/// As [`read`].
pub fn read_as(path: impl AsRef<Path>, format: Format) -> Result<TriangleMesh, MeshError> {
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

/// The mesh that the soup of a file of this format is, if it is one.
///
/// # Errors
///
/// As [`read`].
pub fn of_soup(soup: &PolygonSoup, format: Format) -> Result<TriangleMesh, MeshError> {
    strict::mesh(soup, format)
}

/// Writes a mesh or any other [`Drawing`]; the extension tells the format, and `.gz` after it compresses.
///
/// Coordinates are written so that reading gives back the same numbers, but for STL and glTF, which hold
/// single precision. PLY and STL are binary. Where a format has no place for colours they are left out.
///
/// # Errors
///
/// [`MeshError::UnknownFormat`], [`MeshError::Io`], and [`MeshError::InvalidArgument`] where
/// colours and elements differ in number.
pub fn write<'a>(path: impl AsRef<Path>, drawing: impl Into<Drawing<'a>>) -> Result<(), MeshError> {
    let path = path.as_ref();
    save(path, &encode(&drawing.into(), format_of(path)?)?)
}

/// Writes polygons as [`write()`] does triangles. Formats that hold no polygons
/// ([`Format::holds_polygons`]) get triangles: a quad is split along its shorter diagonal.
///
/// # Errors
///
/// As [`write()`].
pub fn write_polygons(path: impl AsRef<Path>, polygons: &Polygons) -> Result<(), MeshError> {
    let path = path.as_ref();
    save(path, &encode_polygons(polygons, format_of(path)?)?)
}

/// The contents of a file of polygons.
///
/// # Errors
///
/// As [`write()`].
pub fn encode_polygons(polygons: &Polygons, format: Format) -> Result<Vec<u8>, MeshError> {
    encoded(&polygons.into(), format)
}

fn encode(drawing: &Drawing, format: Format) -> Result<Vec<u8>, MeshError> {
    encoded(&drawing.into(), format)
}

fn encoded(figure: &Figure, format: Format) -> Result<Vec<u8>, MeshError> {
    figure.check()?;
    match format {
        Format::Obj => Ok(obj::encode(figure)),
        Format::Off => Ok(off::encode(figure)),
        Format::Ply => Ok(ply::encode(figure)),
        Format::Stl => stl::encode(figure),
        Format::Gltf => gltf::encode_text(figure),
        Format::Glb => gltf::encode_binary(figure),
        Format::Usda => Ok(usda::encode(figure)),
    }
}

/// The format of a file to be written.
///
/// # Errors
///
/// [`MeshError::UnknownFormat`], and [`MeshError::InvalidArgument`] for a name that ends in `.gz` in a
/// build without the feature `gzip`.
pub fn format_of(path: &Path) -> Result<Format, MeshError> {
    if soup::is_compressed(path) && cfg!(not(feature = "gzip")) {
        return Err(MeshError::InvalidArgument {
            what: "files are compressed only in a build with the feature `gzip`".into(),
        });
    }
    Format::of(path).map_err(|error| match MeshError::from(error) {
        MeshError::UnknownFormat { extension, .. } => MeshError::UnknownFormat {
            extension,
            known: Format::WRITTEN,
        },
        other => other,
    })
}

fn save(path: &Path, contents: &[u8]) -> Result<(), MeshError> {
    let save = || {
        let mut file = std::fs::File::create(path)?;
        #[cfg(feature = "gzip")]
        if soup::is_compressed(path) {
            let level = flate2::Compression::default();
            let mut packed = flate2::write::GzEncoder::new(file, level);
            packed.write_all(contents)?;
            return packed.finish().map(drop);
        }
        file.write_all(contents)
    };
    save().map_err(|reason| MeshError::of_file(path, &reason))
}

#[cfg(test)]
mod tests;
