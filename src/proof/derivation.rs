//! What a search has done, as it tells the proof.
//!
//! Nothing here is believed: what is not so in exact numbers is left out of the proof, which then proves less.

use super::format::{Cut, Step, Switch};

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

/// The search of a part: its unknowns, the rows and what the objective has gained, and its nodes, of which the first is
/// the root.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Searched {
    pub unknowns: Vec<u32>,
    /// Rows of this part, numbered after those of the problem.
    pub cuts: Vec<Cut>,
    pub switches: Vec<Switch>,
    pub nodes: Vec<Visited>,
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
    /// The contradiction that these have found.
    pub contradiction: Option<Ending>,
    pub parts: Vec<Searched>,
}
