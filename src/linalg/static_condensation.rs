//! Static condensation: while [local](super::local_integers) integers are free, they are eliminated from the
//! quadratic.
//!
//! Gauss-Seidel converges several times faster on the condensed system, and an update reads a third of the
//! entries. When a local integer is fixed, its part of the Schur complement is added back, which changes a
//! few entries.

use std::ops::Range;
use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use super::Sparse;
use super::local_integers::local_integers;
use super::shared_float::SharedFloat;
use super::sparse::reserve;
use crate::error::{Error, Result};
use crate::monitor::{collect_in_turn, may_continue, may_continue_at};

/// The rows that a thread takes at a time: those of local integers take less time than the others, which precede
/// them.
const ROWS: usize = 1 << 13;

/// The blocks of rows that are condensed before they are appended to the others.
const BLOCKS: usize = 32;

/// A difference this small, relative to its terms, has cancelled and counts as zero.
const CANCELLED: f64 = 1e-12;

/// The matrix `A` with its free local integers eliminated. Threads may share it, see
/// [`LocalSolve::relax`](super::LocalSolve::relax).
#[derive(Debug)]
pub(super) struct StaticCondensation {
    /// The off-diagonal entries of A in the rows of local integers. All other rows are empty.
    couplings: Sparse,
    diagonal: Vec<f64>,
    local: Vec<bool>,
    rows: Vec<Row>,
    entries: Vec<Entry>,
    /// For each unknown, the free local integers that couple to it. Those of unknown `i` are the
    /// `followers_left[i]` entries from `followers_start[i]` on.
    followers: Vec<AtomicU32>,
    followers_start: Vec<u32>,
    followers_left: Vec<AtomicU32>,
}

/// A row of the condensed matrix: its diagonal entry, and the range of its other entries.
#[derive(Debug)]
struct Row {
    curvature: SharedFloat,
    start: u32,
    end: u32,
}

/// An off-diagonal entry. Index and value are next to each other, since they are always read together.
#[derive(Debug)]
pub(super) struct Entry {
    pub column: u32,
    pub value: SharedFloat,
}

/// Condensed rows, one after the other.
#[derive(Default)]
struct Rows {
    /// The curvature of each, and where its entries end.
    rows: Vec<(f64, usize)>,
    entries: Vec<Entry>,
    /// The followers of all, and how many each has.
    followers: Vec<u32>,
    followers_left: Vec<u32>,
}

/// A system none of whose unknowns have been eliminated.
struct Uncondensed<'a> {
    /// Both triangles, by rows.
    triangles: [&'a Sparse; 2],
    diagonal: &'a [f64],
    local: &'a [bool],
}

impl Uncondensed<'_> {
    /// Row `i` without its diagonal and without zeros.
    fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        let [lower, upper] = self.triangles;
        let row = lower.row(i).chain(upper.row(i));
        row.filter(move |&(j, v)| j != i && v != 0.0)
    }

    /// Some rows, those of local integers as [`row`](Self::row) and all others empty.
    fn couplings(&self, rows: Range<usize>) -> Result<Sparse> {
        let of_local = rows.clone().filter(|&i| self.local[i]);
        let count = of_local.map(|i| self.row(i).count()).sum();
        let mut offsets = reserve(rows.len() + 1)?;
        let mut indices = reserve(count)?;
        let mut values = reserve(count)?;
        offsets.push(0);
        for i in rows {
            may_continue_at(i)?;
            if self.local[i] {
                for (j, v) in self.row(i) {
                    indices.push(j as u32);
                    values.push(v);
                }
            }
            offsets.push(indices.len());
        }
        Ok(Sparse::from_parts(
            self.local.len(),
            offsets,
            indices,
            values,
        ))
    }

    fn condensed(&self, rows: Range<usize>) -> Result<Rows> {
        let mut part = Rows::default();
        let mut row: Vec<(u32, f64)> = Vec::new();
        for i in rows {
            may_continue_at(i)?;
            let mut curvature = self.diagonal[i];
            let (mut count, is_local) = (0, self.local[i]);
            row.clear();
            for (j, v) in self.row(i) {
                if self.local[j] {
                    part.followers.push(j as u32);
                    count += 1;
                } else if !is_local {
                    row.push((j as u32, v));
                }
            }
            let followers = &part.followers[part.followers.len() - count..];
            for &p in followers.iter().filter(|_| !is_local) {
                let p = p as usize;
                let couplings = self.row(p);
                let own = couplings.clone().find(|&(j, _)| j == i);
                let (u, d) = (own.map_or(0.0, |(_, u)| u), self.diagonal[p]);
                curvature -= u * u / d;
                for (j, v) in couplings.filter(|&(j, _)| j != i) {
                    let at = row.iter().position(|&(column, _)| column == j as u32);
                    let at = at.unwrap_or_else(|| {
                        row.push((j as u32, 0.0));
                        row.len() - 1
                    });
                    row[at].1 = changed(row[at].1, -u * v / d);
                }
            }
            row.sort_unstable_by_key(|&(j, _)| j);
            part.entries.extend(row.iter().map(|&(column, v)| Entry {
                column,
                value: SharedFloat::new(v),
            }));
            part.rows.push((curvature, part.entries.len()));
            part.followers_left.push(count as u32);
        }
        Ok(part)
    }
}

/// The sum of an entry and a part that is added to it, or zero if they cancel.
fn changed(entry: f64, part: f64) -> f64 {
    let sum = entry + part;
    match sum.abs() <= CANCELLED * part.abs() {
        true => 0.0,
        false => sum,
    }
}

