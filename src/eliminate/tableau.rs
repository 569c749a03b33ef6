//! The constraints during the elimination: the rows, the occurrences of each unknown, and the choice of the
//! next row.
//!
//! The row with the fewest entries comes first. For comparison, rows can be taken in the order given.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::errors;
use super::occurrences::Occurrences;
use super::ratio::integer_multiples;
use super::row::{Change, Row, State, TooLarge};
use super::stack::Stack;
use super::steps::{Definitions, Step};
use super::substitution::Substitution;
use super::tolerance::{LARGEST, LARGEST_PIVOT, LONG, PIVOT};
use super::unknowns::Unknowns;
use crate::error::{Error, Result};
use crate::linalg::Ordering;
use crate::problem::Model;

/// The state of the elimination.
pub(super) struct Tableau<'a> {
    pub model: &'a Model,
    pub rows: Vec<Row>,
    pub unknowns: Unknowns,
    pub occurrences: Occurrences,
    pub stack: Stack,
    pub steps: Vec<Step>,
    pub definitions: Definitions,
    ordering: Ordering,
    queue: BinaryHeap<Reverse<(u32, u32)>>,
    waiting_long: BinaryHeap<Reverse<(u32, u32)>>,
    buffer: Vec<(u32, f64)>,
    hit: Vec<u32>,
}

impl<'a> Tableau<'a> {
    /// The constraints of `model` without the pinned unknowns.
    pub fn new(model: &'a Model, ordering: Ordering) -> Result<Self> {
        let mut unknowns = Unknowns::new(model.integer());
        let mut stack = Stack::default();
        for (i, value) in model.pinned().iter().enumerate() {
            if value.is_some() {
                let by = Substitution {
                    pivot: i as u32,
                    constraint: Substitution::NO_CONSTRAINT,
                    largest: 0.0,
                    magnitude: 0.0,
                    denominator: Some(1.0),
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
            steps: Vec::new(),
            definitions: Definitions::default(),
            ordering,
            queue: BinaryHeap::with_capacity(count),
            waiting_long: BinaryHeap::new(),
            buffer: Vec::new(),
            hit: Vec::new(),
        };
        for r in 0..count {
            let row = tableau.row_without_pins(r);
            tableau.rows.push(row);
            for k in 0..tableau.rows[r].entries.len() {
                let unknown = tableau.rows[r].entries[k].0;
                tableau.occurrences.add(unknown, r as u32);
            }
            tableau.settle(r)?;
        }
        Ok(tableau)
    }

    fn row_without_pins(&self, r: usize) -> Row {
        let given = self.model.constraints().row(r);
        let largest = given.clone().fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
        let scale = scale_of(largest);
        let pinned = self.model.pinned();
        let whole = |v: f64| v.fract() == 0.0 && v.abs() < LARGEST;
        let are_whole = given.clone().all(|(_, v)| whole(v));
        let free = given.filter(|&(j, _)| pinned[j].is_none());
        let scaled = free.map(|(j, v)| (j as u32, v * scale));
        Row {
            entries: scaled.filter(|e| e.1 != 0.0).collect(),
            magnitude: if largest > 0.0 { largest * scale } else { 1.0 },
            scale,
            denominator: are_whole.then_some(1.0),
            continuous: 0,
            touched: false,
            integral: false,
            state: State::Waiting,
        }
    }

    /// Queues a row that has changed. A row of integers first gets integer coefficients. A long row is set
    /// aside.
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
            self.make_integral(r)?;
        }
        let row = &mut self.rows[r];
        if len > LONG && self.ordering != Ordering::LargestPivot {
            row.state = State::Long;
            for &(unknown, _) in &row.entries {
                self.occurrences.remove(unknown);
            }
            self.waiting_long.push(Reverse((len as u32, r as u32)));
        } else {
            self.queue.push(Reverse((self.urgency(r), r as u32)));
        }
        Ok(())
    }

    /// The key by which rows are queued.
    fn urgency(&self, r: usize) -> u32 {
        match self.ordering {
            Ordering::FillReducing | Ordering::LargestPivot => self.rows[r].entries.len() as u32,
            Ordering::Natural => 0,
        }
    }

    /// The number of rows that solving for `unknown` would change.
    pub fn cost(&self, unknown: u32) -> u32 {
        match self.ordering {
            Ordering::FillReducing => self.occurrences.count(unknown),
            Ordering::Natural | Ordering::LargestPivot => 0,
        }
    }

    /// The least size of a pivot, relative to the largest coefficient of its row.
    pub fn pivot_threshold(&self) -> f64 {
        match self.ordering {
            Ordering::FillReducing | Ordering::Natural => PIVOT,
            Ordering::LargestPivot => LARGEST_PIVOT,
        }
    }

    /// The waiting row with the fewest entries (ties to the first). It no longer counts among the
    /// occurrences.
    pub fn take_next(&mut self) -> Option<usize> {
        while let Some(Reverse((urgency, r))) = self.queue.pop() {
            let current = self.urgency(r as usize) == urgency;
            let row = &mut self.rows[r as usize];
            if row.state == State::Waiting && current {
                row.state = State::Done;
                for &(unknown, _) in &row.entries {
                    self.occurrences.remove(unknown);
                }
                return Some(r as usize);
            }
        }
        None
    }

    /// The long row that had the fewest entries when it was set aside.
    pub fn take_long(&mut self) -> Option<usize> {
        let Reverse((_, r)) = self.waiting_long.pop()?;
        self.rows[r as usize].state = State::Done;
        Some(r as usize)
    }

    /// Solves row `r` for its entry at position `at`, and applies the substitution to the waiting rows.
    pub fn solve_for(&mut self, r: usize, at: usize) -> Result<()> {
        let (row, pivot) = (r as u32, self.rows[r].entries[at].1);
        self.stack.solve(r, &self.rows[r], at);
        self.steps.push(Step::Solve { row, pivot });
        self.apply_last()
    }

    /// Applies the newest substitution to the waiting rows.
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
        let row = &self.rows[r];
        self.steps.push(Step::Substitute {
            row: r as u32,
            by: by as u32,
            factor: row.entries[at].1,
            integral: row.integral,
        });
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

    /// Turns the coefficients of row `r`, which has integer unknowns only, into integers.
    pub fn make_integral(&mut self, r: usize) -> Result<()> {
        let row = &mut self.rows[r];
        let Some(unit) = integer_multiples(row) else {
            return Err(errors::incommensurable(self.model, r));
        };
        if row.entries.iter().any(|e| e.1.abs() >= LARGEST) {
            return Err(self.overflow(r));
        }
        row.integral = true;
        let row = r as u32;
        self.steps.push(Step::MakeIntegral { row, unit });
        Ok(())
    }

    pub fn overflow(&self, r: usize) -> Error {
        errors::overflow(self.model, r)
    }
}

/// The power of two that brings `largest` into [1, 2), or the nearest that a double can hold.
fn scale_of(largest: f64) -> f64 {
    if largest == 0.0 {
        return 1.0;
    }
    // The biased exponent is read from the bits, because log2 may be off by one.
    let exponent = ((largest.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    2f64.powi(-exponent.clamp(-1022, 1022))
}
