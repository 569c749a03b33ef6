//! A solve to which the caller adds rows.

use std::ffi::c_void;
use std::mem::offset_of;

use super::event::{flow_of, monitor as watched_by, roundel_monitor};
use super::failure::{Failure, Outcome};
use super::guard;
use super::options::roundel_options;
use super::output::Out;
use super::problem::roundel_problem;
use super::solution::roundel_solution;
use super::status::roundel_status;
use crate::monitor::Flow;
use crate::problem::Problem;
use crate::search::{Candidate, LazyRows, Options};
use crate::solve::solve_with_lazy_rows;

/// A point that rows may cut off. It is valid until the callback returns.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct roundel_candidate {
    /// Size of this struct in the linked library, in bytes: later versions add members at its end.
    pub size: usize,
    /// The number of values, one for each variable.
    pub count: usize,
    /// The values.
    pub values: *const f64,
    /// The objective at the point.
    pub energy: f64,
    /// 1 if all integer variables have integer values; 0 for the minimiser of a relaxation.
    pub is_integer: i32,
    /// Reserved: 0.
    pub reserved: i32,
}

const _: () = {
    assert!(offset_of!(roundel_candidate, values) == 2 * size_of::<usize>());
    assert!(size_of::<usize>() != 8 || size_of::<roundel_candidate>() == 40);
};

/// Receives a candidate, on the thread that called solve, and adds rows. `rows` is an empty problem of as many
/// variables: the inequalities and constraints that the callback adds to it, for example with
/// roundel_problem_add_inequality, hold for the rest of the solve; nothing else in it is read. The library owns
/// it. The callback returns a roundel_flow: 0 to go on. It must return: no exception and no longjmp may leave it.
pub type roundel_lazy_callback = Option<
    unsafe extern "C" fn(
        candidate: *const roundel_candidate,
        rows: *mut roundel_problem,
        user_data: *mut c_void,
    ) -> i32,
>;

/// Solves a problem together with rows that `callback` adds during the search, because there are too many to give
/// them all before it. `options`, `monitor` and `solution` are those of roundel_problem_solve, and `user_data` is
/// passed to the callback unchanged.
///
/// The callback sees each point that could become the solution, and the minimiser of each relaxation that is not
/// integer. A point that its rows cut off is never a solution, and the solution is optimal among all points that
/// the problem and the rows allow. What it adds must not depend on the order of its calls.
///
/// Apart from the errors of roundel_problem_solve, fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a row that cuts
/// off a point which was accepted before. Rows have numbers after those of the problem's inequalities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_problem_solve_lazy(
    problem: *const roundel_problem,
    options: *const roundel_options,
    monitor: *const roundel_monitor,
    callback: roundel_lazy_callback,
    user_data: *mut c_void,
    solution: *mut *mut roundel_solution,
) -> roundel_status {
    let body = |problem: &Problem| {
        let default = Options::default();
        // SAFETY: the caller gives a live handle or NULL, a monitor as its members say or NULL,
        // and a place for the solution or NULL.
        let (options, monitor, out) = unsafe {
            (
                guard::value_or(options, &default)?,
                watched_by(monitor)?,
                Out::new("solution", solution)?,
            )
        };
        let callback = callback.ok_or(Failure::Null("callback"))?;
        let mut failure = None;
        let ask = |candidate: &Candidate, rows: &mut LazyRows| {
            let asked = ask(candidate, rows, |candidate, rows| {
                // SAFETY: a function by the caller's word; candidate and rows outlive the call.
                unsafe { callback(candidate, rows, user_data) }
            });
            asked.unwrap_or_else(|error| {
                failure = Some(error);
                Flow::Cancel
            })
        };
        let found = solve_with_lazy_rows(problem, options, monitor, ask);
        if let Some(failure) = failure {
            return Err(failure);
        }
        out.set(guard::handle(found?));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, body) }
}

/// Asks the caller for rows and adds them.
fn ask(
    candidate: &Candidate,
    rows: &mut LazyRows,
    callback: impl FnOnce(*const roundel_candidate, *mut roundel_problem) -> i32,
) -> Outcome<Flow> {
    let given = guard::handle::<roundel_problem>(Problem::new(candidate.values.len())?);
    let candidate = roundel_candidate {
        size: size_of::<roundel_candidate>(),
        count: candidate.values.len(),
        values: candidate.values.as_ptr(),
        energy: candidate.energy,
        is_integer: i32::from(candidate.is_integer),
        reserved: 0,
    };
    let flow = flow_of(callback(&raw const candidate, given));
    // SAFETY: made above; the caller must not free it.
    let added = unsafe { guard::value(given) }.and_then(|given| add(given, rows));
    // SAFETY: made above, and not used below.
    let _ = unsafe { guard::free(given) };
    added.map(|()| flow)
}

fn add(given: &Problem, rows: &mut LazyRows) -> Outcome {
    let inequalities = given.inequality_rows();
    for k in 0..inequalities.len() {
        let (indices, coefficients): (Vec<_>, Vec<_>) = inequalities.row(k).unzip();
        let (lower, upper) = (inequalities.lower()[k], inequalities.upper()[k]);
        rows.add(&indices, &coefficients, lower, upper)?;
    }
    let constraints = given.constraint_rows();
    for k in 0..constraints.len() {
        let (indices, coefficients): (Vec<_>, Vec<_>) = constraints.row(k).unzip();
        let rhs = constraints.rhs()[k];
        rows.add(&indices, &coefficients, rhs, rhs)?;
    }
    Ok(())
}
