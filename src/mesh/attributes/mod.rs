//! What faces, corners and vertices of a surface have beside their positions: materials, groups, colours, texture
//! coordinates, and any numbers.

mod kind;
mod libraries;
#[cfg(feature = "mesh-io")]
mod of_file;

use crate::error::{Error, Result, check_length};
pub use kind::AttributeKind;

/// Of a face without a material, or in no group.
pub const NO_NAME: u32 = u32::MAX;

/// A name for each face, such as that of its material.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FaceNames {
    /// All names.
    pub names: Vec<String>,
    /// The place of each face's name in `names`, or [`NO_NAME`].
    pub of_face: Vec<u32>,
}

/// A number for every vertex.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VertexScalar {
    /// Its name.
    pub name: String,
    /// The numbers. NaN stands for none.
    pub values: Vec<f64>,
}

/// The attributes of a surface of triangles, quads or other polygons. Those that are not there are `None` or empty.
///
/// Colours are red, green, blue and alpha from 0 to 1. NaN stands for no colour and for no texture coordinates.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfaceAttributes {
    /// The files that describe the materials, as OBJ names them: paths from the folder of the mesh.
    pub libraries: Vec<String>,
    /// The material of each face.
    pub materials: Option<FaceNames>,
    /// The group of each face.
    pub groups: Option<FaceNames>,
    /// The colour of each face.
    pub face_colors: Option<Vec<[f64; 4]>>,
    /// Texture coordinates of the corners of all faces, one face after the other.
    pub uv: Option<Vec<[f64; 2]>>,
    /// The colour of each vertex.
    pub vertex_colors: Option<Vec<[f64; 4]>>,
    /// Numbers of vertices.
    pub scalars: Vec<VertexScalar>,
}

impl SurfaceAttributes {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        let of_faces =
            self.materials.is_some() || self.groups.is_some() || self.face_colors.is_some();
        let of_others =
            self.uv.is_some() || self.vertex_colors.is_some() || !self.scalars.is_empty();
        !of_faces && !of_others
    }

    /// Refuses attributes of another surface than one of so many vertices, faces and corners.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`]; [`Error::IndexOutOfRange`] for a face whose name there is not; and
    /// [`Error::NotFinite`] for infinite values.
    pub fn check(&self, vertices: usize, faces: usize, corners: usize) -> Result<()> {
        let names = [
            ("materials of faces", &self.materials),
            ("groups of faces", &self.groups),
        ];
        for (what, names) in names {
            if let Some(names) = names {
                check_length(what, names.of_face.len(), faces)?;
                let unknown = |&n: &u32| n != NO_NAME && n as usize >= names.names.len();
                if let Some(position) = names.of_face.iter().position(unknown) {
                    return Err(Error::IndexOutOfRange {
                        what,
                        position,
                        value: names.of_face[position].into(),
                        len: names.names.len(),
                    });
                }
            }
        }
        let values = |what, values: Option<&[f64]>, size: usize, expected: usize| match values {
            Some(values) => check_length(what, values.len() / size, expected)
                .and_then(|()| check_not_infinite(what, values, size)),
            None => Ok(()),
        };
        let of_faces = self.face_colors.as_ref().map(|c| c.as_flattened());
        values("colours of faces", of_faces, 4, faces)?;
        let of_corners = self.uv.as_ref().map(|uv| uv.as_flattened());
        values("texture coordinates of corners", of_corners, 2, corners)?;
        let of_vertices = self.vertex_colors.as_ref().map(|c| c.as_flattened());
        values("colours of vertices", of_vertices, 4, vertices)?;
        for scalar in &self.scalars {
            values("numbers of vertices", Some(&scalar.values), 1, vertices)?;
        }
        Ok(())
    }
}

/// Refuses infinite values, of which each element has `size`, with the element.
pub(crate) fn check_not_infinite(what: &'static str, values: &[f64], size: usize) -> Result<()> {
    match values.iter().position(|x| x.is_infinite()) {
        Some(at) => Err(Error::NotFinite {
            what,
            position: at / size,
        }),
        None => Ok(()),
    }
}
