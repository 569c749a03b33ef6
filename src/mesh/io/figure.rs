//! What the encoders take: positions and polygons with or without colours, however they are stored.

use super::{Drawing, Polygons};
use crate::mesh::MeshError;
use crate::mesh::attributes::SurfaceAttributes;
use crate::mesh::vector::{Vec3, dot, sub};

pub(super) struct Figure<'a> {
    pub(super) vertices: &'a [Vec3],
    pub(super) faces: Vec<&'a [u32]>,
    pub(super) vertex_colors: Option<&'a [[u8; 3]]>,
    pub(super) vertex_quality: Option<&'a [f64]>,
    pub(super) face_colors: Option<&'a [[u8; 3]]>,
    pub(super) attributes: Option<&'a SurfaceAttributes>,
}

impl<'a> From<&Drawing<'a>> for Figure<'a> {
    fn from(drawing: &Drawing<'a>) -> Self {
        Figure {
            vertices: drawing.vertices,
            faces: drawing.triangles.iter().map(<[u32; 3]>::as_slice).collect(),
            vertex_colors: drawing.vertex_colors,
            vertex_quality: drawing.vertex_quality,
            face_colors: drawing.triangle_colors,
            attributes: None,
        }
    }
}

impl<'a> From<&Polygons<'a>> for Figure<'a> {
    fn from(polygons: &Polygons<'a>) -> Self {
        Figure {
            vertices: polygons.vertices,
            faces: polygons.faces.clone(),
            vertex_colors: None,
            vertex_quality: None,
            face_colors: None,
            attributes: polygons.attributes,
        }
    }
}

impl Figure<'_> {
    pub(super) fn check(&self) -> Result<(), MeshError> {
        let vertices = self.vertices.len();
        fits("vertex", self.vertex_colors, vertices)?;
        if let Some(quality) = self.vertex_quality.filter(|q| q.len() != vertices) {
            return Err(MeshError::InvalidArgument {
                what: format!(
                    "there are {} numbers of vertices, not {vertices}",
                    quality.len()
                ),
            });
        }
        fits("triangle", self.face_colors, self.faces.len())?;
        for (face, corners) in self.faces.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
                return Err(MeshError::IndexOutOfRange {
                    face,
                    vertex: vertex.into(),
                    vertices,
                });
            }
        }
        if let Some(attributes) = self.attributes {
            let corners = self.faces.iter().map(|face| face.len()).sum();
            let fit = attributes.check(vertices, self.faces.len(), corners);
            fit.map_err(|error| MeshError::InvalidArgument {
                what: error.to_string(),
            })?;
        }
        Ok(())
    }

    /// Positions in single precision, which STL and glTF hold.
    pub(super) fn single(&self) -> Result<Vec<[f32; 3]>, MeshError> {
        let rounded = |(vertex, position): (usize, &Vec3)| {
            let position = position.map(|x| x as f32);
            match position.iter().all(|x| x.is_finite()) {
                true => Ok(position),
                false => Err(MeshError::InvalidArgument {
                    what: format!(
                        "vertex {vertex}: a coordinate is too large for single precision"
                    ),
                }),
            }
        };
        self.vertices.iter().enumerate().map(rounded).collect()
    }

    /// All faces as triangles, for formats that hold nothing else. A quad is split along its shorter
    /// diagonal, the first where both are as long; other polygons are fans about their first corner.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        let mut triangles = Vec::with_capacity(2 * self.faces.len());
        let length = |v: u32, w: u32| {
            let along = sub(self.vertices[w as usize], self.vertices[v as usize]);
            dot(along, along)
        };
        for face in &self.faces {
            match **face {
                [a, b, c, d] if length(b, d) < length(a, c) => {
                    triangles.extend([[b, c, d], [b, d, a]]);
                }
                [first, ref rest @ ..] => {
                    let pairs = rest.windows(2);
                    triangles.extend(pairs.map(|pair| [first, pair[0], pair[1]]));
                }
                [] => {}
            }
        }
        triangles
    }
}

fn fits(what: &str, colors: Option<&[[u8; 3]]>, expected: usize) -> Result<(), MeshError> {
    match colors {
        Some(colors) if colors.len() != expected => Err(MeshError::InvalidArgument {
            what: format!("there are {} {what} colors, not {expected}", colors.len()),
        }),
        _ => Ok(()),
    }
}
