//! Where a point of a region lies on the original mesh: a walk over its faces, in the region's plane.
//!
//! A walk may circle or end at a corner of the region that is not convex. Then all faces of the region are
//! searched.

use super::flat::Regions;
use super::working_mesh::WorkingMesh;
use crate::mesh::vector::{Vec3, add, scale};
use crate::mesh::{TriangleMesh, orientation};

/// The most steps of a walk.
const STEPS: usize = 200;

impl WorkingMesh<'_> {
    /// The point of the original surface at the foot of `p` in the plane of a face's region, and the
    /// original face on which it lies.
    pub(super) fn on_the_surface(&self, face: u32, p: Vec3) -> (Vec3, u32) {
        let region = self.region(face);
        if let [only] = *self.regions.faces(region) {
            return (p, only);
        }
        let q = self.regions.planes[region as usize].coordinates(p);
        let found = locate(self.mesh, self.regions, q, self.origin[face as usize]);
        let (corners, weights) = found.weights(self.mesh);
        let point = (0..3).fold([0.0; 3], |sum, k| add(sum, scale(corners[k], weights[k])));
        (point, found.face)
    }
}

/// A face, and the doubled areas of the three triangles between the point and its edges, in the plane.
pub(super) struct Located {
    pub(super) face: u32,
    areas: [f64; 3],
}

impl Located {
    /// The corners of the face, and the weights of the point in the face that is closest.
    fn weights(&self, mesh: &TriangleMesh) -> ([Vec3; 3], [f64; 3]) {
        let inside = self.areas.map(|area| area.max(0.0));
        let sum: f64 = inside.iter().sum();
        let [a, b, c] = inside.map(|area| area / sum);
        (mesh.corner_positions(self.face as usize), [b, c, a])
    }

    /// How far outside of the face the point is, as a part of the face's area; at most 0 inside.
    fn outside(&self) -> f64 {
        let sum: f64 = self.areas.iter().sum();
        -self.areas.iter().fold(f64::INFINITY, |m, &a| m.min(a)) / sum
    }
}

/// The face of a region in which the point `q` of its plane lies, or is closest to; found from a face of
/// the region.
pub(super) fn locate(mesh: &TriangleMesh, regions: &Regions, q: [f64; 2], from: u32) -> Located {
    let region = regions.of_face[from as usize];
    let plane = &regions.planes[region as usize];
    let at = |face: u32| {
        let [a, b, c] = mesh
            .corner_positions(face as usize)
            .map(|p| plane.coordinates(p));
        Located {
            face,
            areas: [[a, b, q], [b, c, q], [c, a, q]].map(orientation),
        }
    };
    let mut here = at(from);
    for step in 0..STEPS {
        if here.areas.iter().all(|&area| area >= 0.0) {
            return here;
        }
        // Starting at another edge each time keeps the walk from circling.
        let beyond = (0..3).map(|k| (k + step) % 3).find_map(|k| {
            let (other, _) = mesh.neighbor(here.face as usize, k)?;
            let may_cross = here.areas[k] < 0.0 && regions.of_face[other] == region;
            may_cross.then_some(other as u32)
        });
        match beyond {
            Some(face) => here = at(face),
            None => break,
        }
    }
    for &face in regions.faces(region) {
        let there = at(face);
        if there.outside() < here.outside() {
            here = there;
            if here.outside() <= 0.0 {
                break;
            }
        }
    }
    here
}
