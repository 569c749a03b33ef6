//! A lattice basis as its triangular factor, with the exact transformation to the caller's integers.
//!
//! The lattice is `{ R0 z : z integer }`, where R0 is a factor of the caller's Gram matrix. Every basis of
//! it is `R0 U` with a unimodular U. It is kept as the triangular R of `R0 U = Q R`, since rotations change
//! no distance. Each step changes U exactly and R in floating point. Givens rotations, which are stable,
//! make R triangular again. [`Basis::refresh`] computes R again from R0 and U, so the errors of many steps
//! do not accumulate.
//!
//! If the Gram matrix is semi-definite, the vectors are dependent. They still generate the lattice,
//! together with their integer relations. During the reduction each vector gets an additional coordinate of
//! its own, of `REGULAR` times its length. This makes the vectors independent, and the relations become the
//! shortest vectors. `refresh` finds the relations by their length and puts them last as *free*
//! coordinates, whose integers do not change the distance. (`pohst1987` reduces dependent vectors directly,
//! which needs exact zeros.)

use faer::{Mat, MatRef};

use super::{Gram, Transform};
use crate::error::Result;
use crate::linalg::{CompensatedSum, with_wide_registers};

/// The additional coordinate of a dependent vector, relative to its length.
const REGULAR: f64 = 1e-6;

/// A combination of dependent vectors is a relation between them if it is shorter than this, relative to
/// the sum of the combined lengths.
const NULL_LENGTH: f64 = 1e-8;

/// If a diagonal entry of R is below this part of its column, the vectors are dependent but do not generate
/// a lattice: the relations are not between integers.
const DENSE: f64 = 1e-7;

/// `R`, `R0` and `U` with `R0 U = Q R`.
#[derive(Debug, Clone)]
pub struct Basis {
    dim: usize,
    rank: usize,
    discrete: bool,
    /// Whether the free coordinates are last.
    settled: bool,
    pub(super) r: Vec<f64>,
    original: Vec<f64>,
    full: bool,
    transform: Transform,
    /// The rows of the inverse of `transform`, as columns.
    inverse: Transform,
}

impl Basis {
    /// The basis of unit vectors under the scalar product `gram`.
    pub fn new(gram: &Gram) -> Self {
        let (factor, full) = gram.factor();
        Self::from_factor(gram.dim(), factor, full)
    }

    /// The basis with this upper triangular factor by columns. `full` says that no diagonal entry is zero.
    pub fn from_factor(dim: usize, factor: Vec<f64>, full: bool) -> Self {
        let mut basis = Basis {
            dim,
            rank: dim,
            discrete: true,
            settled: false,
            r: factor.clone(),
            original: factor,
            full,
            transform: Transform::identity(dim),
            inverse: Transform::identity(dim),
        };
        if !full {
            basis.refresh();
        }
        basis
    }

    /// The number of coordinates.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// The number of coordinates that are not free. The free ones come last.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Whether the vectors generate a lattice. If not, no integer relation explains their dependence. Then
    /// no point attains the least distance, and the distances in this basis prove nothing.
    pub fn is_discrete(&self) -> bool {
        self.discrete
    }

    /// A bound on the relative rounding error of the distances of points, `|R v|` for a computed v: row i of
    /// `R v` is a sum of at most m products, each with a relative error of m units
    /// (`higham2002`, section 3.1), and `|v_j|` is at most the distance times the norm of row j of the
    /// inverse of R.
    pub fn evaluation_error(&self) -> f64 {
        let m = self.rank();
        let mut reach = vec![0.0; m];
        for k in 0..m {
            // Column k of the inverse.
            let mut column = vec![0.0; k + 1];
            column[k] = 1.0 / self.r(k, k);
            for i in (0..k).rev() {
                let sum: f64 = (i + 1..=k).map(|j| self.r(i, j) * column[j]).sum();
                column[i] = -sum / self.r(i, i);
            }
            for (r, c) in reach.iter_mut().zip(column) {
                *r += c * c;
            }
        }
        let row = |i: usize| -> f64 {
            let terms = (i..m).map(|j| self.r(i, j).abs() * reach[j].sqrt());
            terms.sum::<f64>().powi(2)
        };
        let size: f64 = (0..m).map(row).sum();
        (m + 4) as f64 * f64::EPSILON * size.sqrt()
    }

