//! The constraints while they are being eliminated: rows, where unknowns occur, whose turn it is.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::integral::make_integral;
use super::occurrences::Occurrences;
use super::row::{Change, Row, State, TooLarge};
use super::stack::{Stack, Substitution};
use super::tolerance::LONG;
use super::unknowns::Unknowns;
use crate::linalg::CompensatedSum;
use crate::problem::row_text;
use crate::{Error, Model, Result};

/// Everything that the elimination works on.
pub(super) struct Tableau<'a> {
    pub model: &'a Model,
    pub rows: Vec<Row>,
    pub unknowns: Unknowns,
    pub occurrences: Occurrences,
    pub stack: Stack,
    queue: BinaryHeap<Reverse<(u32, u32)>>,
    waiting_long: BinaryHeap<Reverse<(u32, u32)>>,
    buffer: Vec<(u32, f64)>,
    hit: Vec<u32>,
}

impl<'a> Tableau<'a> {
    /// The constraints of `model` with the pinned unknowns moved to the right sides.
    pub fn new(model: &'a Model) -> Result<Self> {
        let mut unknowns = Unknowns::new(model.integer(), model.guess());
        let mut stack = Stack::default();
        for (i, value) in model.pinned().iter().enumerate() {
            if let &Some(value) = value {
                let by = Substitution {
                    pivot: i as u32,
                    constraint: Substitution::NO_CONSTRAINT,
                    constant: value,
                    largest: 0.0,
                    magnitude: 0.0,
                    rhs_magnitude: value.abs(),
                };
                unknowns.replaced[i] = stack.len() as u32;
                stack.push(by, []);
            }
        }
        let count = model.constraints().rows();
        let mut tableau = Tableau {
            model,
            rows: Vec::with_capacity(count),
            occurrences: Occurrences::new(unknowns.len()),
            unknowns,
            stack,
            queue: BinaryHeap::with_capacity(count),
            waiting_long: BinaryHeap::new(),
            buffer: Vec::new(),
            hit: Vec::new(),
        };
        for r in 0..count {
            let row = tableau.row_without_pins(r)?;
            tableau.rows.push(row);
            for k in 0..tableau.rows[r].entries.len() {
                let unknown = tableau.rows[r].entries[k].0;
                tableau.occurrences.add(unknown, r as u32);
            }
            tableau.settle(r)?;
        }
        Ok(tableau)
    }

    fn row_without_pins(&self, r: usize) -> Result<Row> {
        let given = self.model.constraints().row(r);
        let largest = given.clone().fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
        let scale = scale_of(largest);
        let rhs = self.model.constraint_rhs()[r] * scale;
        let mut row = Row {
            entries: Vec::with_capacity(given.len()),
            rhs,
            magnitude: if largest > 0.0 { largest * scale } else { 1.0 },
            rhs_magnitude: rhs.abs(),
            scale,
            continuous: 0,
            integral: false,
            state: State::Waiting,
        };
        let mut rest = CompensatedSum::new(rhs);
        for (j, v) in given {
            let v = v * scale;
            if let Some(value) = self.model.pinned()[j] {
                rest.add_product(-v, value);
                row.rhs_magnitude = row.rhs_magnitude.max((v * value).abs());
            } else if v != 0.0 {
                row.entries.push((j as u32, v));
            }
        }
        row.rhs = rest.value();
        if !row.rhs.is_finite() || !row.rhs_magnitude.is_finite() {
            return Err(self.overflow(r));
        }
        Ok(row)
    }

    /// Puts a row that changed where it belongs: exact if it has integers only, among the long
    /// ones if it is long, else in the queue.
    fn settle(&mut self, r: usize) -> Result<()> {
        let row = &mut self.rows[r];
        let integer = &self.unknowns.integer;
        row.continuous = row
            .entries
            .iter()
            .filter(|e| !integer[e.0 as usize])
            .count() as u32;
        let len = row.entries.len();
        if len > 0 && row.continuous == 0 && !row.integral {
            make_integral(self, r)?;
        }
        let row = &mut self.rows[r];
        if len > LONG {
            row.state = State::Long;
            for &(unknown, _) in &row.entries {
                self.occurrences.remove(unknown);
            }
            self.waiting_long.push(Reverse((len as u32, r as u32)));
        } else {
            self.queue.push(Reverse((len as u32, r as u32)));
        }
        Ok(())
    }

