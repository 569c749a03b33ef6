//! The mesh handle: made from arrays, by name or by moving vertices; measured, copied out, freed.

use std::ffi::c_char;

use super::failure::Outcome;
use super::guard::{self, Guarded, boundary, object};
use super::input::{Index, indices, slice, text};
use super::output::{Out, copy_numbers};
use super::status::roundel_status;
use crate::error::{Error, Result};
use crate::mesh::{TriangleMesh, jitter, shape};
use crate::monitor::room_for;

/// An oriented triangle mesh, with or without boundary, of any genus and any number of components.
/// It does not change once made.
///
/// Vertices and faces keep the numbers of the arrays or the file. Local edge k of a face runs from
/// its corner k to its corner k + 1. Edges are numbered in increasing order of (lower face, local
/// edge there); the side in the lower face is their first.
pub struct roundel_mesh(Guarded<TriangleMesh>);

object!(roundel_mesh, TriangleMesh, "mesh");

/// The bytes that a mesh takes while it is made, for each face.
pub(super) const MESH: usize = 400;

/// Makes room for `count` values, or fails.
pub(super) fn reserved<T>(what: &'static str, count: usize) -> Result<Vec<T>> {
    let mut values = Vec::new();
    values
        .try_reserve_exact(count)
        .map_err(|_| Error::OutOfMemory { what })?;
    Ok(values)
}

pub(super) fn times_three(what: &'static str, count: usize) -> Result<usize> {
    count.checked_mul(3).ok_or_else(|| Error::Overflow {
        what: format!("{what}: 3 times {count} entries are more than memory can hold"),
        index: None,
    })
}

/// # Safety
/// The arrays are as the caller of the entry says.
unsafe fn from_arrays<I: Index>(
    vertices: (usize, *const f64),
    faces: (usize, *const I),
    mesh: *mut *mut roundel_mesh,
) -> Outcome {
    // SAFETY: handed on.
    let (out, made) = unsafe { (Out::new("mesh", mesh)?, triangles(vertices, faces)?) };
    out.set(guard::handle(made));
    Ok(())
}

/// The mesh of the caller's vertices and corners.
///
/// # Safety
/// The arrays are as the caller of the entry says.
unsafe fn triangles<I: Index>(
    (vertex_count, coordinates): (usize, *const f64),
    (face_count, corners): (usize, *const I),
) -> Outcome<TriangleMesh> {
    let sizes = [
        times_three("coordinates", vertex_count)?,
        times_three("corners", face_count)?,
    ];
    // SAFETY: handed on.
    let (given, named) = unsafe {
        (
            slice("coordinates", coordinates, sizes[0])?,
            indices("corners", corners, sizes[1], vertex_count)?,
        )
    };
    if u32::try_from(vertex_count).is_err() {
        Err(Error::Overflow {
            what: format!("{vertex_count} vertices are more than 2^32 - 1"),
            index: None,
        })?;
    }
    room_for("the mesh", face_count, MESH)?;
    let mut vertices = reserved("the vertices", vertex_count)?;
    vertices.extend(given.as_chunks::<3>().0);
    let mut triangles = reserved("the faces", face_count)?;
    // Below the number of vertices, which 32 bits hold.
    let faces = named.as_chunks::<3>().0.iter();
    triangles.extend(faces.map(|corners| corners.map(|v| v as u32)));
    Ok(TriangleMesh::new(vertices, triangles).map_err(Error::from)?)
}

/// Makes a mesh of `vertex_count` vertices, whose `coordinates` are x, y, z in turn, and
/// `face_count` triangles, whose `corners` are three vertices each, counter-clockwise seen from
/// outside.
///
/// Fails for a mesh that is not an oriented manifold. The reasons are checked one after the other, each
/// on the whole mesh:
/// ROUNDEL_ERROR_INDEX_OUT_OF_RANGE with the position in `corners`, ROUNDEL_ERROR_EMPTY,
/// ROUNDEL_ERROR_NOT_FINITE with the vertex, ROUNDEL_ERROR_REPEATED_VERTEX,
/// ROUNDEL_ERROR_ZERO_AREA, ROUNDEL_ERROR_NON_MANIFOLD_EDGE,
/// ROUNDEL_ERROR_INCONSISTENT_ORIENTATION, ROUNDEL_ERROR_ISOLATED_VERTEX,
/// ROUNDEL_ERROR_NON_MANIFOLD_VERTEX.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_new(
    vertex_count: usize,
    coordinates: *const f64,
    face_count: usize,
    corners: *const i32,
    mesh: *mut *mut roundel_mesh,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives arrays of the lengths given and a place, or NULL.
        unsafe { from_arrays((vertex_count, coordinates), (face_count, corners), mesh) }
    })
}

/// roundel_mesh_new with 64-bit corners.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_new_i64(
    vertex_count: usize,
    coordinates: *const f64,
    face_count: usize,
    corners: *const i64,
    mesh: *mut *mut roundel_mesh,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives arrays of the lengths given and a place, or NULL.
        unsafe { from_arrays((vertex_count, coordinates), (face_count, corners), mesh) }
    })
}

