//! Writing: a model becomes free-format MPS. Reading the file gives the same model bit for bit.
//!
//! A two-sided row is of type L or G with a range, if the range and one side give the other side exactly in
//! floating point. Otherwise it becomes two rows, of which the second has another name.
//!
//! Each number is written as the shortest decimal that reads back as the same number. MPS has no
//! least-squares rows; the file holds their contributions to Q, q and c.

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::Path;

use super::write_rows::{FileRow, bound_lines, file_rows};
use crate::error::{Error, Result};
use crate::linalg::Sparse;
use crate::problem::files::compression::create;
use crate::problem::files::lines::writable_limit;
use crate::problem::files::names::is_plain;
use crate::problem::files::{NamedProblem, Names};
use crate::problem::{Model, Problem};

/// The place of the values of pinned variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Pins {
    /// In the file, as constraints after the others.
    Rows,
    /// Not in the file.
    Elsewhere,
}

/// Writes `problem` to the file at `path`, compressed by gzip if that ends in `.gz`.
///
/// MPS cannot state everything. The pin of variable i becomes a constraint named `PIN_i` after the others,
/// and the initial guess is lost. A replay file keeps both, see [`replay`](crate::solve::replay). Blanks in
/// names, which only fixed format has, become underscores.
///
/// # Errors
/// As [`Model::new`]; [`Error::Io`] for a file that cannot be written, [`Error::NotSupported`]
/// for compression without the feature `gzip`, and for bounds and sides of rows of 1e20 or more, which
/// readers of MPS take for infinite.
pub fn write(path: &Path, problem: &NamedProblem) -> Result<()> {
    let model = Model::new(&problem.problem)?;
    write_model(path, &model, problem, Pins::Rows)
}

/// Writes `problem` to `writer`, not compressed.
///
/// # Errors
/// As [`write()`].
pub fn write_to(mut writer: impl Write, problem: &NamedProblem) -> Result<()> {
    let model = Model::new(&problem.problem)?;
    let document = Document::new(&model, problem, Pins::Rows)?;
    let written = document.write(&mut writer).and_then(|()| writer.flush());
    written.map_err(|e| Error::Io {
        message: e.to_string(),
    })
}

/// Writes `model`, which is that of `problem`.
pub(crate) fn write_model(
    path: &Path,
    model: &Model,
    problem: &NamedProblem,
    pins: Pins,
) -> Result<()> {
    let document = Document::new(model, problem, pins)?;
    create(path, |mut writer| document.write(&mut writer))
}

struct Document<'a> {
    model: &'a Model,
    problem: &'a Problem,
    names: Names,
    maximise: bool,
    /// Variable, value and row name of each pin in the file.
    pins: Vec<(usize, f64, String)>,
    /// The rows that state the inequalities, and for each inequality the number of its first row.
    rows: (Vec<FileRow>, Vec<usize>),
    /// The inequalities by columns.
    columns: Sparse,
}

impl<'a> Document<'a> {
    fn new(model: &'a Model, problem: &'a NamedProblem, pins: Pins) -> Result<Self> {
        let (names, mut taken) = plain_names(&problem.names);
        let pins = match pins {
            Pins::Rows => pin_rows(model, &mut taken),
            Pins::Elsewhere => Vec::new(),
        };
        let inequalities = problem.problem.inequality_rows();
        let rows = file_rows(inequalities, &names.inequalities, &mut taken)?;
        for j in 0..model.variables() {
            let (lower, upper) = problem.problem.limits_of(j);
            writable_limit("a bound of variable", j, lower)?;
            writable_limit("a bound of variable", j, upper)?;
        }
        let columns = inequalities.to_sparse(model.variables())?.transpose();
        Ok(Document {
            model,
            problem: &problem.problem,
            names,
            maximise: problem.maximise,
            pins,
            rows,
            columns,
        })
    }

