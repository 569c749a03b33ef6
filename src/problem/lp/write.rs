//! Writing: a problem becomes an LP file. Reading the file gives the same problem.
//!
//! Each number is written as the shortest decimal that reads back as the same number. LP has no least-squares
//! rows; the file holds their contributions to Q, q and c. The objective names all variables, so that they
//! keep their order.

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::Path;

use super::words::is_writable;
use crate::error::{Error, Result};
use crate::linalg::Sparse;
use crate::problem::Model;
use crate::problem::files::compression::create;
use crate::problem::files::lines::writable_limit;
use crate::problem::files::{NamedProblem, Names};

/// The number of terms on a line. Some readers do not accept lines of more than 510 characters.
const TERMS_PER_LINE: usize = 5;

/// Writes `problem` to the file at `path`, compressed by gzip if that ends in `.gz`.
///
/// LP cannot state everything. The pin of variable i becomes a constraint named `PIN_i` after the others, the
/// initial guess is lost, and names that LP does not allow are changed.
///
/// # Errors
/// As [`mps::write`](crate::problem::mps::write()).
pub fn write(path: &Path, problem: &NamedProblem) -> Result<()> {
    let model = Model::new(&problem.problem)?;
    let document = Document::new(&model, problem)?;
    create(path, |mut writer| document.write(&mut writer))
}

/// Writes `problem` to `writer`, not compressed.
///
/// # Errors
/// As [`write()`].
pub fn write_to(mut writer: impl Write, problem: &NamedProblem) -> Result<()> {
    let model = Model::new(&problem.problem)?;
    let document = Document::new(&model, problem)?;
    let written = document.write(&mut writer).and_then(|()| writer.flush());
    written.map_err(|e| Error::Io {
        message: e.to_string(),
    })
}

struct Document<'a> {
    model: &'a Model,
    problem: &'a NamedProblem,
    names: Names,
    rows: Sparse,
    /// Variable, value and row name of each pin.
    pins: Vec<(usize, f64, String)>,
}

impl<'a> Document<'a> {
    fn new(model: &'a Model, problem: &'a NamedProblem) -> Result<Self> {
        let inequalities = problem.problem.inequality_rows();
        for (i, (&l, &u)) in inequalities
            .lower()
            .iter()
            .zip(inequalities.upper())
            .enumerate()
        {
            writable_limit("a side of inequality", i, l)?;
            writable_limit("a side of inequality", i, u)?;
        }
        for j in 0..model.variables() {
            let (lower, upper) = problem.problem.limits_of(j);
            writable_limit("a bound of variable", j, lower)?;
            writable_limit("a bound of variable", j, upper)?;
        }
        let (names, mut taken) = lp_names(&problem.names);
        let pinned = model.pinned().iter().enumerate();
        let pins = pinned.filter_map(|(j, value)| {
            let mut name = format!("PIN_{j}");
            while value.is_some() && !taken.insert(name.clone()) {
                name.push('_');
            }
            value.map(|value| (j, value, name))
        });
        Ok(Document {
            model,
            problem,
            pins: pins.collect(),
            names,
            rows: inequalities.to_sparse(model.variables())?,
        })
    }

    /// A value of the objective in the sense of the file.
    fn objective(&self, value: f64) -> f64 {
        if self.problem.maximise { -value } else { value }
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        if !self.names.title.is_empty() {
            writeln!(out, "\\Problem name: {}", self.names.title)?;
        }
        let sense = if self.problem.maximise {
            "Maximize"
        } else {
            "Minimize"
        };
        write!(out, "{sense}\n {}:", self.names.objective)?;
        let linear = self.model.gradient().iter().enumerate();
        self.write_terms(out, linear.map(|(j, &value)| (j, self.objective(value))))?;
        self.write_quadratic(out)?;
        let constant = self.objective(self.model.constant());
        if constant != 0.0 {
            write!(out, "\n {} {:?}", sign(constant), constant.abs())?;
        }
        writeln!(out, "\nSubject To")?;
        self.write_rows(out)?;
        self.write_bounds(out)?;
        let binary = |j: &usize| self.model.integer()[*j] && self.is_binary(*j);
        self.write_list(out, "Binaries", binary)?;
        let general = |j: &usize| self.model.integer()[*j] && !self.is_binary(*j);
        self.write_list(out, "Generals", general)?;
        writeln!(out, "End")
    }

    /// Writes terms with their signs, some on a line.
    fn write_terms(
        &self,
        out: &mut impl Write,
        terms: impl Iterator<Item = (usize, f64)>,
    ) -> io::Result<()> {
        let mut empty = true;
        for (k, (j, value)) in terms.enumerate() {
            if k > 0 && k % TERMS_PER_LINE == 0 {
                write!(out, "\n  ")?;
            }
            let name = &self.names.variables[j];
            write!(out, " {} {:?} {name}", sign(value), value.abs())?;
            empty = false;
        }
        // A row needs a term.
        if empty {
            write!(out, " 0 {}", self.names.variables[0])?;
        }
        Ok(())
    }

