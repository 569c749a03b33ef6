//! The door through which tests and benchmarks of this repository reach the solver's inner layers.
//!
//! It is no part of the interface: what stands here may change or vanish in any version.

/// The elimination of the equality constraints.
pub mod eliminate {
    pub use crate::eliminate::{Elimination, Expansion, ReducedModel, eliminate};
}

/// Factors, orderings and iterative solvers.
pub mod linalg {
    pub use crate::linalg::{
        Cholesky, Effort, EliminationTree, FixedSolve, Ldl, LocalSolve, Lowest, Minimum,
        RelaxedFactor, Sparse, Wave, conjugate_gradient, equilibrate, minimise_fixed,
        minimum_degree,
    };
}
