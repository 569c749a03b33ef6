//! Writing of binary STL, in single precision. It holds triangles only, and no colours.

use super::figure::Figure;
use crate::mesh::MeshError;
use crate::mesh::vector::{Vec3, cross, dot, sub};

pub(super) fn encode(figure: &Figure) -> Result<Vec<u8>, MeshError> {
    let positions = figure.single()?;
    let triangles = figure.triangles();
    let count = u32::try_from(triangles.len()).map_err(|_| MeshError::TooLarge {
        vertices: positions.len(),
        faces: triangles.len(),
    })?;
    let mut out = Vec::with_capacity(84 + 50 * triangles.len());
    // Not `solid`, with which text starts.
    out.extend(b"binary STL");
    out.resize(80, b' ');
    out.extend(count.to_le_bytes());
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| figure.vertices[v as usize]);
        let normal = unit(cross(sub(b, a), sub(c, a))).map(|x| x as f32);
        let corners = triangle.map(|v| positions[v as usize]);
        let numbers = normal.iter().chain(corners.as_flattened());
        out.extend(numbers.flat_map(|x| x.to_le_bytes()));
        out.extend([0; 2]);
    }
    Ok(out)
}

/// The direction of a vector, or zero, which readers take for a normal that is not given.
fn unit(vector: Vec3) -> Vec3 {
    let length = dot(vector, vector).sqrt();
    if length > 0.0 && length.is_finite() {
        vector.map(|x| x / length)
    } else {
        [0.0; 3]
    }
}
