//! Quads that are longer where the surface curves less along them than across.
//!
//! An edge of length h deviates from a surface of normal curvature k along it by |k| h^2 / 8, to first order. So
//! edges whose lengths grow with |k|^(-1/2) deviate equally far along both arms of a cross (`alliez2003`);
//! [`stretch`] is the share of that power that is taken. Both lengths change by inverse factors, so that areas of
//! quads stay.
//!
//! [`stretch`]: super::QuadOptions::stretch

use super::QuadOptions;
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::mesh::curvature::{Curvature, SMOOTHING_ROUNDS, watched_curvature};

/// Normal curvatures of less than this part of the mean count as this part: flat faces have no finite length.
const LEAST_CURVATURE: f64 = 0.1;

/// The most times that a quad is meant to be longer than wide.
const MOST: f64 = 4.0;

/// What decides how long quads are for their width.
pub(super) struct Stretch {
    curvature: Curvature,
    least: f64,
    share: f64,
}

impl Stretch {
    /// The stretch that the options ask for; `None` if quads are to be as long as wide.
    pub(super) fn new(mesh: &TriangleMesh, options: &QuadOptions) -> Result<Option<Self>> {
        if options.stretch == 0.0 {
            return Ok(None);
        }
        let curvature = watched_curvature(mesh, SMOOTHING_ROUNDS)?;
        let weighted =
            (0..mesh.face_count()).map(|face| mesh.area(face) * curvature.k1[face].abs());
        let mean = weighted.sum::<f64>() / mesh.surface_area();
        Ok((mean > 0.0).then_some(Stretch {
            curvature,
            least: LEAST_CURVATURE * mean,
            share: options.stretch,
        }))
    }

    /// By what factor lengths are to be larger along an arm of the cross in every face, given by its angle from the
    /// first edge, and smaller across it.
    pub(super) fn elongations(&self, angles: &[f64]) -> Vec<f64> {
        let of_face = |(face, angle): (usize, &f64)| {
            let (sin, cos) = (angle - self.curvature.direction[face]).sin_cos();
            let (k1, k2) = (self.curvature.k1[face], self.curvature.k2[face]);
            let along = (k2 * cos * cos + k1 * sin * sin).abs().max(self.least);
            let across = (k1 * cos * cos + k2 * sin * sin).abs().max(self.least);
            let ratio = (across / along).powf(0.5 * self.share);
            ratio.clamp(MOST.recip(), MOST).sqrt()
        };
        angles.iter().enumerate().map(of_face).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use super::*;
    use crate::mesh::curvature::curvature;
    use crate::mesh::shape::by_name;

    fn stretched(mesh: &TriangleMesh, stretch: f64) -> Option<Stretch> {
        let options = QuadOptions {
            stretch,
            ..QuadOptions::default()
        };
        Stretch::new(mesh, &options).unwrap()
    }

    /// Of a torus of radii 1 and 0.4: the curvatures on the outer equator are 1 / 0.4 and 1 / 1.4.
    #[test]
    fn lengths_are_inverse_to_the_roots_of_curvatures() {
        let mesh = by_name("torus", 20_000).unwrap();
        assert!(stretched(&mesh, 0.0).is_none());
        let along = curvature(&mesh).direction;
        let [half, full] = [0.5, 1.0].map(|s| stretched(&mesh, s).unwrap().elongations(&along));
        let mut count = 0;
        for face in 0..mesh.face_count() {
            assert!(full[face] >= 1.0 && full[face] <= 2.0);
            assert!((half[face].powi(2) / full[face] - 1.0).abs() < 1e-12);
            let [x, y, _] = mesh.position(mesh.corners(face)[0]);
            if x.hypot(y) > 1.39 {
                let expected = (1.4_f64 / 0.4).powf(0.25);
                assert!((full[face] / expected - 1.0).abs() < 0.02, "{}", full[face]);
                count += 1;
            }
        }
        assert!(count > 100, "{count}");
    }

    #[test]
    fn the_other_arm_has_the_inverse_and_diagonals_have_none() {
        let mesh = by_name("torus", 2_000).unwrap();
        let full = stretched(&mesh, 1.0).unwrap();
        let along = curvature(&mesh).direction;
        let turned = |by: f64| -> Vec<f64> {
            let angles = along.iter().map(|angle| angle + by);
            full.elongations(&angles.collect::<Vec<_>>())
        };
        let [first, second, diagonal] = [0.0, FRAC_PI_2, FRAC_PI_4].map(turned);
        for ((a, b), c) in first.into_iter().zip(second).zip(diagonal) {
            assert!((a * b - 1.0).abs() < 1e-12);
            assert!((c - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn what_is_round_or_flat_stays() {
        let sphere = by_name("sphere", 2_000).unwrap();
        let along = curvature(&sphere).direction;
        let factors = stretched(&sphere, 1.0).unwrap().elongations(&along);
        assert!(factors.iter().all(|factor| (factor - 1.0).abs() < 0.05));
        assert!(stretched(&by_name("plane", 200).unwrap(), 1.0).is_none());
    }
}
