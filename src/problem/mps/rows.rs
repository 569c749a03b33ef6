//! The section ROWS, and the right sides of the rows in the section RHS.

use super::lines::{Line, quoted};
use super::names::Names;
use crate::error::Result;

/// The role of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Row {
    /// The first `N` row.
    Objective,
    /// Another `N` row, which has no meaning.
    Ignored,
    /// The equality constraint of this number.
    Constraint(usize),
}

/// The rows read so far.
pub(super) struct Rows {
    names: Names,
    kinds: Vec<Row>,
    objective: Option<usize>,
    constraints: usize,
}

impl Rows {
    pub fn new() -> Self {
        Rows {
            names: Names::new("row"),
            kinds: Vec::new(),
            objective: None,
            constraints: 0,
        }
    }

    /// Reads `E NAME` or `N NAME`.
    pub fn read(&mut self, line: &Line) -> Result<()> {
        let &[kind, name] = line.fields() else {
            return Err(line.wrong_length("the type and name of a row"));
        };
        let kind = match kind {
            "E" => Row::Constraint(self.constraints),
            "N" if self.objective.is_none() => Row::Objective,
            "N" => Row::Ignored,
            "L" | "G" => {
                let row = quoted(name);
                return Err(line.unsupported(format!("row {row} is an inequality ({kind})")));
            }
            _ => return Err(line.fault(format!("there is no row type {}", quoted(kind)))),
        };
        let number = self.names.insert(line, name)?;
        match kind {
            Row::Objective => self.objective = Some(number),
            Row::Constraint(_) => self.constraints += 1,
            Row::Ignored => {}
        }
        self.kinds.push(kind);
        Ok(())
    }

    /// Ends the section at the header `line` of the next section.
    pub fn end(&self, line: &Line) -> Result<()> {
        match self.objective {
            Some(_) => Ok(()),
            None => Err(line.fault("section ROWS has no objective (a row of type N)")),
        }
    }

    /// Number of all rows.
    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    /// The number and the role of the row with this name.
    pub fn find(&self, line: &Line, name: &str) -> Result<(usize, Row)> {
        let number = self.names.find(line, name)?;
        Ok((number, self.kinds[number]))
    }

    /// The names of the objective and of the constraints.
    pub fn into_names(self) -> (String, Vec<String>) {
        let mut objective = String::new();
        let mut constraints = Vec::with_capacity(self.constraints);
        for (name, kind) in self.names.into_vec().into_iter().zip(self.kinds) {
            match kind {
                Row::Objective => objective = name,
                Row::Constraint(_) => constraints.push(name),
                Row::Ignored => {}
            }
        }
        (objective, constraints)
    }
}

/// The right sides, which are zero unless given.
#[derive(Default)]
pub(super) struct RightSides {
    set: VectorName,
    given: Vec<bool>,
    /// One number for each constraint.
    pub values: Vec<f64>,
    /// The constant of the objective: minus its right side.
    pub constant: f64,
}

impl RightSides {
    pub fn new(rows: &Rows) -> Self {
        RightSides {
            given: vec![false; rows.len()],
            values: vec![0.0; rows.constraints],
            ..Self::default()
        }
    }

    /// Reads `[SET] ROW VALUE [ROW VALUE]`.
    pub fn read(&mut self, line: &Line, rows: &Rows) -> Result<()> {
        let first = match line.fields().len() {
            2 | 4 => 0,
            3 | 5 => 1,
            _ => return Err(line.wrong_length("one or two pairs of row and number")),
        };
        self.set.check(line, &line.fields()[..first])?;
        for (name, value) in line.pairs(first) {
            let (number, row) = rows.find(line, name)?;
            let value = line.value(value)?;
            if std::mem::replace(&mut self.given[number], true) {
                let row = quoted(name);
                return Err(line.fault(format!("row {row} already has a right side")));
            }
            match row {
                Row::Objective => self.constant = -value,
                Row::Ignored => {}
                Row::Constraint(i) => self.values[i] = value,
            }
        }
        Ok(())
    }
}

/// The optional name at the start of the lines of RHS and of BOUNDS. A file may hold several vectors of right
/// sides or bounds under different names. This library accepts files with one.
#[derive(Default)]
pub(super) struct VectorName(Option<String>);

impl VectorName {
    /// Compares the optional name of `line`, a slice of at most one name, with the first name.
    pub fn check(&mut self, line: &Line, name: &[&str]) -> Result<()> {
        let name = name.first().copied().unwrap_or_default();
        match &self.0 {
            None => self.0 = Some(name.to_owned()),
            Some(first) if first == name => {}
            Some(first) => {
                let (name, first) = (quoted(name), quoted(first));
                return Err(line.unsupported(format!("a second vector {name} beside {first}")));
            }
        }
        Ok(())
    }
}
