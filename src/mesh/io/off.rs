//! Writing of Geomview's object file format as text: OFF, or COFF where vertices have colours.

use std::io::Write;

use super::figure::Figure;

pub(super) fn encode(figure: &Figure) -> Vec<u8> {
    let (vertices, faces) = (figure.vertices, &figure.faces);
    let mut out = Vec::with_capacity(60 * vertices.len() + 25 * faces.len());
    let prefix = figure.vertex_colors.map_or("", |_| "C");
    let _ = writeln!(out, "{prefix}OFF\n{} {} 0", vertices.len(), faces.len());
    for (v, [x, y, z]) in vertices.iter().enumerate() {
        let _ = write!(out, "{x} {y} {z}");
        if let Some([r, g, b]) = figure.vertex_colors.map(|colors| colors[v]) {
            let _ = write!(out, " {r} {g} {b} 255");
        }
        out.push(b'\n');
    }
    for (f, face) in faces.iter().enumerate() {
        let _ = write!(out, "{}", face.len());
        for corner in *face {
            let _ = write!(out, " {corner}");
        }
        if let Some([r, g, b]) = figure.face_colors.map(|colors| colors[f]) {
            let _ = write!(out, " {r} {g} {b}");
        }
        out.push(b'\n');
    }
    out
}
