//! What dense kernels leave behind.
//!
//! faer's kernels for wide vector registers do not clear the upper halves of these registers. Until somebody does,
//! some processors take several times as long for all other arithmetic of the same thread.

use std::hint::black_box;

use pulp::Arch;

/// Calls faer's dense `kernels`, and leaves the vector registers clean.
pub(crate) fn with_wide_registers<T>(kernels: impl FnOnce() -> T) -> T {
    let result = kernels();
    leave_wide_registers();
    result
}

/// Clears the upper halves of the vector registers: a function that uses whole registers does so when it returns.
pub(super) fn leave_wide_registers() {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            let mut lanes = black_box([1.0f64; 16]);
            lanes.iter_mut().for_each(|lane| *lane += 1.0);
            black_box(&mut lanes);
        },
    );
}
