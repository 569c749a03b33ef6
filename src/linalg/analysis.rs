//! The symbolic step of a factorization: the order of elimination and the pattern of the factor. Matrices
//! with the same pattern share it.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::simplicial::{
    prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::linalg::cholesky::supernodal::{
    SymbolicSupernodalCholesky, factorize_supernodal_symbolic_cholesky,
    factorize_supernodal_symbolic_cholesky_scratch,
};
use faer::sparse::{FaerError, SymbolicSparseColMatRef};

use super::Sparse;
use super::assembly_tree::AssemblyTree;
use super::cholesky::out_of_memory;
use super::ordering::{inverse, minimum_degree, permute_pattern};
use super::sparse::reserve;
use super::tree_solve::SolveParts;
use crate::error::{Error, Result};
use crate::monitor::{is_wanted, span, with_threads};

/// A factor of at least so many unknowns is computed and used by several threads. Smaller ones take a millisecond.
const SHARED: usize = 8_000;

/// The order of elimination and the pattern of the factor, for all matrices of one pattern.
#[derive(Debug, Clone)]
pub struct Analysis {
    pub(super) pattern: Arc<FactorPattern>,
}

/// The pattern of a factor, and the tasks into which its computation and solves with it are divided.
#[derive(Debug)]
pub(super) struct FactorPattern {
    /// The unknown at each position.
    pub order: Vec<u32>,
    /// The position of each unknown.
    pub place: Vec<u32>,
    pub supernodes: SymbolicSupernodalCholesky<u32>,
    pub tree: AssemblyTree,
    pub solve: SolveParts,
    is_shared: bool,
}

impl FactorPattern {
    /// Does work on the threads that are allowed, or on one if the factor is small.
    pub fn work<T>(&self, work: impl FnOnce() -> T) -> T {
        if self.is_shared {
            work()
        } else {
            with_threads(1, work)
        }
    }
}

impl Analysis {
    /// Analyses the pattern of `lower`, the lower triangle of a symmetric matrix, in an order that keeps the
    /// factor sparse.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Overflow`] if the factor would have more than 2^32 entries, and the reason to
    /// end the current step.
    pub fn new(lower: &Sparse) -> Result<Self> {
        let order = {
            let _span = span("order");
            minimum_degree(lower)?
        };
        Self::in_order(lower, order)
    }

    /// As [`new`](Self::new), but the k-th unknown to be eliminated is `order[k]`.
    pub(super) fn in_order(lower: &Sparse, order: Vec<u32>) -> Result<Self> {
        Self::shared_from(SHARED, lower, order)
    }

    /// As [`in_order`](Self::in_order), and threads share the work from so many unknowns on.
    pub(super) fn shared_from(least: usize, lower: &Sparse, order: Vec<u32>) -> Result<Self> {
        let _span = span("analyse");
        let place = inverse(&order);
        let supernodes = supernodes(lower, &place)?;
        is_wanted()?;
        let tree = AssemblyTree::new(&supernodes);
        let solve = SolveParts::new(&tree, &supernodes);
        let pattern = FactorPattern {
            order,
            place,
            supernodes,
            tree,
            solve,
            is_shared: lower.rows() >= least,
        };
        Ok(Analysis {
            pattern: Arc::new(pattern),
        })
    }
}

/// The supernodes of the factor, with unknown i at position `place[i]`.
fn supernodes(lower: &Sparse, place: &[u32]) -> Result<SymbolicSupernodalCholesky<u32>> {
    let n = lower.rows();
    let (offsets, rows) = permute_pattern(lower, place)?;
    is_wanted()?;
    // The lower positions of a position are the rows of its column in the upper triangle.
    let columns = SymbolicSparseColMatRef::new_unsorted_checked(n, n, &offsets, None, &rows);
    let need = prefactorize_symbolic_cholesky_scratch::<u32>(n, rows.len())
        .or(factorize_supernodal_symbolic_cholesky_scratch::<u32>(n));
    let mut memory = MemBuffer::try_new(need).map_err(|_| out_of_memory())?;
    let stack = MemStack::new(&mut memory);
    let (mut tree, mut counts) = (reserve(n)?, reserve(n)?);
    tree.resize(n, 0i32);
    counts.resize(n, 0u32);
    let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, columns, stack);
    is_wanted()?;
    let params = Default::default();
    let supernodes = factorize_supernodal_symbolic_cholesky(columns, tree, &counts, stack, params);
    supernodes.map_err(|error| match error {
        FaerError::OutOfMemory => out_of_memory(),
        _ => Error::Overflow {
            what: "the factor would have more than 2^32 entries".into(),
            index: None,
        },
    })
}
