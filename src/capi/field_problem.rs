//! Making fields: by a solve, or from the solution of a plain problem.

use super::event::{roundel_monitor, watchers};
use super::field::{Found, roundel_field};
use super::guard;
use super::guidance::roundel_guidance;
use super::mesh::roundel_mesh;
use super::options::roundel_options;
use super::output::Out;
use super::problem::roundel_problem;
use super::solution::roundel_solution;
use super::status::roundel_status;
use crate::error::Result;
use crate::field::{FieldProblem, Guidance, smoothest_field};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::search::Options;
use crate::solve::Solution;

/// The problem of the field that follows a guidance, and the features.
fn stated(mesh: &TriangleMesh, guidance: &Guidance) -> Result<(FieldProblem, FeatureGraph)> {
    let features = guidance.features(mesh)?;
    let options = guidance.field_options(mesh, &features)?;
    Ok((FieldProblem::with_options(mesh, &options)?, features))
}

/// Finds the smoothest field of a mesh that follows a guidance. `guidance`, `options` and `monitor`
/// may be NULL.
///
/// Fails with ROUNDEL_ERROR_INDEX_OUT_OF_RANGE for an element that the mesh does not have,
/// ROUNDEL_ERROR_NOT_FINITE, and ROUNDEL_ERROR_INVALID_ARGUMENT for an element that is named twice, two
/// vertices that no edge joins, a negative weight or an index at the boundary. The error's index is then
/// the position in the list. Also fails with ROUNDEL_ERROR_INVALID_ARGUMENT for indices that do not sum
/// to the Euler characteristic. Other failures are those of roundel_problem_solve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_solve(
    mesh: *const roundel_mesh,
    guidance: *const roundel_guidance,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    field: *mut *mut roundel_field,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let (crosses, default) = (Guidance::default(), Options::default());
        // SAFETY: the caller gives live handles or NULL, a monitor as its members say or NULL, and
        // a place for the field or NULL.
        let (guidance, options, monitor, out) = unsafe {
            (
                guard::value_or(guidance, &crosses)?,
                guard::value_or(options, &default)?,
                watchers(monitor)?,
                Out::new("field", field)?,
            )
        };
        let features = guidance.features(mesh)?;
        let follows = guidance.field_options(mesh, &features)?;
        let (found, solution) = smoothest_field(mesh, &follows, options, monitor)?;
        out.set(guard::handle(Found::new(mesh, found, features, solution)));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Makes the mixed-integer problem of the field that roundel_field_solve finds. `guidance` may be
/// NULL.
///
/// Variable f is the angle of face f. The period jumps follow in the order of the edges. Edges of the
/// boundary, edges between two constrained faces and edges of a spanning forest have no variable: their
/// period jump is zero. The forest grows breadth-first from the constrained faces (in a component without
/// any, from its lowest face) in increasing number, and to neighbours in increasing number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_make_problem(
    mesh: *const roundel_mesh,
    guidance: *const roundel_guidance,
    problem: *mut *mut roundel_problem,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let crosses = Guidance::default();
        // SAFETY: the caller gives a live handle and a place, or NULL.
        let (guidance, out) = unsafe {
            (
                guard::value_or(guidance, &crosses)?,
                Out::new("problem", problem)?,
            )
        };
        let (made, _) = stated(mesh, guidance)?;
        out.set(guard::handle(made.problem().clone()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Makes the field of a solution of roundel_field_make_problem's problem. `mesh` and `guidance` are
/// those of the problem.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH for the solution of another problem,
/// ROUNDEL_ERROR_OVERFLOW for a period jump beyond 2^31.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_field_from_solution(
    mesh: *const roundel_mesh,
    guidance: *const roundel_guidance,
    solution: *const roundel_solution,
    field: *mut *mut roundel_field,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let crosses = Guidance::default();
        // SAFETY: the caller gives live handles and a place, or NULL.
        let (guidance, solution, out): (_, &Solution, _) = unsafe {
            (
                guard::value_or(guidance, &crosses)?,
                guard::value(solution)?,
                Out::new("field", field)?,
            )
        };
        let (problem, features) = stated(mesh, guidance)?;
        let found = problem.field(mesh, solution)?;
        let solution = solution.clone();
        out.set(guard::handle(Found::new(mesh, found, features, solution)));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}
