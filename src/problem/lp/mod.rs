//! CPLEX LP files, reading and writing.
//!
//! | section | what is read |
//! | --- | --- |
//! | `minimize`, `maximize` | a linear expression, a constant, and `[ Q-terms ] / 2` with `x ^ 2` and `x * y` |
//! | `subject to` | linear rows: `expression <= number`, `number <= expression <= number`, `=`, `>=` |
//! | `bounds` | `l <= x <= u` and each half, `x = v`, `x free`; a later line takes precedence |
//! | `general`, `integer` | integer unknowns, with the bounds that they have |
//! | `binary` | integer unknowns between 0 and 1 |
//! | `end` | needed |
//!
//! Section names start a line, in any case and with the usual abbreviations (`st`, `gen`, `bin`, ...). A row
//! may have a name: `name: ...`. Text behind `\` is a comment. A variable without a bound has the lower bound
//! 0 and no upper bound. The words `inf` and `infinity` and numbers of 1e20 and beyond are infinite as limits.
//! Variables are numbered in order of appearance; one that first appears behind the rows is an error, as it is
//! most likely misspelt. An upper bound below 0 needs a lower bound as well, on which readers disagree.
//!
//! Quadratic constraints, semi-continuous unknowns, special ordered sets, indicators, lazy constraints and the
//! like are [`Error::NotSupported`] with their line, an objective that is not convex is [`Error::NotConvexAt`] where
//! entries of Q show it, other text is [`Error::Parse`] with its line.
//!
//! [`Error::NotConvexAt`]: crate::Error::NotConvexAt
//! [`Error::NotSupported`]: crate::Error::NotSupported
//! [`Error::Parse`]: crate::Error::Parse

mod bounds;
mod content;
mod expression;
mod rows;
mod tokens;
mod words;
mod write;

use std::io::BufRead;
use std::path::Path;

pub use write::{write, write_to};

use super::files::NamedProblem;
use super::files::compression::{parse_by, read_by};
use crate::error::Result;

/// Reads the file at `path`.
///
/// # Errors
/// As [`mps::read`](crate::problem::mps::read).
pub fn read(path: &Path) -> Result<NamedProblem> {
    read_by(path, content::parse_text)
}

/// Reads from `reader`, which may be compressed.
///
/// # Errors
/// As [`read`].
pub fn parse(reader: impl BufRead) -> Result<NamedProblem> {
    parse_by(reader, content::parse_text)
}
