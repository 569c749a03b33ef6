//! The sections of an MPS file and their order.

use super::lines::{Line, quoted};
use crate::error::Result;

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
            Section::EndData => "ENDATA",
        }
    }

    /// The position of a section in the order. Two sections with the same position exclude each other.
    fn step(self) -> usize {
        match self {
            Section::QMatrix => Section::QuadObj as usize,
            other => other as usize,
        }
    }

    /// The section that the header `line` opens after the section `self`.
    pub fn next(self, line: &Line) -> Result<Section> {
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
            "ENDATA" => Section::EndData,
            "OBJNAME" | "OBJECTIVE" | "USERCUTS" | "LAZYCONS" | "SOS" | "SOS1" | "SOS2"
            | "SETS" | "QSECTION" | "QCMATRIX" | "CSECTION" | "INDICATORS" | "GENCONS"
            | "PWLOBJ" | "BRANCH" => {
                return Err(line.unsupported(format!("section {word}")));
            }
            _ => return Err(line.fault(format!("there is no section {}", quoted(word)))),
        };
        if next == self {
            return Err(line.fault(format!("section {word} is already open")));
        }
        if next.step() <= self.step() {
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
        if line.fields().len() > 1 && !matches!(next, Section::Name | Section::ObjSense) {
            let text = quoted(line.fields()[1]);
            return Err(line.fault(format!("{text} stands behind the section's name {word}")));
        }
        Ok(next)
    }
}
