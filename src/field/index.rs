//! Indices of vertices and boundary loops from the period jumps, as integers.
//!
//! The index counts the turns of the cross around a vertex, the angle defect of the vertex included
//! (`bommes2009`, section 4.2; `ray2008`). In steps of 1/N of a turn it is an integer:
//!
//! ```text
//! N I(v) = (2 pi - sum of angles - sum over the ring, counter-clockwise, of kappa) N / 2 pi
//!        - sum over the ring, counter-clockwise, of p
//! ```
//!
//! The first line belongs to the surface alone: a whole number of steps, computed in floating point and
//! rounded once. The jumps are integers. A cube corner has one step in a field of crosses, index +1/4.
//! Nothing is different at a vertex on a feature inside the surface.
//!
//! A vertex of the boundary has no index, and 0 in the lists: its fan is open, and what the field turns
//! along it need not be whole. The boundary loop has an index. It sums the turns of the boundary at its
//! vertices (pi - sum of angles) and the same sums over their open fans, again an integer of steps, so
//! that by Gauss-Bonnet all indices sum to the Euler characteristic.

use std::f64::consts::{PI, TAU};
use std::iter::Sum;
use std::ops::Neg;

use super::OrientationField;
use crate::linalg::CompensatedSum;
use crate::mesh::TriangleMesh;
use crate::monitor::collect_in_parts;

/// The least number of vertices that are worth a thread.
const LEAST: usize = 1 << 12;

impl OrientationField {
    /// The index of every vertex in steps of 1/N of a turn, quarters for crosses: 1 at the corner of a
    /// cube. Vertices of the boundary have none: 0.
    pub fn vertex_index_steps(&self, mesh: &TriangleMesh) -> Vec<i32> {
        let steps = |v: usize| match mesh.is_boundary_vertex(v) {
            true => 0,
            false => {
                let free = steps_without_jumps(mesh, &self.kappa, self.step(), v);
                narrowed(free - self.jumps_around(mesh, v))
            }
        };
        // All threads need the angles, so they are not left to one of them.
        mesh.angles();
        collect_in_parts(mesh.vertex_count(), LEAST, steps)
    }

    /// The index of every vertex in full turns: [`vertex_index_steps`](Self::vertex_index_steps) over N.
    pub fn vertex_indices(&self, mesh: &TriangleMesh) -> Vec<f64> {
        let steps = self.vertex_index_steps(mesh).into_iter();
        steps.map(|n| self.turns(n)).collect()
    }

    /// The index of every boundary loop in steps of 1/N of a turn, in the order of
    /// [`boundary_loops`](TriangleMesh::boundary_loops).
    pub fn boundary_index_steps(&self, mesh: &TriangleMesh) -> Vec<i32> {
        let loops = mesh.boundary_loops();
        let steps = |sides: &Vec<(usize, usize)>| {
            let (mut turn, mut jumps) = (CompensatedSum::new(0.0), 0);
            for &(face, k) in sides {
                let v = mesh.corners(face)[k];
                turn.add(PI - angle_sum(mesh, v) - sum_around(mesh, v, |e| self.kappa[e]));
                jumps += self.jumps_around(mesh, v);
            }
            narrowed((turn.value() / self.step()).round() as i64 - jumps)
        };
        loops.iter().map(steps).collect()
    }

    /// The index of every boundary loop in full turns:
    /// [`boundary_index_steps`](Self::boundary_index_steps) over N.
    pub fn boundary_indices(&self, mesh: &TriangleMesh) -> Vec<f64> {
        let steps = self.boundary_index_steps(mesh).into_iter();
        steps.map(|n| self.turns(n)).collect()
    }

    /// The sum of all indices in full turns: the Euler characteristic of the mesh.
    pub fn index_sum(&self, mesh: &TriangleMesh) -> f64 {
        let vertices = self.vertex_index_steps(mesh);
        let all = vertices.into_iter().chain(self.boundary_index_steps(mesh));
        let steps: i64 = all.map(i64::from).sum();
        steps as f64 / f64::from(self.symmetry)
    }

    /// The irregular vertices: those whose index is not zero.
    pub fn irregular_vertices(&self, mesh: &TriangleMesh) -> Vec<usize> {
        let steps = self.vertex_index_steps(mesh);
        (0..steps.len()).filter(|&v| steps[v] != 0).collect()
    }

    /// Steps of 1/N of a turn as full turns, rounded once: exact but for N = 6.
    pub(crate) fn turns(&self, steps: i32) -> f64 {
        f64::from(steps) / f64::from(self.symmetry)
    }

