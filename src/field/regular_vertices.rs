//! Constraints of a second field, in which vertices are regular that the first makes irregular.
//!
//! A regular vertex has index 0, which is a sum of the jumps around it (see [`super::prescribed_indices`]). Where all
//! jumps around it are known, its index is known, too, and it stays as it is.
//!
//! What the field turns from one constrained face to the next around a vertex is a sum of jumps as well. If it is kept
//! on features, as many quads as before lie between feature edges at each of their vertices.
//!
//! Constraints make factors dense, and nearly all vertices are regular without any. So only those around irregular
//! vertices are constrained at first, and more of them where irregular vertices have moved to others.

use std::collections::BTreeSet;

use super::problem::Jump;
use super::{FieldOptions, FieldProblem, OrientationField};
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::monitor::may_continue_at;

/// How many times more vertices are constrained before all are.
pub(super) const ROUNDS: usize = 3;

/// The number of rings around irregular vertices that are constrained first, twice as many each time.
const RINGS: usize = 8;

/// The vertices that should be regular and are irregular in a field.
pub(super) fn too_near(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    field: &OrientationField,
) -> Vec<usize> {
    let steps = field.vertex_index_steps(mesh);
    let is_irregular = |v: &usize| steps.get(*v).is_some_and(|&n| n != 0);
    let regular = options.regular.iter().copied();
    regular.filter(is_irregular).collect()
}

/// Adds to the vertices that are constrained those that should be regular around irregular ones: as many rings through
/// such vertices as in this round, or all of them.
pub(super) fn constrain_around(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    irregular: &[usize],
    round: usize,
    constrained: &mut BTreeSet<usize>,
) {
    if round == ROUNDS {
        constrained.extend(&options.regular);
        return;
    }
    let mut may_reach: BTreeSet<usize> = options.regular.iter().copied().collect();
    let mut front = irregular.to_vec();
    for v in &front {
        may_reach.remove(v);
    }
    for _ in 0..RINGS << round {
        constrained.extend(&front);
        let next = front
            .iter()
            .flat_map(|&v| mesh.ring(v))
            .flat_map(|(face, _)| mesh.corners(face));
        front = next.filter(|v| may_reach.remove(v)).collect();
    }
}

impl FieldProblem {
    /// Adds the constraints for these regular vertices, and for those that [keep](FieldOptions::kept_turns) their
    /// turns, which are those of the first field.
    ///
    /// # Errors
    /// The end of the call.
    pub(super) fn keep_regular(
        &mut self,
        mesh: &TriangleMesh,
        options: &FieldOptions,
        (first, regular): (&OrientationField, &BTreeSet<usize>),
    ) -> Result<()> {
        for (position, &v) in regular.iter().enumerate() {
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
