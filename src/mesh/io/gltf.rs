//! Writing of glTF 2.0 (Khronos Group, 2021): one mesh of triangles, in single precision, without
//! colours. Its buffer holds the positions, then the corners.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;

use super::figure::Figure;
use crate::mesh::MeshError;

/// The JSON with the buffer in it, as base64.
pub(super) fn encode_text(figure: &Figure) -> Result<Vec<u8>, MeshError> {
    let (mut document, buffer) = document(figure)?;
    let data = STANDARD.encode(&buffer);
    document["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{data}").into();
    let mut text = document.to_string().into_bytes();
    text.push(b'\n');
    Ok(text)
}

/// The binary file (section 4.4): a header, and chunks of JSON and of the buffer.
pub(super) fn encode_binary(figure: &Figure) -> Result<Vec<u8>, MeshError> {
    let (document, buffer) = document(figure)?;
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + text.len() + 8 + buffer.len();
    let length = u32::try_from(length).map_err(|_| MeshError::TooLarge {
        vertices: figure.vertices.len(),
        faces: figure.faces.len(),
    })?;
    let mut out = Vec::with_capacity(length as usize);
    out.extend(b"glTF");
    out.extend(2_u32.to_le_bytes());
    out.extend(length.to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &buffer)] {
        out.extend((chunk.len() as u32).to_le_bytes());
        out.extend(kind);
        out.extend(chunk);
    }
    Ok(out)
}

fn document(figure: &Figure) -> Result<(serde_json::Value, Vec<u8>), MeshError> {
    let positions = figure.single()?;
    let triangles = figure.triangles();
    let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for position in &positions {
        for axis in 0..3 {
            bounds[0][axis] = bounds[0][axis].min(position[axis]);
            bounds[1][axis] = bounds[1][axis].max(position[axis]);
        }
    }
    let numbers = positions.as_flattened().iter();
    let mut buffer: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
    let start = buffer.len();
    let corners = triangles.as_flattened().iter();
    buffer.extend(corners.flat_map(|v| v.to_le_bytes()));
    let document = json!({
        "asset": {"version": "2.0", "generator": "roundel"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}]}],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": positions.len(), "type": "VEC3",
                "min": bounds[0], "max": bounds[1],
            },
            {"bufferView": 1, "componentType": 5125, "count": 3 * triangles.len(), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": start, "target": 34962},
            {
                "buffer": 0, "byteOffset": start, "byteLength": buffer.len() - start,
                "target": 34963,
            },
        ],
        "buffers": [{"byteLength": buffer.len()}],
    });
    Ok((document, buffer))
}
