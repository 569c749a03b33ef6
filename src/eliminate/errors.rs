//! The errors of the elimination. Each quotes the faulty constraint as the caller gave it.

use crate::error::Error;
use crate::problem::Model;
use crate::problem::row_text;

pub(super) fn overflow(model: &Model, r: usize) -> Error {
    Error::Overflow {
        what: format!(
            "constraint {r}: {} leads to numbers too large to be exact",
            text(model, r)
        ),
        index: Some(r),
    }
}

pub(super) fn infeasible(model: &Model, r: usize) -> Error {
    Error::Infeasible {
        constraint: r,
        row: text(model, r),
    }
}

pub(super) fn no_integer_solution(model: &Model, r: usize) -> Error {
    Error::NoIntegerSolution {
        constraint: r,
        row: text(model, r),
    }
}

/// The integer relation that remains of row `r` has no integer coefficients.
pub(super) fn incommensurable(model: &Model, r: usize) -> Error {
    Error::NotSupported {
        what: format!(
            "constraint {r}: {} leaves a relation of integers whose coefficients have no common measure",
            text(model, r)
        ),
        index: Some(r),
        line: None,
    }
}

fn text(model: &Model, r: usize) -> String {
    row_text(model.constraints().row(r), model.constraint_rhs()[r])
}
