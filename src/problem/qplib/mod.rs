//! QPLIB files, read (format of `furini2019`, appendix B).
//!
//! The file holds one number after the other, each on a line, in a fixed order; sparse vectors and matrices
//! are a count and as many lines of indices and a value. Everything behind that on a line is a comment, as are
//! lines that start with `#`, `!` or `%`. The type of a problem is three letters: the objective is linear
//! (`L`), diagonal and convex (`D`), convex (`C`) or any quadratic (`Q`), the unknowns are continuous (`C`),
//! binary (`B`), continuous and binary (`M`), integer (`I`) or of all kinds (`G`), and the constraints are none
//! (`N`), bounds (`B`), linear (`L`) or quadratic (`D`, `C`, `Q`).
//!
//! A quadratic constraint is [`Error::NotSupported`] with its line, an objective that is not convex
//! [`Error::NotConvexAt`] where entries of Q show it, and text that is no QPLIB file is [`Error::Parse`] with its
//! line. Starting points are checked and not kept. Variables without a name are x1, x2, ..., constraints c1, c2, ...
//!
//! [`Error::NotConvexAt`]: crate::Error::NotConvexAt
//! [`Error::NotSupported`]: crate::Error::NotSupported
//! [`Error::Parse`]: crate::Error::Parse

mod content;
mod kind;
mod records;

use std::io::BufRead;
use std::path::Path;

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
