//! Solves with the leading block of a factor.
//!
//! The leading block of L D L' is the factor of the leading block of A. faer solves with whole factors only,
//! so this file has its own forward and back substitution, column by column.

use faer::sparse::linalg::cholesky::{SymbolicCholeskyRaw, supernodal::SupernodalLdltRef};

use super::Cholesky;
use crate::error::Result;

impl Cholesky {
    /// Solves in place for all but the last `m` unknowns in the order of elimination. These last unknowns are
    /// held at zero, and their entries of `b` are neither read nor changed. The factor must have no [null
    /// unknowns](Self::null_unknowns).
    ///
    /// # Errors
    /// The end of the call.
    pub fn solve_leading(&self, b: &mut [f64], m: usize) -> Result<()> {
        let first = self.dim() - m;
        if self.solve_by_subtrees(b, first)? {
            return Ok(());
        }
        let scaled = |k: usize| b[self.unknown(k)] * self.scale[self.unknown(k)];
        let mut x: Vec<f64> = (0..first).map(scaled).collect();
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(raw) => {
                let factor = SupernodalLdltRef::new(raw, &self.values);
                for s in 0..raw.n_supernodes() {
                    each_column(&factor, s, first, false, |k, column| {
                        column.eliminate(k, &mut x)
                    });
                }
                for s in (0..raw.n_supernodes()).rev() {
                    each_column(&factor, s, first, true, |k, column| {
                        column.substitute(k, &mut x)
                    });
                }
            }
            // For a diagonal matrix faer chooses the simplicial form.
            SymbolicCholeskyRaw::Simplicial(raw) => {
                for (x, &at) in x.iter_mut().zip(raw.col_ptr()) {
                    *x /= self.values[at as usize];
                }
            }
        }
        for (k, x) in x.into_iter().enumerate() {
            b[self.unknown(k)] = x * self.scale[self.unknown(k)];
        }
        Ok(())
    }
}

/// A column of L within the leading block.
struct Column<'a> {
    pivot: f64,
    /// The entries of the rows directly below the pivot.
    next: &'a [f64],
    /// The other entries; their rows follow.
    values: &'a [f64],
    rows: &'a [u32],
}

impl Column<'_> {
    /// `x_i -= L_ik x_k`.
    fn eliminate(&self, k: usize, x: &mut [f64]) {
        let pull = x[k];
        for (x, l) in x[k + 1..].iter_mut().zip(self.next) {
            *x -= l * pull;
        }
        for (&i, l) in self.rows.iter().zip(self.values) {
            x[i as usize] -= l * pull;
        }
    }

    /// `x_k = x_k / D_k - sum_i L_ik x_i`.
    fn substitute(&self, k: usize, x: &mut [f64]) {
        let next = x[k + 1..].iter().zip(self.next).map(|(x, l)| l * x);
        let below = self.rows.iter().zip(self.values);
        let below = below.map(|(&i, l)| l * x[i as usize]);
        let sum = next.sum::<f64>() + below.sum::<f64>();
        x[k] = x[k] / self.pivot - sum;
    }
}

/// Visits the columns of a supernode before position `first`, each cut off at that position.
fn each_column(
    factor: &SupernodalLdltRef<'_, u32, f64>,
    supernode: usize,
    first: usize,
    backwards: bool,
    mut visit: impl FnMut(usize, Column),
) {
    let block = factor.supernode(supernode);
    let (start, val) = (block.start(), block.val());
    let columns = val.ncols().min(first.saturating_sub(start));
    // The rows of a supernode increase.
    let below = block.pattern().partition_point(|&i| (i as usize) < first);
    for c in 0..columns {
        let c = if backwards { columns - 1 - c } else { c };
        let Some(column) = val.col(c).try_as_col_major() else {
            unreachable!("faer stores supernodes by columns");
        };
        let column = column.as_slice();
        let values = &column[val.ncols()..];
        visit(
            start + c,
            Column {
                pivot: column[c],
                next: &column[c + 1..columns],
                values: &values[..below],
                rows: &block.pattern()[..below],
            },
        );
    }
}
