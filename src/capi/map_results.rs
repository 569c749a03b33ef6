//! The results of a map's last solve.

use std::ffi::c_char;

use super::failure::Outcome;
use super::guard;
use super::input::{path, slice_mut};
use super::map::{Found, Mapped, roundel_map};
use super::output::{Out, copy_numbers};
use super::solution::roundel_solution;
use super::status::roundel_status;
use crate::error::Error;
use crate::map::SeamlessMap;

/// An entry that gives one number of a map.
///
/// # Safety
/// `map` is NULL or a live handle, `out` NULL or a place for the number.
pub(super) unsafe fn give<T>(
    map: *const roundel_map,
    what: &'static str,
    out: *mut T,
    read: impl FnOnce(&Found) -> T,
) -> roundel_status {
    let body = |map: &Mapped| {
        // SAFETY: handed on.
        let out = unsafe { Out::new(what, out) }?;
        out.set(read(map.found()?));
        Ok(())
    };
    // SAFETY: handed on.
    unsafe { guard::read(map, body) }
}

/// An entry that copies one list of numbers of a map.
///
/// # Safety
/// `map` is NULL or a live handle, `to` NULL or an array of `length` numbers.
unsafe fn copy<T: Copy>(
    map: *const roundel_map,
    what: &'static str,
    values: impl FnOnce(&SeamlessMap) -> Vec<T>,
    to: *mut T,
    length: usize,
) -> roundel_status {
    let body = |map: &Mapped| -> Outcome {
        let values = values(&map.found()?.map);
        // SAFETY: handed on.
        unsafe { copy_numbers(what, values.into_iter(), to, length) }
    };
    // SAFETY: handed on.
    unsafe { guard::read(map, body) }
}

/// Copies u, v of the three corners of every face. `length` is six times the number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_corner_uvs(
    map: *const roundel_map,
    uvs: *mut f64,
    length: usize,
) -> roundel_status {
    let values = |map: &SeamlessMap| {
        let corners = map.corner_uvs();
        corners.as_flattened().as_flattened().to_vec()
    };
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(map, "coordinates of corners", values, uvs, length) }
}

/// Gives the number of vertices of the cut surface. A vertex of the mesh has one copy for each sector
/// between cut edges.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_vertex_count(
    map: *const roundel_map,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe {
        give(map, "vertex count", count, |found| {
            found.map.vertex_uvs().len()
        })
    }
}

/// Copies u, v of every vertex of the cut surface. `length` is twice their number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_vertex_uvs(
    map: *const roundel_map,
    uvs: *mut f64,
    length: usize,
) -> roundel_status {
    let values = |map: &SeamlessMap| map.vertex_uvs().as_flattened().to_vec();
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(map, "coordinates of vertices", values, uvs, length) }
}

/// Copies the three corners of every face as vertices of the cut surface. `length` is three times
/// the number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_vertex_corners(
    map: *const roundel_map,
    corners: *mut i32,
    length: usize,
) -> roundel_status {
    // Two unknowns a vertex, and there are fewer than 2^31 unknowns.
    let values = |map: &SeamlessMap| {
        let copies = map.copies().as_flattened().iter();
        copies.map(|&copy| copy as i32).collect()
    };
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(map, "corners of the cut surface", values, corners, length) }
}

/// Gives the number of cut edges.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_cut_count(
    map: *const roundel_map,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe {
        give(map, "cut count", count, |found| {
            found.map.transitions().len()
        })
    }
}

/// Copies the cut edges in increasing order, and how coordinates change over each from its first to
/// its second face: by `quarters` turns counter-clockwise, 0 to 3, then by a translation (s, t).
/// `count` is the number of cut edges; `translations` has twice as many entries.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_transitions(
    map: *const roundel_map,
    count: usize,
    edges: *mut i32,
    quarters: *mut i32,
    translations: *mut f64,
) -> roundel_status {
    let body = |map: &Mapped| {
        let transitions = map.found()?.map.transitions();
        if count != transitions.len() {
            Err(Error::LengthMismatch {
                what: "cut edges",
                expected: transitions.len(),
                actual: count,
            })?;
        }
        // SAFETY: the caller gives arrays of these lengths, or NULL.
        let (edges, quarters, translations) = unsafe {
            (
                slice_mut("cut edges", edges, count)?,
                slice_mut("quarters", quarters, count)?,
                slice_mut("translations", translations, 2 * count)?,
            )
        };
        let pairs = translations.as_chunks_mut::<2>().0;
        for (i, transition) in transitions.iter().enumerate() {
            edges[i] = transition.edge as i32;
            quarters[i] = i32::from(transition.quarters);
            pairs[i] = transition.translation;
        }
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}

/// Gives the number of cones: irregular vertices of the field.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_cone_count(
    map: *const roundel_map,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(map, "cone count", count, |found| found.map.cones().len()) }
}

/// Copies the cones in increasing order. `length` is their number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_cones(
    map: *const roundel_map,
    vertices: *mut i32,
    length: usize,
) -> roundel_status {
    let values = |map: &SeamlessMap| map.cones().iter().map(|&v| v as i32).collect();
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(map, "cones", values, vertices, length) }
}

/// Gives the number of faces that the map flips or collapses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_flipped_face_count(
    map: *const roundel_map,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe {
        give(map, "flipped count", count, |found| {
            found.map.flipped().len()
        })
    }
}

/// Copies the faces that the map turns over or collapses, in increasing order. `length` is their
/// number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_flipped_faces(
    map: *const roundel_map,
    faces: *mut i32,
    length: usize,
) -> roundel_status {
    let values = |map: &SeamlessMap| map.flipped().iter().map(|&f| f as i32).collect();
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(map, "flipped faces", values, faces, length) }
}

/// Gives the energy of the map: the sum over triangles of area times the squared differences between the
/// gradients of u and v and the arms of the field, scaled to the size asked for. Recomputed from the
/// mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_energy(
    map: *const roundel_map,
    energy: *mut f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(map, "energy", energy, |found| found.map.energy()) }
}

/// Makes a copy of the solution behind a map, which tells how the solve ended, its lower bound and
/// its times. To be freed with roundel_solution_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_solution(
    map: *const roundel_map,
    solution: *mut *mut roundel_solution,
) -> roundel_status {
    let body = |map: &Mapped| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("solution", solution) }?;
        out.set(guard::handle(map.found()?.solution.clone()));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}

/// Writes the mesh with the coordinates of its corners as OBJ.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_map_write(
    map: *const roundel_map,
    file: *const c_char,
) -> roundel_status {
    let body = |map: &Mapped| {
        // SAFETY: the caller gives a text, or NULL.
        let file = unsafe { path("file", file) }?;
        Ok(map.found()?.map.write_obj(map.mesh(), file)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}
