//! The simplicial factor `A = L D L'` of a positive semi-definite matrix, which can be updated.
//!
//! The factorization is up-looking: row by row along the elimination tree (`davis2006`, section 4.7). faer
//! has this factorization too, but does not let its values be changed in place, and [`super::fix`] needs
//! vanished pivots to stay zero.

use super::cholesky::PIVOT_TOLERANCE;
use super::ordering::{EliminationTree, NONE};
use super::scaling::{equilibrate, unit_scale};
use super::{Sparse, sparse::reserve};
use crate::error::Result;

/// Number of multiplications between two calls of `go_on`: a few milliseconds of work.
const STEPS_AT_A_TIME: usize = 1_000_000;

/// `P S A S P' = L D L'` with S a diagonal scaling and P an order of elimination.
///
/// All values inside are scaled and stored by position: unknown `i` is at `tree.position[i]` and has the
/// value `x_i / scale_i`. A zero pivot marks an unknown that the others determine. Its column is zero, and so
/// is its entry in every solution.
#[derive(Debug, Clone)]
pub struct Ldl {
    pub(super) tree: EliminationTree,
    pub(super) scale: Vec<f64>,
    /// Column `j` of L below the diagonal: `offsets[j]..ends[j]`, rows increasing.
    pub(super) offsets: Vec<usize>,
    pub(super) ends: Vec<usize>,
    pub(super) indices: Vec<u32>,
    pub(super) values: Vec<f64>,
    pub(super) pivots: Vec<f64>,
}

impl Ldl {
    /// Factors the symmetric matrix with lower triangle `lower` and eliminates in `order`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(lower: &Sparse, order: &[u32]) -> Result<Self> {
        let factored = Self::new_while(lower, order, || true)?;
        Ok(factored.unwrap_or_else(|| unreachable!("nothing ends it")))
    }

    /// As [`new`](Self::new), but stops early when `go_on`, which is asked now and then, returns false.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn new_while(
        lower: &Sparse,
        order: &[u32],
        go_on: impl FnMut() -> bool,
    ) -> Result<Option<Self>> {
        let tree = EliminationTree::new(lower, order)?;
        let scale = equilibrate(lower);
        let rows = permuted_rows(lower, &tree, &scale)?;
        let (offsets, total) = column_offsets(&rows, &tree);
        let mut indices = reserve(total)?;
        indices.resize(total, 0);
        let mut values = reserve(total)?;
        values.resize(total, 0.0);
        let n = order.len();
        let mut ldl = Ldl {
            ends: offsets[..n].to_vec(),
            tree,
            scale,
            offsets,
            indices,
            values,
            pivots: vec![0.0; n],
        };
        Ok(ldl.factor(&rows, go_on).then_some(ldl))
    }

    /// The factor of `R'R` for the upper triangular `r` with `m` columns, dense and by columns. Zero rows of
    /// `r` are vanished pivots.
    pub fn dense(r: &[f64], m: usize) -> Self {
        let at = |i: usize, j: usize| r[j * m + i];
        let diagonal = |j: usize| (0..=j).map(|i| at(i, j) * at(i, j)).sum();
        let scale: Vec<f64> = (0..m).map(|j| unit_scale(diagonal(j))).collect();
        let mut ldl = Ldl {
            tree: EliminationTree::chain(m),
            offsets: (0..=m)
                .map(|j| j * (2 * m - j).saturating_sub(1) / 2)
                .collect(),
            ends: Vec::new(),
            indices: Vec::new(),
            values: Vec::new(),
            pivots: Vec::new(),
            scale,
        };
        ldl.ends = ldl.offsets[1..].to_vec();
        for j in 0..m {
            let pivot = at(j, j);
            ldl.pivots.push((pivot * ldl.scale[j]).powi(2));
            for i in j + 1..m {
                ldl.indices.push(i as u32);
                ldl.values.push(match pivot {
                    0.0 => 0.0,
                    _ => at(j, i) * ldl.scale[i] / (pivot * ldl.scale[j]),
                });
            }
        }
        ldl
    }

    /// Computes the factor. Returns whether the computation was completed.
    fn factor(&mut self, rows: &Sparse, mut go_on: impl FnMut() -> bool) -> bool {
        let n = rows.rows();
        let mut row = vec![0.0; n];
        let mut seen = vec![NONE; n];
        let mut reach = Vec::new();
        let mut steps = 0;
        for k in 0..n {
            if steps >= STEPS_AT_A_TIME {
                steps = 0;
                if !go_on() {
                    return false;
                }
            }
            let mut pivot = 0.0;
            for (j, v) in rows.row(k) {
                if j == k {
                    pivot = v;
                } else {
                    row[j] = v;
                }
            }
            row_reach(rows, &self.tree.parent, k, &mut seen, &mut reach);
            for &j in &reach {
                let j = j as usize;
                let v = std::mem::take(&mut row[j]);
                let d = self.pivots[j];
                let entry = if d == 0.0 { 0.0 } else { v / d };
                steps += self.ends[j] - self.offsets[j];
                if entry != 0.0 {
                    for p in self.offsets[j]..self.ends[j] {
                        row[self.indices[p] as usize] -= self.values[p] * v;
                    }
                    pivot -= entry * v;
                }
                self.indices[self.ends[j]] = k as u32;
                self.values[self.ends[j]] = entry;
                self.ends[j] += 1;
            }
            self.pivots[k] = if pivot <= PIVOT_TOLERANCE { 0.0 } else { pivot };
        }
        true
    }

    /// Number of unknowns.
    pub fn dim(&self) -> usize {
        self.pivots.len()
    }

    /// The order of elimination and its tree.
    pub fn tree(&self) -> &EliminationTree {
        &self.tree
    }

    /// The scale of each unknown: its value is its scaled value times this.
    pub fn scale(&self) -> &[f64] {
        &self.scale
    }

    /// Number of entries of L below the diagonal.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether L has no entry below the diagonal.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

