//! Normals, areas, angles and extents.

use super::TriangleMesh;
use super::vector::{Vec3, add, cross, dot, norm, normalize, scale, sub};
use crate::monitor::collect_in_parts;

/// The least number of faces or edges that are worth a thread.
const LEAST: usize = 1 << 12;

impl TriangleMesh {
    /// Unit normal of a face.
    #[inline]
    pub fn normal(&self, face: usize) -> Vec3 {
        normalize(self.doubled_area_vector(face))
    }

    /// Area of a face.
    #[inline]
    pub fn area(&self, face: usize) -> f64 {
        0.5 * norm(self.doubled_area_vector(face))
    }

    /// Angle of a face at its corner `k`, in radians.
    ///
    /// By arctangent of the cross and dot products, which keeps its digits at every angle.
    pub fn angle(&self, face: usize, k: usize) -> f64 {
        self.angles()[face][k]
    }

    /// The angles at the corners of every face. They are measured when they are first asked for.
    pub(crate) fn angles(&self) -> &[[f64; 3]] {
        let of_face = |face: usize| {
            let p = self.corner_positions(face);
            [0, 1, 2].map(|k| {
                let (u, v) = (sub(p[(k + 1) % 3], p[k]), sub(p[(k + 2) % 3], p[k]));
                norm(cross(u, v)).atan2(dot(u, v))
            })
        };
        let measure = || collect_in_parts(self.face_count(), LEAST, of_face);
        self.angles.get_or_init(measure)
    }

    /// Length of local edge `k` of a face.
    #[inline]
    pub fn edge_length(&self, face: usize, k: usize) -> f64 {
        let p = self.corner_positions(face);
        norm(sub(p[(k + 1) % 3], p[k]))
    }

    /// Mean length of all edges.
    pub fn mean_edge_length(&self) -> f64 {
        let total: f64 = self
            .edges()
            .map(|e| self.edge_length(e.first.0, e.first.1))
            .sum();
        total / self.edge_count() as f64
    }

    /// Centroid of a face.
    pub fn face_centroid(&self, face: usize) -> Vec3 {
        let [a, b, c] = self.corner_positions(face);
        scale(add(add(a, b), c), 1.0 / 3.0)
    }

    /// Area of the surface. It is measured when it is first asked for.
    pub fn surface_area(&self) -> f64 {
        let areas = || collect_in_parts(self.face_count(), LEAST, |f| self.area(f));
        let measure = || areas().into_iter().sum();
        *self.area.get_or_init(measure)
    }

    /// Centroid of the surface: of its faces, weighted by area.
    pub fn centroid(&self) -> Vec3 {
        let sum = (0..self.face_count()).fold([0.0; 3], |sum, f| {
            add(sum, scale(self.face_centroid(f), self.area(f)))
        });
        scale(sum, 1.0 / self.surface_area())
    }

    /// Lowest and highest coordinates.
    pub fn bounding_box(&self) -> [Vec3; 2] {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for p in self.vertices() {
            for (axis, &x) in p.iter().enumerate() {
                bounds[0][axis] = bounds[0][axis].min(x);
                bounds[1][axis] = bounds[1][axis].max(x);
            }
        }
        bounds
    }

    /// Unit axes of the frame of a face: along its first edge, and a quarter turn
    /// counter-clockwise from there.
    #[inline]
    pub fn frame(&self, face: usize) -> [Vec3; 2] {
        let [a, b, _] = self.corner_positions(face);
        let x = normalize(sub(b, a));
        [x, cross(self.normal(face), x)]
    }

    /// Angle of local edge `k` of a face in its frame, in (-pi, pi]: from the first edge
    /// counter-clockwise. Local edge 0 has exactly 0.
    pub fn edge_angle(&self, face: usize, k: usize) -> f64 {
        use std::f64::consts::PI;
        match k {
            0 => 0.0,
            1 => PI - self.angle(face, 1),
            _ => self.angle(face, 0) - PI,
        }
    }

    /// Angle of the frame axis of `face` seen in the frame of the face across its local edge
    /// `k`, after unfolding over the edge, in (-pi, pi]; none at the boundary.
    pub fn transport(&self, face: usize, k: usize) -> Option<f64> {
        use std::f64::consts::{PI, TAU};
        let (across, j) = self.neighbor(face, k)?;
        // The common edge runs the other way in the other face.
        let turn = self.edge_angle(across, j) + PI - self.edge_angle(face, k);
        let turn = turn.rem_euclid(TAU);
        Some(if turn > PI { turn - TAU } else { turn })
    }

    /// The [transport](Self::transport) over every edge from its first face; 0 at the boundary.
    pub(crate) fn transports(&self) -> Vec<f64> {
        // All threads need the angles, so they are not left to one of them.
        self.angles();
        collect_in_parts(self.edge_count(), LEAST, |e| {
            let (face, k) = self.edge(e).first;
            self.transport(face, k).unwrap_or(0.0)
        })
    }

    fn doubled_area_vector(&self, face: usize) -> Vec3 {
        let [a, b, c] = self.corner_positions(face);
        cross(sub(b, a), sub(c, a))
    }
}
