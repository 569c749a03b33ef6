//! How far quads are from the surface that they stand for.

use roundel::extract::QuadMesh;
use roundel::mesh::vector::{Vec3, norm, sub};
use roundel::mesh::{ClosestPoint, TriangleMesh};

/// Samples along either side of a quad.
const SAMPLES: usize = 5;

/// For every quad the largest distance of its samples from the mesh. A quad is the bilinear patch of its
/// corners.
pub fn distances(quads: &QuadMesh, mesh: &TriangleMesh) -> Vec<f32> {
    let surface = ClosestPoint::new(mesh);
    let mut hint = None;
    let mut distance = |p: Vec3| {
        let (face, point) = surface.find(p, hint)?;
        hint = Some(face);
        Some(norm(sub(p, point)))
    };
    let of = quads.quads.iter().map(|quad| {
        let corners = quad.map(|v| quads.vertices[v as usize]);
        let samples = (0..SAMPLES * SAMPLES).map(|i| patch(corners, i / SAMPLES, i % SAMPLES));
        samples.filter_map(&mut distance).fold(0.0, f64::max) as f32
    });
    of.collect()
}

/// The sample of a bilinear patch in this row and column.
fn patch([a, b, c, d]: [Vec3; 4], row: usize, column: usize) -> Vec3 {
    let [s, t] = [column, row].map(|i| i as f64 / (SAMPLES - 1) as f64);
    [0, 1, 2].map(|k| {
        let (low, high) = (a[k] + s * (b[k] - a[k]), d[k] + s * (c[k] - d[k]));
        low + t * (high - low)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quad_that_floats_above_a_plane_is_as_far_away_as_it_floats() {
        let flat = vec![
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 4.0, 0.0],
            [0.0, 4.0, 0.0],
        ];
        let mesh = TriangleMesh::new(flat.clone(), vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let mut quads = QuadMesh::from_quads(flat, vec![[0, 1, 2, 3]], 1);
        assert_eq!(distances(&quads, &mesh), [0.0]);
        quads.vertices[1][2] = 0.5;
        assert_eq!(distances(&quads, &mesh), [0.5]);
    }
}
