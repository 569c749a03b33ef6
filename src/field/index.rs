//! Indices of vertices and boundary loops from the period jumps.
//!
//! The index counts the turns of the cross around a vertex, the angle defect of the vertex included
//! (`bommes2009`, section 4.2; `ray2008`):
//!
//! ```text
//! I(v) = (2 pi - sum of angles - sum over the ring, counter-clockwise, of (kappa + 2 pi/N p)) / 2 pi
//! ```
//!
//! a multiple of 1/N; a cube corner has +1/4 in a field of crosses. The index of a boundary loop sums
//! the turns of its vertices (pi - sum of angles) and the same sums over their open fans, so that by
//! Gauss-Bonnet all indices sum to the Euler characteristic.

use std::f64::consts::{PI, TAU};

use super::OrientationField;
use crate::mesh::TriangleMesh;

/// An index times N at least this far from zero is irregular: half of the smallest that there is.
const IRREGULAR: f64 = 0.5;

impl OrientationField {
    /// The index of every vertex, in full turns. Boundary vertices have none: 0.
    pub fn vertex_indices(&self, mesh: &TriangleMesh) -> Vec<f64> {
        let interior = |v: usize| !mesh.is_boundary_vertex(v);
        (0..mesh.vertex_count())
            .map(|v| match interior(v) {
                true => (TAU - angle_sum(mesh, v) - self.turning(mesh, v)) / TAU,
                false => 0.0,
            })
            .collect()
    }

    /// The quarter turns of the field around a vertex. At the boundary they are counted from one
    /// boundary edge to the other, and are a whole number only if the field follows both.
    pub(crate) fn quarters(&self, mesh: &TriangleMesh, v: usize) -> i32 {
        let mut around = angle_sum(mesh, v) + self.turning(mesh, v);
        let mut faces = mesh.ring(v).map(|(face, _)| face);
        if let (true, Some(first)) = (mesh.is_boundary_vertex(v), faces.next()) {
            let last = faces.last().unwrap_or(first);
            around -= self.angles[last] - self.angles[first];
        }
        (4.0 * around / TAU).round() as i32
    }

    /// The index of every boundary loop, in the order of
    /// [`boundary_loops`](TriangleMesh::boundary_loops).
    pub fn boundary_indices(&self, mesh: &TriangleMesh) -> Vec<f64> {
        let of_vertex = |v: usize| PI - angle_sum(mesh, v) - self.turning(mesh, v);
        mesh.boundary_loops()
            .iter()
            .map(|sides| {
                let starts = sides.iter().map(|&(face, k)| mesh.corners(face)[k]);
                starts.map(of_vertex).sum::<f64>() / TAU
            })
            .collect()
    }

    /// The sum of all indices: the Euler characteristic of the mesh.
    pub fn index_sum(&self, mesh: &TriangleMesh) -> f64 {
        let vertices: f64 = self.vertex_indices(mesh).iter().sum();
        vertices + self.boundary_indices(mesh).iter().sum::<f64>()
    }

    /// The irregular vertices: those whose index is not zero.
    pub fn irregular_vertices(&self, mesh: &TriangleMesh) -> Vec<usize> {
        let indices = self.vertex_indices(mesh);
        let irregular = |v: &usize| f64::from(self.symmetry) * indices[*v].abs() >= IRREGULAR;
        (0..indices.len()).filter(irregular).collect()
    }

    /// Sum of `kappa + 2 pi/N p` over the steps from face to face around a vertex.
    fn turning(&self, mesh: &TriangleMesh, vertex: usize) -> f64 {
        let mut sum = 0.0;
        for (face, corner) in mesh.ring(vertex) {
            let k = (corner + 2) % 3;
            if mesh.neighbor(face, k).is_none() {
                continue;
            }
            let e = mesh.edge_of(face, k);
            let step = self.kappa[e] + self.step() * f64::from(self.period_jumps[e]);
            sum += mesh.out_of(face, k, step);
        }
        sum
    }
}

fn angle_sum(mesh: &TriangleMesh, vertex: usize) -> f64 {
    mesh.ring(vertex).map(|(f, k)| mesh.angle(f, k)).sum()
}
