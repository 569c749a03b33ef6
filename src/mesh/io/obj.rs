//! Writing of Wavefront OBJ. It has a place for the colours of vertices only.

use std::io::Write;

use super::figure::Figure;

pub(super) fn encode(figure: &Figure) -> Vec<u8> {
    let mut out = Vec::with_capacity(60 * figure.vertices.len() + 25 * figure.faces.len());
    for (v, [x, y, z]) in figure.vertices.iter().enumerate() {
        let _ = write!(out, "v {x} {y} {z}");
        if let Some(colors) = figure.vertex_colors {
            for channel in colors[v] {
                let _ = write!(out, " {:.4}", f64::from(channel) / 255.0);
            }
        }
        out.push(b'\n');
    }
    for face in &figure.faces {
        out.push(b'f');
        for &corner in *face {
            let _ = write!(out, " {}", u64::from(corner) + 1);
        }
        out.push(b'\n');
    }
    out
}
