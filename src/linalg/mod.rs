//! What faer lacks: orderings kept for path solves, fixing unknowns in a sparse factor,
//! semi-definite systems with a documented choice of minimiser.

mod compensated;
pub mod sparse;

pub use compensated::CompensatedSum;
pub use sparse::Sparse;
