//! Writing of the polygon file format: binary, little endian, with double coordinates, and with colours
//! as `red green blue`, which MeshLab and Blender show.

use std::io::Write;

use super::Drawing;

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
