//! The supernodal factor `A = L D L'` of a positive semi-definite matrix, in the layout of faer, which also computes
//! it. The factor of a large matrix is computed front by front instead (`multifrontal.rs`).
//!
//! A pivot vanishes if the unknowns eliminated earlier determine its unknown. The whole column of the Schur
//! complement then vanishes too. Each such pivot is replaced by [`NULL_PIVOT`]. The result is the factor of
//! `A + sum_j NULL_PIVOT e_j e_j'`, where j runs over these *null unknowns*. If a system is consistent, the
//! solution of the changed system is exactly 0 at the null unknowns, so it also solves the original system.
//! It is one of the minimisers; the order of elimination decides which.
//!
//! The factor is L D L' and not L L', because in L L' faer 0.24 leaves the old value on the diagonal when it
//! replaces a pivot.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::perm::PermRef;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::{
    LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    supernodal::SupernodalLdltRef,
};
use faer::{Conj, MatMut, Par, Side};

use super::Sparse;
use super::analysis::{Analysis, Shared, offsets_u32, pattern};
use super::multifrontal::{Columns, factorize};
use super::ordering::Ordering;
use super::scaling::equilibrate;
use super::wide_registers::leave_wide_registers;
use crate::error::{Error, Result};
use crate::monitor::{change_in_parts, collect_in_parts, span};

/// A pivot of the scaled matrix (diagonal in [1/2, 2)) at or below this counts as zero.
///
/// A pivot that cancels leaves a rounding error of about 1e-15. The smallest true pivots of mesh problems
/// (from the regularisation 1e-6 of seam translations) stay above 1e-7.
pub const PIVOT_TOLERANCE: f64 = 1e-12;

/// The same for a matrix of `n` rows. The rounding error of a pivot grows with the number of terms that cancel
/// in it, so a small matrix may be decided more sharply.
pub fn pivot_tolerance(n: usize) -> f64 {
    PIVOT_TOLERANCE.min(128.0 * f64::EPSILON * n as f64)
}

/// The value that replaces a vanished pivot of the scaled matrix. Every true pivot is smaller.
pub const NULL_PIVOT: f64 = 9.0;

/// If a pivot counts as zero, the entries of its column in a semi-definite matrix are at most the root of
/// twice [`PIVOT_TOLERANCE`]. This bound is ten times as large.
const COUPLED: f64 = 1.5e-5;

/// The least number of unknowns that are worth a thread.
const LEAST: usize = 1 << 14;

/// `A = L D L'` of the scaled and permuted matrix.
#[derive(Debug)]
pub struct Cholesky {
    pub(super) symbolic: Arc<SymbolicCholesky<u32>>,
    shared: Option<Arc<Shared>>,
    pub(super) values: Vec<f64>,
    pub(super) scale: Vec<f64>,
    null: Vec<u32>,
    coupled: Vec<u32>,
}

impl Cholesky {
    /// Factors the symmetric matrix with lower triangle `lower`. Every diagonal entry must be stored.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Overflow`] if the factor would have more than 2^32 entries, and for a large
    /// matrix the reason to end the current step.
    pub fn new(lower: &Sparse) -> Result<Self> {
        Self::ordered(lower, Ordering::FillReducing)
    }

