//! How much quads lose of the surface that they are to replace.
//!
//! Quads much larger than a solid's details cut off its edges and corners. Where that loses more than a small
//! part of the surface, quads along its sharp edges may do better.

use crate::extract::QuadMesh;
use crate::mesh::refine::diagonal;
use crate::mesh::vector::{add, norm, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};

/// A point of the surface is lost if it is farther from the quads than this part of the diagonal.
const FAR: f64 = 0.015;

/// The distance beyond which a point of a mesh is lost.
pub(super) fn far(mesh: &TriangleMesh) -> f64 {
    FAR * diagonal(mesh)
}

/// The part of the surface that may be lost.
pub(super) const LOST: f64 = 0.01;

/// The number of points that stand for the surface.
const POINTS: f64 = 4000.0;

/// The fractional parts of the multiples of two irrational numbers fill a square evenly: the reciprocals of
/// the plastic number and of its square.
const EVENLY: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// The part of the surface that is farther than this from the quads.
pub(super) fn lost(quads: &QuadMesh, mesh: &TriangleMesh, far: f64) -> f64 {
    let (mut count, mut lost) = (0usize, 0usize);
    visit(quads, mesh, far, |_, is_lost| {
        count += 1;
        lost += usize::from(is_lost);
    });
    lost as f64 / count.max(1) as f64
}

/// A density that is twice the given one at the vertices of faces that quads lose; none stands for 1.
pub(super) fn denser(quads: &QuadMesh, mesh: &TriangleMesh, far: f64, density: &[f64]) -> Vec<f64> {
    let mut is_lost = vec![false; mesh.vertex_count()];
    visit(quads, mesh, far, |face, lost| {
        if lost {
            mesh.corners(face)
                .into_iter()
                .for_each(|v| is_lost[v] = true);
        }
    });
    let of = |v: usize| density.get(v).copied().unwrap_or(1.0);
    let factor = |v: usize| if is_lost[v] { 2.0 } else { 1.0 };
    (0..is_lost.len()).map(|v| factor(v) * of(v)).collect()
}

/// Visits points that stand for the surface, evenly: the face of each, and whether it is farther than this from the
/// quads.
fn visit(quads: &QuadMesh, mesh: &TriangleMesh, far: f64, mut take: impl FnMut(usize, bool)) {
    let at = |v: u32| quads.vertices[v as usize];
    let triangles = quads.faces().flat_map(|face| {
        let fan = face.windows(2).skip(1);
        fan.map(|pair| [at(face[0]), at(pair[0]), at(pair[1])])
    });
    let tree = ClosestPoint::of_triangles(triangles.collect());
    let spacing = mesh.surface_area() / POINTS;
    let (mut count, mut due) = (0usize, 0.0);
    for face in 0..mesh.face_count() {
        due += mesh.area(face) / spacing;
        while due >= 1.0 {
            due -= 1.0;
            count += 1;
            let p = inside(mesh.corner_positions(face), count);
            let near = tree.find(p, None);
            take(face, near.is_none_or(|(_, q)| norm(sub(p, q)) > far));
        }
    }
}

/// The point of a triangle that belongs to a number: even over all numbers.
fn inside([a, b, c]: [[f64; 3]; 3], number: usize) -> [f64; 3] {
    let [mut s, mut t] = EVENLY.map(|step| (number as f64 * step).fract());
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    add(a, add(scale(sub(b, a), s), scale(sub(c, a), t)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;

    #[test]
    fn the_surface_is_covered_by_itself_and_not_by_half_of_itself() {
        let mesh = by_name("rounded-cube", 2_000).unwrap();
        let whole = QuadMesh {
            others: mesh.triangles().iter().map(|t| t.to_vec()).collect(),
            ..QuadMesh::from_quads(mesh.vertices().to_vec(), Vec::new(), 2)
        };
        assert_eq!(lost(&whole, &mesh, far(&mesh)), 0.0);
        let half = QuadMesh {
            others: whole.others[..mesh.face_count() / 2].to_vec(),
            ..whole.clone()
        };
        assert!(lost(&half, &mesh, far(&mesh)) > 0.3);
        assert!(
            denser(&whole, &mesh, far(&mesh), &[])
                .iter()
                .all(|&d| d == 1.0)
        );
        let given = vec![1.5; mesh.vertex_count()];
        let found = denser(&half, &mesh, far(&mesh), &given);
        // Vertices of the half that is there keep their density, but for those at its rim.
        let of_face = |f: usize| mesh.corners(f).map(|v| found[v]);
        let kept = (0..mesh.face_count() / 2).filter(|&f| of_face(f) == [1.5; 3]);
        assert!(kept.count() > mesh.face_count() / 3);
        let doubled = found.iter().filter(|&&d| d == 3.0).count();
        assert!(doubled > mesh.vertex_count() / 4 && doubled < mesh.vertex_count() * 2 / 3);
    }
}
