//! Vertex indices by following an arm of the cross around the vertex in space.
//!
//! This is independent of [`super::index`]: it uses no kappa and unfolds no frames into the plane.
//! An arm is carried from face to face as a vector, turned over each edge into the next face's
//! plane, and compared with the arm that it is matched with there. The angles between them sum to
//! the turning of the field.

use std::f64::consts::TAU;

use super::OrientationField;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, cross, dot, normalize, scale, sub};

impl OrientationField {
    /// The index of every vertex in steps of 1/N of a turn, by tracing. Boundary vertices have none: 0.
    pub fn traced_index_steps(&self, mesh: &TriangleMesh) -> Vec<i32> {
        let steps = |v| match mesh.is_boundary_vertex(v) {
            true => 0,
            false => self.trace(mesh, v).round() as i32,
        };
        (0..mesh.vertex_count()).map(steps).collect()
    }

    /// The index of every vertex in full turns: [`traced_index_steps`](Self::traced_index_steps) over N.
    pub fn traced_indices(&self, mesh: &TriangleMesh) -> Vec<f64> {
        let steps = self.traced_index_steps(mesh).into_iter();
        steps.map(|n| self.turns(n)).collect()
    }

    /// The index of an interior vertex in steps, an integer but for rounding.
    fn trace(&self, mesh: &TriangleMesh, vertex: usize) -> f64 {
        let mut defect = TAU;
        let mut turning = 0.0;
        // Steps between the arm that is followed and the angle that the face stores.
        let mut steps = 0;
        for (face, corner) in mesh.ring(vertex) {
            let corners = mesh.corner_positions(face);
            let apex = corners[corner];
            let to_next = normalize(sub(corners[(corner + 1) % 3], apex));
            let to_last = normalize(sub(corners[(corner + 2) % 3], apex));
            defect -= dot(to_next, to_last).clamp(-1.0, 1.0).acos();

            let k = (corner + 2) % 3;
            let Some((across, _)) = mesh.neighbor(face, k) else {
                continue;
            };
            let arm = self.arm(mesh, face, steps);
            let e = mesh.edge_of(face, k);
            steps -= mesh.out_of(face, k, self.period_jumps[e]);
            let matched = self.arm(mesh, across, steps);
            let (from, to) = (mesh.normal(face), mesh.normal(across));
            // Over the edge: what lies along it stays, what lies across it turns with the plane.
            let carried = add(
                scale(to_last, dot(arm, to_last)),
                scale(cross(to, to_last), dot(arm, cross(from, to_last))),
            );
            turning += dot(cross(carried, matched), to).atan2(dot(carried, matched));
        }
        (defect + turning) / self.step()
    }

    /// An arm of the cross of a face, as a unit vector in space.
    fn arm(&self, mesh: &TriangleMesh, face: usize, steps: i32) -> Vec3 {
        let [x, y] = mesh.frame(face);
        let angle = self.angles[face] + self.step() * f64::from(steps);
        add(scale(x, angle.cos()), scale(y, angle.sin()))
    }
}

#[cfg(test)]
mod tests {
    use crate::field::FieldProblem;
    use crate::mesh::shape;
    use crate::search::Options;
    use crate::solve::solve;

    #[test]
    fn only_rounding_errors_are_rounded_away() {
        for name in ["gear", "plate-with-holes", "genus-2"] {
            let mesh = shape::by_name(name, 1_500).unwrap();
            let problem = FieldProblem::new(&mesh, &[]).unwrap();
            let solution = solve(problem.problem(), &Options::default()).unwrap();
            let field = problem.field(&mesh, &solution).unwrap();
            let steps = field.traced_index_steps(&mesh);
            for v in (0..steps.len()).filter(|&v| !mesh.is_boundary_vertex(v)) {
                let apart = field.trace(&mesh, v) - f64::from(steps[v]);
                assert!(apart.abs() < 1e-7, "{name}: {v} is off by {apart:e}");
            }
        }
    }
}
