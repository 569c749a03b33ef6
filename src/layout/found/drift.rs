//! How far the arcs of a simplified layout leave the lines of the quads that it was found of.

use super::triangulated::Triangulated;
use super::{FoundLayout, QuadSurface};
use crate::mesh::ClosestPoint;
use crate::mesh::vector::{Vec3, add, dot, scale, sub};

/// The drift of arcs, and their angles with the lines.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drift {
    /// The largest distance that an arc moves across the lines that it runs along, in edges of the quads.
    pub largest: f64,
    /// The mean angle between arcs and lines, by length, in degrees.
    pub mean_angle: f64,
}

/// The drift of the arcs of a layout of `surface` over the quads `of`, whose triangles are given.
///
/// Steps along an arc are measured in the coordinates of the quad below the middle of each, in which it is a square.
pub(super) fn drift(
    surface: &QuadSurface,
    layout: &FoundLayout,
    of: &QuadSurface,
    triangles: &Triangulated,
) -> Drift {
    let tree = ClosestPoint::new(&triangles.mesh);
    let at = |v: u32| surface.positions()[v as usize];
    let mut found = Drift::default();
    let mut lengths = [0.0; 2];
    let mut hint = None;
    for arc in &layout.arcs {
        let (mut across, mut low, mut high) = (0.0, 0.0_f64, 0.0_f64);
        // The direction across, as a vector in space, which tells the sign on the next quad.
        let mut last: Option<Vec3> = None;
        for pair in arc.vertices.windows(2) {
            let step = sub(at(pair[1]), at(pair[0]));
            let middle = scale(add(at(pair[1]), at(pair[0])), 0.5);
            let Some((face, _)) = tree.find(middle, hint) else {
                continue;
            };
            hint = Some(face);
            let gradients = gradients(of, triangles, face);
            let parts = gradients.map(|gradient| dot(gradient, step));
            let side = usize::from(parts[0].abs() > parts[1].abs());
            let flip = last.is_some_and(|last| dot(last, gradients[side]) < 0.0);
            let sign = if flip { -1.0 } else { 1.0 };
            last = Some(scale(gradients[side], sign));
            across += sign * parts[side];
            (low, high) = (low.min(across), high.max(across));
            let length = parts[0].hypot(parts[1]);
            lengths[0] += length * parts[side].abs().atan2(parts[1 - side].abs()).to_degrees();
            lengths[1] += length;
        }
        found.largest = found.largest.max(high - low);
    }
    if lengths[1] > 0.0 {
        found.mean_angle = lengths[0] / lengths[1];
    }
    found
}

/// The gradients in space of the two coordinates of a quad on one of its triangles.
fn gradients(of: &QuadSurface, triangles: &Triangulated, face: usize) -> [Vec3; 2] {
    let [a, b, c, d] = of.quads()[face / 2].map(|v| of.positions()[v as usize]);
    // On the first triangle u rises from a to b and v from b to c, on the second u from d to c and v from a to d.
    let [u, v] = match face % 2 {
        0 => [sub(b, a), sub(c, b)],
        _ => [sub(c, d), sub(d, a)],
    };
    let normal = triangles.mesh.normal(face);
    let [of_u, of_v] = [
        crate::mesh::vector::cross(v, normal),
        crate::mesh::vector::cross(normal, u),
    ];
    [
        scale(of_u, 1.0 / dot(of_u, u)),
        scale(of_v, 1.0 / dot(of_v, v)),
    ]
}
