//! Polygon file format, read by `ply-rs-bw`: ascii and binary of both byte orders.
//!
//! It reads `x y z` of the element `vertex` and the list `vertex_indices` (or `vertex_index`) of the
//! element `face`. It writes binary little endian with double coordinates and with colours as
//! `red green blue`, which MeshLab and Blender show.

use std::io::Cursor;
use std::io::Write;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Encoding, Property, PropertyAccess, PropertyAccessResult};

use super::{Drawing, Soup, triangle};
use crate::mesh::MeshError;
use crate::mesh::vector::Vec3;

pub(super) fn parse(bytes: &[u8]) -> Result<Soup, MeshError> {
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<Skipped>::new()
        .read_header(&mut reader)
        .map_err(|e| explain(&e, true))?;
    let ascii = header.encoding == Encoding::Ascii;
    let mut vertices: Vec<Vec3> = Vec::new();
    let mut faces = Vec::new();
    for (name, element) in &header.elements {
        // Every element takes a byte at least, but for those without properties.
        if element.count > bytes.len() {
            return Err(MeshError::Malformed {
                message: format!(
                    "the file is too short for {} elements '{name}'",
                    element.count
                ),
            });
        }
        match name.as_str() {
            "vertex" => {
                if !["x", "y", "z"]
                    .iter()
                    .all(|axis| element.properties.contains_key(*axis))
                {
                    return Err(MeshError::Malformed {
                        message: "the vertices have no x, y and z".to_owned(),
                    });
                }
                let read = Parser::<Vertex>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|e| explain(&e, ascii))?;
                vertices = read.into_iter().map(|v| v.0).collect();
            }
            "face" => {
                faces = Parser::<Face>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|e| explain(&e, ascii))?;
            }
            _ => {
                Parser::<Skipped>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|e| explain(&e, ascii))?;
            }
        }
    }
    let triangles = faces
        .iter()
        .enumerate()
        .map(|(face, read)| triangle(face, &read.0, vertices.len()))
        .collect::<Result<_, _>>()?;
    Ok((vertices, triangles))
}

pub(super) fn encode(drawing: &Drawing) -> Vec<u8> {
    let (vertices, triangles) = (drawing.vertices, drawing.triangles);
    let mut out = Vec::with_capacity(512 + 27 * vertices.len() + 16 * triangles.len());
    let colored = |colors: Option<_>| match colors {
        Some(_) => "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        None => "",
    };
    let _ = write!(
        out,
        "ply\nformat binary_little_endian 1.0\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}\
         element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
        vertices.len(),
        colored(drawing.vertex_colors),
        triangles.len(),
        colored(drawing.triangle_colors),
    );
    for (v, position) in vertices.iter().enumerate() {
        out.extend(position.iter().flat_map(|x| x.to_le_bytes()));
        out.extend(drawing.vertex_colors.iter().flat_map(|colors| colors[v]));
    }
    for (f, corners) in triangles.iter().enumerate() {
        out.push(3);
        out.extend(corners.iter().flat_map(|v| v.to_le_bytes()));
        out.extend(drawing.triangle_colors.iter().flat_map(|colors| colors[f]));
    }
    out
}

fn explain(error: &ParseError, ascii: bool) -> MeshError {
    let message = error.to_string();
    match error.line() {
        Some(line) if ascii => {
            let place = format!("Line {line}: ");
            let message = message.strip_prefix(&place).unwrap_or(&message).to_owned();
            MeshError::Parse { line, message }
        }
        _ => MeshError::Malformed { message },
    }
}

struct Vertex(Vec3);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Vertex([0.0; 3])
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ => return PropertyAccessResult::Ignored,
        };
        self.0[axis] = match value {
            Property::Double(x) => x,
            Property::Float(x) => x.into(),
            Property::Int(x) => x.into(),
            Property::UInt(x) => x.into(),
            Property::Short(x) => x.into(),
            Property::UShort(x) => x.into(),
            Property::Char(x) => x.into(),
            Property::UChar(x) => x.into(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

struct Face(Vec<i64>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Face(Vec::new())
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.0 = match value {
            Property::ListInt(list) => widened(&list),
            Property::ListUInt(list) => widened(&list),
            Property::ListShort(list) => widened(&list),
            Property::ListUShort(list) => widened(&list),
            Property::ListChar(list) => widened(&list),
            Property::ListUChar(list) => widened(&list),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

fn widened<T: Copy + Into<i64>>(list: &[T]) -> Vec<i64> {
    list.iter().map(|&v| v.into()).collect()
}

struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Skipped
    }
}
