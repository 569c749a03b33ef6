//! The ring torus, evenly divided around its axis and around its tube.

use std::f64::consts::TAU;

use super::divide;
use super::quads::Quads;
use crate::mesh::{MeshError, TriangleMesh};

/// Radius of the circle that the tube follows.
pub(super) const RING: f64 = 1.0;
/// Radius of the tube.
pub(super) const TUBE: f64 = 0.4;

/// A torus about the z axis.
pub(super) fn torus(target: usize) -> Result<TriangleMesh, MeshError> {
    let lengths = [TAU * RING, TAU * TUBE];
    let [around, across] = divide(lengths, 3, target, |[a, b]| 2 * a * b);
    let (at, mut quads) = (
        |i, j| ((j % across) * around + i % around) as u32,
        Quads::default(),
    );
    for j in 0..across {
        let (sin_tube, cos_tube) = (TAU * j as f64 / across as f64).sin_cos();
        let (radius, z) = (RING + TUBE * cos_tube, TUBE * sin_tube);
        for i in 0..around {
            let (sin, cos) = (TAU * i as f64 / around as f64).sin_cos();
            quads.points.push([radius * cos, radius * sin, z]);
            quads
                .quads
                .push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    quads.triangulate()
}
