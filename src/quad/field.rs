//! An orientation field, and its energy measured on the mesh.

use std::f64::consts::FRAC_PI_2;

use crate::linalg::CompensatedSum;
use crate::mesh::TriangleMesh;
use crate::{Error, Result};

/// A 4-symmetric direction field: a cross in every face, and how crosses match over edges.
#[derive(Debug, Clone, PartialEq)]
pub struct OrientationField {
    pub(super) angles: Vec<f64>,
    pub(super) period_jumps: Vec<i32>,
    pub(super) kappa: Vec<f64>,
    pub(super) constrained: Vec<bool>,
}

impl OrientationField {
    /// One arm of each face's cross: radians, counter-clockwise about the normal from the first
    /// edge. Not reduced to a quarter turn: the period jumps belong to these very angles.
    pub fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// One number an edge of the mesh, from its first to its second face: `angle + kappa +
    /// pi/2 jump` is the matching arm of the second. Zero at the boundary.
    pub fn period_jumps(&self) -> &[i32] {
        &self.period_jumps
    }

    /// One angle an edge: the frame of its first face seen in that of its second, after unfolding,
    /// in (-pi, pi]. Zero at the boundary.
    pub fn kappa(&self) -> &[f64] {
        &self.kappa
    }

    /// Which faces had their direction given.
    pub fn constrained(&self) -> &[bool] {
        &self.constrained
    }

    /// Whether this can be a field on that mesh.
    pub(super) fn check_mesh(&self, mesh: &TriangleMesh) -> Result<()> {
        let mismatch = |what, expected, actual| Error::LengthMismatch {
            what,
            expected,
            actual,
        };
        let (faces, edges) = (mesh.face_count(), mesh.edge_count());
        match (self.angles.len(), self.period_jumps.len()) {
            (angles, _) if angles != faces => Err(mismatch("angles", faces, angles)),
            (_, jumps) if jumps != edges => Err(mismatch("period jumps", edges, jumps)),
            _ => Ok(()),
        }
    }

    /// Sum over interior edges, not between two constrained faces, of
    /// `(theta_i + kappa_ij + pi/2 p_ij - theta_j)^2`, recomputed from the mesh.
    pub fn energy(&self, mesh: &TriangleMesh) -> f64 {
        let mut sum = CompensatedSum::new(0.0);
        for (e, edge) in mesh.edges().enumerate() {
            let (i, k) = edge.first;
            let Some((j, _)) = edge.second else { continue };
            if self.constrained[i] && self.constrained[j] {
                continue;
            }
            let kappa = mesh.transport(i, k).unwrap_or(0.0);
            let turn = self.angles[i] + kappa + FRAC_PI_2 * f64::from(self.period_jumps[e]);
            let residual = turn - self.angles[j];
            sum.add_product(residual, residual);
        }
        sum.value()
    }
}
