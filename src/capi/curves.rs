//! The curves handle: curves on the surface that a field follows.

use super::event::{monitor as watched_by, roundel_monitor};
use super::failure::{Failure, Outcome};
use super::geodesic_sources::points;
use super::guard::{self, Guarded, boundary, object};
use super::input::{slice, slice_mut};
use super::mesh::{roundel_mesh, times_three};
use super::output::Out;
use super::status::roundel_status;
use crate::error::Error;
use crate::field::guides_along;
use crate::geodesic::{SurfacePoint, draw_curve};
use crate::mesh::TriangleMesh;

/// Curves on the surface of a mesh, numbered from 0 as they are added. Numbers of faces are those of the mesh that the
/// curves are used with, and are checked when they are used.
pub struct roundel_curves(Guarded<Vec<Vec<SurfacePoint>>>);

object!(roundel_curves, Vec<Vec<SurfacePoint>>, "curves");

/// Makes an empty list of curves. To be freed with roundel_curves_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_curves_new(curves: *mut *mut roundel_curves) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("curves", curves) }?;
        out.set(guard::handle(Vec::new()));
        Ok(())
    })
}

/// Frees curves. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_curves_free(curves: *mut roundel_curves) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(curves) }
}

/// Draws a polyline in space onto a mesh, and adds the curve: through the closest point of each of its `count` points,
/// which are x, y, z in turn, along a shortest path from one to the next. It is closed if the last point is the first.
/// The monitor may be NULL; it is asked whether the call ends, and told nothing.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for fewer than two points, for a point that lies farther from the surface
/// than a twentieth of the diagonal of the bounding box, and for one from which no path leads to the next;
/// ROUNDEL_ERROR_NOT_FINITE for coordinates that are no numbers. roundel_last_error_index is the number of the point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_curves_draw(
    curves: *mut roundel_curves,
    mesh: *const roundel_mesh,
    count: usize,
    points: *const f64,
    monitor: *const roundel_monitor,
) -> roundel_status {
    let body = |curves: &mut Vec<Vec<SurfacePoint>>| {
        let length = times_three("points of a curve", count)?;
        // SAFETY: the caller gives a live mesh, an array of that length and a monitor, or NULL.
        let (mesh, points, monitor): (&TriangleMesh, _, _) = unsafe {
            (
                guard::value(mesh)?,
                slice("points of a curve", points, length)?,
                watched_by(monitor)?,
            )
        };
        curves.push(draw_curve(mesh, points.as_chunks::<3>().0, &monitor)?);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(curves, body) }
}

/// Adds a curve through `count` points of the surface, given as for roundel_sources_add_points. Points that follow each
/// other lie on a common face, its boundary included.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_curves_add(
    curves: *mut roundel_curves,
    count: usize,
    faces: *const i32,
    barycentric: *const f64,
) -> roundel_status {
    let body = |curves: &mut Vec<Vec<SurfacePoint>>| {
        // SAFETY: the caller gives arrays of `count` and 3 `count` numbers, or NULL.
        curves.push(unsafe { points(count, faces, barycentric) }?);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(curves, body) }
}

/// Gives the number of curves.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_curves_count(
    curves: *const roundel_curves,
    count: *mut usize,
) -> roundel_status {
    let body = |curves: &Vec<Vec<SurfacePoint>>| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("count", count) }?;
        out.set(curves.len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(curves, body) }
}

/// Copies at most `capacity` entries, or only tells how many there are if the capacity is 0.
fn room(what: &'static str, found: usize, capacity: usize) -> Outcome<bool> {
    if capacity > 0 && found > capacity {
        return Err(Failure::Library(Error::LengthMismatch {
            what,
            expected: found,
            actual: capacity,
        }));
    }
    Ok(capacity > 0)
}

/// Gives guides along curves, for roundel_guidance_set_guides: for every face that curves pass, the direction of the
/// curve there, and the weight `weight * length / size`, with the length of the curves inside the face and the square
/// root of its area. `symmetry` is that of the field. With a weight of 10 a field follows curves to a fraction of a
/// degree where nothing contradicts. `faces`, `angles` and `weights` have room for `capacity` numbers each; the number
/// of guides goes to `count`. With a capacity of 0 the arrays may be NULL and only the number is given.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a weight that is negative or not finite, for another symmetry than 1,
/// 2, 4 and 6, and, with the number of the curve as roundel_last_error_index, for one of fewer than two points or with
/// points that are not on the surface or lie on no common face; ROUNDEL_ERROR_INDEX_OUT_OF_RANGE for a face that the
/// mesh does not have; ROUNDEL_ERROR_LENGTH_MISMATCH if the room is too small.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_curves_guides(
    curves: *const roundel_curves,
    mesh: *const roundel_mesh,
    symmetry: i32,
    weight: f64,
    capacity: usize,
    faces: *mut i32,
    angles: *mut f64,
    weights: *mut f64,
    count: *mut usize,
) -> roundel_status {
    let body = |curves: &Vec<Vec<SurfacePoint>>| {
        // SAFETY: the caller gives a live mesh and a place for the number, or NULL.
        let (mesh, out): (&TriangleMesh, _) =
            unsafe { (guard::value(mesh)?, Out::new("count", count)?) };
        let symmetry = u8::try_from(symmetry).unwrap_or(0);
        let guides = guides_along(mesh, curves, symmetry, weight)?;
        if room("guides", guides.len(), capacity)? {
            let length = guides.len();
            // SAFETY: the caller gives arrays with room for `capacity` numbers, or NULL.
            let (faces, angles, weights) = unsafe {
                (
                    slice_mut("guided faces", faces, length)?,
                    slice_mut("guiding angles", angles, length)?,
                    slice_mut("guiding weights", weights, length)?,
                )
            };
            for (i, guide) in guides.iter().enumerate() {
                (faces[i], angles[i], weights[i]) = (guide.face as i32, guide.angle, guide.weight);
            }
        }
        out.set(guides.len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(curves, body) }
}
