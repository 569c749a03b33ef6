//! The repair handle: the mesh made of a soup, the edits, and where its elements come from.

use std::ffi::c_char;

use super::guard::{self, Guarded, object};
use super::mesh::roundel_mesh;
use super::output::{Out, copy_numbers, copy_whole, fill, places};
use super::repair_options::roundel_repair_options;
use super::soup::roundel_soup;
use super::status::roundel_status;
use crate::error::Error;
use crate::mesh::TriangleMesh;
use crate::monitor::room_for;
use crate::soup::{EditKind, PolygonSoup, RepairOptions, Repaired};

/// What repair makes of a soup: an oriented manifold mesh, a list of edits that says what was done, and where
/// vertices and faces of the mesh come from. The soup may be freed before it.
pub struct roundel_repair(Guarded<Made>);

/// The mesh, and what was done to get it.
pub(super) struct Made {
    mesh: TriangleMesh,
    repaired: Repaired,
}

impl Made {
    pub(super) fn parts(&self) -> (&TriangleMesh, &Repaired) {
        (&self.mesh, &self.repaired)
    }
}

object!(roundel_repair, Made, "repair");

/// Repairs a soup. `options` may be NULL for new repair options. A soup that roundel_mesh_new accepts comes
/// back with its numbers and coordinates and an empty list of edits, unless its boundary edges lie on each
/// other: then they are welded.
///
/// Fails with ROUNDEL_ERROR_EMPTY if nothing is left: the soup has no polygons, or none with area. Fails
/// with ROUNDEL_ERROR_OVERFLOW for more than 2^28 vertices or corners.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_soup_repair(
    soup: *const roundel_soup,
    options: *const roundel_repair_options,
    repair: *mut *mut roundel_repair,
) -> roundel_status {
    let body = |soup: &PolygonSoup| {
        let default = RepairOptions::default();
        // SAFETY: the caller gives live handles and a place, or NULL.
        let (options, out) = unsafe {
            (
                guard::value_or(options, &default)?,
                Out::new("repair", repair)?,
            )
        };
        room_for("the repaired mesh", soup.corners().len(), REPAIR)?;
        let (mesh, repaired) = TriangleMesh::from_soup(soup, options).map_err(Error::from)?;
        out.set(guard::handle(Made { mesh, repaired }));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(soup, body) }
}

/// The bytes that repair takes, for each corner.
const REPAIR: usize = 600;

/// Frees what repair made. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_free(repair: *mut roundel_repair) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(repair) }
}

/// Gives the mesh, which is the caller's own to free with roundel_mesh_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_mesh(
    repair: *const roundel_repair,
    mesh: *mut *mut roundel_mesh,
) -> roundel_status {
    let body = |made: &Made| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("mesh", mesh) }?;
        out.set(guard::handle(made.mesh.clone()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}

/// An entry that gives one number of a repair.
///
/// # Safety
/// `repair` is NULL or a live handle, `out` NULL or a place for the number.
unsafe fn give(
    repair: *const roundel_repair,
    what: &'static str,
    out: *mut usize,
    read: impl FnOnce(&Repaired) -> usize,
) -> roundel_status {
    let body = |made: &Made| {
        // SAFETY: handed on.
        unsafe { Out::new(what, out) }?.set(read(&made.repaired));
        Ok(())
    };
    // SAFETY: handed on.
    unsafe { guard::read(repair, body) }
}

/// Gives the number of edits. It is 0 if the soup was a mesh as it is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_edit_count(
    repair: *const roundel_repair,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(repair, "edit count", count, |r| r.edits.list().len()) }
}

/// Gives the number of edits of one kind, a roundel_edit_kind.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_count_of(
    repair: *const roundel_repair,
    kind: i32,
    count: *mut usize,
) -> roundel_status {
    let body = |made: &Made| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("edit count", count) }?;
        let known = EditKind::ALL.into_iter().find(|&k| k as i32 == kind);
        let kind = known.ok_or_else(|| Error::InvalidArgument {
            what: format!("{kind} is no kind of edit"),
            index: None,
        })?;
        out.set(made.repaired.edits.count(kind));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}

/// Copies the edits in the order in which they were made: the kind of each, the element that it was done to,
/// and another number, or -1 where there is none. roundel_edit_kind says for each kind what they are.
/// `length` is the number of edits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_edits(
    repair: *const roundel_repair,
    kinds: *mut i32,
    elements: *mut i32,
    others: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |made: &Made| {
        let edits = made.repaired.edits.list();
        // SAFETY: the caller gives arrays of `length` numbers, or NULL.
        let (kinds, elements, others) = unsafe {
            (
                places("kinds", edits.len(), kinds, length)?,
                places("elements", edits.len(), elements, length)?,
                places("others", edits.len(), others, length)?,
            )
        };
        fill(kinds, edits.iter().map(|edit| edit.kind as i32));
        // Repair takes no more than 2^28 of anything.
        fill(elements, edits.iter().map(|edit| edit.element as i32));
        fill(others, edits.iter().map(|edit| signed(edit.other)));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}

/// Copies one line about the edits, such as "welded 12 vertices, split 3 vertices", to `buffer`, which has
/// `capacity` bytes, with the terminating NUL. It is empty if nothing was done. Its length without the NUL
/// is written to `length`, which may be NULL. If `buffer` is NULL and `capacity` 0, only the length is written.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH if the buffer is too small.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_summary(
    repair: *const roundel_repair,
    buffer: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> roundel_status {
    let body = |made: &Made| {
        let summary = made.repaired.edits.summary();
        // SAFETY: the caller gives a buffer of `capacity` bytes and a place for the length, or NULL.
        unsafe { copy_whole(&summary, buffer, capacity, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}

/// A number, or -1 for none.
fn signed(number: Option<u32>) -> i32 {
    // Repair takes no more than 2^28 of anything.
    number.map_or(-1, |n| n as i32)
}

/// Gives the number of vertices of the mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_vertex_count(
    repair: *const roundel_repair,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(repair, "vertex count", count, |r| r.vertex_origin.len()) }
}

/// Gives the number of faces of the mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_face_count(
    repair: *const roundel_repair,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(repair, "face count", count, |r| r.triangle_origin.len()) }
}

/// Copies for each vertex of the mesh the vertex of the soup that it comes from, or -1 for one that repair
/// made. `length` is the number of vertices of the mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_vertex_origins(
    repair: *const roundel_repair,
    vertices: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |made: &Made| {
        let origins = made.repaired.vertex_origin.iter().map(|&v| signed(v));
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("vertex origins", origins, vertices, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}

/// Copies for each face of the mesh the polygon of the soup that it comes from, or -1 for one that fills a
/// hole. `length` is the number of faces of the mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_face_origins(
    repair: *const roundel_repair,
    polygons: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |made: &Made| {
        let origins = made.repaired.triangle_origin.iter().map(|&p| signed(p));
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("face origins", origins, polygons, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}

/// Gives the number of vertices of the soup.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_soup_vertex_count(
    repair: *const roundel_repair,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(repair, "vertex count", count, Repaired::input_vertex_count) }
}

/// Copies for each vertex of the soup the one that it was welded to: itself if to none, -1 if its coordinates
/// are not finite. With roundel_repair_vertex_origins this leads from the soup to the mesh. `length` is the
/// number of vertices of the soup.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_repair_welded_to(
    repair: *const roundel_repair,
    vertices: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |made: &Made| {
        let all = 0..made.repaired.input_vertex_count();
        let welded = all.map(|v| signed(made.repaired.welded_to(v)));
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("welded vertices", welded, vertices, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(repair, body) }
}