    /// As [`new`](Self::new), with another order of elimination.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn ordered(lower: &Sparse, ordering: Ordering) -> Result<Self> {
        let ordering = match ordering {
            Ordering::FillReducing | Ordering::LargestPivot => SymmetricOrdering::Amd,
            Ordering::Natural => SymmetricOrdering::Identity,
        };
        Self::with(&Analysis::ordered(lower, ordering)?, lower)
    }

    /// As [`new`](Self::new), but the k-th unknown to be eliminated is `order[k]`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn in_order(lower: &Sparse, order: &[u32]) -> Result<Self> {
        let mut place = vec![0; order.len()];
        for (k, &i) in order.iter().enumerate() {
            place[i as usize] = k as u32;
        }
        let order = PermRef::new_checked(order, &place, order.len());
        Self::with(
            &Analysis::ordered(lower, SymmetricOrdering::Custom(order))?,
            lower,
        )
    }

    /// As [`new`](Self::new), for a matrix with the pattern that was analysed.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with(analysis: &Analysis, lower: &Sparse) -> Result<Self> {
        let _span = span("factor");
        let symbolic = Arc::clone(&analysis.symbolic);
        let scale = equilibrate(lower);
        let mut values = zeros(symbolic.len_val())?;
        let tolerance = pivot_tolerance(lower.rows());
        let has_null = match (&analysis.shared, symbolic.raw()) {
            (Some(shared), SymbolicCholeskyRaw::Supernodal(factor)) => {
                let places = symbolic.perm().map(|perm| perm.arrays().1);
                let position = |i: usize| places.map_or(i as u32, |places| places[i]);
                let columns = Columns::new(lower, &scale, position)?;
                factorize(factor, &shared.tree, &columns, tolerance, &mut values)?
            }
            _ => {
                factorize_serially(&symbolic, lower, &scale, tolerance, &mut values)?;
                // What faer counts is not returned.
                true
            }
        };
        leave_wide_registers();
        let mut factor = Cholesky {
            symbolic,
            shared: analysis.shared.clone(),
            values,
            scale,
            null: Vec::new(),
            coupled: Vec::new(),
        };
        if !has_null {
            return Ok(factor);
        }
        let (mut null, mut coupled) = (Vec::new(), Vec::new());
        factor.for_each_column(|k, pivot, entries| {
            if pivot == NULL_PIVOT {
                null.push(factor.unknown(k) as u32);
                let largest = entries.fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
                if largest * NULL_PIVOT > COUPLED {
                    coupled.push(factor.unknown(k) as u32);
                }
            }
        });
        (factor.null, factor.coupled) = (null, coupled);
        Ok(factor)
    }

    /// A combination of the directions that belong to the null unknowns, and the smallest pivot that did not
    /// vanish. None if no pivot vanished.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn null_direction(&self) -> Result<Option<(Vec<f64>, f64)>> {
        if self.null.is_empty() {
            return Ok(None);
        }
        let mut direction = vec![0.0; self.dim()];
        for (k, &j) in self.null.iter().enumerate() {
            // Weights between 1 and 2, in no order.
            direction[j as usize] = 1.0 + (0.618_033_988_75 * k as f64).fract();
        }
        self.solve(&mut direction)?;
        let mut smallest = f64::INFINITY;
        self.for_each_column(|_, pivot, _| smallest = smallest.min(pivot));
        Ok(Some((direction, smallest)))
    }

    /// Number of unknowns.
    pub fn dim(&self) -> usize {
        self.scale.len()
    }

    /// The scale of each unknown: the factor is that of the matrix with entries
    /// `scale_i A_ij scale_j`.
    pub fn scale(&self) -> &[f64] {
        &self.scale
    }

    /// Number of stored entries of L below the diagonal. It includes zeros that are stored to make blocks
    /// larger.
    pub fn entries(&self) -> usize {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(raw) => (0..raw.n_supernodes())
                .map(|s| {
                    let block = raw.supernode(s);
                    let columns = raw.supernode_end()[s] - raw.supernode_begin()[s];
                    let columns = columns as usize;
                    columns * (columns.saturating_sub(1)) / 2 + columns * block.pattern().len()
                })
                .sum(),
            SymbolicCholeskyRaw::Simplicial(raw) => raw.len_val() - raw.nrows(),
        }
    }

    /// The unknowns whose pivot vanished, in order of elimination.
    pub fn null_unknowns(&self) -> &[u32] {
        &self.null
    }

    /// The null unknowns that other unknowns depend on all the same. If there are any, the matrix is not
    /// semi-definite.
    pub fn coupled_unknowns(&self) -> &[u32] {
        &self.coupled
    }

    /// Eliminates all but the last `m` unknowns and returns the upper triangular factor `R'R = S` of the
    /// Schur complement S, dense and by columns, in the order of elimination. The second result says whether
    /// all pivots were positive. A vanished pivot leaves a zero row. Its column is zero as well if it holds
    /// nothing but rounding errors.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn trailing_factor(&self, m: usize) -> Result<(Vec<f64>, bool)> {
        let first = self.dim() - m;
        let mut r = Vec::new();
        r.try_reserve_exact(m * m).map_err(|_| Error::OutOfMemory {
            what: "the dense factor of the integers",
        })?;
        r.resize(m * m, 0.0);
        let mut null = Vec::new();
        // The largest entry of each column of the scaled complement.
        let mut size = vec![0.0f64; m];
        let mut set = |row: usize, pivot: f64, column: usize, entry: f64| {
            let value = entry * pivot.sqrt() / self.scale[self.unknown(column)];
            r[(column - first) * m + row - first] = value;
            size[column - first] = size[column - first].max((entry * pivot).abs());
        };
        self.for_each_column(|k, pivot, entries| {
            if k < first {
                return;
            }
            if pivot == NULL_PIVOT {
                null.push(k - first);
                return;
            }
            set(k, pivot, k, 1.0);
            entries.for_each(|(i, v)| set(k, pivot, i, v));
        });
        for &k in null.iter().filter(|&&k| size[k] <= PIVOT_TOLERANCE) {
            r[k * m..(k + 1) * m].fill(0.0);
        }
        let full = null.is_empty();
        Ok((r, full))
    }

    /// The unknown that is eliminated as the `position`-th.
    pub(super) fn unknown(&self, position: usize) -> usize {
        // `None` is the natural order.
        let order = self.symbolic.perm().map(|perm| perm.arrays().0);
        order.map_or(position, |order| order[position] as usize)
    }

    /// Calls `visit` with each position, its pivot, and its column of L below the diagonal.
    pub(super) fn for_each_column(
        &self,
        mut visit: impl FnMut(usize, f64, &mut dyn Iterator<Item = (usize, f64)>),
    ) {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(raw) => {
                let factor = SupernodalLdltRef::new(raw, &self.values);
                for s in 0..raw.n_supernodes() {
                    let block = factor.supernode(s);
                    let (start, val) = (block.start(), block.val());
                    for k in 0..val.ncols() {
                        let row = |i: usize| match i.checked_sub(val.ncols()) {
                            None => start + i,
                            Some(below) => block.pattern()[below] as usize,
                        };
                        let mut entries = (k + 1..val.nrows()).map(|i| (row(i), val[(i, k)]));
                        visit(start + k, val[(k, k)], &mut entries);
                    }
                }
            }
            // For a diagonal matrix faer chooses the simplicial form.
            SymbolicCholeskyRaw::Simplicial(raw) => {
                for k in 0..raw.nrows() {
                    let range = raw.col_ptr()[k] as usize..raw.col_ptr()[k + 1] as usize;
                    let rows = &raw.row_idx()[range.clone()];
                    let column = rows.iter().zip(&self.values[range]).skip(1);
                    let mut entries = column.map(|(&i, &v)| (i as usize, v));
                    let pivot = self.values[raw.col_ptr()[k] as usize];
                    visit(k, pivot, &mut entries);
                }
            }
        }
    }

    /// Solves `A x = b` in place. Null unknowns get 0 if the system is consistent.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], and the end of the call.
    pub fn solve(&self, b: &mut [f64]) -> Result<()> {
        let _span = span("substitute");
        let n = self.dim();
        if self.solve_by_subtrees(b, n)? {
            return Ok(());
        }
        for (b, s) in b.iter_mut().zip(&self.scale) {
            *b *= s;
        }
        let mut memory =
            MemBuffer::try_new(self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))
                .map_err(|_| out_of_memory())?;
        LdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(b, n, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        leave_wide_registers();
        for (b, s) in b.iter_mut().zip(&self.scale) {
            *b *= s;
        }
        Ok(())
    }

    /// Solves by the subtrees of a factor that threads share, with the unknowns from the given position on held at
    /// zero. Their entries of `b` are neither read nor changed. The result says whether the factor is shared.
    ///
    /// # Errors
    /// The end of the call.
    pub(super) fn solve_by_subtrees(&self, b: &mut [f64], held: usize) -> Result<bool> {
        let (Some(shared), SymbolicCholeskyRaw::Supernodal(raw)) =
            (&self.shared, self.symbolic.raw())
        else {
            return Ok(false);
        };
        let n = self.dim();
        let arrays = self.symbolic.perm().map(|perm| perm.arrays());
        let mut x = collect_in_parts(n, LEAST, |k| {
            let i = arrays.map_or(k, |(order, _)| order[k] as usize);
            if k < held { b[i] * self.scale[i] } else { 0.0 }
        });
        let factor = SupernodalLdltRef::new(raw, &self.values);
        shared.solve.solve(&factor, &mut x, held)?;
        leave_wide_registers();
        change_in_parts(b, LEAST, |i, b| {
            let k = arrays.map_or(i, |(_, place)| place[i] as usize);
            if k < held {
                *b = x[k] * self.scale[i];
            }
        });
        Ok(true)
    }
}

