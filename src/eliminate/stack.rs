//! The substitutions so far, in the order in which they were made.

use super::row::Row;
use super::substitution::Substitution;
use crate::error::Error;

/// A list of substitutions; later ones never mention an unknown that an earlier one replaced.
#[derive(Debug, Default)]
pub(super) struct Stack {
    list: Vec<Substitution>,
    ends: Vec<usize>,
    terms: Vec<(u32, f64)>,
}

impl Stack {
    pub fn len(&self) -> usize {
        self.list.len()
    }

    pub fn get(&self, k: usize) -> (&Substitution, &[(u32, f64)]) {
        let start = if k == 0 { 0 } else { self.ends[k - 1] };
        (&self.list[k], &self.terms[start..self.ends[k]])
    }

    /// Adds `x_pivot = constant + terms`. Sorts the terms by unknown.
    pub fn push(&mut self, by: Substitution, terms: impl IntoIterator<Item = (u32, f64)>) {
        let start = self.terms.len();
        self.terms.extend(terms);
        self.terms[start..].sort_unstable_by_key(|t| t.0);
        self.list.push(by);
        self.ends.push(self.terms.len());
    }

    /// The error for too large a number in substitution `k`. `of_row` makes the error of a constraint.
    pub fn too_large(&self, k: usize, of_row: impl FnOnce(usize) -> Error) -> Error {
        let by = self.list[k];
        if by.constraint == Substitution::NO_CONSTRAINT {
            return Error::Overflow {
                what: format!("variable {} is pinned to a number too large", by.pivot),
                index: Some(by.pivot as usize),
            };
        }
        of_row(by.constraint as usize)
    }

    /// Solves `row` for the unknown at position `at`.
    pub fn solve(&mut self, constraint: usize, row: &Row, at: usize) {
        let (pivot, a) = row.entries[at];
        let others = row.entries.iter().filter(|e| e.0 != pivot);
        let terms = others.map(|&(j, v)| (j, -v / a));
        let by = Substitution {
            pivot,
            constraint: constraint as u32,
            largest: terms.clone().fold(0.0, |m: f64, t| m.max(t.1.abs())),
            magnitude: row.magnitude,
            denominator: row.denominator_by(a),
        };
        self.push(by, terms);
    }
}
