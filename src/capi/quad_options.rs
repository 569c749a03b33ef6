//! The handle of quad options: all options of the steps from a mesh to quads.

use std::ffi::c_char;

use super::failure::Outcome;
use super::guard::{self, Guarded, Object, boundary, object};
use super::guidance::roundel_guidance;
use super::input::{indices, slice, text};
use super::options::roundel_options;
use super::output::Out;
use super::status::roundel_status;
use crate::error::Error;
use crate::map::Sizing;
use crate::quad::QuadOptions;
use crate::search::OptionValue;

/// The options of quads: their size, their guidance, the solves of field and map, untangling and
/// smoothing. roundel_quad_option_info lists those that are set by name. New quad options are those of
/// the program `roundel quad` without flags: 1000 quads along the boundary and the curvature, adaptive
/// rounding for the field and lattice decoding for the map. The guidance is checked when quads are made.
/// If vary_curvature is 1, curvature may have less weight than the guidance gives it.
pub struct roundel_quad_options(Guarded<QuadOptions>);

object!(roundel_quad_options, QuadOptions, "quad options");

/// Makes quad options. To be freed with roundel_quad_options_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_new(
    options: *mut *mut roundel_quad_options,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a place for the handle, or NULL.
        let out = unsafe { Out::new("quad options", options) }?;
        out.set(guard::handle(QuadOptions::default()));
        Ok(())
    })
}

/// Frees quad options. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_free(
    options: *mut roundel_quad_options,
) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(options) }
}

/// An entry that changes quad options.
///
/// # Safety
/// `options` is NULL or a live handle that nobody else uses.
unsafe fn change(
    options: *mut roundel_quad_options,
    change: impl FnOnce(&mut QuadOptions) -> Outcome,
) -> roundel_status {
    // SAFETY: handed on.
    unsafe { guard::write(options, change) }
}

/// An entry that copies another handle's value into quad options; NULL stands for the value in new quad
/// options.
///
/// # Safety
/// As [`change`]; `given` is NULL or a live handle.
unsafe fn put<H: Object<Value: Clone>>(
    options: *mut roundel_quad_options,
    given: *const H,
    place: fn(&mut QuadOptions) -> &mut H::Value,
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        let mut default = QuadOptions::default();
        // SAFETY: handed on.
        let given = unsafe { guard::value_or(given, place(&mut default)) }?;
        place(options).clone_from(given);
        Ok(())
    };
    // SAFETY: handed on.
    unsafe { change(options, body) }
}

/// Sets a quad option, which roundel_quad_option_info lists, to a whole number. Options of type real take
/// whole numbers too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_int(
    options: *mut roundel_quad_options,
    name: *const c_char,
    value: i64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe {
        change(options, |options| {
            let value = OptionValue::Integer(value);
            Ok(options.set(text("option name", name)?, &value)?)
        })
    }
}

/// Sets a quad option, which roundel_quad_option_info lists, to a real number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_real(
    options: *mut roundel_quad_options,
    name: *const c_char,
    value: f64,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and a text, or NULL.
    unsafe {
        change(options, |options| {
            let value = OptionValue::Real(value);
            Ok(options.set(text("option name", name)?, &value)?)
        })
    }
}

/// Sets a quad option, which roundel_quad_option_info lists, to a text: one of its words, or "unset" if
/// the option may have no value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_text(
    options: *mut roundel_quad_options,
    name: *const c_char,
    value: *const c_char,
) -> roundel_status {
    // SAFETY: the caller gives a live handle and texts, or NULL.
    unsafe {
        change(options, |options| {
            let value = OptionValue::Text(text("option value", value)?.into());
            Ok(options.set(text("option name", name)?, &value)?)
        })
    }
}

/// Sets two edge lengths for each face, instead of a number of quads: along the arm that the field stores
/// there, and across it. `length` is twice the number of faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_edge_lengths(
    options: *mut roundel_quad_options,
    edge_lengths: *const f64,
    length: usize,
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        let lengths = unsafe { slice("edge lengths of faces", edge_lengths, length) }?;
        let (pairs, rest) = lengths.as_chunks::<2>();
        if !rest.is_empty() {
            Err(Error::InvalidArgument {
                what: format!("{length} edge lengths of faces: expected two a face"),
                index: None,
            })?;
        }
        options.sizing = Sizing::Lengths(pairs.to_vec());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(options, body) }
}

/// Adds a mirror plane about which the quads are symmetric: "x", "y" or "z" for the plane through the centre
/// of the bounding box and perpendicular to that axis, of which the side of larger coordinates is kept; "-x",
/// "-y" or "-z" for the other side; "auto" for the plane about which the mesh is most symmetric; or four
/// numbers "NX,NY,NZ,D" for the points p with N . p = D |N|, of which the side is kept to which N points.
/// Planes must be perpendicular to each other. roundel_mesh_mirror_plane tells which plane is meant.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another text. A plane that cuts nothing, or about which the
/// mesh is not symmetric within the option mirror_tolerance, is found when quads are made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_add_mirror(
    options: *mut roundel_quad_options,
    mirror: *const c_char,
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        // SAFETY: the caller gives a text, or NULL.
        let word = unsafe { text("mirror", mirror) }?;
        options.mirror.push(word.parse()?);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(options, body) }
}

/// Sets how dense quads are at every vertex of the mesh, as a factor of the number of their edges along a length;
/// none, if `length` is 0: evenly. All densities are above 0, and `length` is the number of vertices: both are
/// checked when quads are made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_density(
    options: *mut roundel_quad_options,
    densities: *const f64,
    length: usize,
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        let densities = unsafe { slice("densities of vertices", densities, length) }?;
        options.density = densities.to_vec();
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(options, body) }
}

/// Sets the vertices that sizes change near where the option `near` is "vertices".
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_near_vertices(
    options: *mut roundel_quad_options,
    count: usize,
    vertices: *const i32,
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        let what = "vertices that sizes change near";
        // SAFETY: the caller gives an array of `count` numbers, or NULL.
        options.near_vertices = unsafe { indices(what, vertices, count, i32::MAX as usize + 1) }?;
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(options, body) }
}

/// Sets the guidance of the quads to a copy of `guidance`. NULL stands for the boundary and the
/// curvature, as roundel_guidance_new_for_quads makes it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_guidance(
    options: *mut roundel_quad_options,
    guidance: *const roundel_guidance,
) -> roundel_status {
    // SAFETY: the caller gives live handles, or NULL.
    unsafe { put(options, guidance, |options| &mut options.guidance) }
}

/// Sets the options of the field's solve to a copy of `solve`; NULL stands for adaptive rounding.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_field_options(
    options: *mut roundel_quad_options,
    solve: *const roundel_options,
) -> roundel_status {
    // SAFETY: the caller gives live handles, or NULL.
    unsafe { put(options, solve, |options| &mut options.field) }
}

/// Sets the options of the map's solve to a copy of `solve`; NULL stands for lattice decoding.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_map_options(
    options: *mut roundel_quad_options,
    solve: *const roundel_options,
) -> roundel_status {
    // SAFETY: the caller gives live handles, or NULL.
    unsafe { put(options, solve, |options| &mut options.map) }
}
