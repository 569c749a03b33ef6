//! Writing: a model becomes free-format MPS. Reading the file gives the same model bit for bit.
//!
//! Each number is written as the shortest decimal that reads back as the same number. MPS has no
//! least-squares rows; the file holds their contributions to Q, q and c.

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::Path;

use super::compression::create;
use super::{MpsNames, MpsProblem};
use crate::error::{Error, Result};
use crate::problem::Model;

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
/// and the initial guess is lost. A replay file keeps both, see [`replay`](crate::solve::replay).
///
/// # Errors
/// As [`Model::new`]; [`Error::Io`] for a file that cannot be written, [`Error::NotSupported`]
/// for compression without the feature `gzip`.
pub fn write(path: &Path, problem: &MpsProblem) -> Result<()> {
    let model = Model::new(&problem.problem)?;
    write_model(path, &model, &problem.names, Pins::Rows)
}

/// Writes `problem` to `writer`, not compressed.
///
/// # Errors
/// As [`write()`].
pub fn write_to(mut writer: impl Write, problem: &MpsProblem) -> Result<()> {
    let model = Model::new(&problem.problem)?;
    let document = Document::new(&model, &problem.names, Pins::Rows);
    let written = document.write(&mut writer).and_then(|()| writer.flush());
    written.map_err(|e| Error::Io {
        message: e.to_string(),
    })
}

pub(crate) fn write_model(path: &Path, model: &Model, names: &MpsNames, pins: Pins) -> Result<()> {
    create(path, |mut writer| {
        Document::new(model, names, pins).write(&mut writer)
    })
}

struct Document<'a> {
    model: &'a Model,
    names: &'a MpsNames,
    /// Variable, value and row name of each pin in the file.
    pins: Vec<(usize, f64, String)>,
}

impl<'a> Document<'a> {
    fn new(model: &'a Model, names: &'a MpsNames, pins: Pins) -> Self {
        let pins = match pins {
            Pins::Rows => pin_rows(model, names),
            Pins::Elsewhere => Vec::new(),
        };
        Document { model, names, pins }
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self.names.title.as_str() {
            "" => writeln!(out, "NAME")?,
            title => writeln!(out, "NAME {title}")?,
        }
        self.write_rows(out)?;
        self.write_columns(out)?;
        self.write_right_sides(out)?;
        writeln!(out, "BOUNDS")?;
        for name in &self.names.variables {
            writeln!(out, " FR BND {name}")?;
        }
        writeln!(out, "QUADOBJ")?;
        for (i, j, v) in self.model.hessian().entries() {
            let [i, j] = [i, j].map(|k| &self.names.variables[k as usize]);
            writeln!(out, " {i} {j} {v:?}")?;
        }
        writeln!(out, "ENDATA")
    }

    fn write_rows(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "ROWS\n N {}", self.names.objective)?;
        let pins = self.pins.iter().map(|(_, _, name)| name);
        for name in self.names.constraints.iter().chain(pins) {
            writeln!(out, " E {name}")?;
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
            if linear != 0.0 || (by_columns.row(j).len() == 0 && pinned.is_none()) {
                writeln!(out, " {name} {} {linear:?}", self.names.objective)?;
            }
            for (i, v) in by_columns.row(j) {
                writeln!(out, " {name} {} {v:?}", self.names.constraints[i])?;
            }
            if let Some((_, _, row)) = pinned {
                writeln!(out, " {name} {row} 1.0")?;
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
            writeln!(out, " RHS {} {:?}", self.names.objective, -constant)?;
        }
        let constraints = self.names.constraints.iter().map(String::as_str);
        let given = constraints.zip(self.model.constraint_rhs().iter().copied());
        let pins = self
            .pins
            .iter()
            .map(|(_, value, name)| (name.as_str(), *value));
        for (name, value) in given.chain(pins) {
            // A row without an entry has the right side zero, but not minus zero.
            if value.to_bits() != 0 {
                writeln!(out, " RHS {name} {value:?}")?;
            }
        }
        Ok(())
    }
}

fn pin_rows(model: &Model, names: &MpsNames) -> Vec<(usize, f64, String)> {
    let taken: HashSet<&str> = names.constraints.iter().map(String::as_str).collect();
    let pinned = model.pinned().iter().enumerate();
    let pinned = pinned.filter_map(|(j, value)| value.map(|value| (j, value)));
    let rows = pinned.map(|(j, value)| {
        let mut name = format!("PIN_{j}");
        while name == names.objective || taken.contains(name.as_str()) {
            name.push('_');
        }
        (j, value, name)
    });
    rows.collect()
}
