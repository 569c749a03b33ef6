//! The unimodular matrix that transforms coordinates in the reduced basis to the caller's integers.
//!
//! The matrix is exact. Its entries have 64 bits, and 128 bits in a column that could exceed 64. An entry
//! that could exceed 128 bits is a typed error. A bound on the entries of each column avoids most checks.

use crate::error::{Error, Result};

/// The entries of a column stay below this, so no step overflows before the check.
const SMALL: f64 = (1u64 << 62) as f64;
const LARGE: f64 = (1u128 << 126) as f64;

/// A square integer matrix by columns.
#[derive(Debug, Clone)]
pub struct Transform {
    dim: usize,
    entries: Entries,
    /// A bound on the absolute values of the column's entries.
    bound: Vec<f64>,
}

#[derive(Debug, Clone)]
enum Entries {
    Small(Vec<i64>),
    Large(Vec<i128>),
}

impl Transform {
    /// The identity matrix.
    pub fn identity(dim: usize) -> Self {
        let mut entries = vec![0; dim * dim];
        entries.iter_mut().step_by(dim + 1).for_each(|e| *e = 1);
        Transform {
            dim,
            entries: Entries::Small(entries),
            bound: vec![1.0; dim],
        }
    }

    /// The number of columns.
    #[cfg(test)]
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// The entry in row `i`, column `j`.
    pub fn at(&self, i: usize, j: usize) -> i128 {
        match &self.entries {
            Entries::Small(e) => e[j * self.dim + i].into(),
            Entries::Large(e) => e[j * self.dim + i],
        }
    }

    /// Subtracts `q` times column `j` from column `k`, where `q` is a whole number.
    ///
    /// # Errors
    /// [`Error::Overflow`] if an entry exceeds 126 bits.
    pub fn subtract(&mut self, k: usize, j: usize, q: f64) -> Result<()> {
        let n = self.dim;
        let reach = |bound: &[f64]| (q.abs() * bound[j] + bound[k]) * (1.0 + 1e-9);
        if reach(&self.bound) >= SMALL {
            self.tighten(j);
            self.tighten(k);
            if reach(&self.bound) >= LARGE {
                return Err(overflow(k));
            }
            if reach(&self.bound) >= SMALL {
                self.promote();
            }
        }
        self.bound[k] = reach(&self.bound);
        match &mut self.entries {
            Entries::Small(e) => {
                let (to, from) = two_columns(e, n, k, j);
                let q = q as i64;
                to.iter_mut().zip(from).for_each(|(t, f)| *t -= q * f);
            }
            Entries::Large(e) => {
                let (to, from) = two_columns(e, n, k, j);
                let q = q as i128;
                to.iter_mut().zip(from).for_each(|(t, f)| *t -= q * f);
            }
        }
        Ok(())
    }

    /// Moves column `k` before column `i <= k`.
    pub fn insert(&mut self, k: usize, i: usize) {
        let range = i * self.dim..(k + 1) * self.dim;
        match &mut self.entries {
            Entries::Small(e) => e[range].rotate_right(self.dim),
            Entries::Large(e) => e[range].rotate_right(self.dim),
        }
        self.bound[i..=k].rotate_right(1);
    }

    /// Column `j` in floating point, each entry rounded once.
    pub fn column(&self, j: usize) -> Vec<f64> {
        let range = j * self.dim..(j + 1) * self.dim;
        match &self.entries {
            Entries::Small(e) => e[range].iter().map(|&v| v as f64).collect(),
            Entries::Large(e) => e[range].iter().map(|&v| v as f64).collect(),
        }
    }

    /// The product of the matrix with the column `z`.
    ///
    /// # Errors
    /// [`Error::Overflow`] if an entry exceeds 64 bits.
    pub fn apply(&self, z: &[i64]) -> Result<Vec<i64>> {
        (0..self.dim)
            .map(|i| exact_sum(i, (0..self.dim).map(|j| (self.at(i, j), z[j]))))
            .collect()
    }

    /// The product of the row `z` with the matrix.
    ///
    /// # Errors
    /// [`Error::Overflow`] if an entry exceeds 64 bits.
    pub fn apply_transposed(&self, z: &[i64]) -> Result<Vec<i64>> {
        (0..self.dim)
            .map(|j| exact_sum(j, (0..self.dim).map(|i| (self.at(i, j), z[i]))))
            .collect()
    }

    /// Sets the bound of column `j` to its largest entry.
    fn tighten(&mut self, j: usize) {
        let column = self.column(j);
        self.bound[j] = column.iter().fold(1.0, |m, v| m.max(v.abs()));
    }

    fn promote(&mut self) {
        if let Entries::Small(e) = &self.entries {
            self.entries = Entries::Large(e.iter().map(|&v| v.into()).collect());
        }
    }
}

fn overflow(i: usize) -> Error {
    Error::Overflow {
        what: "an integer of the lattice is too large".into(),
        index: Some(i),
    }
}

/// Entry `i` of a product, as a sum of products.
fn exact_sum(i: usize, terms: impl Iterator<Item = (i128, i64)>) -> Result<i64> {
    let mut sum = 0i128;
    for (a, b) in terms {
        let term = a.checked_mul(b.into());
        let next = term.and_then(|t| sum.checked_add(t));
        sum = next.ok_or_else(|| overflow(i))?;
    }
    i64::try_from(sum).map_err(|_| overflow(i))
}

/// Column `k` for writing, and column `j` for reading.
fn two_columns<T>(entries: &mut [T], n: usize, k: usize, j: usize) -> (&mut [T], &[T]) {
    let (low, high) = entries.split_at_mut(k.max(j) * n);
    let (a, b) = (&mut low[k.min(j) * n..][..n], &mut high[..n]);
    if k < j { (a, b) } else { (b, a) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_entries_are_promoted_and_stay_exact() {
        let mut u = Transform::identity(2);
        u.subtract(1, 0, -2f64.powi(50)).unwrap();
        u.subtract(0, 1, -2f64.powi(50)).unwrap();
        assert_eq!(u.at(0, 0), (1 << 100) + 1);
        assert_eq!(u.at(0, 0) * u.at(1, 1) - u.at(0, 1) * u.at(1, 0), 1);
        assert!(u.subtract(1, 0, -2f64.powi(50)).is_err());
        assert!(u.apply(&[1, 0]).is_err(), "beyond 64 bits");
        assert_eq!(u.apply(&[0, 3]).unwrap(), [3 << 50, 3]);
    }

    #[test]
    fn loose_bounds_promote_nothing() {
        let mut u = Transform::identity(2);
        for _ in 0..200 {
            u.subtract(1, 0, 1e18).unwrap();
            u.subtract(1, 0, -1e18).unwrap();
        }
        assert!(matches!(u.entries, Entries::Small(_)));
        assert_eq!(u.apply(&[5, 7]).unwrap(), [5, 7]);
    }
}
