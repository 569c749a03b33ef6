//! Proofs that a stranger can check: of the least energy, or that there is no point.
//!
//! ```text
//! search --derivation--> seal --lines--> file --lines--> check
//! ```
//!
//! A proof holds the problem, a point and its energy, and a tree of bounds: at every leaf the objective is above
//! the claimed bound, or no point is left. [`check`] confirms it in exact numbers by code that shares nothing with
//! the search, and refuses a proof with a false step by a [`Fault`] that names the line.
//!
//! | File | Step |
//! | --- | --- |
//! | `exact` | exact numbers |
//! | `format`, `statement` | the lines of a proof; the statement of a problem |
//! | `problem`, `steps` | the problem in exact numbers, and bounds that its rows imply |
//! | `translation` | integers held that may move for ever at the same energy |
//! | `cut` | rows that follow in both cases of a split |
//! | `switch` | the perspective reformulation of the objective |
//! | `minorant`, `estimate`, `held`, `convex` | a bound from a point and multipliers; its estimate in floats; convexity |
//! | `lattice`, `substitution`, `sparse_factor`, `enumeration`, `splits` | a bound by the closest point of a lattice |
//! | `tree`, `check`, `fault` | the checker |
//! | `derivation`, `condensed`, `curvature`, `numbers`, `repair`, `seal` | the writer |

mod check;
mod condensed;
mod convex;
mod curvature;
mod cut;
mod derivation;
mod enumeration;
mod estimate;
mod exact;
mod fault;
mod format;
mod held;
mod lattice;
mod minorant;
mod numbers;
mod problem;
mod repair;
mod seal;
mod sparse_factor;
mod splits;
mod statement;
mod steps;
mod substitution;
mod switch;
mod translation;
mod tree;

use std::io::{self, BufRead, Write};

use crate::error::Result;
use crate::problem::Problem;
pub use check::{TOLERANCE, Verdict};
pub(crate) use derivation::{
    Condensed, Derivation, Distances, Ending, Multiplied, Searched, Visited,
};
pub use fault::{Fault, FaultKind};
pub(crate) use format::{Case, Cut, Split, Step, Switch, Translation};
use format::{Claim, Line, Part, Statement};

/// A proof of a bound on the energy of all points, or that there is no point.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    lines: Vec<Line>,
}

impl Proof {
    /// The proof of what a search has done. It is made as long as `ask` returns no error.
    ///
    /// # Errors
    /// [`Error::NotSupported`](crate::Error::NotSupported) for what cannot be proved in exact numbers; that of
    /// `ask`.
    pub(crate) fn new(
        problem: &Problem,
        derivation: &Derivation,
        values: Option<&[f64]>,
        ask: &dyn Fn() -> Result<()>,
    ) -> Result<Self> {
        let lines = seal::seal(Statement::of(problem), derivation, values, ask)?;
        Ok(Proof { lines })
    }

    fn claim(&self) -> Option<&Claim> {
        self.lines.iter().find_map(|line| match line {
            Line::Claim(claim) => Some(claim),
            _ => None,
        })
    }

    /// No point has less energy than this. Nothing if the proof is that there is no point.
    pub fn lower_bound(&self) -> Option<f64> {
        self.claim()?.lower_bound
    }

    /// The energy of the point, rounded to the next float above.
    pub fn energy(&self) -> Option<f64> {
        self.claim()?.energy
    }

    /// The number of nodes, with those that the checker enumerates.
    pub fn nodes(&self) -> usize {
        let of_line = |line: &Line| match line {
            Line::Node(_) => 1,
            Line::Parts(parts) => parts.iter().map(Part::enumerated).sum(),
            _ => 0,
        };
        self.lines.iter().map(of_line).sum()
    }

    /// Writes the proof, one JSON object a line.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, mut to: impl Write) -> io::Result<()> {
        for line in &self.lines {
            serde_json::to_writer(&mut to, line)?;
            to.write_all(b"\n")?;
        }
        to.flush()
    }
}

/// Checks the proof in a text. Returns what it proves.
///
/// # Errors
/// The first fault.
pub fn check(reader: impl BufRead) -> std::result::Result<Verdict, Fault> {
    check::check_lines(reader, None)
}

/// Checks the proof in a text, which must be a proof of this problem.
///
/// # Errors
/// The first fault.
pub fn check_of(problem: &Problem, reader: impl BufRead) -> std::result::Result<Verdict, Fault> {
    check::check_lines(reader, Some(&Statement::of(problem)))
}
