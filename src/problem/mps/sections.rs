//! The sections of an MPS file and their order.
//!
//! Programs disagree on the order of the sections behind COLUMNS, and any order is accepted, except that
//! RANGES needs the right sides.

use super::lines::Line;
use crate::error::Result;
use crate::problem::files::lines::quoted;

/// A section, or the state before the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    Start,
    Name,
    ObjSense,
    Rows,
    Columns,
    Rhs,
    Ranges,
    Bounds,
    QuadObj,
    QMatrix,
    QOfRow,
    EndData,
}

impl Section {
    fn word(self) -> &'static str {
        match self {
            Section::Start => "",
            Section::Name => "NAME",
            Section::ObjSense => "OBJSENSE",
            Section::Rows => "ROWS",
            Section::Columns => "COLUMNS",
            Section::Rhs => "RHS",
            Section::Ranges => "RANGES",
            Section::Bounds => "BOUNDS",
            Section::QuadObj => "QUADOBJ",
            Section::QMatrix => "QMATRIX",
            Section::QOfRow => "QSECTION",
            Section::EndData => "ENDATA",
        }
    }

    /// The position of a section in the order. A section may follow one of the same position.
    fn step(self) -> usize {
        match self {
            Section::Bounds | Section::QuadObj | Section::QMatrix | Section::QOfRow => {
                Section::Ranges as usize
            }
            Section::Rhs | Section::Ranges => Section::Ranges as usize,
            other => other as usize,
        }
    }

    /// Whether the section holds Q.
    pub fn is_quadratic(self) -> bool {
        matches!(self, Section::QuadObj | Section::QMatrix | Section::QOfRow)
    }

    /// Whether two sections may not both be in a file.
    fn excludes(self, other: Section) -> bool {
        self == other || (self.is_quadratic() && other.is_quadratic())
    }

    /// The section that the header `line` opens after the section `self`, the last of those `seen`.
    pub fn next(self, seen: &[Section], line: &Line) -> Result<Section> {
        let word = line.fields()[0];
        let next = match word {
            "NAME" => Section::Name,
            "OBJSENSE" => Section::ObjSense,
            "ROWS" => Section::Rows,
            "COLUMNS" => Section::Columns,
            "RHS" => Section::Rhs,
            "RANGES" => Section::Ranges,
            "BOUNDS" => Section::Bounds,
            "QUADOBJ" => Section::QuadObj,
            "QMATRIX" => Section::QMatrix,
            "QSECTION" => Section::QOfRow,
            "ENDATA" => Section::EndData,
            "OBJNAME" | "OBJECTIVE" | "USERCUTS" | "LAZYCONS" | "SOS" | "SOS1" | "SOS2"
            | "SETS" | "CSECTION" | "INDICATORS" | "GENCONS" | "PWLOBJ" | "BRANCH"
            | "SCENARIOS" | "DELAYEDROWS" | "MODELCUTS" | "MULTIOBJ" | "INDICATOR" => {
                return Err(line.unsupported(format!("section {word}")));
            }
            "QCMATRIX" => return Err(line.unsupported("a quadratic constraint (QCMATRIX)")),
            _ => return Err(line.fault(format!("there is no section {}", quoted(word)))),
        };
        if next == self {
            return Err(line.fault(format!("section {word} is already open")));
        }
        let late = seen.contains(&Section::Ranges) && next == Section::Rhs;
        let repeated = seen.iter().any(|&other| next.excludes(other));
        if next.step() < self.step() || late || repeated {
            return Err(line.fault(format!("section {word} may not follow {}", self.word())));
        }
        let needed = match next {
            Section::Start | Section::Name | Section::ObjSense | Section::Rows => Section::Start,
            Section::Columns => Section::Rows,
            _ => Section::Columns,
        };
        if self.step() < needed.step() {
            return Err(line.fault(format!("section {word} before {}", needed.word())));
        }
        let takes_text = matches!(next, Section::Name | Section::ObjSense) || next.is_quadratic();
        if line.fields().len() > 1 && !takes_text {
            let text = quoted(line.fields()[1]);
            return Err(line.fault(format!("{text} stands behind the section's name {word}")));
        }
        Ok(next)
    }
}
