//! Rows that the caller adds while a search runs, because there are too many to give them all before it.

use std::collections::BTreeSet;

use crate::error::Result;
use crate::monitor::{Flow, Monitor};
use crate::problem::Problem;

/// A point misses a row by more than this part of the row's terms if it violates it.
const VIOLATED: f64 = 1e-9;

/// A point that the caller may cut off by rows.
#[derive(Debug, Clone, Copy)]
pub struct Candidate<'a> {
    /// The values, one for each variable.
    pub values: &'a [f64],
    /// The objective at the point.
    pub energy: f64,
    /// Whether all integer variables have integer values. Otherwise the point is the minimiser of a
    /// relaxation.
    pub is_integer: bool,
}

/// Receives candidates and adds rows. [`Flow::Cancel`] and [`Flow::Finish`] act as those of a monitor, and a
/// candidate for which the caller cancels is not accepted.
pub type LazyCallback<'a> = dyn FnMut(&Candidate, &mut LazyRows) -> Flow + 'a;

/// The rows that a caller adds for a candidate.
#[derive(Debug)]
pub struct LazyRows<'a> {
    problem: &'a mut Problem,
    known: &'a mut BTreeSet<Vec<u64>>,
}

impl LazyRows<'_> {
    /// Adds the inequality `lower <= sum_k coefficients[k] x[indices[k]] <= upper`, which all solutions that
    /// are wanted satisfy. A row that was added before is left out. Rows continue the numbers of the problem's
    /// inequalities.
    ///
    /// # Errors
    /// As [`Problem::add_inequality`]; nothing is added then.
    pub fn add(
        &mut self,
        indices: &[usize],
        coefficients: &[f64],
        lower: f64,
        upper: f64,
    ) -> Result<()> {
        let numbers = indices.iter().map(|&i| i as u64);
        let bits = coefficients.iter().chain([&lower, &upper]);
        let key: Vec<u64> = numbers.chain(bits.map(|x| x.to_bits())).collect();
        if !self.known.contains(&key) {
            self.problem
                .add_inequality(indices, coefficients, lower, upper)?;
            self.known.insert(key);
        }
        Ok(())
    }
}

/// A problem that grows by the rows that a callback adds.
pub(crate) struct LazyProblem<'a> {
    problem: Problem,
    known: BTreeSet<Vec<u64>>,
    callback: &'a mut LazyCallback<'a>,
}

impl<'a> LazyProblem<'a> {
    /// The problem without rows of the callback.
    pub fn new(problem: Problem, callback: &'a mut LazyCallback<'a>) -> Self {
        LazyProblem {
            problem,
            known: BTreeSet::new(),
            callback,
        }
    }

    /// The problem with all rows so far.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// Shows a point to the callback. Returns whether the rows that it added cut off the point, or the caller
    /// cancelled.
    pub fn cuts_off(&mut self, values: &[f64], energy: f64, monitor: &mut Monitor) -> bool {
        let before = self.problem.inequalities();
        let integers = self.problem.integers().iter().zip(values);
        let candidate = Candidate {
            values,
            energy,
            is_integer: integers.fold(true, |all, (&is, x)| all && (!is || x.fract() == 0.0)),
        };
        let mut rows = LazyRows {
            problem: &mut self.problem,
            known: &mut self.known,
        };
        let flow = (self.callback)(&candidate, &mut rows);
        monitor.ask(flow);
        flow == Flow::Cancel || self.first_violated(values, before).is_some()
    }

    /// The first inequality from `first` on that a point violates.
    pub fn first_violated(&self, values: &[f64], first: usize) -> Option<usize> {
        let rows = self.problem.inequality_rows();
        (first..rows.len()).find(|&i| {
            let terms = rows.row(i).map(|(j, a)| a * values[j]);
            let (sum, size) = terms.fold((0.0, 1.0), |(s, m): (f64, f64), t| (s + t, m + t.abs()));
            (rows.lower()[i] - sum).max(sum - rows.upper()[i]) > VIOLATED * size
        })
    }
}
