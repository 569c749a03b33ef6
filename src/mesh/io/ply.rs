//! Writing of the polygon file format: binary, little endian, with double coordinates, with colours as
//! `red green blue`, which MeshLab and Blender show, and with a number for every vertex as `quality`.

use std::io::Write;

use super::figure::Figure;

pub(super) fn encode(figure: &Figure) -> Vec<u8> {
    let (vertices, faces) = (figure.vertices, &figure.faces);
    let mut out = Vec::with_capacity(512 + 27 * vertices.len() + 20 * faces.len());
    let colored = |colors: Option<_>| match colors {
        Some(_) => "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        None => "",
    };
    let small = faces.iter().all(|face| face.len() <= usize::from(u8::MAX));
    let _ = write!(
        out,
        "ply\nformat binary_little_endian 1.0\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}{}\
         element face {}\nproperty list {} int vertex_indices\n{}end_header\n",
        vertices.len(),
        colored(figure.vertex_colors),
        if figure.vertex_quality.is_some() {
            "property double quality\n"
        } else {
            ""
        },
        faces.len(),
        if small { "uchar" } else { "int" },
        colored(figure.face_colors),
    );
    for (v, position) in vertices.iter().enumerate() {
        out.extend(position.iter().flat_map(|x| x.to_le_bytes()));
        out.extend(figure.vertex_colors.iter().flat_map(|colors| colors[v]));
        out.extend(
            figure
                .vertex_quality
                .iter()
                .flat_map(|q| q[v].to_le_bytes()),
        );
    }
    for (f, face) in faces.iter().enumerate() {
        let length = (face.len() as u32).to_le_bytes();
        out.extend(&length[..if small { 1 } else { 4 }]);
        out.extend(face.iter().flat_map(|v| v.to_le_bytes()));
        out.extend(figure.face_colors.iter().flat_map(|colors| colors[f]));
    }
    out
}
