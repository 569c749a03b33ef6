//! The quads handle: extracted from a map, or made from a mesh in one call.

use super::error::Outcome;
use super::event::{monitor as watched_by, roundel_monitor, watchers};
use super::guard::{self, Guarded, boundary, object};
use super::guidance::roundel_guidance;
use super::input::slice;
use super::map::{Mapped, roundel_map};
use super::mesh::{roundel_mesh, triangles};
use super::options::roundel_options;
use super::output::Out;
use super::status::roundel_status;
use crate::extract::{IntegerGridMap, QuadMesh, extract};
use crate::field::Guidance;
use crate::map::Sizing;
use crate::mesh::TriangleMesh;
use crate::quad::{QuadOptions, quadrangulate};
use crate::smooth::{SmoothOptions, smooth};
use crate::{Error, Monitor};

/// A mesh of quads with shared vertices. Where a map leaves no quads to be made, other polygons are
/// kept beside them. It does not need the mesh and the map that it is from any more.
pub struct roundel_quads(Guarded<QuadMesh>);

object!(roundel_quads, QuadMesh, "quads");
/// Turns `face_count` triangles, given as for roundel_mesh_new, into about `quad_count` quads: field,
/// map, extraction and smoothing in one call, under the eyes of `monitor`.
///
/// `guidance` says what the quads follow; its features, and the boundary where it is followed,
/// become chains of their edges. NULL stands for the boundary and the curvature. `options` are those
/// of both solves; NULL stands for lattice decoding of the map and adaptive rounding of the field.
/// `monitor` may be NULL.
///
/// Fails as roundel_mesh_new, roundel_field_solve and roundel_map_solve do, and with
/// ROUNDEL_ERROR_INVALID_ARGUMENT for no quads. Whether all faces are quads tells
/// roundel_quads_is_conforming.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quadrangulate(
    vertex_count: usize,
    coordinates: *const f64,
    face_count: usize,
    corners: *const i32,
    quad_count: usize,
    guidance: *const roundel_guidance,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    quads: *mut *mut roundel_quads,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives arrays of the lengths given or NULL.
        let mesh = unsafe { triangles((vertex_count, coordinates), (face_count, corners)) }?;
        // SAFETY: the caller gives live handles, a monitor as its members say, or NULL.
        unsafe { make(&mesh, quad_count, guidance, options, monitor, quads) }
    })
}

/// roundel_quadrangulate for a mesh that is there already.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_make(
    mesh: *const roundel_mesh,
    quad_count: usize,
    guidance: *const roundel_guidance,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    quads: *mut *mut roundel_quads,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives live handles, a monitor as its members say, or NULL.
        unsafe { make(mesh, quad_count, guidance, options, monitor, quads) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// # Safety
/// As the callers of the entries above say.
unsafe fn make(
    mesh: &TriangleMesh,
    quad_count: usize,
    guidance: *const roundel_guidance,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    quads: *mut *mut roundel_quads,
) -> Outcome {
    let default = QuadOptions::default();
    // SAFETY: handed on.
    let (monitor, out, wanted) = unsafe {
        let wanted = QuadOptions {
            sizing: Sizing::Quads(quad_count),
            vary_curvature: guidance.is_null(),
            guidance: guard::value_or(guidance, &default.guidance)?.clone(),
            field: guard::value_or(options, &default.field)?.clone(),
            map: guard::value_or(options, &default.map)?.clone(),
            ..default
        };
        (watchers(monitor)?, Out::new("quads", quads)?, wanted)
    };
    out.set(guard::handle(quadrangulate(mesh, &wanted, monitor)?.quads));
    Ok(())
}

/// Extracts the quads of the last solve of a map. Faces that the map turns over are coped with.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a map that has not been solved for, or whose
/// integers were not decided.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_extract(
    map: *const roundel_map,
    quads: *mut *mut roundel_quads,
) -> roundel_status {
    let body = |map: &Mapped| {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("quads", quads) }?;
        let exact = IntegerGridMap::from_seamless(map.mesh(), &map.found()?.map)?;
        let found = extract(map.mesh(), &exact, &mut Monitor::default())?;
        out.set(guard::handle(found));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}

/// Extracts the quads of an integer-grid map from anywhere: u, v of the three corners of every face.
/// Over seams coordinates turn by quarters and shift by integers, and irregular vertices lie on
/// integers. `length` is six times the number of faces.
///
/// Fails with ROUNDEL_ERROR_NOT_FINITE and ROUNDEL_ERROR_OVERFLOW with the face,
/// ROUNDEL_ERROR_INVALID_ARGUMENT with the edge that is no such seam or the vertex around which
/// coordinates close at no integer point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_extract_uvs(
    mesh: *const roundel_mesh,
    uvs: *const f64,
    length: usize,
    quads: *mut *mut roundel_quads,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives an array of the length given and a place, or NULL.
        let (out, uvs) = unsafe {
            (
                Out::new("quads", quads)?,
                slice("coordinates of corners", uvs, length)?,
            )
        };
        let (corners, rest) = uvs.as_chunks::<2>().0.as_chunks::<3>();
        if !rest.is_empty() || 6 * corners.len() != length {
            Err(Error::LengthMismatch {
                what: "coordinates of corners",
                expected: 6 * mesh.face_count(),
                actual: length,
            })?;
        }
        let exact = IntegerGridMap::new(mesh, corners)?;
        out.set(guard::handle(extract(
            mesh,
            &exact,
            &mut Monitor::default(),
        )?));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Moves the vertices of quads over the mesh that they were extracted from, towards squares of one
/// size. They stay on the features of `guidance` and on the boundary; NULL stands for no features.
/// After a failure the quads are what they were.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_smooth(
    quads: *mut roundel_quads,
    mesh: *const roundel_mesh,
    guidance: *const roundel_guidance,
    monitor: *const roundel_monitor,
) -> roundel_status {
    let body = |quads: &mut QuadMesh| {
        let default = Guidance::default();
        // SAFETY: the caller gives live handles and a monitor as its members say, or NULL.
        let (mesh, guidance, mut monitor): (&TriangleMesh, _, _) = unsafe {
            (
                guard::value(mesh)?,
                guard::value_or(guidance, &default)?,
                watched_by(monitor)?,
            )
        };
        let options = SmoothOptions {
            features: guidance.features(mesh)?.edges().collect(),
            ..SmoothOptions::default()
        };
        let mut moved = quads.clone();
        smooth(&mut moved, mesh, &options, &mut monitor)?;
        *quads = moved;
        Ok(())
    };
    // SAFETY: the caller gives a live handle that nobody else uses, or NULL.
    unsafe { guard::write(quads, body) }
}

/// Frees quads. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_free(quads: *mut roundel_quads) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(quads) }
}
