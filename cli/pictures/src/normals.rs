//! Normals for shading: smooth over the surface, broken at its creases.

use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{Vec3, add, dot, normalize, scale};

/// Cosine of the angle between two faces beyond which the edge between them looks sharp: 50
/// degrees, so that round parts of a coarse mesh stay round.
const CREASE: f64 = 0.643;

/// One normal for each corner of every face: the mean, weighted by angles, of those faces around its
/// vertex that differ from its own by less than a crease.
pub(super) fn corner_normals(mesh: &TriangleMesh) -> Vec<[Vec3; 3]> {
    let normals: Vec<Vec3> = (0..mesh.face_count()).map(|f| mesh.normal(f)).collect();
    let mut found = vec![[[0.0; 3]; 3]; mesh.face_count()];
    for v in 0..mesh.vertex_count() {
        let ring: Vec<(usize, usize, f64)> = mesh
            .ring(v)
            .map(|(f, k)| (f, k, mesh.angle(f, k)))
            .collect();
        for &(f, k, _) in &ring {
            let near = ring
                .iter()
                .filter(|r| dot(normals[r.0], normals[f]) > CREASE);
            let sum = near.fold([0.0; 3], |sum, r| add(sum, scale(normals[r.0], r.2)));
            found[f][k] = normalize(sum);
        }
    }
    found
}
