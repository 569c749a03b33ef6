//! The quads handle: extracted from a map, or made from a mesh in one call.

use std::ops::Deref;

use super::event::{monitor as watched_by, roundel_monitor, watchers};
use super::guard::{self, Guarded, object};
use super::guidance::roundel_guidance;
use super::input::slice;
use super::map::{Mapped, roundel_map};
use super::mesh::roundel_mesh;
use super::output::Out;
use super::quad_options::roundel_quad_options;
use super::status::roundel_status;
use crate::error::Error;
use crate::extract::{IntegerGridMap, QuadMesh, extract};
use crate::field::Guidance;
use crate::mesh::TriangleMesh;
use crate::monitor::Monitor;
use crate::quad::{QuadOptions, quadrangulate};
use crate::smooth::{SmoothOptions, smooth};

/// A mesh of quads with shared vertices. Where a map gives no quads, other polygons are kept beside them.
/// The mesh and the map may be freed before the quads.
pub struct roundel_quads(Guarded<Quads>);

/// Quads, and what is known of those that were made in one call.
pub(super) struct Quads {
    mesh: QuadMesh,
    /// See [`Quadrangulation`](crate::quad::Quadrangulation).
    near_features: Option<usize>,
    /// The number of faces whose quads are pairs.
    paired: usize,
}

impl Quads {
    pub(super) fn extracted(mesh: QuadMesh) -> Self {
        Quads {
            mesh,
            near_features: None,
            paired: 0,
        }
    }
}

impl Deref for Quads {
    type Target = QuadMesh;

    fn deref(&self) -> &QuadMesh {
        &self.mesh
    }
}

object!(roundel_quads, Quads, "quads");

/// Makes quads of a mesh: field, map, extraction and smoothing in one call. `options` may be NULL
/// for new quad options, `monitor` for none. Features, and the boundary where it is followed, become
/// chains of the quads' edges. roundel_quads_is_conforming tells whether all faces are quads.
///
/// Fails as roundel_field_solve and roundel_map_solve do, and with ROUNDEL_ERROR_INVALID_ARGUMENT,
/// ROUNDEL_ERROR_NOT_FINITE or ROUNDEL_ERROR_LENGTH_MISMATCH for an invalid size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_make(
    mesh: *const roundel_mesh,
    options: *const roundel_quad_options,
    monitor: *const roundel_monitor,
    quads: *mut *mut roundel_quads,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let default = QuadOptions::default();
        // SAFETY: the caller gives live handles, a monitor as its members say and a place, or NULL.
        let (options, monitor, out) = unsafe {
            (
                guard::value_or(options, &default)?,
                watchers(monitor)?,
                Out::new("quads", quads)?,
            )
        };
        let made = quadrangulate(mesh, options, monitor)?;
        out.set(guard::handle(Quads {
            mesh: made.quads,
            near_features: Some(made.near_features),
            paired: made.paired.len(),
        }));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Extracts the quads of the last solve of a map, which may have flipped faces.
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
        out.set(guard::handle(Quads::extracted(found)));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(map, body) }
}

/// Extracts the quads of any integer-grid map, given by u, v of the three corners of every face. Across
/// seams coordinates turn by quarter turns and shift by integers, and irregular vertices lie on integers.
/// `length` is six times the number of faces.
///
/// Fails with ROUNDEL_ERROR_NOT_FINITE and ROUNDEL_ERROR_OVERFLOW with the face, and with
/// ROUNDEL_ERROR_INVALID_ARGUMENT with the edge that is no such seam, or with the vertex around which
/// coordinates close at no integer point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_extract_from_uvs(
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
        let found = extract(mesh, &exact, &mut Monitor::default())?;
        out.set(guard::handle(Quads::extracted(found)));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}

/// Moves the vertices of quads over the mesh that they were extracted from, so that the quads become
/// squares of one size. Vertices stay on the features of `guidance` and on the boundary; NULL stands for
/// no features. A failure leaves the quads unchanged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_smooth(
    quads: *mut roundel_quads,
    mesh: *const roundel_mesh,
    guidance: *const roundel_guidance,
    monitor: *const roundel_monitor,
) -> roundel_status {
    let body = |quads: &mut Quads| {
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
        let mut moved = quads.mesh.clone();
        smooth(&mut moved, mesh, &options, &mut monitor)?;
        quads.mesh = moved;
        Ok(())
    };
    // SAFETY: the caller gives a live handle that nobody else uses, or NULL.
    unsafe { guard::write(quads, body) }
}

/// Gives the number of irregular vertices of the field that lie nearer to features than they should, an edge of the
/// quads or the clearance of the guidance, but not on them. Smoothing does not change it.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for quads that roundel_quads_make did not make.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_near_feature_count(
    quads: *const roundel_quads,
    count: *mut usize,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("near feature count", count) }?;
        out.set(quads.near_features.ok_or_else(|| Error::InvalidArgument {
            what: "these quads were extracted from a map: nobody looked for features".into(),
            index: None,
        })?);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

/// Gives the number of triangles of the mesh whose quads are pairs of them, because no map had quads that conform and
/// cover the surface there: 0 where all quads are those of a map.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_paired_face_count(
    quads: *const roundel_quads,
    count: *mut usize,
) -> roundel_status {
    let body = |quads: &Quads| {
        // SAFETY: the caller gives a place for the number, or NULL.
        let out = unsafe { Out::new("paired face count", count) }?;
        out.set(quads.paired);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

/// Frees quads. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_free(quads: *mut roundel_quads) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(quads) }
}
