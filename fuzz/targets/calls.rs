//! Random sequences of C calls that satisfy the contract: handles are live and arrays have the stated
//! lengths. Every call returns a known status, and none panics.
#![no_main]

mod handles;

use std::ffi::{CString, c_char};
use std::ptr::null;

use handles::{Handles, pick};
use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use roundel::capi::*;

fuzz_target!(|bytes: &[u8]| {
    let mut handles = Handles::default();
    let mut u = Unstructured::new(bytes);
    while !u.is_empty() && call(&mut u, &mut handles).is_ok() {}
});

/// Checks the status of a call: it is known, it comes with a message, and it is not a panic.
fn known(status: roundel_status) {
    let number = status as i32;
    // SAFETY: the function returns a static text.
    let name = unsafe { std::ffi::CStr::from_ptr(roundel_status_name(number)) };
    assert_ne!(name.to_bytes(), b"unknown");
    if status != roundel_status::ROUNDEL_OK {
        let mut text: [c_char; 400] = [0; 400];
        // SAFETY: the buffer has the given length, and the call ends the text with a zero.
        assert!(unsafe { roundel_last_error_message(text.as_mut_ptr(), text.len()) } > 0);
        // SAFETY: see above.
        let text = unsafe { std::ffi::CStr::from_ptr(text.as_ptr()) };
        assert!(number < 90, "{}", text.to_string_lossy());
    }
}

fn call(u: &mut Unstructured, h: &mut Handles) -> Result<()> {
    let which = u.int_in_range(0..=43)?;
    if matches!(which, 14..=39 | 42..=43) { used(u, h, which) } else { built(u, h, which) }
}

/// Calls that build problems and options.
fn built(u: &mut Unstructured, h: &mut Handles, which: u8) -> Result<()> {
    let (reals, ints) = (reals(u)?, ints(u)?);
    let count = reals.len().min(ints.len());
    let (x, i) = (reals.as_ptr(), ints.as_ptr());
    let problem = pick(u, &h.problems)?;
    let (a, b): (f64, i64) = (number(u)?, i64::from(u.arbitrary::<i8>()?));
    let triangle = u.int_in_range(-1..=3)?;
    // SAFETY: handles are live or NULL, and arrays have the stated lengths.
    known(unsafe {
        match which {
            0 => h.make(|h| &mut h.problems, |out| roundel_problem_new(b.unsigned_abs() as usize % 8, out)),
            1 => roundel_problem_add_quadratic_triplets(problem, triangle, count, i, i, x),
            2 => roundel_problem_add_quadratic_csr(problem, triangle, ints.len(), i, count, i, x),
            3 => roundel_problem_add_quadratic_csc(problem, triangle, ints.len(), i, count, i, x),
            4 => roundel_problem_add_linear(problem, x, reals.len()),
            5 => roundel_problem_add_linear_term(problem, b, a),
            6 => roundel_problem_add_least_squares(problem, count, i, x, a, 1.0, std::ptr::null_mut()),
            7 => roundel_problem_add_constraint(problem, count, i, x, a),
            8 => roundel_problem_set_integers(problem, ints.len(), i),
            9 => roundel_problem_pin(problem, b, a),
            10 => roundel_problem_set_guess(problem, x, reals.len()),
            11 => {
                let signs: Vec<i8> = ints.iter().map(|&k| (k % 3 - 1) as i8).collect();
                roundel_problem_hint_cycles(problem, ints.len(), i, signs.len(), i, signs.as_ptr())
            }
            12 => h.make(|h| &mut h.problems, |out| roundel_problem_clone(problem, out)),
            40 | 41 => {
                let n = reals.len();
                let add = match which {
                    40 => roundel_problem_add_least_squares_csr,
                    _ => roundel_problem_add_least_squares_csc,
                };
                let weights = if b > 0 { x } else { null() };
                add(problem, ints.len(), i, count, i, x, n, x, weights, std::ptr::null_mut())
            }
            _ => {
                let n = reals.len();
                roundel_problem_add_constraints_csr(
                    problem, ints.len(), i, count, i, x, n, x, std::ptr::null_mut(),
                )
            }
        }
    });
    Ok(())
}

