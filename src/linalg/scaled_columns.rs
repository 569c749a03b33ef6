//! A scaled matrix by columns, as its factorization reads it.

use super::Sparse;
use super::sparse::reserve;
use crate::error::Result;
use crate::monitor::in_parts;

/// The least number of columns that are worth a thread.
const LEAST: usize = 1 << 14;

/// The scaled matrix by columns, in the order of elimination: of each column the entries from the diagonal on.
pub(super) struct Columns {
    offsets: Vec<u32>,
    entries: Vec<(u32, f64)>,
}

impl Columns {
    /// The columns of the matrix with lower triangle `lower`, with unknown i at `position(i)`.
    pub fn new(
        lower: &Sparse,
        scale: &[f64],
        position: impl Fn(usize) -> u32 + Sync,
    ) -> Result<Self> {
        let place = |i: usize, j: usize| {
            let (a, b) = (position(i), position(j));
            (a.min(b) as usize, a.max(b))
        };
        // Each part looks at all entries and takes those of its own columns.
        let parts = in_parts(lower.rows(), LEAST, |part| -> Result<_> {
            let mut offsets = vec![0u32; part.len() + 1];
            let of_part = |i: usize, j: usize| {
                let (column, row) = place(i, j);
                let column = column.wrapping_sub(part.start);
                (column < part.len()).then_some((column, row))
            };
            for i in 0..lower.rows() {
                let columns = lower.row(i).filter_map(|(j, _)| of_part(i, j));
                columns.for_each(|(column, _)| offsets[column + 1] += 1);
            }
            for k in 0..part.len() {
                offsets[k + 1] += offsets[k];
            }
            let mut next = offsets.clone();
            let count = offsets[part.len()] as usize;
            let mut entries = reserve(count)?;
            entries.resize(count, (0, 0.0));
            for i in 0..lower.rows() {
                for (j, v) in lower.row(i) {
                    if let Some((column, row)) = of_part(i, j) {
                        entries[next[column] as usize] = (row, v * scale[i] * scale[j]);
                        next[column] += 1;
                    }
                }
            }
            Ok(Columns { offsets, entries })
        });
        let mut parts = parts.into_iter();
        let mut all = parts
            .next()
            .unwrap_or_else(|| unreachable!("there is one"))?;
        for part in parts {
            let mut part = part?;
            let before = all.entries.len() as u32;
            (all.offsets).extend(part.offsets[1..].iter().map(|at| before + at));
            all.entries.append(&mut part.entries);
        }
        Ok(all)
    }

    pub fn column(&self, k: usize) -> &[(u32, f64)] {
        &self.entries[self.offsets[k] as usize..self.offsets[k + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn columns_hold_the_scaled_entries_in_the_order_of_rows() {
        let n = 3 * LEAST;
        let near = |i: usize| {
            let columns = i.saturating_sub(2)..=i;
            columns.map(move |j| (i as u32, j as u32, j as f64 + 0.5))
        };
        let entries = (0..n).flat_map(near);
        let a = Sparse::from_triplets(n, n, entries).unwrap();
        let scale: Vec<f64> = (0..n).map(|i| 1.0 + (i % 3) as f64).collect();
        let position = |i: usize| (i * 5 % n) as u32;
        let made = || Columns::new(&a, &scale, position).unwrap();
        let mut expected = vec![Vec::new(); n];
        for (i, j, v) in a.entries() {
            let (i, j) = (i as usize, j as usize);
            let (k, l) = (position(i), position(j));
            expected[k.min(l) as usize].push((k.max(l), v * scale[i] * scale[j]));
        }
        for threads in [1, 3] {
            let mut columns = None;
            let started = spawned(|| columns = Some(with_threads(threads, made)));
            assert_eq!(started, threads - 1);
            let columns = columns.unwrap();
            assert!((0..n).all(|k| columns.column(k) == expected[k]));
        }
    }
}
