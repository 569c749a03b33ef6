//! A quadratic from which [private](super::private) integers are eliminated while they are free.
//!
//! In what is left Gauss-Seidel converges several times faster, and an update reads a third of the
//! entries. When a private integer is fixed its part is given back, at a few entries.

use super::Sparse;
use super::private::private_integers;
use crate::Result;

/// No entry is this small next to what it is the difference of: it cancelled.
const CANCELLED: f64 = 1e-12;

/// `A` with free private integers eliminated.
#[derive(Debug)]
pub(super) struct Condensed {
    /// All of A but its diagonal, both triangles.
    matrix: Sparse,
    diagonal: Vec<f64>,
    private: Vec<bool>,
    offsets: Vec<usize>,
    indices: Vec<u32>,
    values: Vec<f64>,
    curvature: Vec<f64>,
}

impl Condensed {
    /// The system of the `A` with lower triangle `lower`, all private integers free.
    pub fn new(lower: &Sparse, integer: &[bool]) -> Result<Self> {
        let n = lower.rows();
        let mut diagonal = vec![0.0; n];
        for (i, _, v) in lower.entries().filter(|&(i, j, _)| i == j) {
            diagonal[i as usize] = v;
        }
        let off = lower.entries().filter(|&(i, j, v)| i != j && v != 0.0);
        let both = off.flat_map(|(i, j, v)| [(i, j, v), (j, i, v)]);
        let matrix = Sparse::from_triplets(n, n, both)?;
        let private = private_integers(lower, integer);
        let pairs = (0..n).filter(|&p| private[p]).flat_map(|p| {
            let row = matrix.row(p);
            let inner = move |(i, _)| row.clone().map(move |(j, _)| (i, j));
            let couples = matrix.row(p).flat_map(inner);
            couples
                .filter(|(i, j)| i != j)
                .map(|(i, j)| (i as u32, j as u32, 0.0))
        });
        let kept = matrix
            .entries()
            .filter(|&(i, j, _)| !private[i as usize] && !private[j as usize]);
        let pattern = Sparse::from_triplets(n, n, kept.chain(pairs))?;
        let (offsets, indices) = (pattern.offsets().to_vec(), pattern.indices().to_vec());
        let mut condensed = Condensed {
            values: pattern.values().to_vec(),
            offsets,
            indices,
            curvature: diagonal.clone(),
            matrix,
            diagonal,
            private,
        };
        for p in 0..n {
            if condensed.private[p] {
                condensed.change(p, -1.0);
            }
        }
        Ok(condensed)
    }

    pub fn is_private(&self, i: usize) -> bool {
        self.private[i]
    }

    /// `A_ii`.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.diagonal[i]
    }

    /// Curvature along unknown `i` when the free private integers follow.
    pub fn curvature(&self, i: usize) -> f64 {
        self.curvature[i]
    }

    /// Row `i` of A without its diagonal.
    pub fn couplings(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.matrix.row(i)
    }

    /// Where row `i` of A stands, for [`coupling`](Self::coupling).
    pub fn coupling_range(&self, i: usize) -> std::ops::Range<usize> {
        self.matrix.offsets()[i]..self.matrix.offsets()[i + 1]
    }

    /// An entry of a row of A.
    pub fn coupling(&self, at: usize) -> (usize, f64) {
        (self.matrix.indices()[at] as usize, self.matrix.values()[at])
    }

    /// Where row `i` of the condensed matrix stands, for [`entry`](Self::entry).
    pub fn row_range(&self, i: usize) -> std::ops::Range<usize> {
        self.offsets[i]..self.offsets[i + 1]
    }

    /// An entry of a row of the condensed matrix.
    pub fn entry(&self, at: usize) -> (usize, f64) {
        (self.indices[at] as usize, self.values[at])
    }

    /// Gives back the part of a private integer that is fixed from now on.
    pub fn release(&mut self, p: usize) {
        self.change(p, 1.0);
    }

    /// Adds `sign` times the part that private integer `p` has in the Schur complement.
    fn change(&mut self, p: usize, sign: f64) {
        let d = self.diagonal[p];
        for a in self.coupling_range(p) {
            let (i, u) = self.coupling(a);
            self.curvature[i] += sign * u * u / d;
            for b in self.coupling_range(p) {
                let (j, v) = self.coupling(b);
                if i == j {
                    continue;
                }
                let row = self.row_range(i);
                let columns = &self.indices[row.clone()];
                if let Ok(k) = columns.binary_search(&(j as u32)) {
                    let part = u * v / d;
                    let value = &mut self.values[row.start + k];
                    *value += sign * part;
                    if value.abs() <= CANCELLED * part.abs() {
                        *value = 0.0;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_absorbed_row_couples_nobody_until_its_integer_is_fixed() {
        // (x0 - x1 + 2 x2)^2 with x2 integer
        let row = [(0u32, 1.0), (1, -1.0), (2, 2.0)];
        let entries = row.iter().flat_map(|&(i, u)| {
            let lower = row.iter().filter(move |&&(j, _)| j <= i);
            lower.map(move |&(j, v)| (i, j, 2.0 * u * v))
        });
        let a = Sparse::from_triplets(3, 3, entries).unwrap();
        let mut condensed = Condensed::new(&a, &[false, false, true]).unwrap();
        let values = |c: &Condensed| c.row_range(0).map(|at| c.entry(at)).collect::<Vec<_>>();
        assert_eq!(values(&condensed), [(1, 0.0)]);
        assert_eq!(condensed.curvature(0), 0.0);
        condensed.release(2);
        assert_eq!(values(&condensed), [(1, -2.0)]);
        assert_eq!(condensed.curvature(0), 2.0);
    }
}
