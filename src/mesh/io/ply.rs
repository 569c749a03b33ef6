//! Writing of the polygon file format: binary, little endian, with double coordinates, with colours as
//! `red green blue alpha`, which MeshLab and Blender show, and with numbers of vertices by their names.
//!
//! Materials and groups are numbers of faces, `material_index` and `group_index`; comments tell their names.
//! Texture coordinates are lists of faces, `texcoord`, as MeshLab has them.

use std::io::Write;

use super::figure::Figure;
use crate::mesh::attributes::FaceNames;

pub(super) fn encode(figure: &Figure) -> Vec<u8> {
    let (vertices, faces) = (figure.vertices, &figure.faces);
    let mut out = Vec::with_capacity(512 + 27 * vertices.len() + 20 * faces.len());
    let attributes = figure.attributes;
    let names = attributes.map_or([const { None }; 2], |a| {
        [
            ("material", a.materials.as_ref()),
            ("group", a.groups.as_ref()),
        ]
        .map(|(what, names)| Some((what, names?)))
    });
    let of_vertices = Colors::of(
        figure.vertex_colors,
        attributes.and_then(|a| a.vertex_colors.as_deref()),
    );
    let of_faces = Colors::of(
        figure.face_colors,
        attributes.and_then(|a| a.face_colors.as_deref()),
    );
    let quality = figure.vertex_quality.map(|values| ("quality", values));
    let scalars = attributes.iter().flat_map(|a| &a.scalars);
    let scalars = scalars.map(|scalar| (scalar.name.as_str(), scalar.values.as_slice()));
    let scalars: Vec<_> = quality.into_iter().chain(scalars).collect();
    let uv = attributes.and_then(|a| a.uv.as_deref());
    // The list of coordinates has two numbers for each corner.
    let most = usize::from(u8::MAX) / if uv.is_some() { 2 } else { 1 };
    let small = faces.iter().all(|face| face.len() <= most);
    let length = if small { "uchar" } else { "int" };

    out.extend(b"ply\nformat binary_little_endian 1.0\n");
    for (what, names) in names.iter().flatten() {
        for (number, name) in names.names.iter().enumerate() {
            let _ = writeln!(out, "comment {what} {number} {name}");
        }
    }
    let _ = write!(
        out,
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}",
        vertices.len(),
        of_vertices.header(),
    );
    for (name, _) in &scalars {
        let _ = writeln!(out, "property double {name}");
    }
    let _ = write!(
        out,
        "element face {}\nproperty list {length} int vertex_indices\n{}",
        faces.len(),
        of_faces.header(),
    );
    for (what, _) in names.iter().flatten() {
        let _ = writeln!(out, "property int {what}_index");
    }
    if uv.is_some() {
        let _ = writeln!(out, "property list {length} double texcoord");
    }
    out.extend(b"end_header\n");

    for (v, position) in vertices.iter().enumerate() {
        out.extend(position.iter().flat_map(|x| x.to_le_bytes()));
        of_vertices.add(v, &mut out);
        out.extend(
            scalars
                .iter()
                .flat_map(|(_, values)| values[v].to_le_bytes()),
        );
    }
    let mut corner = 0;
    let size = if small { 1 } else { 4 };
    for (f, face) in faces.iter().enumerate() {
        out.extend(&(face.len() as u32).to_le_bytes()[..size]);
        out.extend(face.iter().flat_map(|v| v.to_le_bytes()));
        of_faces.add(f, &mut out);
        for (_, names) in names.iter().flatten() {
            out.extend(number(names, f).to_le_bytes());
        }
        if let Some(uv) = uv {
            let numbers = uv[corner..corner + face.len()].as_flattened();
            out.extend(&(numbers.len() as u32).to_le_bytes()[..size]);
            out.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
            corner += face.len();
        }
    }
    out
}

/// The number of a face's name; -1 for none.
fn number(names: &FaceNames, face: usize) -> i32 {
    // NO_NAME has the bits of -1.
    names.of_face[face].cast_signed()
}

/// Colours of vertices or of faces, in bytes or from 0 to 1.
enum Colors<'a> {
    None,
    Bytes(&'a [[u8; 3]]),
    Reals {
        colors: &'a [[f64; 4]],
        /// Three without alpha, four with it.
        channels: usize,
    },
}

impl<'a> Colors<'a> {
    fn of(bytes: Option<&'a [[u8; 3]]>, reals: Option<&'a [[f64; 4]]>) -> Self {
        match (bytes, reals) {
            (Some(bytes), _) => Colors::Bytes(bytes),
            (None, Some(colors)) => {
                let is_opaque = colors.iter().all(|&[.., alpha]| byte(alpha) == u8::MAX);
                let channels = if is_opaque { 3 } else { 4 };
                Colors::Reals { colors, channels }
            }
            (None, None) => Colors::None,
        }
    }

    fn header(&self) -> &'static str {
        match self {
            Colors::None => "",
            Colors::Reals { channels: 4, .. } => {
                "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
            }
            _ => "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        }
    }

    fn add(&self, element: usize, out: &mut Vec<u8>) {
        match self {
            Colors::None => {}
            Colors::Bytes(bytes) => out.extend(bytes[element]),
            Colors::Reals { colors, channels } => {
                out.extend(colors[element][..*channels].iter().map(|&x| byte(x)));
            }
        }
    }
}

/// A channel in one byte. What has no colour is white.
fn byte(channel: f64) -> u8 {
    match channel.is_nan() {
        true => u8::MAX,
        false => (255.0 * channel).round().clamp(0.0, 255.0) as u8,
    }
}
