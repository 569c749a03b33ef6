//! The supernodal factor `A = L D L'` of a positive semi-definite matrix, in the layout of faer. It is computed front
//! by front (`multifrontal.rs`), which takes half the time of faer's own factorization and can be interrupted.
//!
//! A pivot vanishes if the unknowns eliminated earlier determine its unknown. The whole column of the Schur
//! complement then vanishes too. Each such pivot is replaced by [`NULL_PIVOT`]. The result is the factor of
//! `A + sum_j NULL_PIVOT e_j e_j'`, where j runs over these *null unknowns*. If a system is consistent, the
//! solution of the changed system is exactly 0 at the null unknowns, so it also solves the original system.
//! It is one of the minimisers; the order of elimination decides which.
//!
//! The factor is L D L' and not L L', because the kernel of faer 0.24 for L L' leaves the old value on the diagonal
//! when it replaces a pivot.

use std::sync::Arc;

use super::Sparse;
use super::analysis::{Analysis, FactorPattern};
use super::multifrontal::factorize;
use super::ordering::Ordering;
use super::scaled_columns::Columns;
use super::scaling::equilibrate;
use super::tree_solve::Factor;
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
    pattern: Arc<FactorPattern>,
    pub(super) values: Vec<f64>,
    pub(super) scale: Vec<f64>,
    null: Vec<u32>,
    coupled: Vec<u32>,
}

impl Cholesky {
    /// Factors the symmetric matrix with lower triangle `lower`. Every diagonal entry must be stored.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Overflow`] for more than 2^32 entries, and for a large
    /// matrix the reason to end the current step.
    pub fn new(lower: &Sparse) -> Result<Self> {
        Self::ordered(lower, Ordering::FillReducing)
    }

    /// As [`new`](Self::new), with another order of elimination.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn ordered(lower: &Sparse, ordering: Ordering) -> Result<Self> {
        Self::with(&Analysis::in_order(lower, ordering.order(lower)?)?, lower)
    }

    /// As [`new`](Self::new), but the k-th unknown to be eliminated is `order[k]`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn in_order(lower: &Sparse, order: &[u32]) -> Result<Self> {
        Self::with(&Analysis::in_order(lower, order.to_vec())?, lower)
    }

    /// As [`new`](Self::new), for a matrix with the pattern that was analysed.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with(analysis: &Analysis, lower: &Sparse) -> Result<Self> {
        let _span = span("factor");
        let pattern = Arc::clone(&analysis.pattern);
        let scale = equilibrate(lower);
        let mut values = zeros(pattern.supernodes.value_count())?;
        let tolerance = pivot_tolerance(lower.rows());
        let columns = Columns::new(lower, &scale, |i| pattern.place[i])?;
        let (supernodes, tree) = (&pattern.supernodes, &pattern.tree);
        let work = || factorize(supernodes, tree, &columns, tolerance, &mut values);
        let has_null = pattern.work(work)?;
        leave_wide_registers();
        let mut factor = Cholesky {
            pattern,
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
        let supernodes = &self.pattern.supernodes;
        let entries = |s: usize| {
            let (columns, rows) = (supernodes.width(s), supernodes.rows(s).len());
            columns * (columns - 1) / 2 + columns * rows
        };
        (0..supernodes.count()).map(entries).sum()
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
        self.for_each_column_from(first, |k, pivot, entries| {
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
        self.pattern.order[position] as usize
    }

    /// Calls `visit` with each position, its pivot, and its column of L below the diagonal.
    pub(super) fn for_each_column(
        &self,
        visit: impl FnMut(usize, f64, &mut dyn Iterator<Item = (usize, f64)>),
    ) {
        self.for_each_column_from(0, visit);
    }

    /// As [`for_each_column`](Self::for_each_column), from position `first` on.
    fn for_each_column_from(
        &self,
        first: usize,
        mut visit: impl FnMut(usize, f64, &mut dyn Iterator<Item = (usize, f64)>),
    ) {
        let supernodes = &self.pattern.supernodes;
        for s in 0..supernodes.count() {
            let (columns, rows) = (supernodes.columns(s), supernodes.rows(s));
            if columns.end <= first {
                continue;
            }
            let (start, width) = (columns.start, columns.len());
            let block = &self.values[supernodes.values(s)];
            let columns = block.chunks_exact(width + rows.len()).enumerate();
            for (k, column) in columns.skip(first.saturating_sub(start)) {
                let row = |i: usize| match i.checked_sub(width) {
                    None => start + i,
                    Some(below) => rows[below] as usize,
                };
                let mut entries = (k + 1..column.len()).map(|i| (row(i), column[i]));
                visit(start + k, column[k], &mut entries);
            }
        }
    }

    /// Solves `A x = b` in place. Null unknowns get 0 if the system is consistent.
    ///
    /// # Errors
    /// The end of the call.
    pub fn solve(&self, b: &mut [f64]) -> Result<()> {
        self.solve_leading(b, 0)
    }

    /// Solves in place for all but the last `m` unknowns in the order of elimination. These last unknowns are
    /// held at zero, and their entries of `b` are neither read nor changed. If there are any, the factor must have no
    /// [null unknowns](Self::null_unknowns).
    ///
    /// # Errors
    /// The end of the call.
    pub fn solve_leading(&self, b: &mut [f64], m: usize) -> Result<()> {
        let _span = span("substitute");
        let (n, held) = (self.dim(), self.dim() - m);
        let FactorPattern { order, place, .. } = &*self.pattern;
        let mut x = collect_in_parts(n, LEAST, |k| {
            let i = order[k] as usize;
            if k < held { b[i] * self.scale[i] } else { 0.0 }
        });
        let factor = Factor {
            supernodes: &self.pattern.supernodes,
            values: &self.values,
        };
        let solve = || self.pattern.solve.solve(factor, &mut x, held);
        self.pattern.work(solve)?;
        leave_wide_registers();
        change_in_parts(b, LEAST, |i, b| {
            let k = place[i] as usize;
            if k < held {
                *b = x[k] * self.scale[i];
            }
        });
        Ok(())
    }
}

/// So many zeros. The system makes the zeros of a large array page by page, for the thread that uses a page first.
pub(super) fn zeros(len: usize) -> Result<Vec<f64>> {
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
    use crate::linalg::Random;

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

    #[test]
    fn a_free_graph_has_one_null_unknown_whatever_its_weights() {
        let mut random = Random::new(7);
        for round in 0..4000 {
            let n = 2 + round % 9;
            let mut weight = || {
                let part = (random.next() % 1000) as f64 / 1000.0;
                10f64.powf(12.0 * part - 6.0)
            };
            let springs: Vec<(u32, u32, f64)> = (1..n)
                .flat_map(|i| [(i, i / 2, weight()), (i, i - 1, weight())])
                .flat_map(|(i, j, k)| [(i, i, k), (j, j, k), (i, j, -k)])
                .collect();
            let n = n as usize;
            let a = Sparse::from_triplets(n, n, springs.into_iter()).unwrap();
            let factor = Cholesky::new(&a).unwrap();
            assert_eq!(factor.null_unknowns().len(), 1, "{round}");
        }
    }
}