    /// The quarter turns of the field around a vertex of the boundary, from one boundary edge to the
    /// other: a whole number only if the field follows both.
    pub(crate) fn boundary_quarters(&self, mesh: &TriangleMesh, v: usize) -> i32 {
        let turn = |e| self.kappa[e] + self.step() * f64::from(self.period_jumps[e]);
        let mut around = angle_sum(mesh, v) + sum_around(mesh, v, turn);
        let mut faces = mesh.ring(v).map(|(face, _)| face);
        if let Some(first) = faces.next() {
            let last = faces.last().unwrap_or(first);
            around -= self.angles[last] - self.angles[first];
        }
        (4.0 * around / TAU).round() as i32
    }

    fn jumps_around(&self, mesh: &TriangleMesh, vertex: usize) -> i64 {
        sum_around(mesh, vertex, |e| i64::from(self.period_jumps[e]))
    }
}

/// The index of an interior vertex, in steps, of a field whose jumps around it are all zero.
pub(super) fn steps_without_jumps(
    mesh: &TriangleMesh,
    kappa: &[f64],
    step: f64,
    vertex: usize,
) -> i64 {
    let defect = TAU - angle_sum(mesh, vertex);
    ((defect - sum_around(mesh, vertex, |e| kappa[e])) / step).round() as i64
}

fn angle_sum(mesh: &TriangleMesh, vertex: usize) -> f64 {
    mesh.ring(vertex).map(|(f, k)| mesh.angle(f, k)).sum()
}

/// The sum of a value over the edges that a walk around a vertex crosses, counter-clockwise.
fn sum_around<T>(mesh: &TriangleMesh, vertex: usize, of_edge: impl Fn(usize) -> T) -> T
where
    T: Sum + Neg<Output = T>,
{
    let sides = mesh
        .ring(vertex)
        .map(|(face, corner)| (face, (corner + 2) % 3));
    let crossed = sides.filter(|&(face, k)| mesh.neighbor(face, k).is_some());
    crossed
        .map(|(face, k)| mesh.out_of(face, k, of_edge(mesh.edge_of(face, k))))
        .sum()
}

/// Jumps beyond 32 bits are refused, and around a vertex they cancel; only a field that a caller made
/// up can have an index that is cut off here.
fn narrowed(steps: i64) -> i32 {
    steps.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{FieldOptions, FieldProblem};
    use crate::mesh::shape;
    use crate::search::Options;
    use crate::solve::solve;

    /// The index in steps straight from its definition, in floating point.
    fn defined(field: &OrientationField, mesh: &TriangleMesh, full: f64, v: usize) -> f64 {
        let turn = |e| field.kappa[e] + field.step() * f64::from(field.period_jumps[e]);
        let turns = full - angle_sum(mesh, v) - sum_around(mesh, v, turn);
        f64::from(field.symmetry) * turns / TAU
    }

    #[test]
    fn only_rounding_errors_are_rounded_away() {
        for (name, symmetry) in [("gear", 4), ("plate-with-holes", 6), ("genus-2", 2)] {
            let mesh = shape::by_name(name, 1_500).unwrap();
            let options = FieldOptions {
                symmetry,
                ..FieldOptions::default()
            };
            let problem = FieldProblem::with_options(&mesh, &options).unwrap();
            let solution = solve(problem.problem(), &Options::default()).unwrap();
            let field = problem.field(&mesh, &solution).unwrap();
            let steps = field.vertex_index_steps(&mesh);
            for v in (0..steps.len()).filter(|&v| !mesh.is_boundary_vertex(v)) {
                let apart = defined(&field, &mesh, TAU, v) - f64::from(steps[v]);
                assert!(apart.abs() < 1e-12, "{name}: {v} is off by {apart:e}");
            }
            let loops = mesh.boundary_loops().into_iter();
            for (sides, steps) in loops.zip(field.boundary_index_steps(&mesh)) {
                let starts = sides.iter().map(|&(face, k)| mesh.corners(face)[k]);
                let sum: f64 = starts.map(|v| defined(&field, &mesh, PI, v)).sum();
                let apart = sum - f64::from(steps);
                assert!(apart.abs() < 1e-11, "{name}: a loop is off by {apart:e}");
            }
        }
    }

    #[test]
    fn large_jumps_that_cancel_leave_the_index_as_it_is() {
        let mesh = shape::by_name("sphere", 200).unwrap();
        let problem = FieldProblem::new(&mesh, &[]).unwrap();
        let solution = solve(problem.problem(), &Options::default()).unwrap();
        let mut field = problem.field(&mesh, &solution).unwrap();
        let before = field.vertex_index_steps(&mesh);
        // Face 3 turned by 2^30 quarters, its jumps with it: two at every vertex of the face.
        for k in 0..3 {
            let e = mesh.edge_of(3, k);
            let left = if mesh.edge(e).first == (3, k) { 1 } else { -1 };
            field.period_jumps[e] -= left * (1 << 30);
        }
        assert_eq!(field.vertex_index_steps(&mesh), before);
        assert_eq!(field.index_sum(&mesh), 2.0);
    }
}
