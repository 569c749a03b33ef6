//! A function that panics, so that the boundary can be seen to hold. Never in a release.

use super::guard;
use super::problem::roundel_problem;
use super::status::roundel_status;

/// Panics inside of the library, while it holds the problem.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_test_panic(problem: *const roundel_problem) -> roundel_status {
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(problem, |_| panic!("asked to panic")) }
}
