//! Back substitution: the expansion `x = T y + t` from the stack, last substitution first.

use super::Expansion;
use super::row::{TooLarge, add_product};
use super::stack::Substitution;
use super::tableau::Tableau;
use super::tolerance::NOISE;
use super::unknowns::Unknowns;
use crate::linalg::Sparse;
use crate::linalg::sparse::reserve;
use crate::solve::Monitor;
use crate::{Error, Result};

/// The expansion, and the unknowns that are left, in their order.
pub(super) fn substitute_back(
    tableau: &Tableau,
    monitor: &mut Monitor,
) -> Result<(Expansion, Vec<u32>)> {
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
        offset: vec![0.0; stack.len()],
    };
    let mut sum = Sum::new(free.len());
    for k in (0..stack.len()).rev() {
        monitor.check()?;
        let (by, terms) = stack.get(k);
        sum.exact = unknowns.integer[by.pivot as usize];
        known
            .push(k, by, terms, &reduced, &unknowns.replaced, &mut sum)
            .map_err(|error| match error {
                Trouble::TooLarge if by.constraint == Substitution::NO_CONSTRAINT => {
                    Error::Overflow {
                        what: format!("variable {} is pinned to a number too large", by.pivot),
                        index: Some(by.pivot as usize),
                    }
                }
                Trouble::TooLarge => tableau.overflow(by.constraint as usize),
                Trouble::Memory(error) => error,
            })?;
    }
    Ok((known.expansion(tableau, &reduced)?, free))
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

/// Rows of `T` and entries of `t` of the replaced unknowns, by substitution.
struct Known {
    entries: Vec<(u32, f64)>,
    rows: Vec<(usize, usize)>,
    offset: Vec<f64>,
}

impl Known {
    fn push(
        &mut self,
        k: usize,
        by: &Substitution,
        terms: &[(u32, f64)],
        reduced: &[u32],
        replaced: &[u32],
        sum: &mut Sum,
    ) -> std::result::Result<(), Trouble> {
        let mut offset = by.constant;
        let mut largest = offset.abs();
        for &(j, c) in terms {
            match replaced[j as usize] {
                Unknowns::FREE => sum.add(reduced[j as usize], c)?,
                later => {
                    let later = later as usize;
                    let (start, end) = self.rows[later];
                    for &(y, v) in &self.entries[start..end] {
                        sum.add(y, c * v)?;
                    }
                    largest = largest.max((c * self.offset[later]).abs());
                    offset = add_product(offset, c, self.offset[later], sum.exact)?;
                }
            }
        }
        if !offset.is_finite() {
            return Err(Trouble::TooLarge);
        }
        if !sum.exact && offset.abs() <= NOISE * largest {
            offset = 0.0;
        }
        self.offset[k] = offset;
        let start = self.entries.len();
        self.entries.try_reserve(sum.present.len()).map_err(|_| {
            Trouble::Memory(Error::OutOfMemory {
                what: "the expansion",
            })
        })?;
        sum.drain_into(&mut self.entries);
        self.rows[k] = (start, self.entries.len());
        Ok(())
    }

    fn expansion(&self, tableau: &Tableau, reduced: &[u32]) -> Result<Expansion> {
        let n = tableau.model.variables();
        let free = reduced.iter().filter(|&&y| y != u32::MAX).count();
        let mut offsets = reserve(n + 1)?;
        let mut indices = reserve(n + self.entries.len())?;
        let mut values = reserve(n + self.entries.len())?;
        let mut offset = vec![0.0; n];
        offsets.push(0);
        for i in 0..n {
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
                    offset[i] = self.offset[k as usize];
                }
            }
            offsets.push(indices.len());
        }
        let matrix = Sparse::from_parts(free, offsets, indices, values);
        Ok(Expansion::new(matrix, offset))
    }
}

/// A sparse row being summed.
struct Sum {
    value: Vec<f64>,
    /// The largest term of each entry; 0 where there is none.
    largest: Vec<f64>,
    present: Vec<u32>,
    exact: bool,
}

impl Sum {
    fn new(len: usize) -> Self {
        Sum {
            value: vec![0.0; len],
            largest: vec![0.0; len],
            present: Vec::new(),
            exact: false,
        }
    }

    fn add(&mut self, y: u32, v: f64) -> std::result::Result<(), TooLarge> {
        let i = y as usize;
        if v != 0.0 && self.largest[i] == 0.0 {
            self.present.push(y);
        }
        self.largest[i] = self.largest[i].max(v.abs());
        self.value[i] = add_product(self.value[i], v, 1.0, self.exact)?;
        Ok(())
    }

    /// Appends the row, sorted and without what cancelled, and empties the sum.
    fn drain_into(&mut self, entries: &mut Vec<(u32, f64)>) {
        self.present.sort_unstable();
        for &y in &self.present {
            let i = y as usize;
            let value = std::mem::take(&mut self.value[i]);
            let largest = std::mem::take(&mut self.largest[i]);
            let noise = if self.exact { 0.0 } else { NOISE * largest };
            if value.abs() > noise {
                entries.push((y, value));
            }
        }
        self.present.clear();
    }
}
