//! The guidance handle: the requirements of a field and of the map that follows it.

use std::ffi::c_char;

use super::failure::Outcome;
use super::guard::{self, Guarded, boundary, object};
use super::guidance_files::read_features;
use super::input::{indices, path, slice, text};
use super::mesh::roundel_mesh;
use super::output::{Out, copy_numbers};
use super::status::roundel_status;
use crate::error::Error;
use crate::field::{Constraint, Guidance, Guide, PrescribedIndex};
use crate::mesh::TriangleMesh;
use crate::quad::QuadOptions;
use crate::search::OptionValue;

/// The requirements of a field, and the edges that become isolines of its map: features, the boundary,
/// given directions, the curvature, given indices. If several give a direction for one face, the first of
/// these decides: a given direction, a feature or the boundary, a reliable curvature.
///
/// roundel_guidance_option_info lists its options. A new guidance asks for crosses that follow the
/// boundary, and for nothing else; NULL stands for the same wherever a function takes a guidance. Numbers
/// of faces, edges and vertices are those of the mesh that the guidance is used with, and are checked
/// when it is used.
pub struct roundel_guidance(Guarded<Guidance>);

object!(roundel_guidance, Guidance, "guidance");

/// Makes a guidance. To be freed with roundel_guidance_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_new(
    guidance: *mut *mut roundel_guidance,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("guidance", guidance) }?;
        out.set(guard::handle(Guidance::default()));
        Ok(())
    })
}

/// Makes the default guidance of quads: crosses that follow the boundary and the curvature. To be freed
/// with roundel_guidance_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_new_for_quads(
    guidance: *mut *mut roundel_guidance,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("guidance", guidance) }?;
        out.set(guard::handle(QuadOptions::default().guidance));
        Ok(())
    })
}

/// Frees a guidance. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_free(guidance: *mut roundel_guidance) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(guidance) }
}

/// An entry that changes a guidance.
///
/// # Safety
/// `guidance` is NULL or a live handle that nobody else uses.
unsafe fn change(
    guidance: *mut roundel_guidance,
    change: impl FnOnce(&mut Guidance) -> Outcome,
) -> roundel_status {
    // SAFETY: handed on.
    unsafe { guard::write(guidance, change) }
}

/// Sets an option of a guidance, which roundel_guidance_option_info lists, to a whole number. Options of
/// type real take whole numbers too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_int(
    guidance: *mut roundel_guidance,
    name: *const c_char,
    value: i64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe {
        change(guidance, |guidance| {
            let value = OptionValue::Integer(value);
            Ok(guidance.set(text("option name", name)?, &value)?)
        })
    }
}

/// Sets an option of a guidance, which roundel_guidance_option_info lists, to a real number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_real(
    guidance: *mut roundel_guidance,
    name: *const c_char,
    value: f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe {
        change(guidance, |guidance| {
            let value = OptionValue::Real(value);
            Ok(guidance.set(text("option name", name)?, &value)?)
        })
    }
}

/// Sets an option of a guidance, which roundel_guidance_option_info lists, to a text: one of its words,
/// or "unset" if the option may have no value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_text(
    guidance: *mut roundel_guidance,
    name: *const c_char,
    value: *const c_char,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and texts, or NULL.
    unsafe {
        change(guidance, |guidance| {
            let value = OptionValue::Text(text("option value", value)?.into());
            Ok(guidance.set(text("option name", name)?, &value)?)
        })
    }
}

/// The caller's numbers of elements, of a mesh that is not known yet.
///
/// # Safety
/// `values` is NULL or has `count` entries.
unsafe fn elements(what: &'static str, values: *const i32, count: usize) -> Outcome<Vec<usize>> {
    // SAFETY: handed on.
    unsafe { indices(what, values, count, i32::MAX as usize + 1) }
}

