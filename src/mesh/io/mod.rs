//! Reading and writing of mesh files: OBJ, OFF and PLY, told apart by extension.
//!
//! Vertices and faces keep the numbers of the file. Only triangles are read: any other polygon is an
//! error that names its face. Normals, texture coordinates, colours, materials and groups are
//! ignored.

mod drawing;
mod obj;
mod obj_uv;
mod off;
mod ply;

use std::io::Write;
use std::path::Path;

use super::vector::Vec3;
use super::{MeshError, TriangleMesh};

pub use drawing::Drawing;
pub use obj_uv::{TexturedMesh, parse_textured, read_textured};

/// A file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Wavefront, `.obj`.
    Obj,
    /// Object file format of Geomview, `.off`, with its variants COFF, NOFF and STOFF.
    Off,
    /// Polygon file format, `.ply`: ascii, and binary of both byte orders.
    Ply,
}

impl Format {
    /// The format that the extension of a file name stands for, in any case.
    ///
    /// # Errors
    ///
    /// [`MeshError::UnknownFormat`].
    pub fn of(path: &Path) -> Result<Format, MeshError> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        match extension.to_ascii_lowercase().as_str() {
            "obj" => Ok(Format::Obj),
            "off" => Ok(Format::Off),
            "ply" => Ok(Format::Ply),
            _ => Err(MeshError::UnknownFormat {
                extension: extension.into_owned(),
            }),
        }
    }
}

/// Positions and corners as a file has them, nothing checked yet.
type Soup = (Vec<Vec3>, Vec<[u32; 3]>);

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
    let bytes = std::fs::read(path).map_err(|e| MeshError::of_file(path, &e))?;
    parse(&bytes, format)
}

/// The mesh that the contents of a file describe.
///
/// # Errors
///
/// As [`read`].
pub fn parse(bytes: &[u8], format: Format) -> Result<TriangleMesh, MeshError> {
    let (vertices, triangles) = match format {
        Format::Obj => obj::parse(bytes),
        Format::Off => off::parse(bytes),
        Format::Ply => ply::parse(bytes),
    }?;
    TriangleMesh::new(vertices, triangles)
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
    let bytes = encode(&drawing, format);
    std::fs::File::create(path)
        .and_then(|mut file| file.write_all(&bytes))
        .map_err(|e| MeshError::of_file(path, &e))
}

fn encode(drawing: &Drawing, format: Format) -> Vec<u8> {
    match format {
        Format::Obj => obj::encode(drawing),
        Format::Off => off::encode(drawing),
        Format::Ply => ply::encode(drawing),
    }
}

/// The corners of one face of the file, which must be three.
fn triangle(face: usize, corners: &[i64], vertices: usize) -> Result<[u32; 3], MeshError> {
    let &[a, b, c] = corners else {
        return Err(MeshError::NotATriangle {
            face,
            corners: corners.len(),
        });
    };
    let number = |vertex: i64| {
        u32::try_from(vertex)
            .ok()
            .filter(|&v| (v as usize) < vertices)
            .ok_or(MeshError::IndexOutOfRange {
                face,
                vertex,
                vertices,
            })
    };
    Ok([number(a)?, number(b)?, number(c)?])
}

#[cfg(test)]
mod tests;
