//! A field from one direction for each face, the form in which other programs store it.
//!
//! A direction is one arm of the face's cross; it does not tell which arms match over an edge.
//! Nearest matching decides that: the period jump is the one that leaves the least angle between
//! the matched arms, at most an eighth of a turn for crosses (`ray2008`, section 3).

use std::sync::Arc;

use super::OrientationField;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, dot, scale};

impl OrientationField {
    /// The field of crosses with this direction in every face, matched by the nearest arms over
    /// every edge.
    ///
    /// Directions are vectors in space of any length; their component normal to the face is dropped.
    /// No face counts as constrained.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is one direction for each face; with the face,
    /// [`Error::NotFinite`], and [`Error::InvalidArgument`] for a direction perpendicular to it.
    pub fn from_directions(mesh: &TriangleMesh, directions: &[Vec3]) -> Result<Self> {
        Self::matched(mesh, directions, 4)
    }

    /// As [`from_directions`](Self::from_directions) with this many arms in every face.
    pub(super) fn matched(mesh: &TriangleMesh, directions: &[Vec3], symmetry: u8) -> Result<Self> {
        if directions.len() != mesh.face_count() {
            return Err(Error::LengthMismatch {
                what: "directions of faces",
                expected: mesh.face_count(),
                actual: directions.len(),
            });
        }
        let mut angles = Vec::with_capacity(directions.len());
        for (face, &direction) in directions.iter().enumerate() {
            angles.push(angle(mesh, face, direction)?);
        }
        let kappa = |(f, k)| mesh.transport(f, k).unwrap_or(0.0);
        let kappa: Vec<f64> = mesh.edges().map(|edge| kappa(edge.first)).collect();
        let mut field = OrientationField {
            symmetry,
            period_jumps: vec![0; kappa.len()],
            constrained: vec![false; angles.len()],
            angles,
            kappa: Arc::new(kappa),
        };
        for e in 0..mesh.edge_count() {
            field.period_jumps[e] = field.nearest_jump(mesh, e);
        }
        Ok(field)
    }

    /// As [`from_directions`](Self::from_directions), where these quarter turns lead from the arm of the first face of
    /// every interior edge to that of the second. Of the period jumps that do so, the nearest is taken.
    pub(crate) fn with_quarters(
        mesh: &TriangleMesh,
        directions: &[Vec3],
        quarters: impl Fn(usize) -> i32,
    ) -> Result<Self> {
        let mut field = Self::from_directions(mesh, directions)?;
        for e in 0..mesh.edge_count() {
            if mesh.edge(e).second.is_some() {
                let off = (quarters(e) - field.period_jumps[e] + 2).rem_euclid(4) - 2;
                field.period_jumps[e] += off;
            }
        }
        Ok(field)
    }

    /// The arm of a face at its angle: a unit vector in space, in the plane of the face.
    pub fn direction(&self, mesh: &TriangleMesh, face: usize) -> Vec3 {
        let [x, y] = mesh.frame(face);
        let angle = self.angles[face];
        add(scale(x, angle.cos()), scale(y, angle.sin()))
    }

    /// The period jump of an edge that leaves the least angle between the arms of its faces.
    pub(super) fn nearest_jump(&self, mesh: &TriangleMesh, edge: usize) -> i32 {
        let sides = mesh.edge(edge);
        let Some((j, _)) = sides.second else { return 0 };
        let turn = self.angles[j] - self.angles[sides.first.0] - self.kappa[edge];
        (turn / self.step()).round() as i32
    }
}

/// The angle of a direction in the frame of a face, in (-pi, pi].
pub(super) fn angle(mesh: &TriangleMesh, face: usize, direction: Vec3) -> Result<f64> {
    /// Part of a direction that must lie in its face.
    const IN_FACE: f64 = 1e-6;
    let largest = direction.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if direction.iter().any(|x| !x.is_finite()) {
        return Err(Error::NotFinite {
            what: "directions of faces",
            position: face,
        });
    }
    // Scaled first: squares of tiny and of huge numbers have no digits.
    let unit = match largest > 0.0 {
        true => direction.map(|x| x / largest),
        false => direction,
    };
    let [x, y] = mesh.frame(face).map(|axis| dot(unit, axis));
    if x.hypot(y) < IN_FACE {
        return Err(Error::InvalidArgument {
            what: format!("the direction of face {face} is perpendicular to the face"),
            index: Some(face),
        });
    }
    Ok(y.atan2(x))
}
