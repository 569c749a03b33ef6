//! The results of quads: vertices, faces, counts.

use std::ffi::c_char;
use std::path::Path;

use super::guard;
use super::input::path;
use super::output::{Out, copy_numbers};
use super::quads::{Quads, roundel_quads};
use super::status::roundel_status;
use crate::error::Result;
use crate::extract::QuadMesh;

/// An entry that gives one number of quads.
///
/// # Safety
/// `quads` is NULL or a live handle, `out` NULL or a place for the number.
unsafe fn give<T>(
    quads: *const roundel_quads,
    what: &'static str,
    out: *mut T,
    read: impl FnOnce(&QuadMesh) -> T,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: handed on.
        unsafe { Out::new(what, out) }?.set(read(quads));
        Ok(())
    };
    // SAFETY: handed on.
    unsafe { guard::read(quads, body) }
}

/// An entry that copies one list of numbers of quads.
///
/// # Safety
/// `quads` is NULL or a live handle, `to` NULL or an array of `length` numbers.
unsafe fn copy<T: Copy>(
    quads: *const roundel_quads,
    what: &'static str,
    values: impl FnOnce(&QuadMesh) -> Vec<T>,
    to: *mut T,
    length: usize,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: handed on.
        unsafe { copy_numbers(what, values(quads).into_iter(), to, length) }
    };
    // SAFETY: handed on.
    unsafe { guard::read(quads, body) }
}

fn signed(corners: &[u32]) -> Vec<i32> {
    // Extraction makes no more than 2^24 points.
    corners.iter().map(|&v| v as i32).collect()
}

/// Gives the number of vertices. Every vertex has a face.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_vertex_count(
    quads: *const roundel_quads,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(quads, "vertex count", count, |q| q.vertices.len()) }
}

/// Copies x, y, z of every vertex. `length` is three times the number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_coordinates(
    quads: *const roundel_quads,
    coordinates: *mut f64,
    length: usize,
) -> roundel_status {
    let values = |q: &QuadMesh| q.vertices.as_flattened().to_vec();
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(quads, "coordinates", values, coordinates, length) }
}

/// Gives the number of quads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_count(
    quads: *const roundel_quads,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(quads, "quad count", count, |q| q.quads.len()) }
}

/// Copies the four corners of every quad, counter-clockwise seen from outside. `length` is four
/// times the number of quads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_corners(
    quads: *const roundel_quads,
    corners: *mut i32,
    length: usize,
) -> roundel_status {
    let values = |q: &QuadMesh| signed(q.quads.as_flattened());
    // SAFETY: the caller gives a live handle and an array of `length` numbers, or NULL.
    unsafe { copy(quads, "corners", values, corners, length) }
}

/// Gives the number of faces that are not quads, and the number of all their corners. Neither place may
/// be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_other_face_counts(
    quads: *const roundel_quads,
    count: *mut usize,
    corner_count: *mut usize,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: the caller gives places for the numbers, or NULL.
        let (count, corners) = unsafe {
            (
                Out::new("other count", count)?,
                Out::new("corner count", corner_count)?,
            )
        };
        count.set(quads.others.len());
        corners.set(quads.others.iter().map(Vec::len).sum());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

/// Copies the faces that are no quads: the number of corners of each, and the corners of all, one
/// face after the other. The lengths are those of roundel_quads_other_face_counts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_other_faces(
    quads: *const roundel_quads,
    count: usize,
    sizes: *mut i32,
    corner_count: usize,
    corners: *mut i32,
) -> roundel_status {
    let body = |quads: &Quads| {
        let all = signed(&quads.others.concat());
        let of_face = quads.others.iter().map(|face| face.len() as i32);
        // SAFETY: the caller gives arrays of the lengths given, or NULL.
        unsafe {
            copy_numbers("sizes", of_face, sizes, count)?;
            copy_numbers("corners", all.into_iter(), corners, corner_count)
        }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

/// Gives the number of vertices with other than four edges, or three on the boundary.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_irregular_count(
    quads: *const roundel_quads,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(quads, "irregular count", count, |q| q.figures().irregular) }
}

