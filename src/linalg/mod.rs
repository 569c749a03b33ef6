//! Linear algebra that faer lacks: fixing unknowns in a sparse factor, semi-definite systems with a documented
//! choice of minimiser, Gauss-Seidel from a queue, and compensated sums. The other layers share the
//! submatrices, accumulators, disjoint sets and random numbers here.

mod accumulator;
mod analysis;
mod assembly_tree;
mod cholesky;
mod compensated;
mod conjugate_gradient;
mod disjoint_sets;
mod fix;
mod gauss_seidel;
mod ldl;
mod local_integers;
mod minimise;
mod minimise_fixed;
mod minimum_degree;
mod multifrontal;
mod ordering;
mod path;
mod queue_gauss_seidel;
mod random;
mod relaxed;
mod ring;
mod scaling;
mod schur_factor;
mod shared_float;
pub mod sparse;
mod static_condensation;
mod submatrix;
mod substitute;
mod tree_solve;
mod unpreconditioned_cg;
pub mod vector;
mod wide_registers;

pub(crate) use accumulator::Accumulator;
pub use analysis::Analysis;
pub use cholesky::Cholesky;
pub use compensated::{CompensatedSum, TwoFold, sum_below};
pub use conjugate_gradient::{Effort, conjugate_gradient};
pub(crate) use disjoint_sets::DisjointSets;
pub use fix::FixedSolve;
pub use gauss_seidel::{LocalSolve, Wave};
pub use ldl::Ldl;
pub use minimise::{CANCELLED, Lowest, Minimum, minimise, minimise_bounded, residual};
pub use minimise_fixed::minimise_fixed;
pub use ordering::{EliminationTree, Ordering, minimum_degree};
pub use path::PathSolve;
pub use queue_gauss_seidel::QueueGaussSeidel;
pub(crate) use random::Random;
pub use relaxed::RelaxedFactor;
pub use scaling::equilibrate;
pub use schur_factor::SchurFactor;
pub use sparse::Sparse;
pub use submatrix::{NO_PLACE, coupling, places, principal_submatrix};
pub use unpreconditioned_cg::unpreconditioned_conjugate_gradient;
pub(crate) use wide_registers::with_wide_registers;
