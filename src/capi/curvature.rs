//! Constraints that the curvature of a mesh suggests.

use super::guard;
use super::input::slice_mut;
use super::mesh::roundel_mesh;
use super::output::Out;
use super::status::roundel_status;
use crate::error::Error;
use crate::field::curvature_constraints;
use crate::mesh::TriangleMesh;

/// Gives the directions of least absolute curvature of the faces where they are most reliable: `fraction`
/// of all faces, rounded to the nearest count, in increasing order. `faces` and `angles` have room for
/// `capacity` entries; the number of faces of the mesh always suffices. The number of entries written
/// goes to `count`.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a fraction outside of 0 to 1, and with
/// ROUNDEL_ERROR_LENGTH_MISMATCH if the room is too small.
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
