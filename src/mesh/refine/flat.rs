//! Regions of faces that lie in one plane.
//!
//! A region grows from the largest face that has none, over edges that are no features, to faces whose
//! corners lie within half the deviation of the plane of that face. Triangles between such corners are
//! within half the deviation of the plane as well. So whatever is flipped inside a region, the old surface
//! and the new one are within the deviation.

use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, cross, dot, norm, sub};
use crate::mesh::{TriangleMesh, orientation};

/// The normals of a region's faces differ from that of its plane by at most this angle (10 degrees),
/// unless the face is thinner than the deviation, which leaves its normal to chance.
const COS_OF_TURN: f64 = 0.984_807_753_012_208;

/// No region: a face that has not been visited.
const NONE: u32 = u32::MAX;

/// The regions of a mesh.
pub(super) struct Regions {
    /// The region of every face.
    pub(super) of_face: Vec<u32>,
    /// The plane of every region.
    pub(super) planes: Vec<Plane>,
    /// Faces, those of a region next to each other.
    members: Vec<u32>,
    start: Vec<u32>,
}

/// A plane with a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    origin: Vec3,
    axes: [Vec3; 2],
    normal: Vec3,
}

impl Plane {
    fn of(mesh: &TriangleMesh, face: usize) -> Self {
        Plane {
            origin: mesh.corner_positions(face)[0],
            axes: mesh.frame(face),
            normal: mesh.normal(face),
        }
    }

    /// The coordinates of the foot of a point.
    pub(super) fn coordinates(&self, p: Vec3) -> [f64; 2] {
        let off = sub(p, self.origin);
        self.axes.map(|axis| dot(off, axis))
    }

    fn height(&self, p: Vec3) -> f64 {
        dot(sub(p, self.origin), self.normal).abs()
    }

    /// Whether the face lies in the plane and is seen from the same side.
    fn contains(&self, mesh: &TriangleMesh, face: usize, half: f64) -> bool {
        let corners = mesh.corner_positions(face);
        if corners.iter().any(|&p| self.height(p) > half) {
            return false;
        }
        let [a, b, c] = corners;
        let sides = [sub(b, a), sub(c, b), sub(a, c)];
        let area = cross(sides[0], sides[1]);
        let longest = sides.iter().map(|&s| norm(s)).fold(0.0, f64::max);
        let is_parallel = dot(area, self.normal) >= COS_OF_TURN * norm(area);
        let is_thin = norm(area) <= half * longest;
        (is_parallel || is_thin) && orientation(corners.map(|p| self.coordinates(p))) > 0.0
    }
}

impl Regions {
    /// Each face as a region.
    pub(super) fn of_single_faces(mesh: &TriangleMesh) -> Self {
        let faces = mesh.face_count() as u32;
        Regions {
            of_face: (0..faces).collect(),
            planes: (0..mesh.face_count())
                .map(|face| Plane::of(mesh, face))
                .collect(),
            members: (0..faces).collect(),
            start: (0..=faces).collect(),
        }
    }

    /// The faces of a region.
    pub(super) fn faces(&self, region: u32) -> &[u32] {
        let range = self.start[region as usize]..self.start[region as usize + 1];
        &self.members[range.start as usize..range.end as usize]
    }
}

/// The regions of the mesh between these features.
pub(super) fn regions(mesh: &TriangleMesh, features: &FeatureGraph, deviation: f64) -> Regions {
    let mut by_area: Vec<(f64, u32)> = (0..mesh.face_count())
        .map(|face| (mesh.area(face), face as u32))
        .collect();
    by_area.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut of_face = vec![NONE; mesh.face_count()];
    let (mut planes, mut start) = (Vec::new(), vec![0]);
    let mut members: Vec<u32> = Vec::with_capacity(mesh.face_count());
    for (_, seed) in by_area {
        if of_face[seed as usize] != NONE {
            continue;
        }
        let (region, plane) = (planes.len() as u32, Plane::of(mesh, seed as usize));
        let mut next = members.len();
        of_face[seed as usize] = region;
        members.push(seed);
        while let Some(&face) = members.get(next) {
            next += 1;
            for k in 0..3 {
                let Some((other, _)) = mesh.neighbor(face as usize, k) else {
                    continue;
                };
                let is_open = !features.contains(mesh.edge_of(face as usize, k));
                if is_open && of_face[other] == NONE && plane.contains(mesh, other, 0.5 * deviation)
                {
                    of_face[other] = region;
                    members.push(other as u32);
                }
            }
        }
        planes.push(plane);
        start.push(members.len() as u32);
    }
    Regions {
        of_face,
        planes,
        members,
        start,
    }
}
