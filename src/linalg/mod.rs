//! What faer lacks: fixing unknowns in a sparse factor, semi-definite systems with a documented
//! choice of minimiser, sums whose terms cancel.

mod analysis;
mod cholesky;
mod compensated;
mod condensed;
mod conjugate_gradient;
mod fix;
mod gauss_seidel;
mod held;
mod joint;
mod ldl;
mod leading;
mod minimise;
mod ordering;
mod path;
mod plain_gradients;
mod plain_seidel;
mod private;
mod relaxed;
mod scaling;
pub mod sparse;
mod substitute;

pub use analysis::Analysis;
pub use cholesky::{Cholesky, NULL_PIVOT, PIVOT_TOLERANCE};
pub use compensated::CompensatedSum;
pub use conjugate_gradient::{Effort, conjugate_gradient};
pub use fix::FixedSolve;
pub use gauss_seidel::LocalSolve;
pub use held::minimise_held;
pub use joint::JointFactor;
pub use ldl::Ldl;
pub use minimise::{
    CANCELLED, CURVATURE_TOLERANCE, Lowest, Minimum, SLOPE_TOLERANCE, minimise, minimise_bounded,
    residual,
};
pub use ordering::{EliminationTree, Ordering, minimum_degree};
pub use path::PathSolve;
pub use plain_gradients::plain_conjugate_gradient;
pub use plain_seidel::PlainSeidel;
pub use relaxed::RelaxedFactor;
pub use scaling::equilibrate;
pub use sparse::Sparse;
