//! Small reproducible noise, so that no two edges of a symmetric shape are equally long.

use super::vector::{add, norm, scale, sub};
use super::{MeshError, TriangleMesh};
use crate::linalg::Random;

/// Moves every vertex by a vector whose coordinates are uniform in
/// ±`amplitude` times its shortest edge; the same for the same seed everywhere.
///
/// # Errors
///
/// [`MeshError::InvalidArgument`] unless the amplitude is finite and at least 0;
/// [`MeshError::ZeroArea`] where a large one collapses a face.
pub fn jitter(mesh: &TriangleMesh, amplitude: f64, seed: u64) -> Result<TriangleMesh, MeshError> {
    if !amplitude.is_finite() || amplitude < 0.0 {
        return Err(MeshError::InvalidArgument {
            what: format!("the jitter amplitude is {amplitude}; it must be finite and at least 0"),
        });
    }
    let mut shortest = vec![f64::INFINITY; mesh.vertex_count()];
    for edge in mesh.edges() {
        let [a, b] = edge.vertices;
        let length = norm(sub(mesh.position(a), mesh.position(b)));
        shortest[a] = shortest[a].min(length);
        shortest[b] = shortest[b].min(length);
    }
    let mut random = Random::new(seed);
    let vertices = mesh
        .vertices()
        .iter()
        .zip(shortest)
        .map(|(&p, length)| {
            let noise = [random.symmetric(), random.symmetric(), random.symmetric()];
            add(p, scale(noise, amplitude * length))
        })
        .collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec())
}
