//! Writing of Geomview's object file format as text: OFF, or COFF where vertices have colours.

use std::io::Write;

use super::Drawing;

pub(super) fn encode(drawing: &Drawing) -> Vec<u8> {
    let (vertices, triangles) = (drawing.vertices, drawing.triangles);
    let mut out = Vec::with_capacity(60 * vertices.len() + 25 * triangles.len());
    let prefix = drawing.vertex_colors.map_or("", |_| "C");
    let _ = writeln!(out, "{prefix}OFF\n{} {} 0", vertices.len(), triangles.len());
    for (v, [x, y, z]) in vertices.iter().enumerate() {
        let _ = write!(out, "{x} {y} {z}");
        if let Some([r, g, b]) = drawing.vertex_colors.map(|colors| colors[v]) {
            let _ = write!(out, " {r} {g} {b} 255");
        }
        out.push(b'\n');
    }
    for (f, [a, b, c]) in triangles.iter().enumerate() {
        let _ = write!(out, "3 {a} {b} {c}");
        if let Some([r, g, b]) = drawing.triangle_colors.map(|colors| colors[f]) {
            let _ = write!(out, " {r} {g} {b}");
        }
        out.push(b'\n');
    }
    out
}
