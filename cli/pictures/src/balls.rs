//! Irregular vertices as balls, coloured by index.

use roundel::field::OrientationField;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::{Vec3, add, normalize, scale};

pub(super) const POSITIVE: [u8; 3] = [214, 48, 38];
pub(super) const NEGATIVE: [u8; 3] = [30, 92, 205];
pub(super) const OTHER: [u8; 3] = [240, 168, 12];

/// A ball: red for an index of one step of 1/N of a turn, blue for minus one, amber for all others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    pub(super) centre: Vec3,
    pub(super) color: [u8; 3],
}

/// One ball for each irregular vertex, in increasing order of vertices.
pub(super) fn balls(mesh: &TriangleMesh, field: &OrientationField) -> Vec<Ball> {
    let steps = field.vertex_index_steps(mesh).into_iter().enumerate();
    let ball = |(vertex, steps)| Ball {
        centre: mesh.position(vertex),
        color: match steps {
            1 => POSITIVE,
            -1 => NEGATIVE,
            _ => OTHER,
        },
    };
    steps.filter(|&(_, steps)| steps != 0).map(ball).collect()
}

/// A sphere of radius 1 about the origin, whose points are its normals: an octahedron, each edge
/// cut in `steps`.
pub(super) fn unit_sphere(steps: usize) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for octant in 0..8u8 {
        let sign = [0, 1, 2].map(|k| if octant >> k & 1 == 0 { 1.0 } else { -1.0 });
        let mirrored = sign.iter().product::<f64>() < 0.0;
        let first = points.len();
        // Row i of the octant's triangle has i + 1 points.
        let number = |i: usize, j: usize| (first + i * (i + 1) / 2 + j) as u32;
        for i in 0..=steps {
            for j in 0..=i {
                let corner = [(steps - i) as f64, (i - j) as f64, j as f64];
                let bent = corner.map(|x| (x / steps as f64 * std::f64::consts::FRAC_PI_2).sin());
                points.push(normalize(std::array::from_fn(|k| sign[k] * bent[k])));
                if i == steps {
                    continue;
                }
                let mut add = |[a, b, c]: [u32; 3]| {
                    triangles.push(if mirrored { [a, c, b] } else { [a, b, c] });
                };
                add([number(i, j), number(i + 1, j), number(i + 1, j + 1)]);
                if j < i {
                    add([number(i, j), number(i + 1, j + 1), number(i, j + 1)]);
                }
            }
        }
    }
    (points, triangles)
}

impl Ball {
    /// The point of the ball of this radius in the direction of a unit vector.
    pub(super) fn point(&self, radius: f64, towards: Vec3) -> Vec3 {
        add(self.centre, scale(towards, radius))
    }
}
