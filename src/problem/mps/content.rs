//! Reading: the lines of the sections become a problem.

use std::io::BufRead;

use super::columns::{Bounds, Columns};
use super::lines::{Line, Lines, fault, quoted};
use super::names::check_title;
use super::quadratic::Quadratic;
use super::rows::{RightSides, Rows};
use super::sections::Section;
use super::{MpsNames, MpsProblem};
use crate::error::Result;
use crate::problem::{Layout, MatrixRef, Problem, Triangle};

/// Reads plain text.
pub(super) fn parse_text(reader: impl BufRead) -> Result<MpsProblem> {
    let mut lines = Lines::new(reader);
    let mut content = Content::new();
    let mut section = Section::Start;
    while let Some(line) = lines.next()? {
        if section == Section::EndData {
            let text = quoted(line.fields()[0]);
            return Err(line.fault(format!("{text} stands behind ENDATA")));
        }
        if line.is_header() {
            let next = section.next(&line)?;
            content.end(section, &line)?;
            content.begin(next, &line)?;
            section = next;
        } else {
            content.read(section, &line)?;
        }
    }
    match section {
        Section::EndData => content.into_problem(),
        Section::Start => Err(fault(lines.number().max(1), "the file is empty")),
        _ => Err(fault(lines.number(), "the file ends without ENDATA")),
    }
}

/// The content of the sections read so far.
struct Content {
    title: String,
    has_sense: bool,
    rows: Rows,
    columns: Columns,
    right_sides: RightSides,
    bounds: Bounds,
    quadratic: Quadratic,
}

impl Content {
    fn new() -> Self {
        let rows = Rows::new();
        Content {
            title: String::new(),
            has_sense: false,
            columns: Columns::new(&rows),
            rows,
            right_sides: RightSides::default(),
            bounds: Bounds::default(),
            quadratic: Quadratic::default(),
        }
    }

    /// Starts `section`. The sections to which it refers are complete by then.
    fn begin(&mut self, section: Section, line: &Line) -> Result<()> {
        match section {
            Section::Name => {
                let title = line.rest();
                check_title(title).map_err(|fault| line.fault(fault))?;
                self.title = title.to_owned();
            }
            Section::ObjSense if line.fields().len() > 1 => self.read_sense(line, 1)?,
            Section::Columns => {
                self.columns = Columns::new(&self.rows);
                self.right_sides = RightSides::new(&self.rows);
            }
            Section::Bounds => self.bounds = Bounds::new(&self.columns),
            Section::QuadObj => self.quadratic = Quadratic::new(false),
            Section::QMatrix => self.quadratic = Quadratic::new(true),
            _ => {}
        }
        Ok(())
    }

    fn read(&mut self, section: Section, line: &Line) -> Result<()> {
        match section {
            Section::ObjSense => self.read_sense(line, 0),
            Section::Rows => self.rows.read(line),
            Section::Columns => self.columns.read(line, &self.rows),
            Section::Rhs => self.right_sides.read(line, &self.rows),
            Section::Bounds => self.bounds.read(line, &self.columns),
            Section::QuadObj | Section::QMatrix => self.quadratic.read(line, &self.columns.names),
            Section::Start | Section::Name | Section::EndData => {
                let text = quoted(line.fields()[0]);
                Err(line.fault(format!("{text} stands where a section must start")))
            }
        }
    }

    fn end(&mut self, section: Section, line: &Line) -> Result<()> {
        match section {
            Section::ObjSense if !self.has_sense => {
                Err(line.fault("OBJSENSE says neither MIN nor MAX"))
            }
            Section::Rows => self.rows.end(line),
            Section::Columns => self.columns.end(line),
            _ => Ok(()),
        }
    }

    fn read_sense(&mut self, line: &Line, field: usize) -> Result<()> {
        let words = &line.fields()[field..];
        match words {
            ["MIN" | "MINIMIZE"] if !self.has_sense => self.has_sense = true,
            ["MAX" | "MAXIMIZE"] => return Err(line.unsupported("maximisation")),
            _ => {
                let word = quoted(words.last().copied().unwrap_or_default());
                return Err(line.fault(format!("expected MIN once, found {word}")));
            }
        }
        Ok(())
    }

    fn into_problem(self) -> Result<MpsProblem> {
        let columns = self.bounds.end(self.columns)?;
        let variables = columns.names.len();
        let mut problem = Problem::new(variables)?;
        let (rows, cols, values) = self.quadratic.lower_triangle(variables)?;
        problem.add_quadratic_triplets(Triangle::Lower, &rows, &cols, &values)?;
        problem.add_linear(&columns.linear)?;
        problem.add_constant(self.right_sides.constant)?;
        let matrix = MatrixRef {
            layout: Layout::Columns,
            offsets: &columns.offsets,
            indices: &columns.rows,
            values: &columns.values,
        };
        problem.add_constraint_matrix(&matrix, &self.right_sides.values)?;
        problem.set_integers(&columns.integers)?;
        let (objective, constraints) = self.rows.into_names();
        let names = MpsNames {
            title: self.title,
            objective,
            variables: columns.names.into_vec(),
            constraints,
        };
        Ok(MpsProblem { problem, names })
    }
}
