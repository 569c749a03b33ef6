//! The coefficients of one equation while it is being worked on.

use super::substitution::Substitution;
use super::tolerance::{LARGEST, NOISE, RANK};

/// The left side of an equation; the right sides follow later, see `right_sides`.
#[derive(Debug, Clone)]
pub(super) struct Row {
    /// Unknowns, increasing, with their coefficients, none of them zero.
    pub entries: Vec<(u32, f64)>,
    /// Largest coefficient that took part in making this row: what noise is measured against.
    pub magnitude: f64,
    /// The power of two that the caller's row was multiplied by.
    pub scale: f64,
    /// How many of the unknowns are continuous.
    pub continuous: u32,
    /// Whether anything was substituted.
    pub touched: bool,
    /// Only integer unknowns, and only integers below 2^53 as numbers: nothing here is rounded.
    pub integral: bool,
    pub state: State,
}

/// Where a row is on its way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Short, kept free of substituted unknowns at every step.
    Waiting,
    /// Long, freed of substituted unknowns when its turn comes.
    Long,
    /// Used or dropped.
    Done,
}

/// A number outgrew what can be represented: 2^53 among integers, infinity otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TooLarge;

/// What a substitution did to the pattern of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    Appeared,
    Vanished,
}

/// `value` if it may stand in a row.
pub(super) fn representable(value: f64, integral: bool) -> Result<f64, TooLarge> {
    let limit = if integral { LARGEST } else { f64::INFINITY };
    if value.abs() < limit {
        Ok(value)
    } else {
        Err(TooLarge)
    }
}

/// `a + b c`, exactly if all are integers.
pub(super) fn add_product(a: f64, b: f64, c: f64, integral: bool) -> Result<f64, TooLarge> {
    let product = representable(b * c, integral)?;
    representable(a + product, integral)
}

impl Row {
    /// Where the entry of `unknown` stands, if there is one.
    pub fn position(&self, unknown: u32) -> Option<usize> {
        self.entries.binary_search_by_key(&unknown, |e| e.0).ok()
    }

    /// Takes note that a substitution comes in, times `factor`.
    pub fn grow(&mut self, factor: f64, by: &Substitution) {
        self.touched = true;
        let factor = factor.abs();
        // As in Wilkinson's analysis (`wilkinson1961`), the noise is that of the largest numbers seen.
        // Multiplying it up along chains of substitutions would be a bound too, but one that grows
        // without any relation to the error, until everything passes for noise.
        let inherited = factor.min(1.0);
        let largest = (factor * by.largest).max(inherited * by.magnitude);
        self.magnitude = self.magnitude.max(largest);
    }

    /// Drops what rounding left behind where it would decide something: continuous coefficients
    /// when none of them is more than noise, and integer ones in a row of integers.
    pub fn drop_noise(&mut self, integer: &[bool], mut dropped: impl FnMut(u32)) {
        let noise = RANK * self.magnitude;
        let decides = |e: &(u32, f64)| !integer[e.0 as usize] && e.1.abs() > noise;
        if self.integral || self.entries.iter().any(decides) {
            return;
        }
        self.entries.retain(|&(unknown, a)| {
            let keep = a.abs() > noise;
            if !keep {
                dropped(unknown);
            }
            keep
        });
    }

    /// Puts `terms` in the place of the unknown at position `at`, and tells which
    /// unknowns came and went. `buffer` is scratch space.
    pub fn substitute(
        &mut self,
        at: usize,
        by: &Substitution,
        terms: &[(u32, f64)],
        buffer: &mut Vec<(u32, f64)>,
        mut changed: impl FnMut(u32, Change),
    ) -> Result<(), TooLarge> {
        let integral = self.integral;
        let (pivot, factor) = self.entries[at];
        self.grow(factor, by);
        changed(pivot, Change::Vanished);
        let noise = if integral {
            0.0
        } else {
            NOISE * self.magnitude
        };
        buffer.clear();
        let mut old = self.entries.iter().filter(|e| e.0 != pivot).peekable();
        for &(unknown, term) in terms {
            while let Some(&entry) = old.next_if(|e| e.0 < unknown) {
                buffer.push(entry);
            }
            match old.next_if(|e| e.0 == unknown) {
                Some(&(_, a)) => {
                    let sum = add_product(a, factor, term, integral)?;
                    if sum.abs() > noise {
                        buffer.push((unknown, sum));
                    } else {
                        changed(unknown, Change::Vanished);
                    }
                }
                None => {
                    let product = representable(factor * term, integral)?;
                    // Underflow is the only way to a zero here.
                    if product != 0.0 {
                        buffer.push((unknown, product));
                        changed(unknown, Change::Appeared);
                    }
                }
            }
        }
        buffer.extend(old);
        std::mem::swap(&mut self.entries, buffer);
        Ok(())
    }
}
