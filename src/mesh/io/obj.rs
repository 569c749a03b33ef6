//! Writing of Wavefront OBJ.

use std::io::Write;

use super::Drawing;

pub(super) fn encode(drawing: &Drawing) -> Vec<u8> {
    let mut out = Vec::with_capacity(60 * drawing.vertices.len() + 25 * drawing.triangles.len());
    for (v, [x, y, z]) in drawing.vertices.iter().enumerate() {
        let _ = write!(out, "v {x} {y} {z}");
        if let Some(colors) = drawing.vertex_colors {
            for channel in colors[v] {
                let _ = write!(out, " {:.4}", f64::from(channel) / 255.0);
            }
        }
        out.push(b'\n');
    }
    for [a, b, c] in drawing
        .triangles
        .iter()
        .map(|t| t.map(|v| u64::from(v) + 1))
    {
        let _ = writeln!(out, "f {a} {b} {c}");
    }
    out
}
