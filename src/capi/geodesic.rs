//! The geodesic handle: exact distances along a mesh, gradients, paths and nearest sources.

use super::event::{monitor as watched_by, roundel_monitor};
use super::failure::{Failure, Outcome};
use super::geodesic_sources::{points, roundel_sources};
use super::guard::{self, Guarded, object};
use super::input::slice_mut;
use super::mesh::{roundel_mesh, times_three};
use super::output::{Out, copy_numbers};
use super::status::roundel_status;
use crate::error::Error;
use crate::geodesic::{GeodesicDistance, GeodesicOptions, Source, SurfacePoint, geodesic_distance};
use crate::mesh::TriangleMesh;

/// The exact distance along the surface of every vertex of a mesh to the nearest of some sources. The mesh may be
/// freed before it, but is needed for what is asked about other points.
pub struct roundel_geodesic(Guarded<GeodesicDistance>);

object!(roundel_geodesic, GeodesicDistance, "geodesic distances");

/// Computes distances from sources to all vertices. Distances above `limit` are infinite; INFINITY is no limit. If
/// `everywhere` is not 0, distances, gradients and paths can be asked for at any point, which takes more memory;
/// else at vertices alone. The monitor may be NULL; it is asked whether the call ends, and told nothing.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT without sources, for a limit that is negative or not a number, and for
/// a point that is not in its face, or points of a polyline that lie on no common face;
/// ROUNDEL_ERROR_INDEX_OUT_OF_RANGE for a vertex, face or edge that the mesh does not have; ROUNDEL_ERROR_NOT_FINITE
/// for barycentric coordinates that are no numbers. roundel_last_error_index is the number of the source.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_geodesic_new(
    mesh: *const roundel_mesh,
    sources: *const roundel_sources,
    limit: f64,
    everywhere: i32,
    monitor: *const roundel_monitor,
    geodesic: *mut *mut roundel_geodesic,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives live handles, a monitor and a place for the result, or NULL.
        let (out, sources, monitor): (_, &Vec<Source>, _) = unsafe {
            (
                Out::new("geodesic distances", geodesic)?,
                guard::value(sources)?,
                watched_by(monitor)?,
            )
        };
        let options = GeodesicOptions {
            limit,
            everywhere: everywhere != 0,
        };
        let found = geodesic_distance(mesh, sources, &options, &monitor)?;
        out.set(guard::handle(found));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Frees geodesic distances. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_geodesic_free(geodesic: *mut roundel_geodesic) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(geodesic) }
}

/// Copies the distance of every vertex; INFINITY beyond the limit and where no source can be reached. `length` is
/// the number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_geodesic_distances(
    geodesic: *const roundel_geodesic,
    distances: *mut f64,
    length: usize,
) -> roundel_status {
    let body = |found: &GeodesicDistance| {
        let values = found.vertices().iter().copied();
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("distances", values, distances, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(geodesic, body) }
}

/// Copies the number of the nearest source of every vertex; -1 where the distance is infinite. `length` is the
/// number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_geodesic_nearest_sources(
    geodesic: *const roundel_geodesic,
    sources: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |found: &GeodesicDistance| {
        let number = |source: &Option<usize>| source.map_or(-1, |s| s as i32);
        let values = found.nearest_sources().iter().map(number);
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("nearest sources", values, sources, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(geodesic, body) }
}

/// Asks about points of the surface.
///
/// # Safety
/// `geodesic` and `mesh` are NULL or live handles, the arrays NULL or of `count` and three times `count` entries.
unsafe fn ask(
    geodesic: *const roundel_geodesic,
    mesh: *const roundel_mesh,
    (count, faces, barycentric): (usize, *const i32, *const f64),
    answer: impl FnOnce(&GeodesicDistance, &TriangleMesh, Vec<SurfacePoint>) -> Outcome,
) -> roundel_status {
    let body = |found: &GeodesicDistance| {
        // SAFETY: handed on.
        let (mesh, points) = unsafe { (guard::value(mesh)?, points(count, faces, barycentric)?) };
        answer(found, mesh, points)
    };
    // SAFETY: handed on.
    unsafe { guard::read(geodesic, body) }
}

/// Gives the distances of `count` points of the surface, given as for roundel_sources_add_points. `mesh` is the one
/// that the distances are of.
///
/// Fails for points that are not at vertices with ROUNDEL_ERROR_INVALID_ARGUMENT if the distances were not computed
/// everywhere.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_geodesic_distances_at(
    geodesic: *const roundel_geodesic,
    mesh: *const roundel_mesh,
    count: usize,
    faces: *const i32,
    barycentric: *const f64,
    distances: *mut f64,
) -> roundel_status {
    let answer = |found: &GeodesicDistance, mesh: &TriangleMesh, points: Vec<SurfacePoint>| {
        let all = points.iter().map(|p| found.at(mesh, p));
        let all = all.collect::<Result<Vec<f64>, Error>>()?;
        // SAFETY: the caller gives an array of `count` numbers, or NULL.
        unsafe { copy_numbers("distances", all.into_iter(), distances, count) }
    };
    // SAFETY: the caller gives live handles and arrays of these lengths, or NULL.
    unsafe { ask(geodesic, mesh, (count, faces, barycentric), answer) }
}

