//! The JSON object that a run prints: of a solution or of a failure.

use std::path::Path;

use roundel::{Error, Solution};
use serde::Serialize;

use crate::summary::{telling_bound, telling_gap};

/// The output of `--json` for a solution.
#[derive(Serialize)]
pub struct Report<'a> {
    file: String,
    strategy: &'a str,
    status: &'a str,
    complete: bool,
    stopped_by: &'a str,
    energy: Option<f64>,
    lower_bound: Option<f64>,
    /// Instead of the lower bound, where the file maximises.
    #[serde(skip_serializing_if = "Option::is_none")]
    upper_bound: Option<Option<f64>>,
    gap: Option<f64>,
    variables: usize,
    integers: usize,
    constraints: usize,
    inequalities: usize,
    reduced_integers: usize,
    reduced_continuous: usize,
    factor_nonzeros: usize,
    seconds: Seconds,
    peak_memory_bytes: Option<u64>,
    max_constraint_violation: Option<f64>,
    max_integrality_violation: Option<f64>,
}

/// Wall-clock seconds by phase; `total` includes them all.
#[derive(Serialize)]
struct Seconds {
    read: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    assemble: Option<f64>,
    eliminate: f64,
    factor: f64,
    round: f64,
    total: f64,
}

/// Seconds before the solver begins.
#[derive(Debug, Clone, Copy)]
pub struct Preparation {
    /// Reading the file.
    pub read: f64,
    /// Making the problem, if the file does not hold one.
    pub assemble: Option<f64>,
}

impl<'a> Report<'a> {
    /// The report of `solution`, which `strategy` found for the contents of `file`.
    pub fn new(
        file: &Path,
        strategy: &'a str,
        before: Preparation,
        solution: &Solution,
        peak_memory_bytes: Option<u64>,
    ) -> Self {
        let counts = solution.counts();
        let seconds = solution.seconds();
        Report {
            file: name(file),
            strategy,
            status: solution.status().name(),
            complete: solution.is_complete(),
            stopped_by: solution.stopped_by().name(),
            energy: finite(solution.energy()),
            lower_bound: telling_bound(solution),
            upper_bound: None,
            gap: telling_gap(solution.gap()),
            variables: counts.variables,
            integers: counts.integers,
            constraints: counts.constraints,
            inequalities: counts.inequalities,
            reduced_integers: counts.reduced_integers,
            reduced_continuous: counts.reduced_continuous,
            factor_nonzeros: counts.factor_nonzeros,
            seconds: Seconds {
                read: before.read,
                assemble: before.assemble,
                eliminate: seconds.eliminate,
                factor: seconds.factor,
                round: seconds.round,
                total: before.read + before.assemble.unwrap_or(0.0) + seconds.total,
            },
            peak_memory_bytes,
            max_constraint_violation: finite(solution.max_constraint_violation()),
            max_integrality_violation: finite(solution.max_integrality_violation()),
        }
    }

    /// The same report for a file that maximises, if it does: energy and bound are those of its objective, of
    /// which the solver minimised the negative.
    pub fn in_sense_of_file(self, maximise: bool) -> Self {
        if !maximise {
            return self;
        }
        Report {
            energy: self.energy.map(|energy| -energy),
            lower_bound: None,
            upper_bound: Some(self.lower_bound.map(|bound| -bound)),
            ..self
        }
    }
}

/// The output of `--json` for a run without a solution.
#[derive(Serialize)]
pub struct Failure {
    file: String,
    status: &'static str,
    error: Details,
}

#[derive(Serialize)]
struct Details {
    code: &'static str,
    message: String,
    index: Option<usize>,
    line: Option<usize>,
}

impl Failure {
    /// The report of a run for `file` that ended in `error`.
    pub fn new(file: &Path, error: &Error) -> Self {
        Failure {
            file: name(file),
            status: status(error),
            error: Details {
                code: error.code(),
                message: error.to_string(),
                index: error.index(),
                line: error.line(),
            },
        }
    }
}

/// The status word of a run without a solution: how the solve ended, if that tells something about the
/// problem, else `error`.
fn status(error: &Error) -> &'static str {
    match error {
        Error::Infeasible { .. }
        | Error::Contradiction { .. }
        | Error::NoIntegerSolution { .. } => "infeasible",
        Error::Unbounded { .. } => "unbounded",
        Error::Cancelled => "cancelled",
        Error::TimeLimit | Error::SearchLimit { .. } => "limit",
        _ => "error",
    }
}

/// JSON has no infinities and no NaN: they become null.
fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

fn name(file: &Path) -> String {
    file.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_not_finite_become_null() {
        assert_eq!(finite(f64::INFINITY), None);
        assert_eq!(finite(f64::NAN), None);
        assert_eq!(finite(-0.5), Some(-0.5));
    }

    #[test]
    fn a_status_word_says_what_is_known_of_the_problem() {
        let row = String::from("2 x0 + 4 x1 = 3");
        let direction = vec![1.0];
        let cases = [
            (
                Error::Infeasible {
                    constraint: 0,
                    row: row.clone(),
                },
                "infeasible",
            ),
            (
                Error::NoIntegerSolution { constraint: 0, row },
                "infeasible",
            ),
            (
                Error::Contradiction {
                    what: "bounds of x0".into(),
                    index: Some(0),
                    elements: Vec::new(),
                },
                "infeasible",
            ),
            (
                Error::Unbounded {
                    variable: 0,
                    direction: direction.clone(),
                },
                "unbounded",
            ),
            (
                Error::NotConvex {
                    variable: 0,
                    direction,
                },
                "error",
            ),
            (Error::Cancelled, "cancelled"),
            (Error::TimeLimit, "limit"),
            (Error::SearchLimit { what: "nodes" }, "limit"),
            (Error::Empty, "error"),
        ];
        for (error, word) in cases {
            assert_eq!(status(&error), word, "{error}");
        }
    }
}
