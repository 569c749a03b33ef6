//! Problems from and to files: MPS, LP and QPLIB, and replay files that hold options and hints beside MPS.

use std::ffi::c_char;

use super::guard::{self, boundary};
use super::input::path;
use super::options::roundel_options;
use super::output::{Out, optional};
use super::problem::roundel_problem;
use super::status::roundel_status;
use crate::problem::Problem;
use crate::problem::files::{self, NamedProblem};
use crate::problem::mps;
use crate::search::Options;
use crate::solve::replay;

/// Makes a problem from a file in the format that its name says: LP for ".lp", QPLIB for ".qplib", and MPS, free or
/// fixed, for any other, each also with ".gz" behind it. Variables and rows are numbered in the order of the file;
/// their names are not kept.
///
/// A file may maximise. The problem then minimises the negated objective, and 1 is written to `maximises`, else
/// 0; `maximises` may be NULL.
///
/// Fails with ROUNDEL_ERROR_PARSE, ROUNDEL_ERROR_NOT_SUPPORTED or, where entries of Q show that the objective is not
/// convex, ROUNDEL_ERROR_NOT_CONVEX, and the line at fault, and with ROUNDEL_ERROR_IO.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_read(
    file: *const c_char,
    maximises: *mut i32,
    problem: *mut *mut roundel_problem,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a text, a place for the number or NULL, and one for the handle or NULL.
        let (file, maximises, out) = unsafe {
            (
                path("file", file)?,
                optional("maximises", maximises)?,
                Out::new("problem", problem)?,
            )
        };
        let read = files::read(file)?;
        if let Some(maximises) = maximises {
            maximises.set(i32::from(read.maximises()));
        }
        out.set(guard::handle(read.into_problem()));
        Ok(())
    })
}

/// Writes a problem to a file in the format that its name says: LP for ".lp" and free-format MPS for any other, each
/// compressed for ".gz" behind it. What is said of roundel_problem_write_mps holds for both.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_write(
    problem: *const roundel_problem,
    file: *const c_char,
) -> roundel_status {
    let body = |value: &Problem| {
        // SAFETY: the caller gives a text, or NULL.
        let file = unsafe { path("file", file) }?;
        Ok(files::write(file, &NamedProblem::new(value.clone()))?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Makes a problem from a file in MPS, gzipped or not, whatever its name is. See roundel_problem_read.
///
/// Fails as roundel_problem_read does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_read_mps(
    file: *const c_char,
    problem: *mut *mut roundel_problem,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a text and a place for the handle, or NULL.
        let (file, out) = unsafe { (path("file", file)?, Out::new("problem", problem)?) };
        out.set(guard::handle(mps::read(file)?.into_problem()));
        Ok(())
    })
}

/// Writes a problem as free-format MPS, gzipped if the file's name ends in ".gz". Variables are
/// named x0, x1, ..., constraints c0, c1, ....
///
/// MPS has no place for some parts: pins become constraints, least-squares rows are summed into Q,
/// q and c, and the guess is lost. roundel_problem_save_replay keeps pins and guess.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_write_mps(
    problem: *const roundel_problem,
    file: *const c_char,
) -> roundel_status {
    let body = |value: &Problem| {
        // SAFETY: the caller gives a text, or NULL.
        let file = unsafe { path("file", file) }?;
        Ok(mps::write(file, &NamedProblem::new(value.clone()))?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Writes a problem and its options, so that the solve can be repeated elsewhere. The problem is written
/// to `file`, which ends in ".mps" or ".mps.gz". The options, pins and guess are written to a file beside
/// it that ends in ".replay.json". `options` may be NULL for the default options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_save_replay(
    problem: *const roundel_problem,
    options: *const roundel_options,
    file: *const c_char,
) -> roundel_status {
    let body = |value: &Problem| {
        let default = Options::default();
        // SAFETY: the caller gives a text or NULL, and a live handle or NULL.
        let (options, file) = unsafe { (guard::value_or(options, &default)?, path("file", file)?) };
        Ok(replay::save(file, value, options)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Makes the problem and the options that roundel_problem_save_replay wrote to `file`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_load_replay(
    file: *const c_char,
    problem: *mut *mut roundel_problem,
    options: *mut *mut roundel_options,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a text and places for the handles, or NULL.
        let (file, problem_out, options_out) = unsafe {
            (
                path("file", file)?,
                Out::new("problem", problem)?,
                Out::new("options", options)?,
            )
        };
        let (problem, options) = replay::load(file)?;
        problem_out.set(guard::handle(problem));
        options_out.set(guard::handle(options));
        Ok(())
    })
}
