//! What a search has done, as it tells the proof.
//!
//! Nothing here is believed: what is not so in exact numbers is left out of the proof, which then proves less.

use super::format::{Cut, Split, Step, Switch, Terms, Translation};

/// A point and multipliers of rows, in floats.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Multiplied {
    /// One value for each unknown of the part.
    pub point: Vec<f64>,
    /// Rows and their multipliers; positive ones hold upper sides.
    pub multipliers: Vec<(u32, f64)>,
}

/// How a node has ended.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum Ending {
    /// Its bound is enough, or the search has ended before it.
    #[default]
    Bounded,
    /// Two children: the unknown is at most `at` in the first and at least `at + 1` in the second.
    Branched {
        unknown: u32,
        at: f64,
        children: [usize; 2],
    },
    /// The rows with these multipliers contradict each other.
    Contradiction(Vec<(u32, f64)>),
    /// No point within the bounds satisfies this row.
    Missed(u32),
}

/// A node of a tree.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Visited {
    pub steps: Vec<Step>,
    pub certificate: Option<Multiplied>,
    pub ending: Ending,
}

/// What is left of the objective of a part in its integers, in floats.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Condensed {
    /// Equations, and the unknown that each one gives after those before it.
    pub solved: Vec<(u32, u32)>,
    /// The minimiser of the part where integers are real.
    pub point: Vec<f64>,
    pub forms: Vec<Distances>,
}

/// `1/2 |R (y - t)|^2`, where y are combinations of integers, and t those of the minimiser.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Distances {
    pub combinations: Vec<Terms>,
    /// The rows of R, each from its diagonal on.
    pub rows: Vec<Vec<f64>>,
    /// Diagonals below the leading blocks of `R'R`: of one unknown, of two, and so on. There may be none.
    pub diagonals: Vec<Vec<f64>>,
    /// What shows a least value without an enumeration, with a number that is taken off. There may be none.
    pub splits: Vec<Split>,
    pub level: f64,
    /// Integers with a value of `|R (y - t)|^2` below this are looked for.
    pub square: f64,
}

/// The search of a part: its unknowns, the rows and what the objective has gained, and its nodes, of which the first is
/// the root.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Searched {
    pub unknowns: Vec<u32>,
    /// Rows of this part, numbered after those of the problem.
    pub cuts: Vec<Cut>,
    pub switches: Vec<Switch>,
    pub nodes: Vec<Visited>,
    /// What bounds the part without a tree.
    pub condensed: Option<Condensed>,
}

impl Searched {
    /// Gives rows other numbers. Those that get none are left out.
    pub fn renumber(&mut self, number: impl Fn(u32) -> Option<u32>) {
        let rows = |rows: &mut Vec<(u32, f64)>| {
            rows.retain_mut(|(row, _)| number(*row).map(|to| *row = to).is_some());
        };
        for node in &mut self.nodes {
            node.steps.retain_mut(|step| {
                let row = step.row_mut();
                number(*row).map(|to| *row = to).is_some()
            });
            if let Some(certificate) = &mut node.certificate {
                rows(&mut certificate.multipliers);
            }
            match &mut node.ending {
                Ending::Contradiction(contradicting) => rows(contradicting),
                Ending::Missed(row) => match number(*row) {
                    Some(to) => *row = to,
                    None => node.ending = Ending::Bounded,
                },
                Ending::Bounded | Ending::Branched { .. } => {}
            }
        }
    }
}

/// A whole search.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Derivation {
    /// Whether a search has begun.
    pub is_begun: bool,
    /// The steps before any branch.
    pub steps: Vec<Step>,
    /// What was left out and held after the steps.
    pub translations: Vec<Translation>,
    /// Further unknowns, numbered after those of the problem, each the sum of terms of unknowns before it. They are
    /// equations, numbered after the rows of the problem.
    pub defined: Vec<Terms>,
    /// The contradiction that these have found.
    pub contradiction: Option<Ending>,
    pub parts: Vec<Searched>,
}
