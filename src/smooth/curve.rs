//! A curve on the surface, parametrised by arc length.

use crate::mesh::features::FeatureCurve;
use crate::mesh::vector::{Vec3, add, norm, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};

/// A chain of edges of the mesh.
pub(super) struct Curve {
    tree: ClosestPoint,
    points: Vec<Vec3>,
    /// The arc length at every point.
    arcs: Vec<f64>,
    /// The vertices of the mesh at which it starts and ends.
    pub(super) ends: [usize; 2],
}

impl Curve {
    pub(super) fn new(mesh: &TriangleMesh, curve: &FeatureCurve) -> Self {
        let points: Vec<Vec3> = curve.vertices.iter().map(|&v| mesh.position(v)).collect();
        let (mut arcs, mut arc) = (vec![0.0], 0.0);
        let mut segments = Vec::new();
        for ends in points.windows(2) {
            arc += norm(sub(ends[1], ends[0]));
            arcs.push(arc);
            segments.push([ends[0], ends[1], ends[1]]);
        }
        let ends = [0, curve.edges.len()].map(|i| curve.vertices[i]);
        Curve {
            tree: ClosestPoint::of_triangles(segments),
            points,
            arcs,
            ends,
        }
    }

    pub(super) fn length(&self) -> f64 {
        self.arcs[self.arcs.len() - 1]
    }

    /// The number of the closest edge and the closest point. `hint` is an edge number found before.
    pub(super) fn closest(&self, p: Vec3, hint: Option<usize>) -> Option<(usize, Vec3)> {
        self.tree.find(p, hint)
    }

    /// The arc length at the closest point, and the distance to that point.
    pub(super) fn arc(&self, p: Vec3) -> (f64, f64) {
        self.closest(p, None)
            .map_or((0.0, f64::INFINITY), |(edge, point)| {
                let along = norm(sub(point, self.points[edge]));
                (self.arcs[edge] + along, norm(sub(p, point)))
            })
    }

    /// The point at this arc length, which is periodic if the curve is a loop.
    pub(super) fn point(&self, arc: f64) -> Vec3 {
        let arc = match self.ends[0] == self.ends[1] {
            true => arc.rem_euclid(self.length()),
            false => arc,
        };
        let after = self.arcs.partition_point(|&a| a < arc);
        let edge = after.clamp(1, self.arcs.len() - 1) - 1;
        let [from, to] = [self.points[edge], self.points[edge + 1]];
        let part = (arc - self.arcs[edge]) / (self.arcs[edge + 1] - self.arcs[edge]);
        add(from, scale(sub(to, from), part.clamp(0.0, 1.0)))
    }
}
