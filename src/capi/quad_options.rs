//! The handle of quad options: all that can be decided on the way from a mesh to quads.

use super::failure::Outcome;
use super::guard::{self, Guarded, Object, boundary, object};
use super::guidance::roundel_guidance;
use super::input::slice;
use super::options::roundel_options;
use super::output::Out;
use super::status::roundel_status;
use crate::Error;
use crate::map::Sizing;
use crate::quad::QuadOptions;
use crate::smooth::SmoothOptions;

/// How to make quads: their size, what they follow, how field and map are solved, untangling and
/// smoothing. A new one is what the program `roundel quad` does without flags: 1000 quads along the
/// boundary and the curvature, the field's integers decided adaptively and the map's by lattice
/// decoding. Sizes and guidance are checked when quads are made.
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

/// An entry that decides yes or no by a number.
///
/// # Safety
/// As [`change`].
unsafe fn decide(
    options: *mut roundel_quad_options,
    what: &str,
    number: i32,
    set: impl FnOnce(&mut QuadOptions, bool),
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        let yes = match number {
            0 => false,
            1 => true,
            _ => Err(Error::InvalidArgument {
                what: format!("{what} by 1 or not by 0, not {number}"),
                index: None,
            })?,
        };
        set(options, yes);
        Ok(())
    };
    // SAFETY: handed on.
    unsafe { change(options, body) }
}

/// An entry that puts a copy of another handle's value in its place; NULL stands for what new quad
/// options have there.
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

/// Aims at a number of quads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_quads(
    options: *mut roundel_quad_options,
    quads: usize,
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        options.sizing = Sizing::Quads(quads);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(options, body) }
}

/// Aims at edges of one length instead, in units of the mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_edge_length(
    options: *mut roundel_quad_options,
    edge_length: f64,
) -> roundel_status {
    let body = |options: &mut QuadOptions| {
        options.sizing = Sizing::EdgeLength(edge_length);
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(options, body) }
}

/// Aims at edges of two lengths a face instead: along the arm that the field stores there, and
/// across it. `length` is twice the number of faces.
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
                what: format!("{length} edge lengths of faces: two a face are"),
                index: None,
            })?;
        }
        options.sizing = Sizing::Lengths(pairs.to_vec());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { change(options, body) }
}

/// Sets what quads follow, by a copy of `guidance`; NULL stands for the boundary and the curvature,
/// which is what roundel_guidance_new_for_quads makes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_guidance(
    options: *mut roundel_quad_options,
    guidance: *const roundel_guidance,
) -> roundel_status {
    // SAFETY: the caller gives live handles, or NULL.
    unsafe { put(options, guidance, |options| &mut options.guidance) }
}

/// Sets whether curvature may count for less than the guidance has it, where the map is less
/// distorted then: 1, as at first, or 0. On meshes that are not large a few fields are tried.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_vary_curvature(
    options: *mut roundel_quad_options,
    vary: i32,
) -> roundel_status {
    let set = |options: &mut QuadOptions, yes: bool| options.vary_curvature = yes;
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { decide(options, "curvature is varied", vary, set) }
}

/// Sets how the field is solved for, by a copy of `solve`; NULL stands for adaptive rounding.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_field_options(
    options: *mut roundel_quad_options,
    solve: *const roundel_options,
) -> roundel_status {
    // SAFETY: the caller gives live handles, or NULL.
    unsafe { put(options, solve, |options| &mut options.field) }
}

/// Sets how the map is solved for, by a copy of `solve`; NULL stands for lattice decoding.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_map_options(
    options: *mut roundel_quad_options,
    solve: *const roundel_options,
) -> roundel_status {
    // SAFETY: the caller gives live handles, or NULL.
    unsafe { put(options, solve, |options| &mut options.map) }
}

/// Sets whether a map is untangled whose folds extraction cannot cope with: 1, as at first, or 0.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_untangle(
    options: *mut roundel_quad_options,
    untangle: i32,
) -> roundel_status {
    let set = |options: &mut QuadOptions, yes: bool| options.untangle = yes;
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { decide(options, "maps are untangled", untangle, set) }
}

/// Sets whether quads are smoothed: 1, as at first, or 0, which leaves vertices where the map has
/// them.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for another number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quad_options_set_smooth(
    options: *mut roundel_quad_options,
    smooth: i32,
) -> roundel_status {
    let set =
        |options: &mut QuadOptions, yes: bool| options.smooth = yes.then(SmoothOptions::default);
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { decide(options, "quads are smoothed", smooth, set) }
}