    /// The shortest waiting row, ties to the first, no longer counted among the occurrences.
    pub fn take_shortest(&mut self) -> Option<usize> {
        while let Some(Reverse((len, r))) = self.queue.pop() {
            let row = &mut self.rows[r as usize];
            if row.state == State::Waiting && row.entries.len() == len as usize {
                row.state = State::Done;
                for &(unknown, _) in &row.entries {
                    self.occurrences.remove(unknown);
                }
                return Some(r as usize);
            }
        }
        None
    }

    /// The long row that was the shortest when it was set aside.
    pub fn take_long(&mut self) -> Option<usize> {
        let Reverse((_, r)) = self.waiting_long.pop()?;
        self.rows[r as usize].state = State::Done;
        Some(r as usize)
    }

    /// Solves row `r` for its entry at position `at`, and puts the result into the waiting rows.
    pub fn solve_for(&mut self, r: usize, at: usize) -> Result<()> {
        self.stack.solve(r, &self.rows[r], at);
        self.apply_last()
    }

    /// Puts the newest substitution into the waiting rows.
    pub fn apply_last(&mut self) -> Result<()> {
        let last = self.stack.len() - 1;
        let pivot = self.stack.get(last).0.pivot;
        self.unknowns.replaced[pivot as usize] = last as u32;
        self.occurrences.resize(self.unknowns.len());
        let mut hit = std::mem::take(&mut self.hit);
        hit.clear();
        hit.extend(self.occurrences.rows(pivot));
        for &r in &hit {
            let r = r as usize;
            if self.rows[r].state == State::Waiting
                && let Some(at) = self.rows[r].position(pivot)
            {
                self.substitute(r, at, last).map_err(|_| self.overflow(r))?;
                let occurrences = &mut self.occurrences;
                self.rows[r].drop_noise(&self.unknowns.integer, |u| occurrences.remove(u));
                self.settle(r)?;
            }
        }
        self.hit = hit;
        Ok(())
    }

    fn substitute(&mut self, r: usize, at: usize, by: usize) -> std::result::Result<(), TooLarge> {
        let (by, terms) = self.stack.get(by);
        let occurrences = &mut self.occurrences;
        self.rows[r].substitute(
            at,
            by,
            terms,
            &mut self.buffer,
            |unknown, change| match change {
                Change::Appeared => occurrences.add(unknown, r as u32),
                Change::Vanished => occurrences.remove(unknown),
            },
        )
    }

    /// Constraint `r` as the caller gave it.
    pub fn text(&self, r: usize) -> String {
        row_text(
            self.model.constraints().row(r),
            self.model.constraint_rhs()[r],
        )
    }

    pub fn overflow(&self, r: usize) -> Error {
        Error::Overflow {
            what: format!(
                "constraint {r}: {} leads to numbers too large to be exact",
                self.text(r)
            ),
            index: Some(r),
        }
    }

    pub fn no_integer_solution(&self, r: usize) -> Error {
        Error::NoIntegerSolution {
            constraint: r,
            row: self.text(r),
        }
    }

    pub fn infeasible(&self, r: usize) -> Error {
        Error::Infeasible {
            constraint: r,
            row: self.text(r),
        }
    }
}

/// The power of two that brings `largest` into [1, 2), as far as there is one.
fn scale_of(largest: f64) -> f64 {
    if largest == 0.0 {
        return 1.0;
    }
    // The biased exponent, straight from the bits: log2 may be off by one.
    let exponent = ((largest.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    2f64.powi(-exponent.clamp(-1022, 1022))
}
