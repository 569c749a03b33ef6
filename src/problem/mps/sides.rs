//! The right sides of the rows (section RHS) and their ranges (section RANGES).

use super::lines::Line;
use super::rows::{Relation, Row, Rows, VectorName};
use crate::error::Result;
use crate::problem::files::lines::quoted;

/// The right sides, which are zero unless given, and the ranges.
#[derive(Default)]
pub(super) struct Sides {
    right_set: VectorName,
    range_set: VectorName,
    right_given: Vec<bool>,
    right: Vec<f64>,
    /// The range of each constraint that has one.
    ranges: Vec<Option<f64>>,
    /// The constant of the objective: minus its right side.
    pub constant: f64,
}

impl Sides {
    pub fn new(rows: &Rows) -> Self {
        let constraints = rows.relations().len();
        Sides {
            right_given: vec![false; rows.len()],
            right: vec![0.0; constraints],
            ranges: vec![None; constraints],
            ..Self::default()
        }
    }

    /// Reads `[SET] ROW VALUE [ROW VALUE]` of section RHS.
    pub fn read_right(&mut self, line: &Line, rows: &Rows) -> Result<()> {
        let first = first_pair(line)?;
        self.right_set.check(line, &line.fields()[..first])?;
        for (name, text) in line.pairs(first) {
            let (number, row) = rows.find(line, name)?;
            if std::mem::replace(&mut self.right_given[number], true) {
                let row = quoted(name);
                return Err(line.fault(format!("row {row} already has a right side")));
            }
            match row {
                Row::Objective => self.constant = -line.value(text)?,
                Row::Ignored => drop(line.value(text)?),
                Row::Constraint(i) => {
                    self.right[i] = match rows.relations()[i] {
                        Relation::Equal => line.value(text)?,
                        Relation::AtMost => line.limit_but(f64::NEG_INFINITY, text)?,
                        Relation::AtLeast => line.limit_but(f64::INFINITY, text)?,
                    };
                }
            }
        }
        Ok(())
    }

    /// Reads `[SET] ROW VALUE [ROW VALUE]` of section RANGES.
    pub fn read_range(&mut self, line: &Line, rows: &Rows) -> Result<()> {
        let first = first_pair(line)?;
        self.range_set.check(line, &line.fields()[..first])?;
        for (name, text) in line.pairs(first) {
            let (_, row) = rows.find(line, name)?;
            let range = line.limit(text)?;
            let Row::Constraint(i) = row else {
                let row = quoted(name);
                return Err(line.fault(format!("row {row} is of type N and has no range")));
            };
            if self.right[i].is_infinite() {
                let row = quoted(name);
                return Err(line.fault(format!("row {row} has no right side to begin a range at")));
            }
            if self.ranges[i].replace(range).is_some() {
                let row = quoted(name);
                return Err(line.fault(format!("row {row} already has a range")));
            }
        }
        Ok(())
    }

    /// Both sides of constraint `i`. They are equal for an equality.
    pub fn of(&self, i: usize, relation: Relation) -> (f64, f64) {
        let (right, range) = (self.right[i], self.ranges[i]);
        match (relation, range) {
            (Relation::Equal, None) => (right, right),
            (Relation::Equal, Some(range)) if range < 0.0 => (right + range, right),
            (Relation::Equal, Some(range)) => (right, right + range),
            (Relation::AtMost, None) => (f64::NEG_INFINITY, right),
            (Relation::AtMost, Some(range)) => (right - range.abs(), right),
            (Relation::AtLeast, None) => (right, f64::INFINITY),
            (Relation::AtLeast, Some(range)) => (right, right + range.abs()),
        }
    }

    /// Whether constraint `i` is an equality: of type E, without a range other than zero.
    pub fn is_equality(&self, i: usize, relation: Relation) -> bool {
        relation == Relation::Equal && self.ranges[i].is_none_or(|range| range == 0.0)
    }
}

/// The first field of the pairs on `line`, behind the optional name of the vector.
fn first_pair(line: &Line) -> Result<usize> {
    match line.fields().len() {
        2 | 4 => Ok(0),
        3 | 5 => Ok(1),
        _ => Err(line.wrong_length("one or two pairs of row and number")),
    }
}
