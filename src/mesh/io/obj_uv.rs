//! Texture coordinates of the corners of an OBJ file's faces.
//!
//! `tobj` numbers them anew, as it does vertices, so the lines `vt` and `f` are read here. The reader
//! of the mesh has validated the rest of every face before.

use std::path::Path;

use super::{Format, strict};
use crate::mesh::{MeshError, TriangleMesh};
use crate::soup::io::{self as soup, Statement, Statements, corner_number};

/// A mesh and the coordinates (u, v) of the corners of each of its faces.
pub type TexturedMesh = (TriangleMesh, Vec<[[f64; 2]; 3]>);

/// Reads an OBJ file whose every corner has texture coordinates, `f v/vt v/vt v/vt`.
///
/// # Errors
/// As [`read`](super::read), [`MeshError::InvalidArgument`] for a file that is not OBJ, and
/// [`MeshError::Parse`] with the line for a corner without coordinates, for a number that names
/// none, and for coordinates that are not two finite numbers.
pub fn read_textured(path: impl AsRef<Path>) -> Result<TexturedMesh, MeshError> {
    let path = path.as_ref();
    let format = Format::of(path)?;
    if format != Format::Obj {
        return Err(MeshError::InvalidArgument {
            what: "texture coordinates are read from OBJ files only".into(),
        });
    }
    let bytes = std::fs::read(path).map_err(|e| MeshError::of_file(path, &e))?;
    parse_textured(&bytes)
}

/// The mesh and the coordinates that the contents of an OBJ file describe.
///
/// # Errors
/// As [`read_textured`].
pub fn parse_textured(bytes: &[u8]) -> Result<TexturedMesh, MeshError> {
    let soup = soup::parse(bytes, Format::Obj)?;
    strict::triangles(&soup)?;
    let uv = corners(bytes)?;
    Ok((strict::mesh(&soup, Format::Obj)?, uv))
}

fn corners(bytes: &[u8]) -> Result<Vec<[[f64; 2]; 3]>, MeshError> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut faces: Vec<(usize, [usize; 3])> = Vec::new();
    for (line, statement) in Statements::new(bytes) {
        let fault = |message: &str| MeshError::Parse {
            line,
            message: message.to_owned(),
        };
        match statement {
            Statement::Texture(text) => {
                let point = point(words(&text));
                points.push(point.ok_or_else(|| fault("vt needs two finite numbers"))?);
            }
            Statement::Face(text) => {
                let mut corners = [0; 3];
                for (corner, word) in corners.iter_mut().zip(words(&text)) {
                    let number = word.split(|&b| b == b'/').nth(1);
                    let number = number.filter(|number| !number.is_empty());
                    let number =
                        number.ok_or_else(|| fault("a corner has no texture coordinates"))?;
                    *corner = corner_number(number, points.len() as i64)
                        .and_then(|number| usize::try_from(number).ok())
                        .ok_or_else(|| fault("a corner names no texture coordinates"))?;
                }
                faces.push((line, corners));
            }
            _ => {}
        }
    }
    let of_face = |&(line, corners): &(usize, [usize; 3])| {
        // Coordinates may follow the faces that name them.
        if corners.iter().any(|&c| c >= points.len()) {
            return Err(MeshError::Parse {
                line,
                message: "a corner names no texture coordinates".into(),
            });
        }
        Ok(corners.map(|c| points[c]))
    };
    faces.iter().map(of_face).collect()
}

fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

fn point<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Option<[f64; 2]> {
    let mut number = || {
        let word = std::str::from_utf8(words.next()?).ok()?;
        word.parse().ok().filter(|x: &f64| x.is_finite())
    };
    Some([number()?, number()?])
}
