//! The map handle: a seamless map of a mesh, solved for at one size after another.

use super::event::{monitor as watched_by, roundel_monitor};
use super::failure::Outcome;
use super::field::{Found as FoundField, roundel_field};
use super::guard::{self, Guarded, object};
use super::guidance::roundel_guidance;
use super::input::slice;
use super::mesh::roundel_mesh;
use super::options::roundel_options;
use super::output::Out;
use super::problem::roundel_problem;
use super::solution::roundel_solution;
use super::status::roundel_status;
use crate::error::{Error, Result};
use crate::map::{SeamlessMap, SeamlessOptions, SeamlessProblem, Sizing};
use crate::mesh::TriangleMesh;
use crate::quad::FoldFreeMap;
use crate::search::{Options, SolveStatus};
use crate::solve::{Solution, Solver};
use crate::untangle::UntangleOptions;

/// The data that a solve at another size needs again, and the results of the last solve.
pub(super) struct Mapped {
    mesh: TriangleMesh,
    problem: SeamlessProblem,
    solver: Solver,
    found: Option<Found>,
    /// The number of times that the surroundings of folds are stiffened before they are untangled.
    pub(super) stiffenings: usize,
}

/// The results of a solve.
pub(super) struct Found {
    pub(super) map: SeamlessMap,
    /// The solution that the integers are from.
    pub(super) solution: Solution,
    /// How often the integers were decided anew.
    pub(super) rounds: usize,
    /// How often the map was made finer.
    pub(super) refinements: usize,
    /// Whether the solve untangled the map, at the size that it then had.
    pub(super) is_untangled: bool,
}

impl Mapped {
    pub(super) fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    pub(super) fn problem(&self) -> &SeamlessProblem {
        &self.problem
    }

    /// Takes the result of a solve of this problem, or of a finer one.
    pub(super) fn take_fold_free(
        &mut self,
        how: impl FnOnce(&TriangleMesh, &SeamlessProblem) -> Result<FoldFreeMap>,
    ) -> Outcome {
        let found = how(&self.mesh, &self.problem)?;
        self.found = Some(Found {
            map: found.untangled.map,
            is_untangled: found.solution.status() != SolveStatus::Relaxed,
            solution: found.solution,
            rounds: found.rounds,
            refinements: found.refinements,
        });
        Ok(())
    }

    /// Takes another map with the same integers.
    pub(super) fn replace(&mut self, map: SeamlessMap) {
        if let Some(found) = &mut self.found {
            found.map = map;
        }
    }

    pub(super) fn found(&self) -> Outcome<&Found> {
        let none = || Error::InvalidArgument {
            what: "the map has not been solved for".into(),
            index: None,
        };
        Ok(self.found.as_ref().ok_or_else(none)?)
    }

    fn resize(&mut self, sizing: &Sizing) -> Outcome {
        Ok(self.problem.resize(&self.mesh, sizing, &mut self.solver)?)
    }

    fn take(&mut self, solution: Solution) -> Outcome {
        let map = self.problem.map(&self.mesh, &solution)?;
        self.found = Some(Found {
            map,
            solution,
            rounds: 0,
            refinements: 0,
            is_untangled: false,
        });
        Ok(())
    }
}

/// A seamless map of a mesh: coordinates (u, v) on the cut surface, whose gradients follow a field of
/// crosses. Across the cut they turn by quarter turns and shift by integers. Cones are integer points,
/// and features are isolines of integer value. The mesh and the field may be freed before the map.
///
/// A map is made for a size of quads and solved. It can be solved again for other sizes, which reuses
/// data of the first solve. The results are those of the last solve.
pub struct roundel_map(Guarded<Mapped>);

object!(roundel_map, Mapped, "map");

