//! Substituted unknowns are removed from a long row in one pass, after the short rows.
//!
//! If a row of thousands of entries were kept up to date, every short row that touches it would copy it.
//! Instead, all substitutions are applied to it at the end, in the order in which they were made. This is the
//! left-looking form of the elimination, as in `gilbert1988`, with a heap for the order in place of a graph
//! search. Its cost is proportional to the entries touched.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::row::{TooLarge, add_product};
use super::steps::Step;
use super::tableau::Tableau;
use super::tolerance::NOISE;
use super::unknowns::Unknowns;
use crate::error::Result;
use crate::linalg::Accumulator;
use crate::monitor::Monitor;

/// Removes all replaced unknowns from row `r`.
pub(super) fn sweep(tableau: &mut Tableau, r: usize, monitor: &mut Monitor) -> Result<()> {
    let Tableau {
        rows,
        stack,
        steps,
        unknowns,
        ..
    } = &mut *tableau;
    let mut scatter = Scatter::new(unknowns);
    let row = &mut rows[r];
    let integral = row.integral;
    for &(j, v) in &row.entries {
        scatter.insert(j, v);
    }
    let mut swept = Ok(());
    while let Some((k, factor)) = scatter.next_replaced(NOISE * row.magnitude, integral) {
        monitor.check()?;
        let (by, terms) = stack.get(k);
        row.grow(factor, by);
        steps.push(Step::Substitute {
            row: r as u32,
            by: k as u32,
            factor,
            integral,
        });
        swept = scatter.add(factor, terms, integral);
        if swept.is_err() {
            break;
        }
    }
    row.entries = scatter.gather(NOISE * row.magnitude, integral);
    let integer = &unknowns.integer;
    row.drop_noise(integer, |_| ());
    row.continuous = row
        .entries
        .iter()
        .filter(|e| !integer[e.0 as usize])
        .count() as u32;
    let becomes_integral = row.continuous == 0 && !integral && !row.entries.is_empty();
    swept.map_err(|TooLarge| tableau.overflow(r))?;
    if becomes_integral {
        tableau.make_integral(r)?;
    }
    Ok(())
}

/// A row in dense storage, with the substitutions that it needs in order.
struct Scatter<'a> {
    replaced: &'a [u32],
    entries: Accumulator<Entry>,
    order: BinaryHeap<Reverse<(u32, u32)>>,
}

#[derive(Clone, Copy, Default)]
struct Entry {
    value: f64,
    terms: Terms,
}

/// The number of terms in the sum of an entry. Several terms may have cancelled.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Terms {
    #[default]
    None,
    One,
    Several,
}

impl<'a> Scatter<'a> {
    fn new(unknowns: &'a Unknowns) -> Self {
        Scatter {
            replaced: &unknowns.replaced,
            entries: Accumulator::new(unknowns.len()),
            order: BinaryHeap::new(),
        }
    }

    fn insert(&mut self, unknown: u32, value: f64) {
        let terms = Terms::One;
        *self.entries.slot(unknown) = Entry { value, terms };
        let substitution = self.replaced[unknown as usize];
        if substitution != Unknowns::FREE {
            self.order.push(Reverse((substitution, unknown)));
        }
    }

    fn add(
        &mut self,
        factor: f64,
        terms: &[(u32, f64)],
        exact: bool,
    ) -> std::result::Result<(), TooLarge> {
        for &(unknown, term) in terms {
            let entry = *self.entries.get(unknown);
            let value = add_product(entry.value, factor, term, exact)?;
            if entry.terms == Terms::None {
                self.insert(unknown, value);
            } else {
                let terms = Terms::Several;
                *self.entries.slot(unknown) = Entry { value, terms };
            }
        }
        Ok(())
    }

    /// The earliest substitution that remains, and the coefficient of the unknown that it replaces.
    fn next_replaced(&mut self, noise: f64, exact: bool) -> Option<(usize, f64)> {
        while let Some(Reverse((k, unknown))) = self.order.pop() {
            let entry = self.entries.get(unknown);
            if !entry.is_noise(noise, exact) {
                return Some((k as usize, entry.value));
            }
        }
        None
    }

    fn gather(mut self, noise: f64, exact: bool) -> Vec<(u32, f64)> {
        let mut row = Vec::new();
        self.entries.sort();
        self.entries.drain(|unknown, entry| {
            let free = self.replaced[unknown as usize] == Unknowns::FREE;
            if free && !entry.is_noise(noise, exact) {
                row.push((unknown, entry.value));
            }
        });
        row
    }
}

impl Entry {
    fn is_noise(&self, noise: f64, exact: bool) -> bool {
        let size = self.value.abs();
        size == 0.0 || (!exact && self.terms == Terms::Several && size <= noise)
    }
}
