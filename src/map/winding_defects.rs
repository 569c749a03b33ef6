//! Winding defects: vertices around which the winding of a map differs from that of its field.
//!
//! With every triangle positively oriented, the angles of a map around a vertex sum to as many
//! quarter turns as the field has there exactly if the map covers the neighbourhood once. No single
//! triangle shows that: a ring may go around its vertex twice without a fold.

use std::f64::consts::FRAC_PI_2;

use super::{SeamlessMap, SeamlessProblem};
use crate::error::Result;
use crate::mesh::{TriangleMesh, angle_at, orientation};
use crate::monitor::{collect_if_wanted, may_continue};

/// The least number of vertices that are worth a thread.
const LEAST: usize = 1 << 12;

impl SeamlessProblem {
    /// The interior vertices at which the winding of a map of this problem differs from that of the
    /// field, in increasing order. Vertices of flipped faces are left out.
    ///
    /// A map without flipped faces and winding defects is locally injective in the interior.
    ///
    /// # Errors
    /// [`LengthMismatch`](crate::Error::LengthMismatch) for the map of another problem or mesh.
    pub fn winding_defects(&self, mesh: &TriangleMesh, map: &SeamlessMap) -> Result<Vec<usize>> {
        self.check_map(mesh, map)?;
        let _memory = mesh.watch_memory();
        may_continue()?;
        let quarters = self.quarters(mesh)?;
        may_continue()?;
        winding_defects(mesh, &quarters, |face| map.uv(face))
    }
}

/// The vertices with given quarter turns at which a map makes another number of them.
///
/// # Errors
/// The reason to end the current step.
pub(crate) fn winding_defects(
    mesh: &TriangleMesh,
    quarters: &[Option<i32>],
    uv: impl Fn(usize) -> [[f64; 2]; 3] + Sync,
) -> Result<Vec<usize>> {
    let is_defect = collect_if_wanted(mesh.vertex_count(), LEAST, |v| {
        has_winding_defect(mesh, quarters, &uv, v)
    })?;
    Ok((0..is_defect.len()).filter(|&v| is_defect[v]).collect())
}

/// Whether a map makes another number of quarter turns around a vertex than is given for it.
pub(crate) fn has_winding_defect(
    mesh: &TriangleMesh,
    quarters: &[Option<i32>],
    uv: impl Fn(usize) -> [[f64; 2]; 3],
    v: usize,
) -> bool {
    let turns = || turns_around(mesh, uv, v);
    quarters[v].is_some() && turns().is_some_and(|turns| Some(turns) != quarters[v])
}

/// The quarter turns to which the map's angles around a vertex sum; none if a triangle there is
/// folded.
fn turns_around(mesh: &TriangleMesh, uv: impl Fn(usize) -> [[f64; 2]; 3], v: usize) -> Option<i32> {
    let mut sum = 0.0;
    for (face, corner) in mesh.ring(v) {
        let uv = uv(face);
        if orientation(uv) <= 0.0 {
            return None;
        }
        sum += angle_at(uv, corner);
    }
    Some((sum / FRAC_PI_2).round() as i32)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::field::{FieldOptions, solve_field};
    use crate::map::SeamlessOptions;
    use crate::monitor::Monitor;
    use crate::search::Options;
    use crate::solve::solve;

    /// A flat disk of eight triangles around vertex 0.
    fn fan() -> TriangleMesh {
        let rim = (0..8).map(|k| (TAU * f64::from(k) / 8.0).sin_cos());
        let points = std::iter::once([0.0; 3]).chain(rim.map(|(sin, cos)| [cos, sin, 0.0]));
        let triangles = (0..8).map(|k| [0, 1 + k, 1 + (k + 1) % 8]);
        TriangleMesh::new(points.collect(), triangles.collect()).unwrap()
    }

    #[test]
    fn a_ring_that_goes_around_twice_is_found_without_a_fold() {
        let (mesh, options) = (fan(), Options::default());
        let field = FieldOptions::default();
        let (field, _) = solve_field(&mesh, &field, &options, Monitor::default).unwrap();
        let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads: 4 }).unwrap();
        let solution = solve(problem.problem(), &options).unwrap();
        let good = problem.map(&mesh, &solution).unwrap();
        assert!(good.flipped().is_empty());
        assert!(problem.winding_defects(&mesh, &good).unwrap().is_empty());

        let mut values = good.values().to_vec();
        for face in 0..8 {
            for (corner, turn) in [(1, face), (2, face + 1)] {
                // A quarter turn a triangle.
                let u = 2 * good.copies()[face][corner] as usize;
                let (sin, cos) = (TAU * turn as f64 / 4.0).sin_cos();
                let centre = 2 * good.copies()[face][0] as usize;
                (values[u], values[u + 1]) = (values[centre] + cos, values[centre + 1] + sin);
            }
        }
        let twice = SeamlessMap::new(&problem, &mesh, &values).unwrap();
        assert!(twice.flipped().is_empty());
        assert_eq!(problem.winding_defects(&mesh, &twice).unwrap(), [0]);
    }
}
