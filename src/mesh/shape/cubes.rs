//! The rounded cube: six square grids on a cube, projected onto the rounded surface.

use super::ball::nearest_square;
use super::quads::Quads;
use crate::mesh::vector::{Vec3, add, normalize, scale, sub};
use crate::mesh::{MeshError, TriangleMesh};

/// Half of the width.
const HALF: f64 = 1.0;
/// Radius of the rounding.
const RADIUS: f64 = 0.35;

/// All points at distance [`RADIUS`] from the cube of half width [`HALF`] - [`RADIUS`]:
/// 12 m^2 triangles.
pub(super) fn rounded_cube(target: usize) -> Result<TriangleMesh, MeshError> {
    let m = nearest_square(target, 12);
    let mut quads = Quads::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            quads.add_patch(m, m, |u, v| {
                let (u, v) = (on_cube(u), on_cube(v));
                let mut p = [0.0; 3];
                p[axis] = side * HALF;
                // Counter-clockwise seen from outside on either side.
                p[(axis + 1) % 3] = if side > 0.0 { u } else { v };
                p[(axis + 2) % 3] = if side > 0.0 { v } else { u };
                drawn_in(p)
            });
        }
    }
    quads.weld().triangulate()
}

/// The coordinate on the cube of a point, given as a fraction of the way across a face of the rounded
/// cube: steps are even in length on the flat part and in angle on the rounding.
fn on_cube(part: f64) -> f64 {
    let flat = HALF - RADIUS;
    let across = flat + RADIUS * std::f64::consts::FRAC_PI_4;
    let way = (2.0 * part - 1.0) * across;
    if way.abs() <= flat {
        way
    } else {
        // The last step is the corner itself, whatever the tangent rounds to.
        let beyond = RADIUS * ((way.abs() - flat) / RADIUS).tan();
        (flat + beyond).min(HALF).copysign(way)
    }
}

fn drawn_in(p: Vec3) -> Vec3 {
    let core = p.map(|x| x.clamp(RADIUS - HALF, HALF - RADIUS));
    add(core, scale(normalize(sub(p, core)), RADIUS))
}
