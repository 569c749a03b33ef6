//! MPS, reading and writing.
//!
//! MPS is IBM's format for linear programs of the 1960s, with many later extensions. This reader accepts the
//! part that states the problems of this library:
//!
//! | section | what is read |
//! | --- | --- |
//! | `NAME` | the rest of the line, which may be left out |
//! | `OBJSENSE` | `MIN` or `MAX`, on the same line or the next |
//! | `ROWS` | `N` (the first is the objective, others are ignored), `E`, `L`, `G` |
//! | `COLUMNS` | one or two entries a line; integer columns between `'MARKER' 'INTORG'` and `'MARKER' 'INTEND'` |
//! | `RHS` | right sides; that of the objective is minus the constant c |
//! | `RANGES` | the distance between the two sides of a row |
//! | `BOUNDS` | `LO`, `UP`, `FX`, `FR`, `MI`, `PL`, and `BV`, `LI`, `UI`, which make a column integer |
//! | `QUADOBJ` | one triangle of Q in 1/2 x'Qx: an off-diagonal entry stands for its mirror image too |
//! | `QSECTION` | the same as `QUADOBJ` |
//! | `QMATRIX` | instead of `QUADOBJ`: both triangles, which must agree |
//! | `ENDATA` | needed |
//!
//! The sections up to `COLUMNS` come in this order, `RHS` before `RANGES`, the others in any. The quadratic
//! sections may name the objective; one that names a constraint is not supported. Section names start in the
//! first column, all other lines with a blank. Lines that start with `*` are comments. Fields are separated
//! by blanks. From the first line on that cannot be read so, they are cut by the columns of fixed format
//! (2-3, 5-12, 15-22, 25-36, 40-47, 50-61), and names may have blanks in them. Every other feature of MPS
//! (semi-continuous variables, quadratic constraints, special ordered sets, indicators, ...) is
//! [`Error::NotSupported`] with its line. An objective that is not convex is [`Error::NotConvexAt`] with the line
//! where entries of Q show it. Text that is not MPS is [`Error::Parse`] with its line. Nothing is skipped or
//! guessed, and no entry may be given twice.
//!
//! [`Error::NotConvexAt`]: crate::Error::NotConvexAt
//! [`Error::NotSupported`]: crate::Error::NotSupported
//! [`Error::Parse`]: crate::Error::Parse
//!
//! Where the format leaves a choice, CPLEX, Gurobi, SCIP and HiGHS agree, and so does this reader. A column
//! without a bound has the lower bound 0; an integer column without a bound is binary. A negative upper bound
//! without a lower bound leaves the column without one. A range R of a row with right side b means
//! [b - |R|, b] for `L`, [b, b + |R|] for `G`, and for `E` [b, b + R] or, if R is negative, [b + R, b]. A
//! bound, right side or range of 1e20 or more is infinite.
//!
//! The reader recognises gzip by the content of the file, the writer by a file name that ends in `.gz`
//! (feature `gzip`).

mod bounds;
mod columns;
mod content;
mod lines;
mod quadratic;
mod rows;
mod sections;
mod sides;
mod write;
mod write_rows;

use std::io::BufRead;
use std::path::Path;

pub(crate) use write::{Pins, write_model};
pub use write::{write, write_to};

use super::files::NamedProblem;
use super::files::compression::{parse_by, read_by};
use crate::error::Result;

/// Reads the file at `path`.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be read or a damaged archive; [`Error::Parse`] and
/// [`Error::NotSupported`] with the faulty line; [`Error::NotConvexAt`] with the line of an entry of Q that shows
/// it, where it takes no factorization to see; [`Error::OutOfMemory`], [`Error::Overflow`].
///
/// [`Error::NotConvexAt`]: crate::Error::NotConvexAt
/// [`Error::Io`]: crate::Error::Io
/// [`Error::Parse`]: crate::Error::Parse
/// [`Error::NotSupported`]: crate::Error::NotSupported
/// [`Error::OutOfMemory`]: crate::Error::OutOfMemory
/// [`Error::Overflow`]: crate::Error::Overflow
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
