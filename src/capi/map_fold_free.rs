//! Maps without folds: solved for in one call, or untangled afterwards, and the remaining faults.

use super::event::{monitor as watched_by, roundel_monitor, watchers};
use super::failure::Outcome;
use super::guard;
use super::map::{Mapped, roundel_map};
use super::map_results::give;
use super::options::roundel_options;
use super::output::{Out, copy_numbers};
use super::status::roundel_status;
use crate::error::Error;
use crate::quad::solve_fold_free;
use crate::search::{Options, SolveStatus};
use crate::untangle::{UntangleOptions, untangle};

/// Solves for a map without folds, as the program `roundel parametrize` does. Integers that collapse
/// cones are decided anew, flipped faces are untangled, and disks around winding defects are laid out
/// anew. If folds remain, the same is done for a finer map. The map with the fewest folds is kept.
/// `options` apply to every solve, and `monitor` watches each; both may be NULL. No solve reuses data of
/// an earlier one. A relaxation is not untangled.
///
/// roundel_map_flipped_face_count and roundel_map_winding_defect_count give the remaining faults.
/// roundel_map_round_count and roundel_map_refinement_count give the work that was done. The next solve
/// uses the size that was asked for, even if this map was made finer.
///
/// Fails as roundel_problem_solve does for the first solve, and with ROUNDEL_ERROR_CANCELLED also later.
/// A failure keeps the results of an earlier solve. The callback must not use the map.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_solve_fold_free(
    map: *mut roundel_map,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
) -> roundel_status {
    let body = |map: &mut Mapped| {
        let default = Options::default();
        // SAFETY: the caller gives a live handle and a monitor as its members say, or NULL.
        let (options, monitor) =
            unsafe { (guard::value_or(options, &default)?, watchers(monitor)?) };
        let effort = effort(map);
        map.take_fold_free(|mesh, problem| {
            solve_fold_free(mesh, problem, options, &effort, monitor)
        })
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, body) }
}

fn effort(map: &Mapped) -> UntangleOptions {
    UntangleOptions {
        stiffenings: map.stiffenings,
        ..UntangleOptions::default()
    }
}

/// Sets how often the surroundings of flipped faces are stiffened before the faces are untangled, with
/// the integers kept: at most 5 times by default.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_set_stiffening_count(
    map: *mut roundel_map,
    count: usize,
) -> roundel_status {
    let body = |map: &mut Mapped| {
        map.stiffenings = count;
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, body) }
}

/// Moves the vertices that integers do not fix until as few faces as possible are flipped or collapsed.
/// `monitor` may be NULL. Seams, cones and isolines stay what they are. roundel_map_flipped_face_count
/// gives the remaining faces; the solution stays that of the solve. A map of roundel_map_solve_fold_free
/// is already untangled.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT before a solve, and after a relaxation, which has no
/// integers to keep. Fails with ROUNDEL_ERROR_CANCELLED, which leaves the map unchanged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_untangle(
    map: *mut roundel_map,
    monitor: *const roundel_monitor,
) -> roundel_status {
    let body = |map: &mut Mapped| {
        // SAFETY: the caller gives a monitor as its members say, or NULL.
        let mut monitor = unsafe { watched_by(monitor) }?;
        let found = map.found()?;
        if found.is_untangled {
            return Ok(());
        }
        if found.solution.status() == SolveStatus::Relaxed {
            Err(Error::InvalidArgument {
                what: "a relaxation has no integers that untangling could hold".into(),
                index: None,
            })?;
        }
        let effort = effort(map);
        let (mesh, problem) = (map.mesh(), map.problem());
        let untangled = untangle(mesh, problem, &found.map, &effort, &mut monitor)?;
        map.replace(untangled.map);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(map, body) }
}

/// Gives the number of inner vertices around which the map turns another number of times than the field
/// does. A ring of faces may go around its vertex twice without a flipped face; vertices of flipped faces
/// are not counted. The number is recomputed from the mesh. A map without winding defects and flipped
/// faces is one to one around every inner point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_winding_defect_count(
    map: *const roundel_map,
    count: *mut usize,
) -> roundel_status {
    let body = |map: &Mapped| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("winding defect count", count) }?;
        out.set(winding_defects(map)?.len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}

/// Copies the vertices of roundel_map_winding_defect_count, in increasing order. `length` is their number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_winding_defects(
    map: *const roundel_map,
    vertices: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |map: &Mapped| {
        let winding_defects = winding_defects(map)?.into_iter().map(|v| v as i32);
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("winding defects", winding_defects, vertices, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}

fn winding_defects(map: &Mapped) -> Outcome<Vec<usize>> {
    let found = map.found()?;
    Ok(map.problem().winding_defects(map.mesh(), &found.map)?)
}

/// Gives how often roundel_map_solve_fold_free decided integers anew, at the size that the map has; 0
/// after any other solve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_round_count(
    map: *const roundel_map,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(map, "round count", count, |found| found.rounds) }
}

/// Gives how often roundel_map_solve_fold_free made the map finer than asked for, each time by the square
/// root of two in length; 0 after any other solve. Later refinements around the remaining folds alone are
/// not counted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_refinement_count(
    map: *const roundel_map,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(map, "refinement count", count, |found| found.refinements) }
}
