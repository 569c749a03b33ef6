//! Back substitution through the stack, last substitution first. It yields the matrix T of the expansion `x =
//! T y + t`; `right_sides` computes the offset `t`.

use super::row::{TooLarge, add_product};
use super::tableau::Tableau;
use super::tolerance::NOISE;
use super::unknowns::Unknowns;
use crate::error::{Error, Result};
use crate::linalg::sparse::reserve;
use crate::linalg::{Accumulator, Sparse};
use crate::monitor::{Monitor, may_continue_at};

/// Computes `T` and the list of remaining unknowns, in increasing order.
pub(super) fn substitute_back(
    tableau: &Tableau,
    monitor: &mut Monitor,
) -> Result<(Sparse, Vec<u32>)> {
    let unknowns = &tableau.unknowns;
    let stack = &tableau.stack;
    let mut reduced = vec![u32::MAX; unknowns.len()];
    let free: Vec<u32> = (0..unknowns.len() as u32)
        .filter(|&u| unknowns.is_free(u))
        .collect();
    for (y, &u) in free.iter().enumerate() {
        reduced[u as usize] = y as u32;
    }
    let mut known = Known {
        entries: reserve(2 * stack.len())?,
        rows: vec![(0, 0); stack.len()],
    };
    let mut sum = Sum::new(free.len());
    for k in (0..stack.len()).rev() {
        monitor.check()?;
        let (by, terms) = stack.get(k);
        sum.exact = unknowns.integer[by.pivot as usize];
        known
            .push(k, terms, &reduced, &unknowns.replaced, &mut sum)
            .map_err(|error| match error {
                Trouble::TooLarge => stack.too_large(k, |r| tableau.overflow(r)),
                Trouble::Memory(error) => error,
            })?;
    }
    Ok((known.matrix(tableau, &reduced)?, free))
}

enum Trouble {
    TooLarge,
    Memory(Error),
}

impl From<TooLarge> for Trouble {
    fn from(_: TooLarge) -> Self {
        Trouble::TooLarge
    }
}

/// The rows of `T` of the replaced unknowns, by substitution.
struct Known {
    entries: Vec<(u32, f64)>,
    rows: Vec<(usize, usize)>,
}

impl Known {
    fn push(
        &mut self,
        k: usize,
        terms: &[(u32, f64)],
        reduced: &[u32],
        replaced: &[u32],
        sum: &mut Sum,
    ) -> std::result::Result<(), Trouble> {
        for &(j, c) in terms {
            match replaced[j as usize] {
                Unknowns::FREE => sum.add(reduced[j as usize], c)?,
                later => {
                    let (start, end) = self.rows[later as usize];
                    for &(y, v) in &self.entries[start..end] {
                        sum.add(y, c * v)?;
                    }
                }
            }
        }
        let start = self.entries.len();
        self.entries.try_reserve(sum.entries.len()).map_err(|_| {
            Trouble::Memory(Error::OutOfMemory {
                what: "the expansion",
            })
        })?;
        sum.drain_into(&mut self.entries);
        self.rows[k] = (start, self.entries.len());
        Ok(())
    }

    fn matrix(&self, tableau: &Tableau, reduced: &[u32]) -> Result<Sparse> {
        let n = tableau.model.variables();
        let free = reduced.iter().filter(|&&y| y != u32::MAX).count();
        let mut offsets = reserve(n + 1)?;
        let mut indices = reserve(n + self.entries.len())?;
        let mut values = reserve(n + self.entries.len())?;
        offsets.push(0);
        for i in 0..n {
            may_continue_at(i)?;
            match tableau.unknowns.replaced[i] {
                Unknowns::FREE => {
                    indices.push(reduced[i]);
                    values.push(1.0);
                }
                k => {
                    let (start, end) = self.rows[k as usize];
                    let row = &self.entries[start..end];
                    indices.extend(row.iter().map(|e| e.0));
                    values.extend(row.iter().map(|e| e.1));
                }
            }
            offsets.push(indices.len());
        }
        Ok(Sparse::from_parts(free, offsets, indices, values))
    }
}

/// A sparse row that is being summed.
struct Sum {
    entries: Accumulator<Entry>,
    exact: bool,
}

#[derive(Clone, Copy, Default)]
struct Entry {
    value: f64,
    largest_term: f64,
}

impl Sum {
    fn new(len: usize) -> Self {
        Sum {
            entries: Accumulator::new(len),
            exact: false,
        }
    }

    fn add(&mut self, y: u32, v: f64) -> std::result::Result<(), TooLarge> {
        let entry = self.entries.slot(y);
        entry.largest_term = entry.largest_term.max(v.abs());
        entry.value = add_product(entry.value, v, 1.0, self.exact)?;
        Ok(())
    }

    /// Appends the row, sorted and without cancelled entries, and empties the sum.
    fn drain_into(&mut self, row: &mut Vec<(u32, f64)>) {
        let exact = self.exact;
        self.entries.sort();
        self.entries.drain(|y, entry| {
            let noise = if exact {
                0.0
            } else {
                NOISE * entry.largest_term
            };
            if entry.value.abs() > noise {
                row.push((y, entry.value));
            }
        });
    }
}
