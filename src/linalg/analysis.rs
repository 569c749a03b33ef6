//! The symbolic step of a factorization: the order of elimination and the pattern of the factor. Matrices
//! with the same pattern share it.

use std::sync::Arc;

use super::Sparse;
use super::assembly_tree::AssemblyTree;
use super::ordering::{inverse, minimum_degree};
use super::supernodes::Supernodes;
use super::tree_solve::SolveParts;
use crate::error::Result;
use crate::monitor::{is_wanted, span, with_threads};

/// A factor of at least so many unknowns is computed and used by several threads. Smaller ones take a millisecond.
const SHARED: usize = 4_000;

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
    pub supernodes: Supernodes,
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
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::Overflow`](crate::Error::Overflow) for a matrix with
    /// more than 2^32 entries, and the reason to end the current step.
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
        let supernodes = Supernodes::new(lower, &place)?;
        is_wanted()?;
        let tree = AssemblyTree::new(&supernodes);
        let is_shared = lower.rows() >= least;
        let solve = SolveParts::new(&tree, &supernodes, is_shared);
        let pattern = FactorPattern {
            order,
            place,
            supernodes,
            tree,
            solve,
            is_shared,
        };
        Ok(Analysis {
            pattern: Arc::new(pattern),
        })
    }
}