/// Calls that solve, and calls on meshes.
fn used(u: &mut Unstructured, h: &mut Handles, which: u8) -> Result<()> {
    let (reals, ints) = (reals(u)?, ints(u)?);
    let count = reals.len().min(ints.len());
    let (x, i) = (reals.as_ptr(), ints.as_ptr());
    let (problem, solver) = (pick(u, &h.problems)?, pick(u, &h.solvers)?);
    let (options, solution) = (pick(u, &h.options)?, pick(u, &h.solutions)?);
    let (mesh, guidance) = (pick(u, &h.meshes)?, pick(u, &h.guidances)?);
    let (field, map, quad) = (pick(u, &h.fields)?, pick(u, &h.maps)?, pick(u, &h.quad_options)?);
    let (a, b): (f64, i64) = (number(u)?, i64::from(u.arbitrary::<i8>()?));
    let (name, value) = (name(u)?, name(u)?);
    let shape = [c"disk", c"sphere", c"torus", c"plane"][b.unsigned_abs() as usize % 4].as_ptr();
    let mut place = reals.clone();
    let (out, room) = (place.as_mut_ptr(), place.len());
    let small = b.unsigned_abs() as usize % 60;
    // SAFETY: handles are live or NULL, and arrays have the stated lengths.
    known(unsafe {
        match which {
            14 => h.make(|h| &mut h.options, |out| handles::modest_options(out)),
            15 => roundel_options_set_text(options, name.as_ptr(), value.as_ptr()),
            16 => roundel_options_set_int(options, name.as_ptr(), b),
            17 => roundel_options_set_real(options, name.as_ptr(), a.min(100.0)),
            18 => h.make(|h| &mut h.solutions, |out| roundel_problem_solve(problem, options, null(), out)),
            19 => h.make(|h| &mut h.solvers, |out| roundel_solver_new(problem, out)),
            20 => h.make(|h| &mut h.solutions, |out| roundel_solver_solve(solver, options, null(), out)),
            21 => roundel_solver_set_constraint_right_sides(solver, x, reals.len()),
            22 => roundel_solver_pin(solver, b, a),
            23 => roundel_solver_set_linear(solver, x, reals.len()),
            24 => roundel_solution_values(solution, out, room),
            25 => h.make(|h| &mut h.meshes, |out| roundel_mesh_make_shape(shape, small, out)),
            26 => h.make(|h| &mut h.meshes, |out| {
                roundel_mesh_new(reals.len() / 3, x, ints.len() / 3, i, out)
            }),
            27 => h.make(|h| &mut h.guidances, |out| roundel_guidance_new(out)),
            28 => roundel_guidance_set_constraints(guidance, count, i, x),
            29 => roundel_guidance_set_indices(guidance, ints.len() / 2, i, i.add(ints.len() / 2)),
            30 => roundel_guidance_set_feature_lines(guidance, ints.len() / 2, i),
            31 => h.make(|h| &mut h.fields, |out| {
                roundel_field_solve(mesh, guidance, options, null(), out)
            }),
            32 => h.make(|h| &mut h.maps, |out| roundel_map_new(mesh, field, guidance, out)),
            33 => roundel_map_set_quads(map, small),
            34 => roundel_map_solve(map, options, null()),
            35 => h.make(|h| &mut h.quad_options, |out| handles::modest_quad_options(out)),
            36 => roundel_quad_options_set_int(quad, c"quads".as_ptr(), small as i64),
            37 => roundel_quad_options_set_edge_lengths(quad, x, reals.len()),
            42 => roundel_map_solve_fold_free(map, options, null()),
            43 => roundel_map_untangle(map, null()),
            38 => h.make(|h| &mut h.quads, |out| roundel_quads_make(mesh, quad, null(), out)),
            _ => h.make(|h| &mut h.quads, |out| roundel_quads_extract(map, out)),
        }
    });
    Ok(())
}

/// A multiple of 1/2 from -8 to 8, or any 64 bits.
fn number(u: &mut Unstructured) -> Result<f64> {
    match u.ratio(7u8, 8u8)? {
        true => Ok(f64::from(u.int_in_range(-16i8..=16)?) / 2.0),
        false => u.arbitrary(),
    }
}

fn reals(u: &mut Unstructured) -> Result<Vec<f64>> {
    let count = u.int_in_range(0..=9)?;
    (0..count).map(|_| number(u)).collect()
}

fn ints(u: &mut Unstructured) -> Result<Vec<i32>> {
    let count = u.int_in_range(0..=9)?;
    (0..count).map(|_| u.int_in_range(-1..=9)).collect()
}

/// The name of an option, a value of one, or neither. The limit on nodes of `exact` is left out, because
/// without it a solve may take a minute by design.
fn name(u: &mut Unstructured) -> Result<CString> {
    let words = [
        "strategy", "ordering", "warm_start", "threads", "gap", "beam_width", "relax", "direct", "greedy",
        "adaptive", "multiple", "lattice", "exact", "auto", "natural", "largest_pivot", "keep", "offer", "",
    ];
    Ok(CString::new(*u.choose(&words)?).expect("no NUL"))
}