    /// A value of the objective in the sense of the file.
    fn objective(&self, value: f64) -> f64 {
        if self.maximise { -value } else { value }
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self.names.title.as_str() {
            "" => writeln!(out, "NAME")?,
            title => writeln!(out, "NAME {title}")?,
        }
        if self.maximise {
            writeln!(out, "OBJSENSE\n    MAX")?;
        }
        self.write_rows(out)?;
        self.write_columns(out)?;
        self.write_right_sides(out)?;
        if self.rows.0.iter().any(|row| row.range.is_some()) {
            writeln!(out, "RANGES")?;
        }
        for FileRow { name, range, .. } in &self.rows.0 {
            if let Some(range) = range {
                writeln!(out, " RNG {name} {range:?}")?;
            }
        }
        writeln!(out, "BOUNDS")?;
        for (j, name) in self.names.variables.iter().enumerate() {
            for (kind, value) in bound_lines(self.problem.limits_of(j), self.model.integer()[j]) {
                match value {
                    Some(value) => writeln!(out, " {kind} BND {name} {value:?}")?,
                    None => writeln!(out, " {kind} BND {name}")?,
                }
            }
        }
        writeln!(out, "QUADOBJ")?;
        for (i, j, v) in self.model.hessian().entries() {
            let [i, j] = [i, j].map(|k| &self.names.variables[k as usize]);
            writeln!(out, " {i} {j} {:?}", self.objective(v))?;
        }
        writeln!(out, "ENDATA")
    }

    fn write_rows(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "ROWS\n N {}", self.names.objective)?;
        let pins = self.pins.iter().map(|(_, _, name)| name);
        for name in self.names.constraints.iter().chain(pins) {
            writeln!(out, " E {name}")?;
        }
        for row in &self.rows.0 {
            writeln!(out, " {} {}", row.kind, row.name)?;
        }
        Ok(())
    }

    fn write_columns(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "COLUMNS")?;
        let by_columns = self.model.constraints().transpose();
        let mut pins = self.pins.iter().peekable();
        let mut in_integers = false;
        for (j, name) in self.names.variables.iter().enumerate() {
            let integer = self.model.integer()[j];
            if integer != in_integers {
                let side = if integer { "'INTORG'" } else { "'INTEND'" };
                writeln!(out, " MARKER 'MARKER' {side}")?;
                in_integers = integer;
            }
            // Only an entry declares a column, so an empty column needs an entry of zero.
            let pinned = pins.next_if(|(variable, _, _)| *variable == j);
            let linear = self.model.gradient()[j];
            let entries = by_columns.row(j).len() + self.columns.row(j).len();
            if linear != 0.0 || (entries == 0 && pinned.is_none()) {
                let linear = self.objective(linear);
                writeln!(out, " {name} {} {linear:?}", self.names.objective)?;
            }
            for (i, v) in by_columns.row(j) {
                writeln!(out, " {name} {} {v:?}", self.names.constraints[i])?;
            }
            if let Some((_, _, row)) = pinned {
                writeln!(out, " {name} {row} 1.0")?;
            }
            for (i, v) in self.columns.row(j) {
                for row in &self.rows.0[self.rows.1[i]..self.rows.1[i + 1]] {
                    writeln!(out, " {name} {} {v:?}", row.name)?;
                }
            }
        }
        if in_integers {
            writeln!(out, " MARKER 'MARKER' 'INTEND'")?;
        }
        Ok(())
    }

    fn write_right_sides(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "RHS")?;
        let constant = self.model.constant();
        if constant != 0.0 {
            let right = self.objective(-constant);
            writeln!(out, " RHS {} {right:?}", self.names.objective)?;
        }
        let constraints = self.names.constraints.iter().map(String::as_str);
        let given = constraints.zip(self.model.constraint_rhs().iter().copied());
        let pins = self
            .pins
            .iter()
            .map(|(_, value, name)| (name.as_str(), *value));
        let rows = self.rows.0.iter().map(|row| (row.name.as_str(), row.right));
        for (name, value) in given.chain(pins).chain(rows) {
            // A row without an entry has the right side zero, but not minus zero.
            if value.to_bits() != 0 {
                writeln!(out, " RHS {name} {value:?}")?;
            }
        }
        Ok(())
    }
}

fn pin_rows(model: &Model, taken: &mut HashSet<String>) -> Vec<(usize, f64, String)> {
    let pinned = model.pinned().iter().enumerate();
    let pinned = pinned.filter_map(|(j, value)| value.map(|value| (j, value)));
    let rows = pinned.map(|(j, value)| {
        let mut name = format!("PIN_{j}");
        while !taken.insert(name.clone()) {
            name.push('_');
        }
        (j, value, name)
    });
    rows.collect()
}

/// The names without blanks, and those of rows.
fn plain_names(names: &Names) -> (Names, HashSet<String>) {
    let blank = |c: char| c.is_ascii_whitespace() || c.is_ascii_control();
    names.writable(is_plain, |name| name.replace(blank, "_"))
}
