//! Labels and numbers of a mesh, carried to its quads.

use super::event::{monitor as watched_by, roundel_monitor};
use super::failure::Outcome;
use super::guard;
use super::input::slice;
use super::mesh::roundel_mesh;
use super::output::copy_numbers;
use super::quads::{Quads, roundel_quads};
use super::status::roundel_status;
use crate::error::{Error, Result};
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::mesh::attributes::NO_NAME;
use crate::monitor::Monitor;
use crate::transfer::{transfer_corner_values, transfer_face_labels, transfer_vertex_values};

/// Gives each face of quads the label of most of the area of the mesh beneath it, such as the number of a
/// material. `labels` has a number from 0 on for each face of the mesh, or -1 for none; `result` gets one for each
/// face of the quads: the quads first, and then the other faces. Of labels with the same area the lowest wins, and
/// -1 only if there is no other. `monitor` may be NULL.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH, and with ROUNDEL_ERROR_INVALID_ARGUMENT and the face for a label
/// below -1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_transfer_face_labels(
    quads: *const roundel_quads,
    mesh: *const roundel_mesh,
    labels: *const i32,
    label_count: usize,
    monitor: *const roundel_monitor,
    result: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: the caller gives live handles, a monitor as its members say and an array of the length given, or
        // NULL.
        let (mesh, labels, mut monitor): (&TriangleMesh, _, _) = unsafe {
            (
                guard::value(mesh)?,
                slice("labels of faces", labels, label_count)?,
                watched_by(monitor)?,
            )
        };
        let labels = checked(labels)?;
        let found = transfer_face_labels(mesh, quads, &labels, &mut monitor)?;
        // NO_NAME has the bits of -1.
        let found = found.into_iter().map(u32::cast_signed);
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("labels of the quads", found, result, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

fn checked(labels: &[i32]) -> Result<Vec<u32>> {
    const { assert!(NO_NAME.cast_signed() == -1) };
    if let Some(face) = labels.iter().position(|&label| label < -1) {
        return Err(Error::InvalidArgument {
            what: format!(
                "labels of faces: {}, of face {face}, is below -1",
                labels[face]
            ),
            index: Some(face),
        });
    }
    Ok(labels.iter().map(|label| label.cast_unsigned()).collect())
}

/// A function of the library that carries numbers to quads.
type Carry = fn(&TriangleMesh, &QuadMesh, usize, &[f64], &mut Monitor) -> Result<Vec<f64>>;

/// An entry that carries numbers of elements.
///
/// # Safety
/// `quads` and `mesh` are NULL or live handles, `monitor` is NULL or as its members say, `values` NULL or an array of
/// `count` numbers, `result` NULL or one of `length` numbers that nobody else uses.
unsafe fn carry(
    quads: *const roundel_quads,
    mesh: *const roundel_mesh,
    components: usize,
    values: (&'static str, *const f64, usize),
    monitor: *const roundel_monitor,
    result: (*mut f64, usize),
    by: Carry,
) -> roundel_status {
    let body = |quads: &Quads| -> Outcome {
        let (what, values, count) = values;
        // SAFETY: handed on.
        let (mesh, values, mut monitor): (&TriangleMesh, _, _) = unsafe {
            (
                guard::value(mesh)?,
                slice(what, values, count)?,
                watched_by(monitor)?,
            )
        };
        let found = by(mesh, quads, components, values, &mut monitor)?;
        // SAFETY: handed on.
        unsafe { copy_numbers("values of the quads", found.into_iter(), result.0, result.1) }
    };
    // SAFETY: handed on.
    unsafe { guard::read(quads, body) }
}

/// Gives each vertex of quads the numbers at the closest point of the mesh, interpolated linearly between its vertices:
/// temperatures, or colours of three or four components. `values` has `components` numbers for each vertex of the mesh,
/// `result` as many for each vertex of the quads. NaN stands for none. `monitor` may be NULL.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH, with ROUNDEL_ERROR_NOT_FINITE and the vertex for an infinite number, and
/// with ROUNDEL_ERROR_INVALID_ARGUMENT for 0 components.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_transfer_vertex_values(
    quads: *const roundel_quads,
    mesh: *const roundel_mesh,
    components: usize,
    values: *const f64,
    count: usize,
    monitor: *const roundel_monitor,
    result: *mut f64,
    length: usize,
) -> roundel_status {
    let values = ("values of vertices", values, count);
    let by = transfer_vertex_values;
    // SAFETY: the caller gives live handles, a monitor as its members say and arrays of these lengths, or NULL.
    unsafe {
        carry(
            quads,
            mesh,
            components,
            values,
            monitor,
            (result, length),
            by,
        )
    }
}

/// Gives each corner of the faces of quads numbers such as texture coordinates. `values` has `components` numbers
/// for each of the three corners of each face of the mesh, and `result` as many for each corner of the quads, four
/// corners each, and then of the other faces. An edge whose two faces have other values at one of its ends is a seam:
/// the corners of one quad have values of one side, that of most of the area beneath the quad. NaN stands for none.
/// `monitor` may be NULL.
///
/// Fails with ROUNDEL_ERROR_LENGTH_MISMATCH, with ROUNDEL_ERROR_NOT_FINITE and the corner for an infinite number, and
/// with ROUNDEL_ERROR_INVALID_ARGUMENT for 0 components.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_transfer_corner_values(
    quads: *const roundel_quads,
    mesh: *const roundel_mesh,
    components: usize,
    values: *const f64,
    count: usize,
    monitor: *const roundel_monitor,
    result: *mut f64,
    length: usize,
) -> roundel_status {
    let values = ("values of corners", values, count);
    let by = transfer_corner_values;
    // SAFETY: the caller gives live handles, a monitor as its members say and arrays of these lengths, or NULL.
    unsafe {
        carry(
            quads,
            mesh,
            components,
            values,
            monitor,
            (result, length),
            by,
        )
    }
}
