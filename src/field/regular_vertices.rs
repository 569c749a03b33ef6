//! Constraints of a second field, in which vertices are regular that the first makes irregular.
//!
//! A regular vertex has index 0, which is a sum of the jumps around it (see [`super::prescribed_indices`]). Where all
//! jumps around it are known, its index is known, too, and it stays as it is.
//!
//! What the field turns from one constrained face to the next around a vertex is a sum of jumps as well. If it is kept
//! on features, as many quads as before lie between feature edges at each of their vertices.

use super::problem::Jump;
use super::{FieldOptions, FieldProblem, OrientationField};
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::monitor::may_continue_at;

impl FieldProblem {
    /// Adds the constraints for the [regular](FieldOptions::regular) vertices of the options, and for those that
    /// [keep](FieldOptions::kept_turns) their turns, which are those of the first field.
    ///
    /// # Errors
    /// The end of the call.
    pub(super) fn keep_regular(
        &mut self,
        mesh: &TriangleMesh,
        options: &FieldOptions,
        first: &OrientationField,
    ) -> Result<()> {
        for (position, &v) in options.regular.iter().enumerate() {
            may_continue_at(position)?;
            let sides: Vec<_> = mesh.ring(v).map(|(face, k)| (face, (k + 2) % 3)).collect();
            let sum = self.ring_sum(mesh, v, 0);
            self.fix_sum(mesh, &sides, sum)?;
        }
        for (position, &v) in options.kept_turns.iter().enumerate() {
            may_continue_at(position)?;
            for sides in self.between_constrained(mesh, v) {
                let jump = |&(face, k): &(usize, usize)| {
                    let e = mesh.edge_of(face, k);
                    f64::from(mesh.out_of(face, k, first.period_jumps[e]))
                };
                let sum = sides.iter().map(jump).sum();
                self.fix_sum(mesh, &sides, sum)?;
            }
        }
        Ok(())
    }

    /// Fixes the sum of the jumps out of faces over these sides, unless all are known.
    fn fix_sum(&mut self, mesh: &TriangleMesh, sides: &[(usize, usize)], sum: f64) -> Result<()> {
        let (mut unknowns, mut signs, mut left) = (Vec::new(), Vec::new(), sum);
        for &(face, k) in sides {
            match self.jump(mesh, face, k) {
                (Jump::Boundary, _) => {}
                (Jump::Known(p), sign) => left -= sign * f64::from(p),
                (Jump::Unknown(p), sign) => {
                    unknowns.push(p as usize);
                    signs.push(sign);
                }
            }
        }
        if !unknowns.is_empty() {
            self.problem.add_constraint(&unknowns, &signs, left)?;
        }
        Ok(())
    }

    /// The sides that a walk around a vertex crosses, counter-clockwise, from each constrained face to the next.
    fn between_constrained(&self, mesh: &TriangleMesh, vertex: usize) -> Vec<Vec<(usize, usize)>> {
        let is_constrained = |face: usize| self.problem.pins()[face].is_some();
        let mut ring: Vec<(usize, usize)> = mesh.ring(vertex).collect();
        let Some(first) = ring.iter().position(|&(face, _)| is_constrained(face)) else {
            return Vec::new();
        };
        ring.rotate_left(first);
        // A walk at the boundary does not go on from its last face to its first one.
        let end = match mesh.is_boundary_vertex(vertex) {
            true => ring.len() - first,
            false => ring.len(),
        };
        let mut walks = Vec::new();
        let mut sides = Vec::new();
        for (i, &(face, k)) in ring.iter().enumerate().take(end) {
            if i > 0 && is_constrained(face) {
                walks.push(std::mem::take(&mut sides));
            }
            sides.push((face, (k + 2) % 3));
        }
        if !mesh.is_boundary_vertex(vertex) {
            walks.push(sides);
        }
        walks
    }
}
