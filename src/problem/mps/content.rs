//! Reading: the lines of the sections become a problem.

use std::io::BufRead;

use super::bounds::Bounds;
use super::columns::Columns;
use super::lines::{Line, Lines, fault, quoted};
use super::names::check_title;
use super::quadratic::Quadratic;
use super::rows::Rows;
use super::sections::Section;
use super::sides::Sides;
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
    sides: Sides,
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
            Section::Rhs => self.sides.read_right(line, &self.rows),
            Section::Ranges => self.sides.read_range(line, &self.rows),
            Section::Bounds => self.bounds.read(line, &mut self.columns),
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
        let columns = self.columns;
        let variables = columns.names.len();
        let mut problem = Problem::new(variables)?;
        let (rows, cols, values) = self.quadratic.lower_triangle(variables)?;
        problem.add_quadratic_triplets(Triangle::Lower, &rows, &cols, &values)?;
        problem.add_linear(&columns.linear)?;
        problem.add_constant(self.sides.constant)?;
        let roles = Roles::new(&self.rows, &self.sides);
        let equalities = roles.entries_of(&columns, true);
        problem.add_constraint_matrix(&equalities.as_ref(), &roles.right)?;
        let inequalities = roles.entries_of(&columns, false);
        problem.add_inequality_matrix(&inequalities.as_ref(), &roles.lower, &roles.upper)?;
        set_bounds(&mut problem, &columns, &self.bounds)?;
        let integer = columns.integer.iter().enumerate();
        let integers: Vec<usize> = integer.filter(|(_, is)| **is).map(|(j, _)| j).collect();
        problem.set_integers(&integers)?;
        let (objective, rows) = self.rows.into_names();
        let [mut constraints, mut inequalities] = [Vec::new(), Vec::new()];
        for (name, &(equality, _)) in rows.into_iter().zip(&roles.of) {
            if equality {
                &mut constraints
            } else {
                &mut inequalities
            }
            .push(name);
        }
        let names = MpsNames {
            title: self.title,
            objective,
            variables: columns.names.into_vec(),
            constraints,
            inequalities,
        };
        Ok(MpsProblem { problem, names })
    }
}

/// The rows of the file as equalities and inequalities, each kind in the order of the file.
struct Roles {
    /// For each constraint of the file, whether it is an equality, and its number among its kind.
    of: Vec<(bool, usize)>,
    /// The right sides of the equalities.
    right: Vec<f64>,
    /// The sides of the inequalities.
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Roles {
    fn new(rows: &Rows, sides: &Sides) -> Self {
        let mut roles = Roles {
            of: Vec::with_capacity(rows.relations().len()),
            right: Vec::new(),
            lower: Vec::new(),
            upper: Vec::new(),
        };
        for (i, &relation) in rows.relations().iter().enumerate() {
            let (lower, upper) = sides.of(i, relation);
            if sides.is_equality(i, relation) {
                roles.of.push((true, roles.right.len()));
                roles.right.push(upper);
            } else {
                roles.of.push((false, roles.lower.len()));
                roles.lower.push(lower);
                roles.upper.push(upper);
            }
        }
        roles
    }

    /// The entries of the rows of one kind, by columns.
    fn entries_of(&self, columns: &Columns, equality: bool) -> Entries {
        let mut entries = Entries {
            offsets: vec![0],
            ..Entries::default()
        };
        for window in columns.offsets.windows(2) {
            for k in window[0]..window[1] {
                let (kind, row) = self.of[columns.rows[k]];
                if kind == equality {
                    entries.rows.push(row);
                    entries.values.push(columns.values[k]);
                }
            }
            entries.offsets.push(entries.rows.len());
        }
        entries
    }
}

/// A matrix by columns.
#[derive(Default)]
struct Entries {
    offsets: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl Entries {
    fn as_ref(&self) -> MatrixRef<'_> {
        MatrixRef {
            layout: Layout::Columns,
            offsets: &self.offsets,
            indices: &self.rows,
            values: &self.values,
        }
    }
}

/// Sets the bounds of the columns that are not free.
fn set_bounds(problem: &mut Problem, columns: &Columns, bounds: &Bounds) -> Result<()> {
    let mut bounded = Vec::new();
    let [mut lower, mut upper] = [Vec::new(), Vec::new()];
    for (j, &integer) in columns.integer.iter().enumerate() {
        let (l, u) = bounds.of(j, integer);
        if l.is_finite() || u.is_finite() {
            bounded.push(j);
            lower.push(l);
            upper.push(u);
        }
    }
    if bounded.is_empty() {
        return Ok(());
    }
    problem.set_bounds(&bounded, &lower, &upper)
}
