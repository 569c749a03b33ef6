//! The factor of the active rows: `G = L D L'` of the matrix `G = A_W P A_W'`, in which rows come and go.
//!
//! A row is appended by one substitution. A row is removed by a rank-one update of the rows after it
//! (`gill1974`, method C1). Both take `O(k^2)` for `k` rows.

use pulp::Arch;

/// Unit lower triangle by rows, and the diagonal.
#[derive(Debug, Clone, Default)]
pub(super) struct Ldl {
    /// The entries below the diagonal of each row.
    rows: Vec<Vec<f64>>,
    /// The first entries of each row, as many as that and a multiple of [`LANES`], are zero.
    zeros: Vec<usize>,
    diagonal: Vec<f64>,
}

/// The sums of an inner product that are added side by side.
const LANES: usize = 8;

/// How many numbers at the beginning are zero, rounded down to a multiple of [`LANES`].
fn zeros(values: &[f64]) -> usize {
    let first = values.iter().position(|v| *v != 0.0);
    first.unwrap_or(values.len()) / LANES * LANES
}

impl Ldl {
    /// The last row of L and D if a row with these products and this square were appended. The entry of D is
    /// what is left of the square, and about zero for a row that depends on the others.
    pub fn next_row(&self, products: &[f64], square: f64) -> (Vec<f64>, f64) {
        let mut row = products.to_vec();
        self.substitute(&mut row, 0);
        let mut left = square;
        for (l, d) in row.iter_mut().zip(&self.diagonal) {
            let scaled = *l / d;
            left -= scaled * *l;
            *l = scaled;
        }
        (row, left)
    }

    /// Appends the result of [`next_row`](Self::next_row).
    pub fn append(&mut self, row: Vec<f64>, diagonal: f64) {
        self.zeros.push(zeros(&row));
        self.rows.push(row);
        self.diagonal.push(diagonal);
    }

    /// Removes row and column `at`.
    pub fn remove(&mut self, at: usize) {
        let mut weight = self.diagonal.remove(at);
        self.rows.remove(at);
        self.zeros.remove(at);
        let mut column: Vec<f64> = self.rows[at..].iter_mut().map(|r| r.remove(at)).collect();
        for (zeros, value) in self.zeros[at..].iter_mut().zip(&column) {
            // Entries after the one that goes move by one.
            if *zeros > at {
                debug_assert!(*value == 0.0);
                *zeros -= LANES;
            }
        }
        // L D L' + weight column column' for the rows from `at` on.
        for j in 0..column.len() {
            let p = column[j];
            let old = self.diagonal[at + j];
            let new = old + weight * p * p;
            if new == old && p == 0.0 {
                continue;
            }
            let beta = weight * p / new;
            weight *= old / new;
            self.diagonal[at + j] = new;
            for (i, c) in column.iter_mut().enumerate().skip(j + 1) {
                let l = &mut self.rows[at + i][at + j];
                *c -= p * *l;
                *l += beta * *c;
            }
        }
    }

    /// Solves `G x = b` in place.
    pub fn solve(&self, b: &mut [f64]) {
        self.substitute(b, 0);
        self.solve_substituted(b);
    }

    /// Replaces b by `L^-1 b`, where the first `done` entries have been replaced already.
    pub fn substitute(&self, b: &mut [f64], done: usize) {
        Arch::new().dispatch(
            #[inline(always)]
            || {
                let start = zeros(b);
                for i in done.max(start)..b.len() {
                    let from = self.zeros[i].max(start);
                    if from < i {
                        let below = dot(&self.rows[i][from..], &b[from..i]);
                        b[i] -= below;
                    }
                }
            },
        );
    }

    /// Solves `D L' x = b` in place.
    pub fn solve_substituted(&self, b: &mut [f64]) {
        for (x, d) in b.iter_mut().zip(&self.diagonal) {
            *x /= d;
        }
        self.solve_transposed(b);
    }

