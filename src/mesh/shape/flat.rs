//! Bounded pieces of the plane: a square, and a plate with round holes.

use std::f64::consts::FRAC_PI_2;

use super::ball::nearest_square;
use super::divide;
use super::quads::Quads;
use crate::mesh::{MeshError, TriangleMesh, turned};

/// Number of holes, one in each unit square of the plate.
const HOLES: usize = 3;
/// Their radius.
const HOLE_RADIUS: f64 = 0.25;

/// The square [-1, 1]^2: 2 m^2 triangles.
pub(super) fn plane(target: usize) -> Result<TriangleMesh, MeshError> {
    let m = nearest_square(target, 2);
    let mut quads = Quads::default();
    quads.add_patch(m, m, |u, v| [2.0 * u - 1.0, 2.0 * v - 1.0, 0.0]);
    quads.triangulate()
}

/// Unit squares in a row, each of four patches between its sides and its hole.
pub(super) fn plate_with_holes(target: usize) -> Result<TriangleMesh, MeshError> {
    // The mean of a side and an arc, and the mean distance between them.
    let lengths = [0.7, 0.34];
    let triangles = |[along, across]: [usize; 2]| 8 * HOLES * along * across;
    let [along, across] = divide(lengths, 1, target, triangles);
    let mut quads = Quads::default();
    for cell in 0..HOLES {
        let centre = cell as f64 - 0.5 * (HOLES - 1) as f64;
        for side in 0..4 {
            quads.add_patch(along, across, |u, v| {
                let (sin, cos) = (FRAC_PI_2 * (0.5 - u)).sin_cos();
                let x = (1.0 - v) * HOLE_RADIUS * cos + v * 0.5;
                let y = (1.0 - v) * HOLE_RADIUS * sin + v * (0.5 - u);
                let [x, y] = turned(side, [x, y]);
                [centre + x, y, 0.0]
            });
        }
    }
    quads.weld().triangulate()
}