/// Gives vertices minus edges plus faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_euler_characteristic(
    quads: *const roundel_quads,
    euler: *mut i64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(quads, "Euler characteristic", euler, |q| q.figures().euler) }
}

/// Gives 1 if all faces are quads, each edge has two faces, or one at the boundary, and the Euler
/// characteristic is that of the triangle mesh; 0 otherwise. roundel_quads_faults then names the elements
/// at fault.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_is_conforming(
    quads: *const roundel_quads,
    is_conforming: *mut i32,
) -> roundel_status {
    let read = |q: &QuadMesh| i32::from(q.is_conforming());
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(quads, "conforming", is_conforming, read) }
}

/// Gives the numbers of elements that keep quads from conforming: faces that are not quads or have a
/// vertex twice, edges with more than two faces or two that run the same way, and vertices whose faces
/// form more than one fan. Also gives the number of triangles that the map folds, which cause these
/// faults. No place may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_fault_counts(
    quads: *const roundel_quads,
    face_count: *mut usize,
    edge_count: *mut usize,
    vertex_count: *mut usize,
    triangle_count: *mut usize,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: the caller gives places for the numbers, or NULL.
        let places = unsafe {
            [
                Out::new("face count", face_count)?,
                Out::new("edge count", edge_count)?,
                Out::new("vertex count", vertex_count)?,
                Out::new("triangle count", triangle_count)?,
            ]
        };
        let faults = quads.faults();
        let counts = [
            faults.faces.len(),
            faults.edges.len(),
            faults.vertices.len(),
            quads.folded.len(),
        ];
        for (place, count) in places.into_iter().zip(counts) {
            place.set(count);
        }
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

/// Copies the elements that roundel_quads_fault_counts counts: faces, the quads numbered first and
/// then the others; the two vertices of each edge; vertices; triangles of the mesh. The lengths are
/// those counts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_faults(
    quads: *const roundel_quads,
    face_count: usize,
    faces: *mut i32,
    edge_count: usize,
    edges: *mut i32,
    vertex_count: usize,
    vertices: *mut i32,
    triangle_count: usize,
    triangles: *mut i32,
) -> roundel_status {
    let body = |quads: &Quads| {
        let faults = quads.faults();
        // No more than 2^31 of anything.
        let numbers = |list: &[usize]| list.iter().map(|&n| n as i32).collect::<Vec<i32>>();
        let ends = numbers(faults.edges.as_flattened());
        let pairs = ends.as_chunks::<2>().0.iter().copied();
        // SAFETY: the caller gives arrays of the lengths given, or NULL.
        unsafe {
            let faces_of = numbers(&faults.faces).into_iter();
            copy_numbers("faces", faces_of, faces, face_count)?;
            copy_numbers("edges", pairs, edges.cast::<[i32; 2]>(), edge_count)?;
            let vertices_of = numbers(&faults.vertices).into_iter();
            copy_numbers("vertices", vertices_of, vertices, vertex_count)?;
            let triangles_of = numbers(&quads.folded).into_iter();
            copy_numbers("triangles", triangles_of, triangles, triangle_count)
        }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

#[cfg(feature = "mesh-io")]
fn write(quads: &QuadMesh, file: &Path) -> Result<()> {
    quads.write(file)
}

#[cfg(not(feature = "mesh-io"))]
fn write(quads: &QuadMesh, file: &Path) -> Result<()> {
    quads.write_obj(file)
}

/// Writes the faces as OBJ, OFF, PLY or USD text (.usda), told apart by extension. Reading gives back the
/// same numbers. STL and glTF hold no quads: they get triangles in single precision.
///
/// Fails with ROUNDEL_ERROR_IO, and with ROUNDEL_ERROR_NOT_SUPPORTED for another extension.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_write(
    quads: *const roundel_quads,
    file: *const c_char,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: the caller gives a text, or NULL.
        let file = unsafe { path("file", file) }?;
        Ok(write(quads, file)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}
