//! The section COLUMNS with its integer markers.

use super::lines::Line;
use super::rows::{Row, Rows};
use crate::error::Result;
use crate::problem::files::lines::quoted;
use crate::problem::files::names::NameList;

/// The columns read so far, and their entries by columns.
pub(super) struct Columns {
    pub names: NameList,
    /// Coefficients of the objective.
    pub linear: Vec<f64>,
    /// Whether each column is integer.
    pub integer: Vec<bool>,
    /// The entries: constraints, columns and values.
    pub entries: (Vec<usize>, Vec<usize>, Vec<f64>),
    /// For each row, one more than the last column with an entry in the row.
    entered: Vec<usize>,
    /// The name of the last column.
    current: String,
    /// The line of the open integer marker, if there is one.
    integer_since: Option<usize>,
}

impl Columns {
    pub fn new(rows: &Rows) -> Self {
        Columns {
            names: NameList::new("column"),
            linear: Vec::new(),
            integer: Vec::new(),
            entries: Default::default(),
            entered: vec![0; rows.len()],
            current: String::new(),
            integer_since: None,
        }
    }

    /// Reads `COLUMN ROW VALUE [ROW VALUE]` or `NAME 'MARKER' 'INTORG'`.
    pub fn read(&mut self, line: &Line, rows: &Rows) -> Result<()> {
        if let [_, "'MARKER'", rest @ ..] = line.fields() {
            return self.read_marker(line, rest);
        }
        let (name, entries) = line.named_pairs()?;
        if self.current != name {
            self.begin(line, name)?;
        }
        let column = self.names.len() - 1;
        for (name, value) in entries {
            let (number, row) = rows.find(line, name)?;
            let value = line.value(value)?;
            if std::mem::replace(&mut self.entered[number], column + 1) == column + 1 {
                let (row, column) = (quoted(name), quoted(&self.current));
                return Err(
                    line.fault(format!("column {column} already has an entry in row {row}"))
                );
            }
            match row {
                Row::Objective => self.linear[column] = value,
                Row::Ignored => {}
                Row::Constraint(i) => {
                    self.entries.0.push(i);
                    self.entries.1.push(column);
                    self.entries.2.push(value);
                }
            }
        }
        Ok(())
    }

    fn begin(&mut self, line: &Line, name: &str) -> Result<()> {
        self.names.insert(line.number, name)?;
        self.current.clear();
        self.current.push_str(name);
        self.linear.push(0.0);
        self.integer.push(self.integer_since.is_some());
        Ok(())
    }

    fn read_marker(&mut self, line: &Line, rest: &[&str]) -> Result<()> {
        // No column continues after a marker, since the marker would apply to half of it.
        self.current.clear();
        self.integer_since = match (rest, self.integer_since) {
            (["'INTORG'"], None) => Some(line.number),
            (["'INTEND'"], Some(_)) => None,
            (["'INTORG'"], Some(open)) => {
                return Err(line.fault(format!("'INTORG' inside that of line {open}")));
            }
            (["'INTEND'"], None) => return Err(line.fault("'INTEND' without 'INTORG'")),
            ([other], _) => return Err(line.unsupported(format!("marker {}", quoted(other)))),
            _ => return Err(line.wrong_length("a name, 'MARKER', and 'INTORG' or 'INTEND'")),
        };
        Ok(())
    }

    /// Ends the section at the header `line` of the next section.
    pub fn end(&mut self, line: &Line) -> Result<()> {
        if let Some(open) = self.integer_since {
            return Err(line.fault(format!("'INTORG' of line {open} has no 'INTEND'")));
        }
        if self.names.len() == 0 {
            return Err(line.fault("section COLUMNS is empty: the problem has no variables"));
        }
        Ok(())
    }
}
