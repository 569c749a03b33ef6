//! What an elimination did to its rows, written down.
//!
//! Which row is solved for which unknown is decided by coefficients alone, never by a right side.
//! So the elimination works on coefficients and keeps this list; right sides are put through it
//! afterwards (see `right_sides`), by the first solve and by every later one with other data.

/// One step on the right side of one row, or of the next substitution on the stack.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step {
    /// Substitution `by` came into the row, times `factor`; exactly, if the row is integral.
    Substitute {
        row: u32,
        by: u32,
        factor: f64,
        integral: bool,
    },
    /// From here on the row holds integers, in units of `unit`.
    MakeIntegral { row: u32, unit: f64 },
    /// The row of integers was divided by the common factor of its coefficients.
    Divide { row: u32, factor: f64 },
    /// The row was solved for an unknown with this coefficient: the next substitution.
    Solve { row: u32, pivot: f64 },
    /// The next substitution introduces an unknown and has no constant.
    Introduce,
    /// No unknown is left in the row, whose coefficients were as large as `magnitude`.
    Check {
        row: u32,
        magnitude: f64,
        integral: bool,
    },
}

/// Introduced unknowns in terms of earlier ones, in an order in which they can be computed.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    /// The unknown, and what the sum of its terms is divided by.
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

    /// All unknowns where the caller's are `x`.
    pub fn evaluate(&self, x: &[f64]) -> Vec<f64> {
        let mut all = x.to_vec();
        all.resize(x.len() + self.list.len(), 0.0);
        let mut start = 0;
        for (&(unknown, divisor), &end) in self.list.iter().zip(&self.ends) {
            let terms = self.terms[start..end].iter();
            let sum: f64 = terms.map(|&(j, c)| c * all[j as usize]).sum();
            all[unknown as usize] = sum / divisor;
            start = end;
        }
        all
    }
}