/// The scaled matrix by position. Row `k` holds the entries with column at most `k`.
fn permuted_rows(lower: &Sparse, tree: &EliminationTree, scale: &[f64]) -> Result<Sparse> {
    let n = lower.rows();
    let entries = lower.entries().map(|(i, j, v)| {
        let v = v * scale[i as usize] * scale[j as usize];
        let (a, b) = (tree.position[i as usize], tree.position[j as usize]);
        (a.max(b), a.min(b), v)
    });
    Sparse::from_triplets(n, n, entries)
}

/// The columns in which row `k` of L has an entry, in topological order. That order is increasing, because
/// positions are post-ordered.
fn row_reach(rows: &Sparse, parent: &[u32], k: usize, seen: &mut [u32], reach: &mut Vec<u32>) {
    reach.clear();
    seen[k] = k as u32;
    for (j, _) in rows.row(k) {
        let mut j = j as u32;
        while seen[j as usize] != k as u32 {
            seen[j as usize] = k as u32;
            reach.push(j);
            j = parent[j as usize];
        }
    }
    reach.sort_unstable();
}

fn column_offsets(rows: &Sparse, tree: &EliminationTree) -> (Vec<usize>, usize) {
    let n = rows.rows();
    let mut counts = vec![0usize; n + 1];
    let mut seen = vec![NONE; n];
    let mut reach = Vec::new();
    for k in 0..n {
        row_reach(rows, &tree.parent, k, &mut seen, &mut reach);
        for &j in &reach {
            counts[j as usize + 1] += 1;
        }
    }
    for j in 0..n {
        counts[j + 1] += counts[j];
    }
    let total = counts[n];
    (counts, total)
}

#[cfg(test)]
mod tests {
    use super::super::minimum_degree;
    use super::*;

    #[test]
    fn a_dense_triangle_is_the_factor_of_its_square() {
        // The columns are (2), (1, 3), (5, 0, 0); the last pivot vanishes.
        let r = [2.0, 0.0, 0.0, 1.0, 3.0, 0.0, 5.0, 0.0, 0.0];
        let ldl = Ldl::dense(&r, 3);
        let l = |i: usize, j: usize| match i.cmp(&j) {
            std::cmp::Ordering::Less => 0.0,
            std::cmp::Ordering::Equal => 1.0,
            std::cmp::Ordering::Greater => ldl.values[ldl.offsets[j] + i - j - 1],
        };
        for i in 0..3 {
            for j in 0..3 {
                let product: f64 = (0..3).map(|k| l(i, k) * ldl.pivots[k] * l(j, k)).sum();
                let square: f64 = (0..3).map(|k| r[i * 3 + k] * r[j * 3 + k]).sum();
                assert_eq!(product, square * ldl.scale[i] * ldl.scale[j]);
            }
        }
    }

    #[test]
    fn the_factor_multiplies_back_to_the_matrix() {
        let n = 30u32;
        let off = (1..n).flat_map(|i| [(i, i - 1, -1.0), (i, (i * 5) % i, -0.5)]);
        let diagonal = (0..n).map(|i| (i, i, 8.0 * f64::from(i + 1)));
        let a = Sparse::from_triplets(30, 30, off.chain(diagonal)).unwrap();
        let ldl = Ldl::new(&a, &minimum_degree(&a).unwrap()).unwrap();
        let n = n as usize;
        let mut l = vec![vec![0.0; n]; n];
        for j in 0..n {
            l[j][j] = 1.0;
            for p in ldl.offsets[j]..ldl.ends[j] {
                l[ldl.indices[p] as usize][j] = ldl.values[p];
            }
        }
        for i in 0..n {
            for (j, v) in a.row(i) {
                let (r, c) = (ldl.tree.position[i] as usize, ldl.tree.position[j] as usize);
                let product: f64 = (0..n).map(|k| l[r][k] * ldl.pivots[k] * l[c][k]).sum();
                assert!((product - v * ldl.scale[i] * ldl.scale[j]).abs() < 1e-13);
            }
        }
    }
}
