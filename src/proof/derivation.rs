//! What a search has done, as it tells the proof.
//!
//! Nothing here is believed: what is not so in exact numbers is left out of the proof, which then proves less.

use super::format::{Step, Switch};

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

/// The search of a part: its unknowns, what its objective gains, and its nodes, of which the first is the root.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Searched {
    pub unknowns: Vec<u32>,
    pub switches: Vec<Switch>,
    pub nodes: Vec<Visited>,
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
