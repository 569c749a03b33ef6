//! Static condensation: while [local](super::local_integers) integers are free, they are eliminated from the
//! quadratic.
//!
//! Gauss-Seidel converges several times faster on the condensed system, and an update reads a third of the
//! entries. When a local integer is fixed, its part of the Schur complement is added back, which changes a
//! few entries.

use super::Sparse;
use super::local_integers::local_integers;
use crate::error::{Error, Result};

/// A difference this small, relative to its terms, has cancelled and counts as zero.
const CANCELLED: f64 = 1e-12;

/// The matrix `A` with its free local integers eliminated.
#[derive(Debug)]
pub(super) struct StaticCondensation {
    /// The off-diagonal entries of A, both triangles.
    matrix: Sparse,
    diagonal: Vec<f64>,
    local: Vec<bool>,
    rows: Vec<Row>,
    entries: Vec<Entry>,
    /// For each unknown, the free local integers that couple to it. Those of unknown `i` are the
    /// `followers_left[i]` entries from `followers_start[i]` on.
    followers: Vec<u32>,
    followers_start: Vec<u32>,
    followers_left: Vec<u32>,
}

/// A row of the condensed matrix: its diagonal entry, and the range of its other entries.
#[derive(Debug, Clone, Copy)]
struct Row {
    curvature: f64,
    start: u32,
    end: u32,
}

/// An off-diagonal entry. Index and value are next to each other, since they are always read together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub column: u32,
    pub value: f64,
}

impl StaticCondensation {
    /// The system with all local integers free, where `lower` is the lower triangle of `A`.
    pub fn new(lower: &Sparse, integer: &[bool]) -> Result<Self> {
        let n = lower.rows();
        let mut diagonal = vec![0.0; n];
        for (i, _, v) in lower.entries().filter(|&(i, j, _)| i == j) {
            diagonal[i as usize] = v;
        }
        let off = lower.entries().filter(|&(i, j, v)| i != j && v != 0.0);
        let both = off.flat_map(|(i, j, v)| [(i, j, v), (j, i, v)]);
        let matrix = Sparse::from_triplets(n, n, both)?;
        let local = local_integers(lower, integer);
        let pairs = (0..n).filter(|&p| local[p]).flat_map(|p| {
            let row = matrix.row(p);
            let inner = move |(i, _)| row.clone().map(move |(j, _)| (i, j));
            let couples = matrix.row(p).flat_map(inner);
            couples
                .filter(|(i, j)| i != j)
                .map(|(i, j)| (i as u32, j as u32, 0.0))
        });
        let kept = matrix
            .entries()
            .filter(|&(i, j, _)| !local[i as usize] && !local[j as usize]);
        let pattern = Sparse::from_triplets(n, n, kept.chain(pairs))?;
        if pattern.len() > u32::MAX as usize {
            return Err(Error::OutOfMemory {
                what: "a condensed system",
            });
        }
        let offsets = pattern.offsets();
        let rows = (0..n).map(|i| Row {
            curvature: diagonal[i],
            start: offsets[i] as u32,
            end: offsets[i + 1] as u32,
        });
        let entries = pattern.indices().iter().zip(pattern.values());
        let mut followers = Vec::new();
        let mut followers_start = Vec::with_capacity(n);
        let mut followers_left = Vec::with_capacity(n);
        for i in 0..n {
            let start = followers.len();
            let couplings = matrix.row(i).map(|(j, _)| j as u32);
            followers.extend(couplings.filter(|&j| local[j as usize]));
            followers_start.push(start as u32);
            followers_left.push((followers.len() - start) as u32);
        }
        let mut condensed = StaticCondensation {
            rows: rows.collect(),
            entries: entries
                .map(|(&column, &value)| Entry { column, value })
                .collect(),
            matrix,
            diagonal,
            local,
            followers,
            followers_start,
            followers_left,
        };
        for p in 0..n {
            if condensed.local[p] {
                condensed.change(p, -1.0);
            }
        }
        Ok(condensed)
    }

    pub fn is_local(&self, i: usize) -> bool {
        self.local[i]
    }

    /// `A_ii`.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.diagonal[i]
    }

    /// The curvature along unknown `i` if the free local integers follow.
    pub fn curvature(&self, i: usize) -> f64 {
        self.rows[i].curvature
    }

    /// Row `i` of A without its diagonal.
    pub fn couplings(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.matrix.row(i)
    }

    /// The range of row `i` of A, for [`coupling`](Self::coupling).
    pub fn coupling_range(&self, i: usize) -> std::ops::Range<usize> {
        self.matrix.offsets()[i]..self.matrix.offsets()[i + 1]
    }

    /// An entry of a row of A.
    pub fn coupling(&self, at: usize) -> (usize, f64) {
        (self.matrix.indices()[at] as usize, self.matrix.values()[at])
    }

    /// Row `i` of the condensed matrix without its diagonal.
    pub fn row(&self, i: usize) -> &[Entry] {
        let row = self.rows[i];
        &self.entries[row.start as usize..row.end as usize]
    }

    /// The free local integers that couple to unknown `i`.
    pub fn followers(&self, i: usize) -> &[u32] {
        let start = self.followers_start[i] as usize;
        &self.followers[start..start + self.followers_left[i] as usize]
    }

    /// Adds back the part of a local integer in the Schur complement. The integer is fixed from now on.
    pub fn release(&mut self, p: usize) {
        self.change(p, 1.0);
        for a in self.coupling_range(p) {
            let (i, _) = self.coupling(a);
            let own = self.followers(i).iter().position(|&q| q as usize == p);
            if let Some(place) = own {
                let start = self.followers_start[i] as usize;
                let last = start + self.followers_left[i] as usize - 1;
                self.followers.swap(start + place, last);
                self.followers_left[i] -= 1;
            }
        }
    }

    /// Adds `sign` times the part of local integer `p` in the Schur complement.
    fn change(&mut self, p: usize, sign: f64) {
        let d = self.diagonal[p];
        for a in self.coupling_range(p) {
            let (i, u) = self.coupling(a);
            let row = &mut self.rows[i];
            row.curvature += sign * u * u / d;
            let row = row.start as usize..row.end as usize;
            for b in self.coupling_range(p) {
                let (j, v) = self.coupling(b);
                if i == j {
                    continue;
                }
                let entries = &mut self.entries[row.clone()];
                if let Some(entry) = entries.iter_mut().find(|e| e.column == j as u32) {
                    let part = u * v / d;
                    entry.value += sign * part;
                    if entry.value.abs() <= CANCELLED * part.abs() {
                        entry.value = 0.0;
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
        let mut condensed = StaticCondensation::new(&a, &[false, false, true]).unwrap();
        let values = |c: &StaticCondensation| {
            let row = c.row(0).iter();
            row.map(|e| (e.column, e.value)).collect::<Vec<_>>()
        };
        assert_eq!(values(&condensed), [(1, 0.0)]);
        assert_eq!(condensed.curvature(0), 0.0);
        condensed.release(2);
        assert_eq!(values(&condensed), [(1, -2.0)]);
        assert_eq!(condensed.curvature(0), 2.0);
    }
}