/// Fixes the directions of `count` faces. `angles` are those of one arm, in radians, counter-clockwise
/// about the normal from the face's first edge. Each face may be named at most once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_constraints(
    guidance: *mut roundel_guidance,
    count: usize,
    faces: *const i32,
    angles: *const f64,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        // SAFETY: the caller gives arrays of the length given, or NULL.
        let (faces, angles) = unsafe {
            (
                elements("constrained faces", faces, count)?,
                slice("constrained angles", angles, count)?,
            )
        };
        let pairs = faces.into_iter().zip(angles);
        let given = pairs.map(|(face, &angle)| Constraint { face, angle });
        guidance.constraints = given.collect();
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Sets the preferred directions of `count` faces, each named at most once. A deviation costs its square
/// times the weight; a deviation between neighbouring faces costs its square. A face with a fixed
/// direction keeps it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_guides(
    guidance: *mut roundel_guidance,
    count: usize,
    faces: *const i32,
    angles: *const f64,
    weights: *const f64,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        // SAFETY: the caller gives arrays of the length given, or NULL.
        let (faces, angles, weights) = unsafe {
            (
                elements("guided faces", faces, count)?,
                slice("guiding angles", angles, count)?,
                slice("guiding weights", weights, count)?,
            )
        };
        let triples = faces.into_iter().zip(angles).zip(weights);
        let given = triples.map(|((face, &angle), &weight)| Guide {
            face,
            angle,
            weight,
        });
        guidance.guides = given.collect();
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Prescribes all irregular vertices: `count` vertices of the interior, each once, and their indices in
/// `steps` of 1/N; all others become regular. On closed meshes the indices must sum to the Euler
/// characteristic, which is checked when the field is made. roundel_guidance_clear_indices undoes this.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_indices(
    guidance: *mut roundel_guidance,
    count: usize,
    vertices: *const i32,
    steps: *const i32,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        // SAFETY: the caller gives arrays of the length given, or NULL.
        let (vertices, steps) = unsafe {
            (
                elements("vertices with an index", vertices, count)?,
                slice("steps", steps, count)?,
            )
        };
        let pairs = vertices.into_iter().zip(steps);
        let given = pairs.map(|(vertex, &steps)| PrescribedIndex { vertex, steps });
        guidance.indices = Some(given.collect());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Drops prescribed indices, so that the energy decides them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_clear_indices(
    guidance: *mut roundel_guidance,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        guidance.indices = None;
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Makes `count` edges features, by number. They replace the features that were set before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_feature_edges(
    guidance: *mut roundel_guidance,
    count: usize,
    edges: *const i32,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        // SAFETY: the caller gives an array of the length given, or NULL.
        guidance.feature_edges = unsafe { elements("feature edges", edges, count) }?;
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Makes the edges between `count` pairs of vertices features. They replace the features that were set
/// before. `vertices` has twice as many entries.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_set_feature_lines(
    guidance: *mut roundel_guidance,
    count: usize,
    vertices: *const i32,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        let ends = count.checked_mul(2).ok_or_else(|| Error::Overflow {
            what: format!("twice {count} vertices are more than memory can hold"),
            index: None,
        })?;
        // SAFETY: the caller gives an array of that length, or NULL.
        let vertices = unsafe { elements("vertices of feature lines", vertices, ends) }?;
        guidance.feature_lines = vertices.as_chunks::<2>().0.to_vec();
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Reads guidance from a text file, one request a line, and adds it: "direction FACE X Y Z" for a
/// direction that the face has, the same with a weight for one that it should have, "edge VERTEX
/// VERTEX" for a feature, "index VERTEX STEPS" for an irregular vertex. A comment begins with #.
///
/// Fails with ROUNDEL_ERROR_IO, and with ROUNDEL_ERROR_PARSE and the line for a line that is none of
/// these or names an element that the mesh does not have. A failure leaves the guidance unchanged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_read(
    guidance: *mut roundel_guidance,
    mesh: *const roundel_mesh,
    file: *const c_char,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        // SAFETY: the caller gives a live handle and a text, or NULL.
        let (mesh, file): (&TriangleMesh, _) =
            unsafe { (guard::value(mesh)?, path("file", file)?) };
        Ok(guidance.read(mesh, file)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Adds the line elements of an OBJ file, which has the vertices of the mesh, to the feature edges.
///
/// Fails with ROUNDEL_ERROR_IO, and with ROUNDEL_ERROR_PARSE and the line for a line between vertices
/// that no edge joins. A failure leaves the guidance unchanged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_guidance_read_features(
    guidance: *mut roundel_guidance,
    mesh: *const roundel_mesh,
    file: *const c_char,
) -> roundel_status {
    let body = |guidance: &mut Guidance| {
        // SAFETY: the caller gives a live handle and a text, or NULL.
        let (mesh, file): (&TriangleMesh, _) =
            unsafe { (guard::value(mesh)?, path("file", file)?) };
        guidance.feature_edges.extend(read_features(mesh, file)?);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(guidance, body) }
}

/// Marks the feature edges of a guidance on a mesh: 1 for each, 0 for all others. `length` is the number
/// of edges. `guidance` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_mesh_mark_features(
    mesh: *const roundel_mesh,
    guidance: *const roundel_guidance,
    marks: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        let default = Guidance::default();
        // SAFETY: the caller gives a live handle, or NULL.
        let guidance = unsafe { guard::value_or(guidance, &default) }?;
        let features = guidance.features(mesh)?;
        let edges = 0..mesh.edge_count();
        let found = edges.map(|e| i32::from(features.contains(e)));
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("marks of edges", found, marks, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}