/// Computes the factor of the scaled matrix on one thread, by faer.
fn factorize_serially(
    symbolic: &SymbolicCholesky<u32>,
    lower: &Sparse,
    scale: &[f64],
    tolerance: f64,
    values: &mut [f64],
) -> Result<()> {
    let n = lower.rows();
    let col_ptr = offsets_u32(lower)?;
    let mut scaled = super::sparse::reserve(lower.len())?;
    for i in 0..n {
        scaled.extend(lower.row(i).map(|(j, v)| v * scale[i] * scale[j]));
    }
    let mut memory = MemBuffer::try_new(
        symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default()),
    )
    .map_err(|_| out_of_memory())?;
    let signs = vec![1; n];
    let regularization = LdltRegularization {
        dynamic_regularization_signs: Some(&signs),
        dynamic_regularization_delta: NULL_PIVOT,
        dynamic_regularization_epsilon: tolerance,
    };
    let done = symbolic.factorize_numeric_ldlt(
        values,
        SparseColMatRef::new(pattern(lower, &col_ptr), &scaled),
        Side::Upper,
        regularization,
        Par::Seq,
        MemStack::new(&mut memory),
        Default::default(),
    );
    done.map(|_| ()).map_err(|_| overflow())
}

/// So many zeros. The system makes the zeros of a large array page by page, for the thread that uses a page first.
fn zeros(len: usize) -> Result<Vec<f64>> {
    // The macro would end the process if there is no memory.
    super::sparse::reserve::<f64>(len)?;
    Ok(vec![0.0; len])
}