/// Gives the gradients of the distance at `count` points of the surface, given as for roundel_sources_add_points: x,
/// y, z of a unit vector in the plane of a face each, null on the sources and where the distance is infinite.
///
/// Fails as roundel_geodesic_distances_at.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_geodesic_gradients_at(
    geodesic: *const roundel_geodesic,
    mesh: *const roundel_mesh,
    count: usize,
    faces: *const i32,
    barycentric: *const f64,
    gradients: *mut f64,
) -> roundel_status {
    let answer = |found: &GeodesicDistance, mesh: &TriangleMesh, points: Vec<SurfacePoint>| {
        let all = points.iter().map(|p| found.gradient(mesh, p));
        let all = all.collect::<Result<Vec<[f64; 3]>, Error>>()?;
        let length = times_three("gradients", count)?;
        let flat = all.as_flattened().iter().copied();
        // SAFETY: the caller gives an array of three times `count` numbers, or NULL.
        unsafe { copy_numbers("gradients", flat, gradients, length) }
    };
    // SAFETY: the caller gives live handles and arrays of these lengths, or NULL.
    unsafe { ask(geodesic, mesh, (count, faces, barycentric), answer) }
}

/// Gives a shortest path from a point, the face and three barycentric coordinates, to the nearest source: points
/// that follow each other lie on a common face, the first is the point itself. `path_faces` has room for `capacity`
/// numbers, `path_barycentric` for three times as many. The number of points goes to `count`: 0 where the distance
/// is infinite. With a capacity of 0, both arrays may be NULL and only the number is given.
///
/// Fails as roundel_geodesic_distances_at, and with ROUNDEL_ERROR_LENGTH_MISMATCH if the room is too small.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_geodesic_path(
    geodesic: *const roundel_geodesic,
    mesh: *const roundel_mesh,
    face: i32,
    barycentric: *const f64,
    capacity: usize,
    path_faces: *mut i32,
    path_barycentric: *mut f64,
    count: *mut usize,
) -> roundel_status {
    let answer = |found: &GeodesicDistance, mesh: &TriangleMesh, points: Vec<SurfacePoint>| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("count", count) }?;
        let path = found.path(mesh, &points[0])?;
        if capacity == 0 {
            out.set(path.len());
            return Ok(());
        }
        if path.len() > capacity {
            return Err(Failure::Library(Error::LengthMismatch {
                what: "points of the path",
                expected: path.len(),
                actual: capacity,
            }));
        }
        // SAFETY: the caller gives arrays with room for `capacity` points, or NULL.
        let (faces, weights) = unsafe {
            (
                slice_mut("faces of the path", path_faces, path.len())?,
                slice_mut("barycentric coordinates", path_barycentric, 3 * path.len())?,
            )
        };
        let weights = weights.as_chunks_mut::<3>().0;
        for ((face, weights), point) in faces.iter_mut().zip(weights).zip(&path) {
            (*face, *weights) = (point.face as i32, point.barycentric);
        }
        out.set(path.len());
        Ok(())
    };
    // SAFETY: the caller gives live handles, a number and three numbers, or NULL.
    unsafe { ask(geodesic, mesh, (1, &raw const face, barycentric), answer) }
}
