//! Writing of Wavefront OBJ. Its colours are those of vertices; materials and groups are of faces, and texture
//! coordinates of corners.

use std::collections::HashMap;
use std::io::Write;

use super::figure::Figure;
use crate::mesh::attributes::{FaceNames, NO_NAME};

pub(super) fn encode(figure: &Figure) -> Vec<u8> {
    let mut out = Vec::with_capacity(60 * figure.vertices.len() + 25 * figure.faces.len());
    let attributes = figure.attributes;
    let materials = attributes.and_then(|a| a.materials.as_ref());
    let groups = attributes.and_then(|a| a.groups.as_ref());
    if let (Some(attributes), Some(_)) = (attributes, materials) {
        for library in &attributes.libraries {
            let _ = writeln!(out, "mtllib {library}");
        }
    }
    let colors = attributes.and_then(|a| a.vertex_colors.as_deref());
    for (v, [x, y, z]) in figure.vertices.iter().enumerate() {
        let _ = write!(out, "v {x} {y} {z}");
        if let Some(colors) = figure.vertex_colors {
            for channel in colors[v] {
                let _ = write!(out, " {:.4}", f64::from(channel) / 255.0);
            }
        } else if let Some(colors) = colors {
            // Of several vertices with colours, one without is white.
            for channel in &colors[v][..3] {
                let channel = if channel.is_nan() { 1.0 } else { *channel };
                let _ = write!(out, " {channel}");
            }
        }
        out.push(b'\n');
    }
    let uv = attributes.and_then(|a| a.uv.as_deref());
    let textures = uv.map(|uv| numbered(uv, &mut out));
    let mut materials = materials.map(|names| Statements::new("usemtl", "None", names));
    let mut groups = groups.map(|names| Statements::new("g", "default", names));
    let mut corner = 0;
    for (f, face) in figure.faces.iter().enumerate() {
        for statements in [&mut groups, &mut materials].into_iter().flatten() {
            statements.add(f, &mut out);
        }
        out.push(b'f');
        let textures = textures
            .as_ref()
            .map(|all| &all[corner..corner + face.len()]);
        corner += face.len();
        // All corners of a face have coordinates, or none.
        let textures = textures.filter(|all| all.iter().all(|&number| number > 0));
        for (k, &vertex) in face.iter().enumerate() {
            let _ = write!(out, " {}", u64::from(vertex) + 1);
            if let Some(textures) = textures {
                let _ = write!(out, "/{}", textures[k]);
            }
        }
        out.push(b'\n');
    }
    out
}

/// Writes texture coordinates, equal ones once. The number of each corner's, counted from 1; 0 for those of none.
fn numbered(uv: &[[f64; 2]], out: &mut Vec<u8>) -> Vec<usize> {
    let mut numbers = HashMap::new();
    let number = |&[u, v]: &[f64; 2]| {
        if u.is_nan() || v.is_nan() {
            return 0;
        }
        let next = numbers.len() + 1;
        *numbers.entry([u, v].map(f64::to_bits)).or_insert_with(|| {
            let _ = writeln!(out, "vt {u} {v}");
            next
        })
    };
    uv.iter().map(number).collect()
}

/// The statements that name what the faces after them have.
struct Statements<'a> {
    keyword: &'static str,
    /// What stands for no name after another one.
    none: &'static str,
    names: &'a FaceNames,
    current: u32,
}

impl<'a> Statements<'a> {
    fn new(keyword: &'static str, none: &'static str, names: &'a FaceNames) -> Self {
        Statements {
            keyword,
            none,
            names,
            current: NO_NAME,
        }
    }

    fn add(&mut self, face: usize, out: &mut Vec<u8>) {
        let label = self.names.of_face[face];
        if label != self.current {
            let name = self.names.names.get(label as usize);
            let name = name.map_or(self.none, String::as_str);
            let _ = writeln!(out, "{} {name}", self.keyword);
            self.current = label;
        }
    }
}
