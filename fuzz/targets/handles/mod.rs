//! The live objects of a sequence of calls. At its end all are freed, kind by kind.

use std::ptr::null_mut;

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use roundel::capi::*;

/// The number of objects of each kind that are kept, so that a sequence stays small.
const KEPT: usize = 3;

macro_rules! handles {
    ($($kind:ident: $type:ident, $free:ident;)*) => {
        #[derive(Default)]
        pub struct Handles {
            $(pub $kind: Vec<*mut $type>,)*
        }

        impl Drop for Handles {
            fn drop(&mut self) {
                $(for handle in self.$kind.drain(..) {
                    // SAFETY: the handle is live, and is not used again.
                    assert!(unsafe { $free(handle) } == roundel_status::ROUNDEL_OK);
                })*
            }
        }

        $(impl Freed for $type {
            unsafe fn free(handle: *mut Self) {
                // SAFETY: the caller's promise is passed on.
                unsafe { $free(handle) };
            }
        })*
    };
}

pub trait Freed {
    unsafe fn free(handle: *mut Self);
}

handles! {
    problems: roundel_problem, roundel_problem_free;
    options: roundel_options, roundel_options_free;
    solutions: roundel_solution, roundel_solution_free;
    solvers: roundel_solver, roundel_solver_free;
    meshes: roundel_mesh, roundel_mesh_free;
    guidances: roundel_guidance, roundel_guidance_free;
    fields: roundel_field, roundel_field_free;
    maps: roundel_map, roundel_map_free;
    quad_options: roundel_quad_options, roundel_quad_options_free;
    quads: roundel_quads, roundel_quads_free;
}

impl Handles {
    /// Keeps the object that a call made, instead of the oldest of its kind. A call that fails makes
    /// nothing.
    pub unsafe fn make<T: Freed>(
        &mut self,
        kind: impl Fn(&mut Handles) -> &mut Vec<*mut T>,
        call: impl FnOnce(*mut *mut T) -> roundel_status,
    ) -> roundel_status {
        let mut handle = null_mut();
        let status = call(&raw mut handle);
        assert_eq!(status == roundel_status::ROUNDEL_OK, !handle.is_null());
        if !handle.is_null() {
            let kept = kind(self);
            if kept.len() == KEPT {
                unsafe { T::free(kept.remove(0)) };
            }
            kept.push(handle);
        }
        status
    }
}

/// A random one of the objects, or NULL.
pub fn pick<T>(u: &mut Unstructured, from: &[*mut T]) -> Result<*mut T> {
    let at = u.int_in_range(0..=KEPT)?;
    Ok(from.get(at.min(from.len().saturating_sub(1))).copied().unwrap_or(null_mut()))
}

/// Options with limits so small that a fuzzer can wait for the solve.
pub unsafe fn modest_options(out: *mut *mut roundel_options) -> roundel_status {
    unsafe {
        let status = roundel_options_new(out);
        roundel_options_set_int(*out, c"nodes".as_ptr(), 500);
        roundel_options_set_int(*out, c"beam_width".as_ptr(), 4);
        status
    }
}

/// Quad options with limits as small.
pub unsafe fn modest_quad_options(out: *mut *mut roundel_quad_options) -> roundel_status {
    unsafe {
        let status = roundel_quad_options_new(out);
        let mut solve = null_mut();
        modest_options(&raw mut solve);
        roundel_quad_options_set_field_options(*out, solve);
        roundel_quad_options_set_map_options(*out, solve);
        roundel_options_free(solve);
        status
    }
}
