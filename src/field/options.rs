//! The options of a field: its symmetry and what it follows.

use std::f64::consts::TAU;

use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;

/// A face whose direction is given: one arm of its cross, as an angle in radians in the face's
/// frame (counter-clockwise about the normal from the first edge).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// The face.
    pub face: usize,
    /// The angle of one arm.
    pub angle: f64,
}

/// A direction that a face should have: it costs `weight (theta - angle)^2`, where the energy has
/// weight 1 for every edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guide {
    /// The face.
    pub face: usize,
    /// The angle of one arm, as in [`Constraint`].
    pub angle: f64,
    /// How much it counts; 0 is no guide.
    pub weight: f64,
}

/// The index that an interior vertex shall have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PrescribedIndex {
    /// The vertex.
    pub vertex: usize,
    /// Its index in steps of 1/N of a turn: 1 at the corner of a cube, for N = 4.
    pub steps: i32,
}

/// The options of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldOptions {
    /// N: arms of a direction, evenly around. 4 for crosses, and 1, 2 or 6.
    pub symmetry: u8,
    /// Directions that faces have, each face at most once.
    pub constraints: Vec<Constraint>,
    /// How many of the constraints, from the first, [`solve_field`](super::solve_field) keeps in any
    /// case; it may drop the others around a vertex whose index no map can have.
    pub firm: usize,
    /// Directions that faces should have, each face at most once. A face with a constraint keeps
    /// that.
    pub guides: Vec<Guide>,
    /// The index of every irregular vertex, all others of the interior being regular; none leaves
    /// that to the energy.
    pub indices: Option<Vec<PrescribedIndex>>,
    /// Interior vertices that should be regular. Where the field is not,
    /// [`solve_field`](super::solve_field) and [`smoothest_field`](super::smoothest_field) solve for it again with
    /// these regular; others take the indices. They keep the first field where there is no other. The problem of
    /// the options, [`FieldProblem`](super::FieldProblem), does not have these constraints.
    pub regular: Vec<usize>,
    /// Vertices that take no index from those, as do features where quads shall stay as many on either side:
    /// between constrained faces the field turns around them as the first one does.
    pub kept_turns: Vec<usize>,
    /// Curvature of details smaller than this length does not count: they attract no irregular
    /// vertices. [`solve_field`](super::solve_field) lets it decide the indices alone. Where it is
    /// not 0, the energy of [`FieldProblem`](super::FieldProblem) is not that of its field.
    pub detail: f64,
    /// Lengths at every vertex, in any unit, that the field shall see as equal: it is the smoothest in the
    /// metric in which they are, so that irregular vertices lie where quads of these sizes need them. Empty where
    /// sizes are the same everywhere. Where it is not, the energy of
    /// [`FieldProblem`](super::FieldProblem) is that of this metric.
    pub lengths: Vec<f64>,
}

impl Default for FieldOptions {
    fn default() -> Self {
        FieldOptions {
            symmetry: 4,
            constraints: Vec::new(),
            firm: usize::MAX,
            guides: Vec::new(),
            indices: None,
            regular: Vec::new(),
            kept_turns: Vec::new(),
            detail: 0.0,
            lengths: Vec::new(),
        }
    }
}

impl FieldOptions {
    /// Adds directions to the constraints, except for faces that have one.
    pub fn constrain_others(&mut self, constraints: impl IntoIterator<Item = Constraint>) {
        let taken = self.constraints.iter().map(|c| c.face);
        let taken: std::collections::BTreeSet<usize> = taken.collect();
        let others = constraints.into_iter().filter(|c| !taken.contains(&c.face));
        self.constraints.extend(others);
    }

    /// Adds guides, except for faces that have one.
    pub fn guide_others(&mut self, guides: impl IntoIterator<Item = Guide>) {
        let taken: std::collections::BTreeSet<usize> = self.guides.iter().map(|g| g.face).collect();
        let others = guides.into_iter().filter(|g| !taken.contains(&g.face));
        self.guides.extend(others);
    }

    /// Whether vertices that should be regular or keep their turns are there.
    pub(super) fn check_regular(&self, mesh: &TriangleMesh) -> Result<()> {
        for (position, &v) in self.regular.iter().chain(&self.kept_turns).enumerate() {
            if v >= mesh.vertex_count() {
                return Err(Error::IndexOutOfRange {
                    what: "regular vertices and those that keep their turns",
                    position,
                    value: i64::try_from(v).unwrap_or(i64::MAX),
                    len: mesh.vertex_count(),
                });
            }
            if position < self.regular.len() && mesh.is_boundary_vertex(v) {
                return Err(Error::InvalidArgument {
                    what: format!("vertex {v} cannot be regular: it lies on the boundary"),
                    index: Some(position),
                });
            }
        }
        Ok(())
    }

    /// The angle from arm to arm.
    pub(super) fn step(&self) -> Result<f64> {
        match self.symmetry {
            1 | 2 | 4 | 6 => Ok(TAU / f64::from(self.symmetry)),
            other => Err(Error::InvalidArgument {
                what: format!("the symmetry is {other}; it must be 1, 2, 4 or 6"),
                index: None,
            }),
        }
    }

    /// The given angle of every face.
    pub(super) fn fixed_angles(&self, mesh: &TriangleMesh) -> Result<Vec<Option<f64>>> {
        let given = self.constraints.iter().map(|c| (c.face, c.angle));
        by_face(mesh, ["constrained faces", "constrained angles"], given)
    }

    /// The guide of every face that has one and is not constrained.
    pub(super) fn guided(
        &self,
        mesh: &TriangleMesh,
        fixed: &[Option<f64>],
    ) -> Result<Vec<Option<Guide>>> {
        let given = self.guides.iter().map(|g| (g.face, g.angle));
        by_face(mesh, ["guided faces", "guiding angles"], given)?;
        let mut guided = vec![None; mesh.face_count()];
        for (position, &guide) in self.guides.iter().enumerate() {
            if !guide.weight.is_finite() {
                return Err(Error::NotFinite {
                    what: "guiding weights",
                    position,
                });
            }
            if guide.weight < 0.0 {
                return Err(Error::InvalidArgument {
                    what: format!("guide {position}: the weight {} is negative", guide.weight),
                    index: Some(position),
                });
            }
            if guide.weight > 0.0 && fixed[guide.face].is_none() {
                guided[guide.face] = Some(guide);
            }
        }
        Ok(guided)
    }
}

/// Angles by face, each face at most once.
fn by_face(
    mesh: &TriangleMesh,
    [faces, angles]: [&'static str; 2],
    given: impl Iterator<Item = (usize, f64)>,
) -> Result<Vec<Option<f64>>> {
    let mut of_face = vec![None; mesh.face_count()];
    for (position, (face, angle)) in given.enumerate() {
        if face >= of_face.len() {
            return Err(Error::IndexOutOfRange {
                what: faces,
                position,
                value: i64::try_from(face).unwrap_or(i64::MAX),
                len: of_face.len(),
            });
        }
        if !angle.is_finite() {
            return Err(Error::NotFinite {
                what: angles,
                position,
            });
        }
        if of_face[face].replace(angle).is_some() {
            return Err(Error::InvalidArgument {
                what: format!("{faces}: face {face} is named twice"),
                index: Some(position),
            });
        }
    }
    Ok(of_face)
}
