//! Feature edges that the surface shows by itself: sharp ones, and its boundary.

use std::f64::consts::PI;

use super::FeatureGraph;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cross, dot, norm};
use crate::{Error, Result};

impl FeatureGraph {
    /// The edges at which the normals of the two faces differ by `angle` radians or more; the
    /// boundary is not among them.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an angle that is not above 0 and at most pi.
    pub fn by_angle(mesh: &TriangleMesh, angle: f64) -> Result<Self> {
        if !(angle > 0.0 && angle <= PI) {
            return Err(Error::InvalidArgument {
                what: format!("the angle of features is {angle}, not above 0 and at most pi"),
                index: None,
            });
        }
        let is_sharp = mesh.edges().map(|edge| {
            let Some((j, _)) = edge.second else {
                return false;
            };
            let [m, n] = [edge.first.0, j].map(|face| mesh.normal(face));
            norm(cross(m, n)).atan2(dot(m, n)) >= angle
        });
        let is_sharp = is_sharp.collect();
        Ok(Self::of(mesh, is_sharp))
    }

    /// The edges with a single face.
    pub fn boundary(mesh: &TriangleMesh) -> Self {
        Self::of(mesh, mesh.edges().map(|e| e.second.is_none()).collect())
    }
}
