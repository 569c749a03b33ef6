//! The symbolic step of a factorization: the order of elimination and the pattern of the factor. Matrices
//! with the same pattern share it.

use std::sync::Arc;

use faer::Side;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};

use super::Sparse;
use super::assembly_tree::AssemblyTree;
use super::tree_solve::SolveParts;
use crate::error::{Error, Result};
use crate::monitor::span;

/// A factor of at least so many unknowns is computed and used by several threads. Smaller ones take a millisecond.
const SHARED: usize = 8_000;

/// The order of elimination and the pattern of the factor, for all matrices of one pattern.
#[derive(Debug, Clone)]
pub struct Analysis {
    pub(super) symbolic: Arc<SymbolicCholesky<u32>>,
    /// How threads share the work, if they do.
    pub(super) shared: Option<Arc<Shared>>,
}

/// The tasks of a factorization, and those of a solve.
#[derive(Debug)]
pub(super) struct Shared {
    pub tree: AssemblyTree,
    pub solve: SolveParts,
}

impl Analysis {
    /// Analyses the pattern of `lower`, the lower triangle of a symmetric matrix, in an order that keeps the
    /// factor sparse.
    ///
    /// # Errors
    /// [`Error::Overflow`] if the factor would have more than 2^32 entries.
    pub fn new(lower: &Sparse) -> Result<Self> {
        Self::ordered(lower, SymmetricOrdering::Amd)
    }

    pub(super) fn ordered(lower: &Sparse, ordering: SymmetricOrdering<u32>) -> Result<Self> {
        let _span = span("order");
        Self::shared_from(SHARED, lower, ordering)
    }

    /// As [`ordered`](Self::ordered), and threads share the work from so many unknowns on.
    pub(super) fn shared_from(
        least: usize,
        lower: &Sparse,
        ordering: SymmetricOrdering<u32>,
    ) -> Result<Self> {
        let col_ptr = offsets_u32(lower)?;
        let symbolic = factorize_symbolic_cholesky(
            pattern(lower, &col_ptr),
            Side::Upper,
            ordering,
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        );
        let symbolic = symbolic.map_err(|_| too_large())?;
        let shared = match symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(factor) if lower.rows() >= least => {
                let tree = AssemblyTree::new(factor);
                let solve = SolveParts::new(&tree, factor);
                Some(Arc::new(Shared { tree, solve }))
            }
            _ => None,
        };
        Ok(Analysis {
            symbolic: Arc::new(symbolic),
            shared,
        })
    }
}

/// The pattern as faer reads it: the rows of the lower triangle are the columns of the upper one.
pub(super) fn pattern<'a>(
    lower: &'a Sparse,
    col_ptr: &'a [u32],
) -> SymbolicSparseColMatRef<'a, u32> {
    let n = lower.rows();
    SymbolicSparseColMatRef::new_checked(n, n, col_ptr, None, lower.indices())
}

pub(super) fn offsets_u32(lower: &Sparse) -> Result<Vec<u32>> {
    let convert = |&o: &usize| u32::try_from(o).map_err(|_| too_large());
    lower.offsets().iter().map(convert).collect()
}

fn too_large() -> Error {
    Error::Overflow {
        what: "the factor would have more than 2^32 entries".into(),
        index: None,
    }
}
