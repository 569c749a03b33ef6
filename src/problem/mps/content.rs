//! Reading: the lines of the sections become a problem.

use std::io::BufRead;

use super::bounds::Bounds;
use super::columns::Columns;
use super::lines::{Line, next_line};
use super::quadratic::Quadratic;
use super::rows::{Row, Rows};
use super::sections::Section;
use super::sides::Sides;
use crate::error::Result;
use crate::problem::files::NamedProblem;
use crate::problem::files::draft::{Draft, DraftRow};
use crate::problem::files::lines::{Lines, fault, quoted};
use crate::problem::files::names::check_title;

/// Reads plain text.
pub(super) fn parse_text(reader: &mut dyn BufRead) -> Result<NamedProblem> {
    let mut lines = Lines::new(reader);
    let mut content = Content::new();
    let mut seen = vec![Section::Start];
    while let Some(line) = next_line(&mut lines)? {
        let section = seen[seen.len() - 1];
        if section == Section::EndData {
            let text = quoted(line.fields()[0]);
            return Err(line.fault(format!("{text} stands behind ENDATA")));
        }
        if line.is_header() {
            let next = section.next(&seen, &line)?;
            content.end(section, &line)?;
            content.begin(next, &line)?;
            seen.push(next);
        } else {
            content.read_free_or_fixed(section, &line)?;
        }
    }
    match seen[seen.len() - 1] {
        Section::EndData => content.into_draft()?.into_problem(),
        Section::Start => Err(fault(lines.number().max(1), "the file is empty")),
        _ => Err(fault(lines.number(), "the file ends without ENDATA")),
    }
}

/// The content of the sections read so far.
struct Content {
    title: String,
    /// Whether the file maximises, once it says so.
    maximise: Option<bool>,
    /// Whether the fields are cut by columns.
    fixed: bool,
    rows: Rows,
    columns: Columns,
    sides: Sides,
    bounds: Bounds,
    quadratic: Quadratic,
}

impl Content {
    fn new() -> Self {
        let rows = Rows::new();
        Content {
            title: String::new(),
            maximise: None,
            fixed: false,
            columns: Columns::new(&rows),
            rows,
            sides: Sides::default(),
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
                self.sides = Sides::new(&self.rows);
            }
            Section::Bounds => self.bounds = Bounds::new(&self.columns),
            Section::QuadObj | Section::QMatrix | Section::QOfRow => {
                self.is_of_objective(line)?;
                self.quadratic = Quadratic::new(section == Section::QMatrix);
            }
            _ => {}
        }
        Ok(())
    }

    /// Checks that the header of a quadratic section names the objective, or nothing.
    fn is_of_objective(&self, line: &Line) -> Result<()> {
        let name = line.rest();
        if name.is_empty() || matches!(self.rows.find(line, name)?, (_, Row::Objective)) {
            return Ok(());
        }
        let what = format!("row {} is a quadratic constraint", quoted(name));
        Err(line.unsupported(what))
    }

    /// Reads a line of free format, or of fixed format from the first line on that is none of free format.
    fn read_free_or_fixed(&mut self, section: Section, line: &Line) -> Result<()> {
        if self.fixed {
            let Some(cut) = line.by_columns() else {
                return Err(line.fault("the line does not keep to the columns of fixed format"));
            };
            return self.read(section, &cut);
        }
        if !line.fits(section)
            && let Some(cut) = line.by_columns()
            && cut.fits(section)
            && self.read(section, &cut).is_ok()
        {
            self.fixed = true;
            return Ok(());
        }
        self.read(section, line)
    }

    fn read(&mut self, section: Section, line: &Line) -> Result<()> {
        match section {
            Section::ObjSense => self.read_sense(line, 0),
            Section::Rows => self.rows.read(line),
            Section::Columns => self.columns.read(line, &self.rows),
            Section::Rhs => self.sides.read_right(line, &self.rows),
            Section::Ranges => self.sides.read_range(line, &self.rows),
            Section::Bounds => self.bounds.read(line, &mut self.columns),
            Section::QuadObj | Section::QMatrix | Section::QOfRow => {
                self.quadratic.read(line, &self.columns.names)
            }
            Section::Start | Section::Name | Section::EndData => {
                let text = quoted(line.fields()[0]);
                Err(line.fault(format!("{text} stands where a section must start")))
            }
        }
    }

    fn end(&mut self, section: Section, line: &Line) -> Result<()> {
        match section {
            Section::ObjSense if self.maximise.is_none() => {
                Err(line.fault("OBJSENSE says neither MIN nor MAX"))
            }
            Section::Rows => self.rows.end(line),
            Section::Columns => self.columns.end(line),
            _ => Ok(()),
        }
    }

    fn read_sense(&mut self, line: &Line, field: usize) -> Result<()> {
        let words = &line.fields()[field..];
        let is = |word: &str, known: [&str; 3]| known.iter().any(|k| word.eq_ignore_ascii_case(k));
        self.maximise = match (words, self.maximise) {
            ([word], None) if is(word, ["MIN", "MINIMIZE", "MINIMISE"]) => Some(false),
            ([word], None) if is(word, ["MAX", "MAXIMIZE", "MAXIMISE"]) => Some(true),
            _ => {
                let word = quoted(words.last().copied().unwrap_or_default());
                return Err(line.fault(format!("expected MIN or MAX once, found {word}")));
            }
        };
        Ok(())
    }

    fn into_draft(self) -> Result<Draft> {
        let columns = self.columns;
        let variables = columns.names.len();
        let quadratic = self.quadratic.lower_triangle(variables)?;
        let bounds = columns.integer.iter().enumerate();
        let (lower, upper) = bounds.map(|(j, &is)| self.bounds.of(j, is)).unzip();
        let relations = self.rows.relations().to_vec();
        let (objective, names) = self.rows.into_names();
        let rows = names.into_iter().zip(relations).enumerate();
        let rows = rows.map(|(i, (name, relation))| {
            let (lower, upper) = self.sides.of(i, relation);
            DraftRow {
                name,
                lower,
                upper,
                equality: self.sides.is_equality(i, relation),
            }
        });
        Ok(Draft {
            title: self.title,
            objective,
            maximise: self.maximise == Some(true),
            variables: columns.names.into_vec(),
            integer: columns.integer,
            lower,
            upper,
            linear: columns.linear,
            constant: self.sides.constant,
            quadratic,
            rows: rows.collect(),
            entries: columns.entries,
        })
    }
}
