//! The closest point of the mesh, on a triangle that faces the same way.

use super::samples::{Sample, samples_of};
use super::{LEAST, all};
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::mesh::vector::{Vec3, add, cross, dot, norm, sub};
use crate::mesh::{ClosestPoint, TriangleMesh, barycentric};
use crate::monitor::{collect_in_parts, is_wanted, may_continue, room_for, span};

/// Quads and the mesh on which they lie.
pub(super) struct Nearest<'a> {
    pub(super) mesh: &'a TriangleMesh,
    /// The positions of the corners of all faces of the quads.
    pub(super) faces: Vec<&'a [u32]>,
    pub(super) quads: &'a QuadMesh,
    tree: ClosestPoint,
}

/// A point of the mesh: a face and barycentric coordinates.
pub(super) type Place = (usize, [f64; 3]);

impl<'a> Nearest<'a> {
    pub(super) fn new(mesh: &'a TriangleMesh, quads: &'a QuadMesh) -> Result<Self> {
        let _span = span("transfer");
        let faces: Vec<_> = quads.faces().collect();
        // Those of the tree: corners, numbers and boxes.
        room_for("the search tree of the mesh", mesh.face_count(), 140)?;
        let tree = ClosestPoint::new(mesh);
        may_continue()?;
        Ok(Nearest {
            mesh,
            faces,
            quads,
            tree,
        })
    }

    /// The triangle and the point closest to `p`, on a triangle whose normal agrees with `normal` if one is less than
    /// `reach` away.
    pub(super) fn find(
        &self,
        p: Vec3,
        normal: Vec3,
        reach: f64,
        hint: Option<usize>,
    ) -> (usize, Vec3) {
        // A mesh has a triangle.
        let found = self.tree.find(p, hint).unwrap_or((0, p));
        let agrees = |face: usize| dot(self.mesh.normal(face), normal) > 0.0;
        if agrees(found.0) {
            return found;
        }
        self.tree.find_wanted(p, reach, agrees).unwrap_or(found)
    }

    pub(super) fn corners(&self, face: usize) -> Vec<Vec3> {
        let corners = self.faces[face].iter();
        corners.map(|&v| self.quads.vertices[v as usize]).collect()
    }

    /// The samples of all faces of the quads.
    pub(super) fn samples(&self) -> Result<Vec<Vec<Sample>>> {
        let count = self.faces.len();
        room_for("samples of the quads", count, 24 + 16 * size_of::<Sample>())?;
        all(collect_in_parts(count, LEAST, |face| {
            is_wanted()?;
            Ok(samples_of(self, &self.corners(face)))
        }))
    }

    /// The place of every vertex of the quads.
    pub(super) fn places(&self) -> Result<Vec<Place>> {
        let count = self.quads.vertices.len();
        room_for(
            "places of the quads",
            count,
            size_of::<(Place, Vec3, f64)>(),
        )?;
        let mut around = vec![([0.0; 3], 0.0f64); count];
        for (face, corners) in self.faces.iter().enumerate() {
            let positions = self.corners(face);
            let (normal, radius) = (normal(&positions), radius(&positions));
            for &v in *corners {
                let (sum, reach) = &mut around[v as usize];
                (*sum, *reach) = (add(*sum, normal), reach.max(radius));
            }
        }
        all(collect_in_parts(count, LEAST, |v| {
            is_wanted()?;
            let (normal, reach) = around[v];
            let (face, point) = self.find(self.quads.vertices[v], normal, reach, None);
            Ok((face, barycentric(self.mesh.corner_positions(face), point)))
        }))
    }
}

/// The doubled area vector of a polygon.
pub(super) fn normal(corners: &[Vec3]) -> Vec3 {
    let next = corners.iter().cycle().skip(1);
    let origin = corners[0];
    let sides = corners.iter().zip(next);
    let areas = sides.map(|(&a, &b)| cross(sub(a, origin), sub(b, origin)));
    areas.fold([0.0; 3], add)
}

pub(super) fn center(corners: &[Vec3]) -> Vec3 {
    let sum = corners.iter().copied().fold([0.0; 3], add);
    sum.map(|x| x / corners.len() as f64)
}

/// The distance of the farthest corner from the center.
pub(super) fn radius(corners: &[Vec3]) -> f64 {
    let center = center(corners);
    let distances = corners.iter().map(|&p| norm(sub(p, center)));
    distances.fold(0.0, f64::max)
}
