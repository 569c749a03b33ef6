//! An orientation field, and its energy measured on the mesh.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::Guide;
use crate::error::{Error, Result};
use crate::linalg::CompensatedSum;
use crate::mesh::{Reordered, TriangleMesh};
use crate::monitor::collect_in_parts;

/// The least number of edges that are worth a thread.
const LEAST: usize = 1 << 14;

/// An N-symmetric direction field: N arms evenly around in every face, a cross for N = 4, and how
/// they match over edges.
#[derive(Debug, Clone, PartialEq)]
pub struct OrientationField {
    pub(super) symmetry: u8,
    pub(super) angles: Vec<f64>,
    pub(super) period_jumps: Vec<i32>,
    /// Copies share it.
    pub(super) kappa: Arc<Vec<f64>>,
    pub(super) constrained: Vec<bool>,
}

impl OrientationField {
    /// N, the number of arms in a face: 4 for crosses.
    pub fn symmetry(&self) -> u8 {
        self.symmetry
    }

    /// One arm of each face: radians, counter-clockwise about the normal from the first edge. Not
    /// reduced to the angle between arms: the period jumps belong to these very angles.
    pub fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// One number for each edge of the mesh, from its first to its second face: `angle + kappa +
    /// 2 pi/N jump` is the matching arm of the second. Zero at the boundary.
    pub fn period_jumps(&self) -> &[i32] {
        &self.period_jumps
    }

    /// One angle for each edge: the frame of its first face seen in that of its second, after
    /// unfolding, in (-pi, pi]. Zero at the boundary.
    pub fn kappa(&self) -> &[f64] {
        &self.kappa
    }

    /// Which faces had a given direction.
    pub fn constrained(&self) -> &[bool] {
        &self.constrained
    }

    /// The angle from arm to arm.
    pub(crate) fn step(&self) -> f64 {
        TAU / f64::from(self.symmetry)
    }

    /// The field of a mesh in another order, on `given`, the mesh as it was.
    pub(crate) fn on_given(&self, reordered: &Reordered, given: &TriangleMesh) -> Self {
        let of_edge = |edge: usize| {
            let (place, is_turned) = reordered.place_of_edge(given, edge);
            self.over(place, is_turned)
        };
        self.with_sides(
            reordered.of_given_faces(&self.angles),
            reordered.of_given_faces(&self.constrained),
            of_edge,
        )
    }

    /// The field of `given` on the mesh in another order.
    pub(crate) fn in_order(&self, given: &TriangleMesh, reordered: &Reordered) -> Self {
        let of_edge = |place: usize| {
            let edge = reordered.edge(given, place);
            self.over(edge, reordered.place_of_edge(given, edge).1)
        };
        self.with_sides(
            reordered.of_faces(&self.angles),
            reordered.of_faces(&self.constrained),
            of_edge,
        )
    }

    /// The jump over an edge and the angle between its frames, from its second side if it is turned.
    fn over(&self, edge: usize, is_turned: bool) -> (i32, f64) {
        let (jump, kappa) = (self.period_jumps[edge], self.kappa[edge]);
        match is_turned {
            // The angle from the other side would be -pi.
            true if kappa == PI => (-jump - i32::from(self.symmetry), PI),
            true => (-jump, 0.0 - kappa),
            false => (jump, kappa),
        }
    }

    /// The same crosses of faces and edges with other numbers.
    fn with_sides(
        &self,
        angles: Vec<f64>,
        constrained: Vec<bool>,
        of_edge: impl Fn(usize) -> (i32, f64) + Sync,
    ) -> Self {
        let of_edges = collect_in_parts(self.kappa.len(), LEAST, of_edge);
        let (period_jumps, kappa): (_, Vec<f64>) = of_edges.into_iter().unzip();
        OrientationField {
            symmetry: self.symmetry,
            angles,
            period_jumps,
            kappa: Arc::new(kappa),
            constrained,
        }
    }

    /// Whether this can be a field on that mesh.
    pub(crate) fn check_mesh(&self, mesh: &TriangleMesh) -> Result<()> {
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
    /// `(theta_i + kappa_ij + 2 pi/N p_ij - theta_j)^2`, recomputed from the mesh.
    pub fn energy(&self, mesh: &TriangleMesh) -> f64 {
        let mut sum = CompensatedSum::new(0.0);
        for (e, edge) in mesh.edges().enumerate() {
            let (i, k) = edge.first;
            let Some((j, _)) = edge.second else { continue };
            if self.constrained[i] && self.constrained[j] {
                continue;
            }
            let kappa = mesh.transport(i, k).unwrap_or(0.0);
            let turn = self.angles[i] + kappa + self.step() * f64::from(self.period_jumps[e]);
            let residual = turn - self.angles[j];
            sum.add_product(residual, residual);
        }
        sum.value()
    }

    /// Sum of `weight (theta - angle)^2` over the guides of faces that are not constrained. With
    /// [`energy`](Self::energy) it is what the solver minimises.
    pub fn guide_energy(&self, guides: &[Guide]) -> f64 {
        let mut sum = CompensatedSum::new(0.0);
        for guide in guides.iter().filter(|g| !self.constrained[g.face]) {
            let error = self.angles[guide.face] - guide.angle;
            sum.add_product(guide.weight * error, error);
        }
        sum.value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_that_are_opposite_match_the_same_arms_from_both_sides() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let given = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2], [2, 3, 0]]).unwrap();
        let reordered = Reordered::new(&given).unwrap();
        let mesh = &reordered.mesh;
        let kappa = mesh.transports();
        let inner = kappa.iter().position(|&kappa| kappa == PI).unwrap();
        assert!(
            reordered
                .place_of_edge(&given, reordered.edge(&given, inner))
                .1
        );
        let mut period_jumps = vec![0; mesh.edge_count()];
        period_jumps[inner] = 1;
        let there = OrientationField {
            symmetry: 4,
            angles: vec![0.2, 0.7],
            period_jumps,
            kappa: Arc::new(kappa),
            constrained: vec![false; 2],
        };
        let here = there.on_given(&reordered, &given);
        assert_eq!(here.angles, [0.7, 0.2]);
        assert_eq!(*here.kappa, given.transports());
        let error = here.energy(&given) - there.energy(mesh);
        assert!(error.abs() < 1e-12, "{error}");
    }
}