/// Makes a procedural shape of about `faces` triangles: "rounded-cube", "sphere", "torus",
/// "genus-N", "gear", "plane", "disk", "plate-with-holes".
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another name or a number that cannot be served.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_make_shape(
    name: *const c_char,
    faces: usize,
    mesh: *mut *mut roundel_mesh,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a text and a place for the handle, or NULL.
        let (name, out) = unsafe { (text("shape", name)?, Out::new("mesh", mesh)?) };
        if faces <= shape::MAX_TRIANGLES {
            room_for("the mesh", faces, MESH)?;
        }
        let made = shape::by_name(name, faces).map_err(Error::from)?;
        out.set(guard::handle(made));
        Ok(())
    })
}

/// Makes a copy whose vertices are moved by a reproducible noise, uniform in +-`amplitude` times the
/// shortest edge of each vertex. This breaks all symmetries of a mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_jitter(
    mesh: *const roundel_mesh,
    amplitude: f64,
    seed: i64,
    copy: *mut *mut roundel_mesh,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("copy", copy) }?;
        let made = jitter(mesh, amplitude, seed.cast_unsigned()).map_err(Error::from)?;
        out.set(guard::handle(made));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Frees a mesh. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_free(mesh: *mut roundel_mesh) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(mesh) }
}

/// An entry that gives one number read off a mesh.
///
/// # Safety
/// `mesh` is NULL or a live handle, `out` NULL or a place for the number.
unsafe fn give<T>(
    mesh: *const roundel_mesh,
    what: &'static str,
    out: *mut T,
    read: impl FnOnce(&TriangleMesh) -> T,
) -> roundel_status {
    // SAFETY: handed on.
    unsafe {
        guard::read(mesh, |mesh| {
            let out = Out::new(what, out)?;
            out.set(read(mesh));
            Ok(())
        })
    }
}

/// Gives the number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_vertex_count(
    mesh: *const roundel_mesh,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(mesh, "vertex count", count, TriangleMesh::vertex_count) }
}

/// Gives the number of undirected edges, boundary included.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_edge_count(
    mesh: *const roundel_mesh,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(mesh, "edge count", count, TriangleMesh::edge_count) }
}

/// Gives the number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_face_count(
    mesh: *const roundel_mesh,
    count: *mut usize,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(mesh, "face count", count, TriangleMesh::face_count) }
}

/// Gives the number of boundary loops.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_boundary_loop_count(
    mesh: *const roundel_mesh,
    count: *mut usize,
) -> roundel_status {
    let read = TriangleMesh::boundary_loop_count;
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(mesh, "boundary loop count", count, read) }
}

/// Gives vertices minus edges plus faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_euler_characteristic(
    mesh: *const roundel_mesh,
    characteristic: *mut i64,
) -> roundel_status {
    let read = TriangleMesh::euler_characteristic;
    // SAFETY: the caller gives a live handle and a place for the number, or NULL.
    unsafe { give(mesh, "Euler characteristic", characteristic, read) }
}

/// Copies x, y, z of every vertex. `length` is three times the number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_coordinates(
    mesh: *const roundel_mesh,
    coordinates: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let values = mesh.vertices().as_flattened().iter().copied();
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("coordinates", values, coordinates, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Copies the three corners of every face. `length` is three times the number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_corners(
    mesh: *const roundel_mesh,
    corners: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let values = mesh.triangles().as_flattened().iter();
        let values = values.map(|&v| i64::from(v));
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_narrowed("corners", values, corners, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Copies the two faces of every edge, first and second, the second -1 at the boundary. `length`
/// is twice the number of edges.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_edge_faces(
    mesh: *const roundel_mesh,
    faces: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let sides = (0..2 * mesh.edge_count()).map(|at| {
            let edge = mesh.edge(at / 2);
            let side = if at % 2 == 0 {
                Some(edge.first)
            } else {
                edge.second
            };
            side.map_or(-1, |(face, _)| face as i64)
        });
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_narrowed("edge faces", sides, faces, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Copies the edges of every face, in the order of its local edges. `length` is three times the
/// number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_face_edges(
    mesh: *const roundel_mesh,
    edges: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let values = (0..3 * mesh.face_count()).map(|h| mesh.edge_of(h / 3, h % 3) as i64);
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_narrowed("face edges", values, edges, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Copies numbers of elements as 32-bit integers, or fails at once where one does not fit.
///
/// # Safety
/// `to` is NULL or has `length` writable numbers.
unsafe fn copy_narrowed(
    what: &'static str,
    values: impl ExactSizeIterator<Item = i64> + Clone,
    to: *mut i32,
    length: usize,
) -> Outcome {
    if let Some(index) = values.clone().position(|v| i32::try_from(v).is_err()) {
        Err(Error::Overflow {
            what: format!("{what}: entry {index} does not fit 32 bits"),
            index: Some(index),
        })?;
    }
    // SAFETY: handed on.
    unsafe { copy_numbers(what, values.map(|v| v as i32), to, length) }
}