pub(super) fn overflow() -> Error {
    Error::Overflow {
        what: "the factorization of the objective overflows".into(),
        index: None,
    }
}

pub(super) fn out_of_memory() -> Error {
    Error::OutOfMemory {
        what: "a factorization",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of `n` springs with stiffness `k`. If `grounded`, a spring of stiffness 1 ties unknown 0 to the
    /// ground.
    fn ring(n: u32, k: f64, grounded: bool) -> Sparse {
        let springs = (0..n).flat_map(move |i| {
            let j = (i + 1) % n;
            [(i, i, k), (j, j, k), (i.max(j), i.min(j), -k)]
        });
        let ground = grounded.then_some((0, 0, 1.0));
        let n = n as usize;
        Sparse::from_triplets(n, n, springs.chain(ground)).unwrap()
    }

    #[test]
    fn a_definite_system_is_solved() {
        for k in [1.0, 3e9, 1e-9] {
            let a = ring(50, k, true);
            let x: Vec<f64> = (0..50).map(|i| f64::from(i).sin()).collect();
            let mut b = a.mul_symmetric(&x);
            let factor = Cholesky::new(&a).unwrap();
            assert!(factor.null_unknowns().is_empty());
            factor.solve(&mut b).unwrap();
            let error = b
                .iter()
                .zip(&x)
                .map(|(b, x)| (b - x).abs())
                .fold(0.0, f64::max);
            assert!(error < 1e-12 * (k + 1.0 / k) * 50.0, "{k}: {error}");
        }
    }

    #[test]
    fn a_free_ring_has_one_null_unknown_that_stays_at_zero() {
        let a = ring(50, 2.0, false);
        let factor = Cholesky::new(&a).unwrap();
        let &[null] = factor.null_unknowns() else {
            panic!("{:?}", factor.null_unknowns());
        };
        let x: Vec<f64> = (0..50).map(|i| f64::from(i).cos()).collect();
        let mut b = a.mul_symmetric(&x);
        factor.solve(&mut b).unwrap();
        let shift = x[null as usize];
        for (b, x) in b.iter().zip(&x) {
            assert!((b - (x - shift)).abs() < 1e-12);
        }
    }
}
