//! Files of problems: what the formats share, and the choice of a format by the name of a file.

pub(in crate::problem) mod compression;
mod curvature;
pub(in crate::problem) mod draft;
pub(in crate::problem) mod lines;
mod named;
pub(in crate::problem) mod names;

use std::path::Path;

pub use named::NamedProblem;
pub(crate) use named::Names;

use super::{lp, mps, qplib};
use crate::error::{Error, Result};

/// A file format.
enum Format {
    Mps,
    Lp,
    Qplib,
}

/// The format that the ending of a name says, before `.gz` if it ends in that. Any other ending means MPS.
fn format_of(path: &Path) -> Format {
    let gz = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    let plain = if gz {
        path.with_extension("")
    } else {
        path.to_owned()
    };
    let ends_in = |ending: &str| {
        plain
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(ending))
    };
    if ends_in("lp") {
        Format::Lp
    } else if ends_in("qplib") {
        Format::Qplib
    } else {
        Format::Mps
    }
}

/// Reads the file at `path` in the format that its name says: LP for `.lp`, QPLIB for `.qplib`, and MPS for any
/// other, each also with `.gz` behind it.
///
/// # Errors
/// As [`mps::read`], [`lp::read`] and [`qplib::read`].
pub fn read(path: &Path) -> Result<NamedProblem> {
    match format_of(path) {
        Format::Mps => mps::read(path),
        Format::Lp => lp::read(path),
        Format::Qplib => qplib::read(path),
    }
}

/// Writes `problem` to the file at `path` in the format that its name says: LP for `.lp` and MPS for any other,
/// each compressed with `.gz` behind it.
///
/// # Errors
/// As [`mps::write`] and [`lp::write`]; [`Error::NotSupported`] for `.qplib`.
pub fn write(path: &Path, problem: &NamedProblem) -> Result<()> {
    match format_of(path) {
        Format::Mps => mps::write(path, problem),
        Format::Lp => lp::write(path, problem),
        Format::Qplib => Err(Error::NotSupported {
            what: "writing QPLIB files; MPS and LP files are written".into(),
            index: None,
            line: None,
        }),
    }
}

pub(crate) fn io_error(path: &Path, reason: impl std::fmt::Display) -> Error {
    Error::Io {
        message: format!("{}: {reason}", path.display()),
    }
}
