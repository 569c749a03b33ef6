//! Small angles, removed by Delaunay refinement (`chew1993`, section 3; `ruppert1995`, section 2).
//!
//! A vertex goes to the circumcenter of the triangle. If a held edge lies between, or has the circumcenter
//! in its diametral circle, then that edge is split in its middle instead.

use super::queue::{smallest_angle, squared_length};
use super::working_mesh::WorkingMesh;
use crate::mesh::connectivity::NONE;
use crate::mesh::orientation;
use crate::mesh::vector::{Vec3, add, scale};

/// The most triangles on the way to a circumcenter.
const STEPS: usize = 1000;

/// The triangle of the circumcenter, or a held edge on the way to it.
enum Way {
    Face(u32),
    Held(u32),
}

impl WorkingMesh<'_> {
    /// Improves a face with a small angle by one vertex; false where the shape does not allow it. Held
    /// edges whose squared length is below `shortest` are not split.
    pub(super) fn improve(&mut self, face: u32, shortest: f64) -> bool {
        let (_, apex) = smallest_angle(self.corners(face));
        let sides = [apex, (apex + 2) % 3].map(|k| 3 * face + k as u32);
        // The angle between held edges stays what it is.
        if sides.iter().all(|&half| self.is_held(half)) {
            return false;
        }
        let Some(q) = self.circumcenter(face) else {
            return false;
        };
        match self.way_to(face, q) {
            Some(Way::Held(half)) => self.split_held(half, shortest),
            Some(Way::Face(found)) => {
                let encroached = self.encroached(face, q);
                match encroached.or_else(|| self.encroached(found, q)) {
                    Some(half) => self.split_held(half, shortest),
                    None => self.insert(found, q),
                }
            }
            None => false,
        }
    }

    /// Puts a vertex at a point of a face or, if the point is on one of its edges as the circumcenter of a
    /// right triangle is, in the middle of that edge.
    fn insert(&mut self, face: u32, q: [f64; 2]) -> bool {
        let p = self.point_of(face, q);
        let (p, on) = self.on_the_surface(face, p);
        if self.split_face(face, p, on) {
            return true;
        }
        let area = |half: u32| {
            let [a, b] = self.in_plane(self.region(face), self.ends(half));
            orientation([a, b, q])
        };
        let edges = (3 * face..3 * face + 3).filter(|&half| !self.is_held(half));
        let nearest = edges.min_by(|&a, &b| area(a).total_cmp(&area(b)));
        nearest.is_some_and(|half| self.split_in_the_middle(half))
    }

    fn split_held(&mut self, half: u32, shortest: f64) -> bool {
        squared_length(self, half) >= shortest && self.split_in_the_middle(half)
    }

    /// The circumcenter of a face in the plane of its region.
    fn circumcenter(&self, face: u32) -> Option<[f64; 2]> {
        let [a, b, c] = self.in_plane(self.region(face), self.triangles[face as usize]);
        let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1]]);
        let [uu, vv] = [u, v].map(|w| w[0] * w[0] + w[1] * w[1]);
        let area = 2.0 * (u[0] * v[1] - u[1] * v[0]);
        let centre = [
            a[0] + (v[1] * uu - u[1] * vv) / area,
            a[1] + (u[0] * vv - v[0] * uu) / area,
        ];
        centre.iter().all(|x| x.is_finite()).then_some(centre)
    }

    /// Walks through the region towards a point of its plane, which ends at held edges.
    fn way_to(&self, from: u32, q: [f64; 2]) -> Option<Way> {
        let (region, mut face, mut entered) = (self.region(from), from, NONE);
        for _ in 0..STEPS {
            let beyond = (3 * face..3 * face + 3).find(|&half| {
                let [a, b] = self.in_plane(region, self.ends(half));
                half != entered && orientation([a, b, q]) < 0.0
            });
            match beyond {
                None => return Some(Way::Face(face)),
                Some(half) if self.is_held(half) => return Some(Way::Held(half)),
                Some(half) => {
                    entered = self.twin[half as usize];
                    face = entered / 3;
                }
            }
        }
        None
    }

    /// A held edge of the face with the point in its diametral circle.
    fn encroached(&self, face: u32, q: [f64; 2]) -> Option<u32> {
        let region = self.region(face);
        (3 * face..3 * face + 3).find(|&half| {
            let [a, b] = self.in_plane(region, self.ends(half));
            let [u, v] = [a, b].map(|p| [p[0] - q[0], p[1] - q[1]]);
            self.is_held(half) && u[0] * v[0] + u[1] * v[1] < 0.0
        })
    }

    /// The point of a face over a point of the plane of its region.
    fn point_of(&self, face: u32, q: [f64; 2]) -> Vec3 {
        let corners = self.corners(face);
        let [a, b, c] = self.in_plane(self.region(face), self.triangles[face as usize]);
        let areas = [[b, c, q], [c, a, q], [a, b, q]].map(orientation);
        let sum: f64 = areas.iter().sum();
        (0..3).fold([0.0; 3], |point, k| {
            add(point, scale(corners[k], areas[k] / sum))
        })
    }
}