    /// Whether vector `k` leaves the span of the vectors before it. Only then do distances determine its
    /// coordinate.
    pub fn decides(&self, k: usize) -> bool {
        let column = self.column(k);
        column[k] > DENSE * column.iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    /// The entry of R in row `i`, column `j`, `i <= j`.
    pub fn r(&self, i: usize, j: usize) -> f64 {
        self.r[j * self.dim + i]
    }

    /// Column `j` of R, down to the diagonal.
    pub fn column(&self, j: usize) -> &[f64] {
        &self.r[j * self.dim..][..=j]
    }

    /// The exact transformation to the caller's integers.
    pub fn transform(&self) -> &Transform {
        &self.transform
    }

    /// The coordinates `y` of the point `p`, which is given in the caller's coordinates: `U y = p`.
    pub fn coordinates(&self, p: &[f64]) -> Vec<f64> {
        let row = |j: usize| {
            let mut sum = CompensatedSum::new(0.0);
            for (u, p) in self.inverse.column(j).into_iter().zip(p) {
                sum.add_product(u, *p);
            }
            sum.value()
        };
        (0..self.dim).map(row).collect()
    }

    /// The coordinates of the lattice point with these integers of the caller.
    ///
    /// # Errors
    /// [`Error::Overflow`](crate::Error::Overflow) if a coordinate exceeds 64 bits.
    pub fn whole_coordinates(&self, integers: &[i64]) -> Result<Vec<i64>> {
        self.inverse.apply_transposed(integers)
    }

    /// The caller's coordinates of the vector with coordinates `g` in the orthonormal basis in
    /// which R is triangular: `U R^-1 g`.
    pub fn orthonormal_to_callers(&self, g: &[f64]) -> Vec<f64> {
        let mut y = g.to_vec();
        for j in (0..self.rank).rev() {
            let column = self.column(j);
            y[j] /= column[j];
            let own = y[j];
            y.iter_mut()
                .zip(&column[..j])
                .for_each(|(y, r)| *y -= r * own);
        }
        let mut x = vec![0.0; self.dim];
        for (j, y) in y.into_iter().enumerate() {
            let column = self.transform.column(j);
            x.iter_mut().zip(column).for_each(|(x, u)| *x += u * y);
        }
        x
    }

    /// The transpose of [`orthonormal_to_callers`](Self::orthonormal_to_callers): `R^-T U' force`.
    pub fn to_orthonormal(&self, force: &[f64]) -> Vec<f64> {
        let mut h = Vec::with_capacity(self.rank);
        for j in 0..self.rank {
            let mut sum = CompensatedSum::new(0.0);
            for (u, f) in self.transform.column(j).into_iter().zip(force) {
                sum.add_product(u, *f);
            }
            let column = self.column(j);
            let before: f64 = column.iter().zip(&h).map(|(r, h)| r * h).sum();
            h.push((sum.value() - before) / column[j]);
        }
        h
    }

    /// Reduces the size of column `k`: subtracts multiples of all vectors before it until each of its
    /// entries is at most half a diagonal entry. This is repeated until nothing changes, since large
    /// multiples lose digits (`nguyen2009`, figure 5).
    pub(super) fn size_reduce(&mut self, k: usize) -> Result<()> {
        let n = self.dim;
        loop {
            let mut largest: f64 = 0.0;
            for j in (0..k).rev() {
                let (before, at) = self.r.split_at_mut(k * n);
                let (column, own) = (&before[j * n..j * n + j + 1], &mut at[..j + 1]);
                let q = own[j] / column[j];
                if q.abs() <= 0.5 + 1e-9 {
                    continue;
                }
                let q = q.round();
                for (a, b) in own.iter_mut().zip(column) {
                    *a -= q * b;
                }
                self.transform.subtract(k, j, q)?;
                self.inverse.subtract(j, k, -q)?;
                largest = largest.max(q.abs());
            }
            if largest <= 1e3 {
                return Ok(());
            }
        }
    }

    /// Moves vector `k` before vector `i < k`, and makes R triangular again by rotations.
    pub(super) fn insert(&mut self, k: usize, i: usize) {
        let n = self.dim;
        self.r[i * n..(k + 1) * n].rotate_right(n);
        self.transform.insert(k, i);
        self.inverse.insert(k, i);
        for row in (i + 1..=k).rev() {
            let column = &mut self.r[i * n..];
            let (a, b) = (column[row - 1], column[row]);
            let length = a.hypot(b);
            if length == 0.0 {
                continue;
            }
            (column[row - 1], column[row]) = (length, 0.0);
            self.rotate(row, a / length, b / length);
        }
        for row in i..=k {
            self.make_positive(row);
        }
    }

    /// Rotates rows `row - 1` and `row` by the angle with this cosine and sine, from column `row` on.
    fn rotate(&mut self, row: usize, cos: f64, sin: f64) {
        let n = self.dim;
        for column in self.r[row * n..self.rank * n].chunks_exact_mut(n) {
            let (a, b) = (column[row - 1], column[row]);
            column[row - 1] = cos * a + sin * b;
            column[row] = cos * b - sin * a;
        }
    }

    /// Changes the sign of a row whose diagonal entry is negative.
    fn make_positive(&mut self, row: usize) {
        let n = self.dim;
        if self.r[row * n + row] < 0.0 {
            for column in self.r[row * n..self.rank * n].chunks_exact_mut(n) {
                column[row] = -column[row];
            }
        }
    }

    /// Computes R again from R0 and U.
    pub(super) fn refresh(&mut self) {
        self.r = self.triangular(!self.full && !self.settled);
    }

    /// Puts the relations between dependent vectors last, as free coordinates, and computes R again from
    /// the other vectors.
    pub(super) fn settle(&mut self) {
        if self.full || self.settled {
            return;
        }
        let lengths = column_lengths(&self.original, self.dim);
        let product = self.product();
        let mut kept = 0;
        for k in 0..self.dim {
            let combined: f64 = self
                .transform
                .column(k)
                .iter()
                .zip(&lengths)
                .map(|(u, l)| u.abs() * l)
                .sum();
            if product.col(k).norm_l2() > NULL_LENGTH * combined {
                self.transform.insert(k, kept);
                self.inverse.insert(k, kept);
                kept += 1;
            }
        }
        self.rank = kept;
        self.settled = true;
        self.refresh();
        self.discrete = (0..kept).all(|k| self.decides(k));
    }

    /// `R0 U`.
    fn product(&self) -> Mat<f64> {
        let n = self.dim;
        let mut u = Mat::zeros(n, n);
        for k in 0..n {
            for (i, v) in self.transform.column(k).into_iter().enumerate() {
                u[(i, k)] = v;
            }
        }
        let original = MatRef::from_column_major_slice(&self.original, n, n);
        with_wide_registers(|| original * u)
    }

    /// The triangular factor of the first `rank` columns of `R0 U`. If `apart`, the columns have the
    /// additional coordinates that make dependent vectors independent.
    fn triangular(&self, apart: bool) -> Vec<f64> {
        let n = self.dim;
        let product = self.product();
        let mut tall = Mat::zeros(if apart { 2 * n } else { n }, self.rank);
        let lengths = column_lengths(&self.original, n);
        for k in 0..self.rank {
            for i in 0..n {
                tall[(i, k)] = product[(i, k)];
            }
            if apart {
                for (i, u) in self.transform.column(k).into_iter().enumerate() {
                    tall[(n + i, k)] = REGULAR * lengths[i] * u;
                }
            }
        }
        let qr = with_wide_registers(|| tall.qr());
        let factor = qr.thin_R();
        let mut r = vec![0.0; n * n];
        for i in 0..factor.nrows() {
            let sign = if factor[(i, i)] < 0.0 { -1.0 } else { 1.0 };
            for k in i..self.rank {
                r[k * n + i] = sign * factor[(i, k)];
            }
        }
        r
    }
}

/// The length of each column, or the greatest length for a column of zeros, since the relations with a zero
/// vector are needed too.
fn column_lengths(r: &[f64], n: usize) -> Vec<f64> {
    let length = |c: &[f64]| c.iter().map(|v| v * v).sum::<f64>().sqrt();
    let mut lengths: Vec<f64> = r.chunks_exact(n.max(1)).map(length).collect();
    let longest = lengths.iter().fold(0.0, |m: f64, &l| m.max(l));
    let stand_in = if longest > 0.0 { longest } else { 1.0 };
    lengths
        .iter_mut()
        .filter(|l| **l == 0.0)
        .for_each(|l| *l = stand_in);
    lengths
}
