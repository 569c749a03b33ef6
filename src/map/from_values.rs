//! The map that the values of a problem's unknowns describe: its transitions, its flipped faces and
//! its energy, measured on the mesh.

use super::{SeamlessMap, SeamlessProblem, Transition};
use crate::error::{Error, Result};
use crate::linalg::CompensatedSum;
use crate::mesh::vector::{Vec3, add, cross, dot, scale, sub};
use crate::mesh::{TriangleMesh, orientation};
use crate::monitor::{filter_in_parts, in_blocks, may_continue, span};
use crate::solve::Solution;

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 14;

impl SeamlessProblem {
    /// The map that belongs to a solution of the problem.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for another mesh or the solution of another problem.
    pub fn map(&self, mesh: &TriangleMesh, solution: &Solution) -> Result<SeamlessMap> {
        self.field.check_mesh(mesh)?;
        SeamlessMap::new(self, mesh, solution.values())
    }

    /// Checks that this is a map of that mesh and this problem.
    pub(crate) fn check_map(&self, mesh: &TriangleMesh, map: &SeamlessMap) -> Result<()> {
        self.field.check_mesh(mesh)?;
        let (expected, actual) = (self.problem.variables(), map.values().len());
        match expected == actual && map.copies() == self.sectors.copy {
            true => Ok(()),
            false => Err(Error::LengthMismatch {
                what: "the map of the parametrization",
                expected,
                actual,
            }),
        }
    }
}

impl SeamlessMap {
    pub(crate) fn new(
        problem: &SeamlessProblem,
        mesh: &TriangleMesh,
        values: &[f64],
    ) -> Result<Self> {
        let _span = span("map");
        let _memory = mesh.watch_memory();
        may_continue()?;
        let expected = problem.translation(problem.seams.len());
        if values.len() != expected {
            return Err(Error::LengthMismatch {
                what: "the solution of the parametrization",
                expected,
                actual: values.len(),
            });
        }
        let mut map = SeamlessMap {
            values: values.to_vec(),
            coordinates: 2 * problem.sectors.count(),
            copies: problem.sectors.copy.clone(),
            transitions: transitions(problem, mesh, values),
            cones: problem.cones.clone(),
            flipped: Vec::new(),
            energy: 0.0,
        };
        may_continue()?;
        map.flipped = filter_in_parts(mesh.face_count(), LEAST, |face| {
            orientation(map.uv(face)) <= 0.0
        });
        may_continue()?;
        map.energy = energy(problem, mesh, &map);
        Ok(map)
    }
}

fn transitions(problem: &SeamlessProblem, mesh: &TriangleMesh, values: &[f64]) -> Vec<Transition> {
    let mut transitions = Vec::new();
    for (seam, sides) in problem.seams.iter().enumerate() {
        let s = problem.translation(seam);
        let translation = [values[s], values[s + 1]];
        let quarters = problem.seam_turns(mesh, seam);
        for &(face, k) in sides {
            let edge = mesh.edge_of(face, k);
            let forth = Transition {
                edge,
                quarters,
                translation,
            };
            transitions.push(match mesh.is_first_side(face, k) {
                true => forth,
                false => forth.inverse(),
            });
        }
    }
    transitions.sort_unstable_by_key(|t| t.edge);
    transitions
}

/// The energy by gradients in space, and so by other formulas than those of the problem.
fn energy(problem: &SeamlessProblem, mesh: &TriangleMesh, map: &SeamlessMap) -> f64 {
    let mut sum = CompensatedSum::new(0.0);
    let blocks = in_blocks(mesh.face_count(), |faces| {
        let mut sum = CompensatedSum::new(0.0);
        for face in faces {
            let (uv, area) = (map.uv(face), mesh.area(face));
            let targets = problem.targets(mesh, face);
            for (axis, target) in targets.into_iter().enumerate() {
                let gradient = gradient(mesh, face, uv.map(|corner| corner[axis]));
                let error = sub(gradient, target);
                sum.add_product(area, dot(error, error));
            }
        }
        sum
    });
    blocks.iter().for_each(|block| sum.add_sum(block));
    sum.value()
}

/// The gradient of the linear function with these values at the corners.
#[inline]
pub(crate) fn gradient(mesh: &TriangleMesh, face: usize, values: [f64; 3]) -> Vec3 {
    let corners = mesh.corner_positions(face);
    let normal = mesh.normal(face);
    let opposite = |k: usize| sub(corners[(k + 2) % 3], corners[(k + 1) % 3]);
    let rise = (1..3).fold([0.0; 3], |sum, k| {
        add(sum, scale(opposite(k), values[k] - values[0]))
    });
    scale(cross(normal, rise), 0.5 / mesh.area(face))
}
