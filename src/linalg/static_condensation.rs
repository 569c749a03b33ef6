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
use super::unknown::{DETERMINED, INTEGER, LOCAL, MOST_ACTIVE, Unknown};
use crate::error::{Error, Result};
use crate::monitor::{both, collect_in_parts, collect_in_turn, may_continue, may_continue_at};

/// The rows that a thread takes at a time: those of local integers take less time than the others, which precede
/// them.
const ROWS: usize = 1 << 13;

/// So many rows are worth a thread.
const LARGE: usize = 1 << 14;

/// The blocks of rows that are condensed before they are appended to the others.
const BLOCKS: usize = 32;

/// A difference this small, relative to its terms, has cancelled and counts as zero.
const CANCELLED: f64 = 1e-12;

/// An unknown whose remaining curvature is at most this share of its diagonal entry counts as undetermined.
const UNDECIDED: f64 = 1e-10;

/// The matrix `A` with its free local integers eliminated, and where its unknowns are. Threads may share it, see
/// [`LocalSolve::relax`](super::LocalSolve::relax).
///
/// The entries of a row that are zero as long as local integers are free come last in it.
#[derive(Debug)]
pub(super) struct StaticCondensation {
    /// The off-diagonal entries of A in the rows of local integers. All other rows are empty.
    couplings: Sparse,
    diagonal: Vec<f64>,
    unknowns: Vec<Unknown>,
    entries: Vec<Entry>,
    /// For each unknown, the free local integers that couple to it. Those of unknown `i` are the
    /// `followers_left[i]` entries from `followers_start[i]` on.
    followers: Vec<AtomicU32>,
    followers_start: Vec<u32>,
    followers_left: Vec<AtomicU32>,
}

/// An off-diagonal entry. Index and value are next to each other, since they are always read together.
#[derive(Debug)]
pub(super) struct Entry {
    column: AtomicU32,
    value: SharedFloat,
}

impl Entry {
    pub fn column(&self) -> u32 {
        self.column.load(Relaxed)
    }

    pub fn value(&self) -> f64 {
        self.value.get()
    }

    fn set(&self, column: u32, value: f64) {
        self.column.store(column, Relaxed);
        self.value.set(value);
    }
}

/// Condensed rows, one after the other.
#[derive(Default)]
struct Rows {
    rows: Vec<Row>,
    entries: Vec<Entry>,
    /// The followers of all rows.
    followers: Vec<u32>,
}

