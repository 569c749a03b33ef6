//! The sources handle: what geodesic distances are measured from.

use super::failure::Outcome;
use super::guard::{self, Guarded, boundary, object};
use super::input::{indices, slice};
use super::mesh::{reserved, roundel_mesh, times_three};
use super::output::Out;
use super::status::roundel_status;
use crate::geodesic::{Source, SurfacePoint};
use crate::mesh::TriangleMesh;

/// Sources of geodesic distances, numbered from 0 as they are added: vertices, points, polylines and sets of
/// edges. Distance is 0 on all of a source. Numbers of vertices, faces and edges are those of the mesh that the
/// sources are used with, and are checked when they are used.
pub struct roundel_sources(Guarded<Vec<Source>>);

object!(roundel_sources, Vec<Source>, "sources");

/// Makes an empty list of sources. To be freed with roundel_sources_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_new(sources: *mut *mut roundel_sources) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("sources", sources) }?;
        out.set(guard::handle(Vec::new()));
        Ok(())
    })
}

/// Frees sources. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_free(sources: *mut roundel_sources) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(sources) }
}

/// The caller's numbers of elements, of a mesh that is not known yet.
///
/// # Safety
/// `values` is NULL or has `count` entries.
unsafe fn elements(what: &'static str, values: *const i32, count: usize) -> Outcome<Vec<usize>> {
    // SAFETY: handed on.
    unsafe { indices(what, values, count, i32::MAX as usize + 1) }
}

/// The caller's points of a surface.
///
/// # Safety
/// The arrays are NULL or have `count` and three times `count` entries.
pub(super) unsafe fn points(
    count: usize,
    faces: *const i32,
    barycentric: *const f64,
) -> Outcome<Vec<SurfacePoint>> {
    let length = times_three("barycentric coordinates", count)?;
    // SAFETY: handed on.
    let (faces, weights) = unsafe {
        (
            elements("faces of points", faces, count)?,
            slice("barycentric coordinates", barycentric, length)?,
        )
    };
    let mut points = reserved("points of the surface", count)?;
    let both = faces.into_iter().zip(weights.as_chunks::<3>().0);
    points.extend(both.map(|(face, &barycentric)| SurfacePoint { face, barycentric }));
    Ok(points)
}

/// Adds `count` vertices, each a source.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_add_vertices(
    sources: *mut roundel_sources,
    count: usize,
    vertices: *const i32,
) -> roundel_status {
    let body = |sources: &mut Vec<Source>| {
        // SAFETY: the caller gives an array of `count` numbers, or NULL.
        let vertices = unsafe { elements("source vertices", vertices, count) }?;
        sources.extend(vertices.into_iter().map(Source::Vertex));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(sources, body) }
}

/// Adds `count` points of the surface, each a source: a face each, and in `barycentric` the weights of its three
/// corners, which add up to 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_add_points(
    sources: *mut roundel_sources,
    count: usize,
    faces: *const i32,
    barycentric: *const f64,
) -> roundel_status {
    let body = |sources: &mut Vec<Source>| {
        // SAFETY: the caller gives arrays of `count` and 3 `count` numbers, or NULL.
        let points = unsafe { points(count, faces, barycentric) }?;
        sources.extend(points.into_iter().map(Source::Point));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(sources, body) }
}

/// Adds a polyline through `count` points, given as for roundel_sources_add_points: one source. Points that follow
/// each other lie on a common face, its boundary included. If `closed` is not 0, a segment joins the last point
/// with the first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_add_polyline(
    sources: *mut roundel_sources,
    count: usize,
    faces: *const i32,
    barycentric: *const f64,
    closed: i32,
) -> roundel_status {
    let body = |sources: &mut Vec<Source>| {
        // SAFETY: the caller gives arrays of `count` and 3 `count` numbers, or NULL.
        let points = unsafe { points(count, faces, barycentric) }?;
        sources.push(Source::Polyline {
            points,
            closed: closed != 0,
        });
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(sources, body) }
}

/// Adds a set of `count` edges: one source.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_add_edges(
    sources: *mut roundel_sources,
    count: usize,
    edges: *const i32,
) -> roundel_status {
    let body = |sources: &mut Vec<Source>| {
        // SAFETY: the caller gives an array of `count` numbers, or NULL.
        let edges = unsafe { elements("source edges", edges, count) }?;
        sources.push(Source::Edges(edges));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(sources, body) }
}

/// Adds the boundary of a mesh: each loop a source.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_add_boundary(
    sources: *mut roundel_sources,
    mesh: *const roundel_mesh,
) -> roundel_status {
    let body = |sources: &mut Vec<Source>| {
        // SAFETY: the caller gives a live mesh, or NULL.
        let mesh: &TriangleMesh = unsafe { guard::value(mesh) }?;
        sources.extend(Source::boundary(mesh));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::write(sources, body) }
}

/// Gives the number of sources.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_sources_count(
    sources: *const roundel_sources,
    count: *mut usize,
) -> roundel_status {
    let body = |sources: &Vec<Source>| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("count", count) }?;
        out.set(sources.len());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(sources, body) }
}
