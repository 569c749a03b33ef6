//! The list of steps by which an elimination changed its rows.
//!
//! Coefficients alone decide which row is solved for which unknown; right sides do not. The elimination
//! therefore works on coefficients and keeps this list. `right_sides` applies the list to the right sides, in
//! the first solve and in every later one with other data.

use std::collections::BTreeMap;

/// One step on the right side of one row, or of the next substitution on the stack.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step {
    /// Substitution `by` enters the row times `factor`. This is exact if the row is integral.
    Substitute {
        row: u32,
        by: u32,
        factor: f64,
        integral: bool,
    },
    /// From this step on the row holds integers in units of `unit`.
    MakeIntegral { row: u32, unit: f64 },
    /// The row of integers was divided by the common factor of its coefficients.
    Divide { row: u32, factor: f64 },
    /// The row is solved for an unknown with this coefficient, which gives the next substitution.
    Solve { row: u32, pivot: f64 },
    /// The next substitution introduces an unknown and has no constant.
    Introduce,
    /// The row has no unknown left. Its coefficients were at most `magnitude`.
    Check {
        row: u32,
        magnitude: f64,
        integral: bool,
    },
}

/// The introduced unknowns in terms of earlier ones, in an order in which they can be computed.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    /// The unknown and the divisor of the sum of its terms.
    list: Vec<(u32, f64)>,
    ends: Vec<usize>,
    terms: Vec<(u32, f64)>,
}

impl Definitions {
    /// Adds `unknown = (sum of terms) / divisor`.
    pub fn push(
        &mut self,
        unknown: u32,
        terms: impl IntoIterator<Item = (u32, f64)>,
        divisor: f64,
    ) {
        self.terms.extend(terms);
        self.list.push((unknown, divisor));
        self.ends.push(self.terms.len());
    }

    /// The terms of definition `k`.
    fn terms_of(&self, k: usize) -> &[(u32, f64)] {
        let start = if k == 0 { 0 } else { self.ends[k - 1] };
        &self.terms[start..self.ends[k]]
    }

    /// The numbers of all unknowns, where the introduced ones are counted after the caller's `n` in the order of their
    /// definitions.
    pub fn numbers(&self, n: usize) -> Vec<u32> {
        let mut numbers: Vec<u32> = (0..(n + self.list.len()) as u32).collect();
        for (k, &(unknown, _)) in self.list.iter().enumerate() {
            numbers[unknown as usize] = (n + k) as u32;
        }
        numbers
    }

    /// Which definition begins with which unknown. None begin with the same one.
    pub fn by_first(&self) -> BTreeMap<u32, usize> {
        let first = |k: usize| Some((self.terms_of(k).first()?.0, k));
        (0..self.list.len()).filter_map(first).collect()
    }

    /// The sums that define the introduced unknowns, in numbers of [`numbers`](Self::numbers).
    pub fn sums(&self, numbers: &[u32]) -> Vec<Vec<(u32, f64)>> {
        let sum = |k: usize| {
            let (terms, divisor) = (self.terms_of(k).iter(), self.list[k].1);
            terms
                .map(|&(j, c)| (numbers[j as usize], c / divisor))
                .collect()
        };
        (0..self.list.len()).map(sum).collect()
    }

    /// The values of all unknowns if the caller's unknowns are `x`.
    pub fn evaluate(&self, x: &[f64]) -> Vec<f64> {
        let mut all = x.to_vec();
        all.resize(x.len() + self.list.len(), 0.0);
        for (k, &(unknown, divisor)) in self.list.iter().enumerate() {
            let terms = self.terms_of(k).iter();
            let sum: f64 = terms.map(|&(j, c)| c * all[j as usize]).sum();
            all[unknown as usize] = sum / divisor;
        }
        all
    }
}