impl StaticCondensation {
    /// The system with all local integers free, where `lower` is the lower triangle of `A`.
    pub fn new(lower: &Sparse, integer: &[bool]) -> Result<Self> {
        let n = lower.rows();
        let local = local_integers(lower, integer);
        let mut diagonal = vec![0.0; n];
        for i in 0..n {
            let last = lower.row(i).last().filter(|&(j, _)| j == i);
            diagonal[i] = last.map_or(0.0, |(_, v)| v);
        }
        may_continue()?;
        let upper = lower.transpose();
        let all = Uncondensed {
            triangles: [lower, &upper],
            diagonal: &diagonal,
            local: &local,
        };
        let block = |k: usize| k * ROWS..n.min((k + 1) * ROWS);
        let blocks = n.div_ceil(ROWS);
        let couplings = Sparse::stacked(collect_in_turn(blocks, |k| all.couplings(block(k))))?;
        may_continue()?;
        let mut condensed = StaticCondensation {
            rows: Vec::with_capacity(n),
            entries: Vec::new(),
            followers: Vec::new(),
            followers_start: Vec::with_capacity(n),
            followers_left: Vec::with_capacity(n),
            couplings,
            diagonal: Vec::new(),
            local: Vec::new(),
        };
        for first in (0..blocks).step_by(BLOCKS) {
            let count = BLOCKS.min(blocks - first);
            for part in collect_in_turn(count, |k| all.condensed(block(first + k))) {
                condensed.append(part?);
            }
        }
        if condensed.entries.len() > u32::MAX as usize {
            return Err(Error::OutOfMemory {
                what: "a condensed system",
            });
        }
        Ok(StaticCondensation {
            diagonal,
            local,
            ..condensed
        })
    }

    /// Appends further rows.
    fn append(&mut self, part: Rows) {
        for (&(curvature, end), &followers) in part.rows.iter().zip(&part.followers_left) {
            let start = self.rows.last().map_or(0, |row| row.end);
            self.rows.push(Row {
                curvature: SharedFloat::new(curvature),
                start,
                end: (self.entries.len() + end) as u32,
            });
            let start = self.followers_start.last().zip(self.followers_left.last());
            let start = start.map_or(0, |(at, count)| at + count.load(Relaxed));
            self.followers_start.push(start);
            self.followers_left.push(AtomicU32::new(followers));
        }
        match self.entries.is_empty() {
            true => self.entries = part.entries,
            false => self.entries.extend(part.entries),
        }
        let followers = part.followers.into_iter();
        self.followers.extend(followers.map(AtomicU32::new));
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
        self.rows[i].curvature.get()
    }

    /// The row of A of local integer `i`, without its diagonal.
    pub fn couplings(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.couplings.row(i)
    }

    /// The range of the row of local integer `i`, for [`coupling`](Self::coupling).
    pub fn coupling_range(&self, i: usize) -> std::ops::Range<usize> {
        self.couplings.offsets()[i]..self.couplings.offsets()[i + 1]
    }

    /// An entry of the row of a local integer.
    pub fn coupling(&self, at: usize) -> (usize, f64) {
        (
            self.couplings.indices()[at] as usize,
            self.couplings.values()[at],
        )
    }

    /// Row `i` of the condensed matrix without its diagonal.
    pub fn row(&self, i: usize) -> &[Entry] {
        let row = &self.rows[i];
        &self.entries[row.start as usize..row.end as usize]
    }

    /// The free local integers that couple to unknown `i`.
    pub fn followers(&self, i: usize) -> impl Iterator<Item = u32> + '_ {
        let of_unknown = self.followers_of(i).iter();
        of_unknown.map(|follower| follower.load(Relaxed))
    }

    fn followers_of(&self, i: usize) -> &[AtomicU32] {
        let start = self.followers_start[i] as usize;
        &self.followers[start..start + self.followers_left[i].load(Relaxed) as usize]
    }

    /// Adds back the part of a local integer in the Schur complement. The integer is fixed from now on.
    pub fn release(&self, p: usize) {
        let d = self.diagonal[p];
        for a in self.coupling_range(p) {
            let (i, u) = self.coupling(a);
            self.rows[i].curvature.add(u * u / d);
            let row = self.row(i);
            for b in self.coupling_range(p) {
                let (j, v) = self.coupling(b);
                if let Some(entry) = row.iter().find(|e| e.column == j as u32) {
                    entry.value.set(changed(entry.value.get(), u * v / d));
                }
            }
            let followers = self.followers_of(i);
            if let Some(place) = self.followers(i).position(|q| q as usize == p) {
                let last = followers.len() - 1;
                let moved = followers[last].load(Relaxed);
                followers[place].store(moved, Relaxed);
                self.followers_left[i].store(last as u32, Relaxed);
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
        let condensed = StaticCondensation::new(&a, &[false, false, true]).unwrap();
        let values = |c: &StaticCondensation| {
            let row = c.row(0).iter();
            row.map(|e| (e.column, e.value.get())).collect::<Vec<_>>()
        };
        assert_eq!(values(&condensed), [(1, 0.0)]);
        assert_eq!(condensed.curvature(0), 0.0);
        condensed.release(2);
        assert_eq!(values(&condensed), [(1, -2.0)]);
        assert_eq!(condensed.curvature(0), 2.0);
    }
}
