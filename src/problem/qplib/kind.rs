//! The three letters that say of which kind a problem is.

use super::records::Record;
use crate::error::Result;
use crate::problem::files::lines::{fault, quoted};

/// The kinds of unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unknowns {
    Continuous,
    Binary,
    Integer,
    /// Each of its own type, which the file gives.
    Mixed,
}

/// What the letters say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind {
    pub quadratic_objective: bool,
    pub unknowns: Unknowns,
    /// Whether there are constraints other than bounds.
    pub constraints: bool,
    pub quadratic_constraints: bool,
}

impl Kind {
    pub fn read(record: &Record) -> Result<Self> {
        let word = record.word(0)?.to_ascii_uppercase();
        let unknown = || {
            fault(
                record.line,
                format!("there is no problem type {}", quoted(&word)),
            )
        };
        let &[objective, unknowns, constraints] = word.as_bytes() else {
            return Err(unknown());
        };
        Ok(Kind {
            quadratic_objective: match objective {
                b'L' => false,
                b'D' | b'C' | b'Q' => true,
                _ => return Err(unknown()),
            },
            unknowns: match unknowns {
                b'C' => Unknowns::Continuous,
                b'B' => Unknowns::Binary,
                b'I' => Unknowns::Integer,
                b'M' | b'G' => Unknowns::Mixed,
                _ => return Err(unknown()),
            },
            constraints: match constraints {
                b'N' | b'B' => false,
                b'L' | b'D' | b'C' | b'Q' => true,
                _ => return Err(unknown()),
            },
            quadratic_constraints: matches!(constraints, b'D' | b'C' | b'Q'),
        })
    }
}
