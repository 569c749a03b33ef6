//! Orientation fields as plain problems: stated, and read back from any solution.

use super::error::Outcome;
use super::field::{Found, roundel_field};
use super::guard;
use super::input::{indices, slice, slice_mut};
use super::mesh::roundel_mesh;
use super::output::Out;
use super::problem::roundel_problem;
use super::solution::roundel_solution;
use super::status::roundel_status;
use crate::field::{Constraint, FieldProblem, curvature_constraints};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::{Error, Solution};

/// The caller's constraints.
///
/// # Safety
/// `faces` and `angles` are NULL or have `count` entries.
pub(super) unsafe fn constraints(
    mesh: &TriangleMesh,
    count: usize,
    faces: *const i32,
    angles: *const f64,
) -> Outcome<Vec<Constraint>> {
    // SAFETY: handed on.
    let (faces, angles) = unsafe {
        (
            indices("constrained faces", faces, count, mesh.face_count())?,
            slice("constrained angles", angles, count)?,
        )
    };
    let pairs = faces.into_iter().zip(angles);
    Ok(pairs
        .map(|(face, &angle)| Constraint { face, angle })
        .collect())
}

/// Makes the mixed-integer problem of the smoothest field of a mesh with the directions of
/// `constraint_count` faces given: `angles` of one arm, in radians, counter-clockwise about the
/// normal from the face's first edge. A face may be constrained once.
///
/// Variable f is the angle of face f. Period jumps follow in the order of the edges, without those
/// of the boundary, between two constrained faces, and of a spanning forest, where they are zero:
/// breadth-first from the constrained faces (else the lowest face of a component) in increasing
/// number, neighbours in increasing number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_make_problem(
    mesh: *const roundel_mesh,
    constraint_count: usize,
    faces: *const i32,
    angles: *const f64,
    problem: *mut *mut roundel_problem,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives arrays of the length given and a place, or NULL.
        let (given, out) = unsafe {
            (
                constraints(mesh, constraint_count, faces, angles)?,
                Out::new("problem", problem)?,
            )
        };
        let made = FieldProblem::new(mesh, &given)?;
        out.set(guard::handle(made.problem().clone()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Makes the field that a solution of roundel_field_make_problem's problem stands for; mesh and
/// constraints are those of the problem.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH for the solution of another problem,
/// ROUNDEL_ERROR_OVERFLOW for a period jump beyond 2^31.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_from_solution(
    mesh: *const roundel_mesh,
    constraint_count: usize,
    faces: *const i32,
    angles: *const f64,
    solution: *const roundel_solution,
    field: *mut *mut roundel_field,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives arrays of the length given, a live handle and a place, or NULL.
        let (given, solution, out): (_, &Solution, _) = unsafe {
            (
                constraints(mesh, constraint_count, faces, angles)?,
                guard::value(solution)?,
                Out::new("field", field)?,
            )
        };
        let found = FieldProblem::new(mesh, &given)?.field(mesh, solution)?;
        let none = FeatureGraph::none(mesh);
        out.set(guard::handle(Found::new(
            mesh,
            found,
            none,
            solution.clone(),
        )));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Gives constraints that the surface itself suggests: `fraction` of the faces (rounded to the
/// nearest count), those whose direction of least absolute curvature is most reliable, in
/// increasing order. `faces` and `angles` have room for `capacity` entries, and as many as the mesh
/// has faces are always enough; `count` tells how many were written.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a fraction outside of 0 to 1,
/// ROUNDEL_ERROR_LENGTH_MISMATCH where the room is too small.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_curvature_constraints(
    mesh: *const roundel_mesh,
    fraction: f64,
    capacity: usize,
    faces: *mut i32,
    angles: *mut f64,
    count: *mut usize,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("count", count) }?;
        let found = curvature_constraints(mesh, fraction)?;
        if found.len() > capacity {
            Err(Error::LengthMismatch {
                what: "curvature constraints",
                expected: found.len(),
                actual: capacity,
            })?;
        }
        let last = found.last().map_or(0, |c| c.face);
        if i32::try_from(last).is_err() {
            Err(Error::Overflow {
                what: format!("face {last} does not fit 32 bits"),
                index: Some(last),
            })?;
        }
        // SAFETY: the caller gives arrays of `capacity` numbers, or NULL.
        let (faces, angles) = unsafe {
            (
                slice_mut("faces", faces, found.len())?,
                slice_mut("angles", angles, found.len())?,
            )
        };
        for ((face, angle), c) in faces.iter_mut().zip(angles).zip(&found) {
            (*face, *angle) = (c.face as i32, c.angle);
        }
        out.set(found.len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}