    fn write_quadratic(&self, out: &mut impl Write) -> io::Result<()> {
        if self.model.hessian().is_empty() {
            return Ok(());
        }
        write!(out, "\n + [")?;
        for (k, (i, j, value)) in self.model.hessian().entries().enumerate() {
            if k % TERMS_PER_LINE == 0 {
                write!(out, "\n  ")?;
            }
            let value = self.objective(value);
            let [a, b] = [i, j].map(|k| &self.names.variables[k as usize]);
            if i == j {
                write!(out, " {} {:?} {a} ^ 2", sign(value), value.abs())?;
                continue;
            }
            // An entry of Q stands twice in x'Qx. Where twice the value is infinite, two terms hold it.
            let (twice, count) = match 2.0 * value {
                twice if twice.is_finite() => (twice, 1),
                _ => (value, 2),
            };
            for _ in 0..count {
                write!(out, " {} {:?} {a} * {b}", sign(value), twice.abs())?;
            }
        }
        write!(out, "\n ] / 2")
    }

    fn write_rows(&self, out: &mut impl Write) -> io::Result<()> {
        let right = self.model.constraint_rhs();
        for (i, name) in self.names.constraints.iter().enumerate() {
            write!(out, " {name}:")?;
            self.write_terms(out, nonzero(self.model.constraints().row(i)))?;
            writeln!(out, " = {:?}", right[i])?;
        }
        for (variable, value, name) in &self.pins {
            writeln!(
                out,
                " {name}: {} = {value:?}",
                self.names.variables[*variable]
            )?;
        }
        let inequalities = self.problem.problem.inequality_rows();
        for (i, name) in self.names.inequalities.iter().enumerate() {
            let (lower, upper) = (inequalities.lower()[i], inequalities.upper()[i]);
            write!(out, " {name}:")?;
            if lower.is_finite() && upper.is_finite() {
                write!(out, " {lower:?} <=")?;
            }
            self.write_terms(out, nonzero(self.rows.row(i)))?;
            if upper.is_finite() {
                writeln!(out, " <= {upper:?}")?;
            } else if lower.is_finite() {
                writeln!(out, " >= {lower:?}")?;
            } else {
                writeln!(out, " >= -1e30")?;
            }
        }
        Ok(())
    }

    fn is_binary(&self, j: usize) -> bool {
        let (lower, upper) = self.problem.problem.limits_of(j);
        lower.to_bits() == 0 && upper == 1.0
    }

    fn write_bounds(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "Bounds")?;
        for (j, name) in self.names.variables.iter().enumerate() {
            let (lower, upper) = self.problem.problem.limits_of(j);
            match (lower, upper) {
                (f64::NEG_INFINITY, f64::INFINITY) => writeln!(out, " {name} free")?,
                (f64::NEG_INFINITY, _) => writeln!(out, " -inf <= {name} <= {upper:?}")?,
                _ if lower.to_bits() == upper.to_bits() => writeln!(out, " {name} = {lower:?}")?,
                (_, f64::INFINITY) if lower.to_bits() == 0 => {}
                (_, f64::INFINITY) => writeln!(out, " {name} >= {lower:?}")?,
                _ if self.model.integer()[j] && self.is_binary(j) => {}
                _ => writeln!(out, " {lower:?} <= {name} <= {upper:?}")?,
            }
        }
        Ok(())
    }

    fn write_list(
        &self,
        out: &mut impl Write,
        section: &str,
        is_in: impl Fn(&usize) -> bool,
    ) -> io::Result<()> {
        let listed: Vec<usize> = (0..self.model.variables()).filter(is_in).collect();
        if !listed.is_empty() {
            writeln!(out, "{section}")?;
        }
        for j in listed {
            writeln!(out, " {}", self.names.variables[j])?;
        }
        Ok(())
    }
}

/// The terms of a row that say something. A term of zero may only declare a variable.
fn nonzero(terms: impl Iterator<Item = (usize, f64)>) -> impl Iterator<Item = (usize, f64)> {
    terms.filter(|(_, value)| *value != 0.0)
}

fn sign(value: f64) -> char {
    if value.is_sign_negative() { '-' } else { '+' }
}

/// The names as LP allows them, and those of rows.
fn lp_names(names: &Names) -> (Names, HashSet<String>) {
    const KEPT: usize = 200;
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    names.writable(is_writable, |name| {
        let kept = name.chars().take(KEPT).map(plain);
        std::iter::once('_').chain(kept).collect()
    })
}
