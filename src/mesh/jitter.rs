//! Small reproducible noise, so that no two edges of a symmetric shape are equally long.

use super::vector::{add, norm, scale, sub};
use super::{MeshError, TriangleMesh};

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
    let mut random = SplitMix::new(seed);
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

/// SplitMix64 (`steele2014`): eight lines, a counter as its only state, and the same numbers on
/// every machine and in every version, which no general generator promises.
struct SplitMix(u64);

impl SplitMix {
    fn new(seed: u64) -> Self {
        SplitMix(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [-1, 1).
    fn symmetric(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
