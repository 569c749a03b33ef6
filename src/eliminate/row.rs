//! The coefficients of an equation during the elimination.

use super::ratio::gcd;
use super::substitution::Substitution;
use super::tolerance::{LARGEST, NOISE, RANK, WHOLE, near_integer};

/// The left side of an equation. The right sides are computed afterwards; see `right_sides`.
#[derive(Debug, Clone)]
pub(super) struct Row {
    /// The unknowns, increasing, with their coefficients. No coefficient is zero.
    pub entries: Vec<(u32, f64)>,
    /// The largest coefficient used to compute this row, to which noise is relative.
    pub magnitude: f64,
    /// The power of two by which the caller's row was multiplied.
    pub scale: f64,
    /// A whole number that turns all coefficients, in the caller's units, into whole numbers, if one is
    /// known.
    pub denominator: Option<f64>,
    /// The number of continuous unknowns.
    pub continuous: u32,
    /// Whether an unknown of the row was substituted.
    pub touched: bool,
    /// Whether the row has only integer unknowns and only integers below 2^53 as coefficients: then no
    /// operation on it has a rounding error.
    pub integral: bool,
    pub state: State,
}

/// The state of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// A short row. Every step removes substituted unknowns from it.
    Waiting,
    /// A long row. Substituted unknowns are removed when its turn comes.
    Long,
    /// A row that was used or dropped.
    Done,
}

/// A number exceeds its range: 2^53 for integers, the largest double otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TooLarge;

/// How a substitution changed the pattern of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    Appeared,
    Vanished,
}

/// Returns `value` if a row may hold it.
pub(super) fn representable(value: f64, integral: bool) -> Result<f64, TooLarge> {
    let limit = if integral { LARGEST } else { f64::INFINITY };
    if value.abs() < limit {
        Ok(value)
    } else {
        Err(TooLarge)
    }
}

/// Computes `a + b c`, without rounding if all are integers.
pub(super) fn add_product(a: f64, b: f64, c: f64, integral: bool) -> Result<f64, TooLarge> {
    let product = representable(b * c, integral)?;
    representable(a + product, integral)
}

impl Row {
    /// The position of the entry of `unknown`, if there is one.
    pub fn position(&self, unknown: u32) -> Option<usize> {
        self.entries.binary_search_by_key(&unknown, |e| e.0).ok()
    }

    /// Raises the magnitude and the denominator for a substitution that enters the row times `factor`.
    pub fn grow(&mut self, factor: f64, by: &Substitution) {
        self.touched = true;
        if !self.integral {
            self.denominator = self.denominator_with(factor, by);
        }
        let factor = factor.abs();
        // As in Wilkinson's analysis (`wilkinson1961`), noise is relative to the largest numbers seen. The
        // product of the factors along a chain of substitutions would be a bound too. But that bound grows
        // without any relation to the error, until every coefficient counts as noise.
        let inherited = factor.min(1.0);
        let largest = (factor * by.largest).max(inherited * by.magnitude);
        self.magnitude = self.magnitude.max(largest);
    }

    /// `factor` is the fraction of `whole` and the row's denominator; a factor that it has in common with the
    /// substitution's denominator cancels.
    fn denominator_with(&self, factor: f64, by: &Substitution) -> Option<f64> {
        let whole = self.whole(factor)?;
        let own = by.denominator? / gcd(whole, by.denominator?);
        self.denominator.map(|d| d * own).filter(|d| *d < LARGEST)
    }

    /// A coefficient of this row in units of one by the row's denominator. `None` if none is known, or if
    /// rounding hides which whole number it is.
    pub fn whole(&self, coefficient: f64) -> Option<f64> {
        let unit = self.scale / self.denominator?;
        let magnitude = self.magnitude / unit;
        (magnitude < WHOLE).then(|| near_integer(coefficient / unit, magnitude))?
    }

    /// The least denominator of the other coefficients once the row is solved for `pivot`.
    pub fn denominator_by(&self, pivot: f64) -> Option<f64> {
        if self.integral {
            return Some(1.0);
        }
        let mut common = 0.0;
        for (_, a) in &self.entries {
            common = gcd(common, self.whole(*a)?);
        }
        Some(self.whole(pivot)?.abs() / common)
    }

    /// Drops rounding errors where they would decide the kind of the row: continuous coefficients if none of
    /// them exceeds the noise, and integer ones in a row of integers.
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

    /// Replaces the unknown at position `at` by `terms`, and reports which unknowns entered and left the row.
    /// `buffer` is scratch space.
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
                    // A product of nonzero numbers is zero only by underflow.
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