/// Makes a map of a mesh and a field on it, not yet solved for, with the size of 1000 quads. The features
/// are those of `guidance`, or, if it is NULL, those that the field follows. To be freed with
/// roundel_map_free.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH for the field of another mesh,
/// ROUNDEL_ERROR_INVALID_ARGUMENT for a field of other than crosses, ROUNDEL_ERROR_OVERFLOW,
/// ROUNDEL_ERROR_OUT_OF_MEMORY, and as roundel_mesh_mark_features does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_new(
    mesh: *const roundel_mesh,
    field: *const roundel_field,
    guidance: *const roundel_guidance,
    map: *mut *mut roundel_map,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives a live handle and a place, or NULL.
        let (found, out): (&FoundField, _) =
            unsafe { (guard::value(field)?, Out::new("map", map)?) };
        let given;
        let features = if guidance.is_null() {
            found.features()
        } else {
            // SAFETY: the caller gives a live handle.
            given = unsafe { guard::value(guidance) }?.features(mesh)?;
            &given
        };
        let sizing = Sizing::Quads(SeamlessOptions::default().quads);
        let problem = SeamlessProblem::with_features(mesh, found.field(), &sizing, features)?;
        out.set(guard::handle(Mapped {
            mesh: mesh.clone(),
            solver: Solver::new(problem.problem())?,
            problem,
            found: None,
            stiffenings: UntangleOptions::default().stiffenings,
        }));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Frees a map. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_free(map: *mut roundel_map) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(map) }
}

/// Sets the size by the number of quads.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_set_quads(
    map: *mut roundel_map,
    quads: usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, |map: &mut Mapped| map.resize(&Sizing::Quads(quads))) }
}

/// Sets the size by one edge length of quads, in units of the mesh.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a length that is not above zero, and with
/// ROUNDEL_ERROR_NOT_FINITE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_set_edge_length(
    map: *mut roundel_map,
    edge_length: f64,
) -> roundel_status {
    let body = |map: &mut Mapped| map.resize(&Sizing::EdgeLength(edge_length));
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, body) }
}

/// Sets the size by two edge lengths of quads for each face: along the arm that the field stores there
/// (its angle), and across it. `length` is twice the number of faces.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT and the face for a length that is not above zero, and with
/// ROUNDEL_ERROR_NOT_FINITE and ROUNDEL_ERROR_LENGTH_MISMATCH.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_set_edge_lengths(
    map: *mut roundel_map,
    edge_lengths: *const f64,
    length: usize,
) -> roundel_status {
    let body = |map: &mut Mapped| {
        let expected = 2 * map.mesh.face_count();
        if length != expected {
            Err(Error::LengthMismatch {
                what: "edge lengths of faces",
                expected,
                actual: length,
            })?;
        }
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        let lengths = unsafe { slice("edge lengths of faces", edge_lengths, length) }?;
        map.resize(&Sizing::Lengths(lengths.as_chunks::<2>().0.to_vec()))
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, body) }
}

/// Solves for the map. `monitor` receives progress and may cancel. `options` and `monitor` may be NULL. A
/// later call at another size skips elimination, orderings and factorizations.
///
/// Fails as roundel_problem_solve does, and keeps the results of an earlier solve. The callback must not
/// use the map.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_solve(
    map: *mut roundel_map,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
) -> roundel_status {
    let body = |map: &mut Mapped| {
        let default = Options::default();
        // SAFETY: the caller gives a live handle and a monitor as its members say, or NULL.
        let (options, monitor) =
            unsafe { (guard::value_or(options, &default)?, watched_by(monitor)?) };
        let solution = map.solver.solve_with(options, monitor)?;
        map.take(solution)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, body) }
}

/// Makes a copy of the mixed-integer problem of a map at its current size, to be saved or solved in
/// another way. Variables 2 c and 2 c + 1 are u and v of vertex c of the cut surface. The translations of
/// the seams follow.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_make_problem(
    map: *const roundel_map,
    problem: *mut *mut roundel_problem,
) -> roundel_status {
    let body = |map: &Mapped| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("problem", problem) }?;
        out.set(guard::handle(map.problem.problem().clone()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}

/// Takes a solution of roundel_map_make_problem's problem as the result of a solve.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH for the solution of another problem.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_set_solution(
    map: *mut roundel_map,
    solution: *const roundel_solution,
) -> roundel_status {
    let body = |map: &mut Mapped| {
        // SAFETY: the caller gives a live handle, or NULL.
        let solution: &Solution = unsafe { guard::value(solution) }?;
        map.take(solution.clone())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, body) }
}
