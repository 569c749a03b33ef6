//! Texture coordinates of the corners of an OBJ file's faces.
//!
//! `tobj` numbers them anew, as it does vertices, so the lines `vt` and `f` are read here. The reader
//! of the mesh has validated the rest of every face before.

use std::path::Path;

use super::Format;
use super::obj::{self, keyword};
use crate::mesh::{MeshError, TriangleMesh};

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
    let (vertices, triangles) = obj::parse(bytes)?;
    let uv = corners(bytes)?;
    Ok((TriangleMesh::new(vertices, triangles)?, uv))
}

fn corners(bytes: &[u8]) -> Result<Vec<[[f64; 2]; 3]>, MeshError> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut faces: Vec<(usize, [usize; 3])> = Vec::new();
    for (at, line) in bytes.split(|&b| b == b'\n').enumerate() {
        let fault = |message: &str| MeshError::Parse {
            line: at + 1,
            message: message.to_owned(),
        };
        let words = || std::str::from_utf8(line).map(|text| text.split_ascii_whitespace().skip(1));
        match keyword(line) {
            b"vt" => {
                let point = words().ok().and_then(point);
                points.push(point.ok_or_else(|| fault("vt needs two finite numbers"))?);
            }
            b"f" => {
                let mut corners = [0; 3];
                let words = words().map_err(|_| fault("the line is not readable text"))?;
                for (corner, word) in corners.iter_mut().zip(words) {
                    let number = word.split('/').nth(1).filter(|number| !number.is_empty());
                    let number =
                        number.ok_or_else(|| fault("a corner has no texture coordinates"))?;
                    *corner = resolve(number, points.len())
                        .ok_or_else(|| fault("a corner names no texture coordinates"))?;
                }
                faces.push((at + 1, corners));
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

fn point<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<[f64; 2]> {
    let mut number = || words.next()?.parse().ok().filter(|x: &f64| x.is_finite());
    Some([number()?, number()?])
}

/// From 1 onwards, or backwards from the last so far.
fn resolve(number: &str, so_far: usize) -> Option<usize> {
    match number.parse::<i64>().ok()? {
        0 => None,
        forwards @ 1.. => usize::try_from(forwards - 1).ok(),
        backwards => so_far.checked_sub(usize::try_from(-backwards).ok()?),
    }
}