    /// Solves `L' x = b` in place.
    pub fn solve_transposed(&self, b: &mut [f64]) {
        Arch::new().dispatch(
            #[inline(always)]
            || {
                for i in (0..b.len()).rev() {
                    let x = b[i];
                    let from = self.zeros[i];
                    if from >= i {
                        continue;
                    }
                    for (b, l) in b[from..i].iter_mut().zip(&self.rows[i][from..]) {
                        *b -= l * x;
                    }
                }
            },
        );
    }

    /// Removes everything.
    pub fn clear(&mut self) {
        self.rows.clear();
        self.zeros.clear();
        self.diagonal.clear();
    }
}

/// The inner product, in eight sums that vector units add side by side.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let (a, b) = (&a[..n], &b[..n]);
    let (a8, b8) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a8
        .remainder()
        .iter()
        .zip(b8.remainder())
        .map(|(a, b)| a * b)
        .sum();
    let mut sums = [0.0; 8];
    for (a, b) in a8.zip(b8) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Random;

    /// The products of random vectors.
    fn gram(vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let row = |a: &Vec<f64>| vectors.iter().map(|b| dot(a, b)).collect();
        vectors.iter().map(row).collect()
    }

    fn factor(gram: &[Vec<f64>]) -> Ldl {
        let mut ldl = Ldl::default();
        for (k, row) in gram.iter().enumerate() {
            let (row, d) = ldl.next_row(&row[..k], row[k]);
            ldl.append(row, d);
        }
        ldl
    }

    #[test]
    fn a_factor_after_removals_solves_what_is_left() {
        let mut random = Random::new(7);
        let mut number = || random.symmetric();
        let mut vectors: Vec<Vec<f64>> = (0..12)
            .map(|_| (0..20).map(|_| number()).collect())
            .collect();
        let mut ldl = factor(&gram(&vectors));
        for at in [11, 0, 4, 7, 3] {
            ldl.remove(at);
            vectors.remove(at);
            let left = gram(&vectors);
            let x: Vec<f64> = (0..left.len()).map(|k| k as f64 - 2.5).collect();
            let mut b: Vec<f64> = left.iter().map(|row| dot(row, &x)).collect();
            ldl.solve(&mut b);
            assert!(b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-9), "{b:?}");
        }
    }

    #[test]
    fn zeros_at_the_beginning_of_rows_change_nothing() {
        let mut random = Random::new(5);
        // Vector k has entries at k, and at two places after it; so rows begin at many places.
        let mut vectors: Vec<Vec<f64>> = (0..40)
            .map(|k| {
                let mut vector = vec![0.0; 60];
                for at in [k, k + 7, k + 20] {
                    vector[at] = 1.0 + 0.3 * random.symmetric();
                }
                vector
            })
            .collect();
        vectors.reverse();
        let mut ldl = factor(&gram(&vectors));
        assert!(ldl.zeros.iter().any(|zeros| *zeros >= LANES));
        for at in [39, 0, 20, 9, 17, 30, 8, 16, 5] {
            ldl.remove(at);
            vectors.remove(at);
            let left = gram(&vectors);
            for unit in 0..left.len() {
                let mut x: Vec<f64> = left.iter().map(|row| row[unit]).collect();
                ldl.solve(&mut x);
                let is_unit =
                    |(k, x): (usize, &f64)| (x - f64::from(u8::from(k == unit))).abs() < 1e-9;
                assert!(x.iter().enumerate().all(is_unit), "{x:?}");
            }
        }
    }

    #[test]
    fn a_row_that_depends_on_the_others_leaves_nothing() {
        let vectors = [vec![1.0, 2.0, 0.0], vec![0.0, 1.0, 1.0]];
        let sum = [1.0, 3.0, 1.0];
        let ldl = factor(&gram(&vectors));
        let products: Vec<f64> = vectors.iter().map(|v| dot(v, &sum)).collect();
        assert!(ldl.next_row(&products, 11.0).1.abs() < 1e-12);
    }
}