/// A condensed row.
struct Row {
    curvature: f64,
    /// The number of its entries, and of those that are not zero.
    entries: usize,
    active: usize,
    followers: u32,
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
            row.sort_unstable_by_key(|&(j, v)| (v == 0.0, j));
            part.entries.extend(row.iter().map(|&(column, v)| Entry {
                column: AtomicU32::new(column),
                value: SharedFloat::new(v),
            }));
            part.rows.push(Row {
                curvature,
                entries: row.len(),
                active: row.iter().filter(|&&(_, v)| v != 0.0).count(),
                followers: count as u32,
            });
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
    /// The system with all local integers free, where `lower` is the lower triangle of `A`, and its unknowns at
    /// `point`.
    pub fn new(lower: &Sparse, integer: &[bool], point: &[f64]) -> Result<Self> {
        let n = lower.rows();
        let (local, upper) = both(
            n >= LARGE,
            || local_integers(lower, integer),
            || lower.transpose(),
        );
        let diagonal = collect_in_parts(n, LARGE, |i| lower.diagonal(i));
        may_continue()?;
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
            couplings,
            diagonal: Vec::new(),
            unknowns: Vec::with_capacity(n),
            entries: Vec::new(),
            followers: Vec::new(),
            followers_start: Vec::with_capacity(n),
            followers_left: Vec::with_capacity(n),
        };
        let flag = |flag: u32, holds: bool| if holds { flag } else { 0 };
        for first in (0..blocks).step_by(BLOCKS) {
            let count = BLOCKS.min(blocks - first);
            for part in collect_in_turn(count, |k| all.condensed(block(first + k))) {
                condensed.append(part?, |i| {
                    let flags = flag(LOCAL, local[i]) | flag(INTEGER, integer[i]);
                    (point[i], flags)
                })?;
            }
        }
        condensed.diagonal = diagonal;
        (0..n).for_each(|i| condensed.determine(i));
        Ok(condensed)
    }

    /// Appends further rows. The value and the flags of their unknowns are those given.
    fn append(&mut self, part: Rows, given: impl Fn(usize) -> (f64, u32)) -> Result<()> {
        const WHAT: &str = "a condensed system";
        if self.entries.len() + part.entries.len() > u32::MAX as usize
            || part.rows.iter().any(|row| row.entries > MOST_ACTIVE)
        {
            return Err(Error::OutOfMemory { what: WHAT });
        }
        let mut entries = self.entries.len();
        let mut followers = self.followers.len() as u32;
        for row in part.rows {
            let (value, flags) = given(self.unknowns.len());
            let start = entries as u32;
            let unknown = Unknown::new(value, row.curvature, start, flags);
            unknown.set_active(row.active);
            self.unknowns.push(unknown);
            entries += row.entries;
            self.followers_start.push(followers);
            self.followers_left.push(AtomicU32::new(row.followers));
            followers += row.followers;
        }
        match self.entries.is_empty() {
            true => self.entries = part.entries,
            false => self.entries.extend(part.entries),
        }
        let followers = part.followers.into_iter();
        self.followers.extend(followers.map(AtomicU32::new));
        Ok(())
    }

    /// Finds out whether the free unknowns determine unknown `i`.
    fn determine(&self, i: usize) {
        let unknown = &self.unknowns[i];
        match unknown.curvature.get() > UNDECIDED * self.diagonal[i] {
            true => unknown.set(DETERMINED),
            false => unknown.clear(DETERMINED),
        }
    }

    /// The number of unknowns.
    pub fn dim(&self) -> usize {
        self.unknowns.len()
    }

    pub fn unknown(&self, i: usize) -> &Unknown {
        &self.unknowns[i]
    }

    /// `A_ii`.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.diagonal[i]
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
        let next = self.unknowns.get(i + 1);
        let end = next.map_or(self.entries.len(), |next| next.start as usize);
        &self.entries[self.unknowns[i].start as usize..end]
    }

    /// The entries of row `i` that may differ from zero.
    pub fn active(&self, i: usize) -> &[Entry] {
        let unknown = &self.unknowns[i];
        let start = unknown.start as usize;
        &self.entries[start..start + unknown.active()]
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
            self.unknowns[i].curvature.add(u * u / d);
            self.determine(i);
            for b in self.coupling_range(p) {
                let (j, v) = self.coupling(b);
                self.add(i, j as u32, u * v / d);
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

    /// Adds a part to an entry of row `i`, if there is one.
    fn add(&self, i: usize, column: u32, part: f64) {
        let row = self.row(i);
        let Some(at) = row.iter().position(|entry| entry.column() == column) else {
            return;
        };
        let value = changed(row[at].value(), part);
        let active = self.unknowns[i].active();
        if at < active || value == 0.0 {
            return row[at].set(column, value);
        }
        // The first that is zero takes its place, and it enters among those that are not, by their columns.
        row[at].set(row[active].column(), 0.0);
        let mut place = active;
        while place > 0 && row[place - 1].column() > column {
            row[place].set(row[place - 1].column(), row[place - 1].value());
            place -= 1;
        }
        row[place].set(column, value);
        self.unknowns[i].set_active(active + 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_random::Random;

    fn entries_of(row: &[Entry]) -> Vec<(u32, f64)> {
        row.iter().map(|e| (e.column(), e.value())).collect()
    }

    #[test]
    fn entries_that_are_no_longer_zero_are_in_the_order_of_columns() {
        let (n, rows) = (40u32, 120u32);
        let mut random = Random::new(11);
        let mut sums = std::collections::BTreeMap::new();
        for p in n..n + rows {
            let [i, j] = [random.below(n as usize), random.below(n as usize)].map(|i| i as u32);
            let row = [(i, 1.0), (j, -1.0), (p, 2.0)];
            for (a, u) in row {
                for (b, v) in row.into_iter().filter(|&(b, _)| b <= a) {
                    *sums.entry((a, b)).or_insert(0.0) += u * v;
                }
            }
        }
        let dim = (n + rows) as usize;
        let triplets = sums.iter().map(|(&(a, b), &v)| (a, b, v));
        let matrix = Sparse::from_triplets(dim, dim, triplets).unwrap();
        let integer: Vec<bool> = (0..dim).map(|i| i >= n as usize).collect();
        let condensed = StaticCondensation::new(&matrix, &integer, &vec![0.0; dim]).unwrap();
        let sorted = |row: &[Entry]| row.is_sorted_by_key(|entry| entry.column());
        let mut least = usize::MAX;
        let mut order: Vec<u32> = (n..n + rows).collect();
        while !order.is_empty() {
            let next = order.swap_remove(random.below(order.len()));
            condensed.release(next as usize);
            for i in 0..n as usize {
                let active = condensed.active(i);
                assert!(sorted(active));
                let zeros = &condensed.row(i)[active.len()..];
                assert!(zeros.iter().all(|entry| entry.value() == 0.0));
                least = least.min(active.len());
            }
        }
        assert_eq!(least, 0);
        for i in 0..n {
            let all = (0..n).filter(|&j| j != i);
            let of = |j: u32| sums.get(&(i.max(j), i.min(j))).copied().unwrap_or(0.0);
            let expected: Vec<_> = all.map(|j| (j, of(j))).filter(|e| e.1 != 0.0).collect();
            assert_eq!(entries_of(condensed.active(i as usize)), expected);
        }
    }

    #[test]
    fn an_absorbed_row_couples_nobody_until_its_integer_is_fixed() {
        // (x0 - x1 + 2 x2)^2 with x2 integer
        let row = [(0u32, 1.0), (1, -1.0), (2, 2.0)];
        let entries = row.iter().flat_map(|&(i, u)| {
            let lower = row.iter().filter(move |&&(j, _)| j <= i);
            lower.map(move |&(j, v)| (i, j, 2.0 * u * v))
        });
        let a = Sparse::from_triplets(3, 3, entries).unwrap();
        let condensed = StaticCondensation::new(&a, &[false, false, true], &[0.0; 3]).unwrap();
        let first = condensed.unknown(0);
        assert_eq!(entries_of(condensed.row(0)), [(1, 0.0)]);
        assert!(condensed.active(0).is_empty());
        assert_eq!(first.curvature.get(), 0.0);
        assert!(!first.has(DETERMINED));
        condensed.release(2);
        assert_eq!(entries_of(condensed.active(0)), [(1, -2.0)]);
        assert_eq!(first.curvature.get(), 2.0);
        assert!(first.has(DETERMINED));
    }
}
