//! The section BOUNDS, and the bounds of columns that it leaves out.
//!
//! The defaults are those on which CPLEX, Gurobi, SCIP, Xpress and HiGHS agree. A column without a line has
//! the lower bound 0 and no upper bound; an integer column without a line is binary. A negative upper bound
//! without a lower bound leaves the column without a lower bound.

use super::columns::Columns;
use super::lines::Line;
use super::rows::VectorName;
use crate::error::Result;
use crate::problem::files::lines::quoted;

/// One side of the bounds of a column, with the line that gave it.
#[derive(Debug, Clone, Copy)]
struct Side {
    value: f64,
    line: usize,
}

/// The bounds read so far.
#[derive(Default)]
pub(super) struct Bounds {
    set: VectorName,
    lower: Vec<Option<Side>>,
    upper: Vec<Option<Side>>,
}

impl Bounds {
    pub fn new(columns: &Columns) -> Self {
        Bounds {
            set: VectorName::default(),
            lower: vec![None; columns.names.len()],
            upper: vec![None; columns.names.len()],
        }
    }

    /// Reads `TYPE [SET] COLUMN [VALUE]`.
    pub fn read(&mut self, line: &Line, columns: &mut Columns) -> Result<()> {
        let kind = line.fields()[0];
        let needs_value = match kind {
            "LO" | "UP" | "FX" | "LI" | "UI" => true,
            "FR" | "MI" | "PL" | "BV" => false,
            "SC" | "SI" => {
                let what = format!("semi-continuous variables (bounds of type {kind})");
                return Err(line.unsupported(what));
            }
            _ => return Err(line.fault(format!("there is no bound type {}", quoted(kind)))),
        };
        // The types without a value are written with one by some programs. It says nothing.
        let (set, name, value) = match (needs_value, &line.fields()[1..]) {
            (true, &[name, value]) => (None, name, value),
            (true, &[set, name, value]) => (Some(set), name, value),
            (false, &[name]) => (None, name, ""),
            (false, &[set, name] | &[set, name, _]) => (Some(set), name, ""),
            (true, _) => return Err(line.wrong_length(&format!("{kind}, a column and a number"))),
            (false, _) => return Err(line.wrong_length(&format!("{kind} and a column"))),
        };
        self.set.check(line, set.as_slice())?;
        let column = columns.names.find(line.number, name)?;
        if matches!(kind, "BV" | "LI" | "UI") {
            columns.integer[column] = true;
        }
        let [lower, upper] = match kind {
            "LO" | "LI" => [Some(line.limit_but(f64::INFINITY, value)?), None],
            "UP" | "UI" => [None, Some(line.limit_but(f64::NEG_INFINITY, value)?)],
            "FX" => [Some(line.value(value)?); 2],
            "BV" => [Some(0.0), Some(1.0)],
            "MI" => [Some(f64::NEG_INFINITY), None],
            "PL" => [None, Some(f64::INFINITY)],
            _ => [Some(f64::NEG_INFINITY), Some(f64::INFINITY)],
        };
        let sides = [(lower, "lower"), (upper, "upper")];
        let known = [&mut self.lower[column], &mut self.upper[column]];
        for ((value, which), known) in sides.into_iter().zip(known) {
            let Some(value) = value else { continue };
            let side = Side {
                value,
                line: line.number,
            };
            if let Some(first) = known.replace(side) {
                let (name, first) = (quoted(name), first.line);
                return Err(line.fault(format!(
                    "column {name} already has a {which} bound, on line {first}"
                )));
            }
        }
        let (lower, upper) = self.of(column, columns.integer[column]);
        if lower > upper {
            let name = quoted(name);
            return Err(line.fault(format!(
                "column {name} has the lower bound {lower} above the upper bound {upper}"
            )));
        }
        Ok(())
    }

    /// The bounds of a column.
    pub fn of(&self, column: usize, integer: bool) -> (f64, f64) {
        let side = |sides: &[Option<Side>]| sides.get(column).copied().flatten();
        let (lower, upper) = (side(&self.lower), side(&self.upper));
        match (lower.map(|side| side.value), upper.map(|side| side.value)) {
            (None, None) if integer => (0.0, 1.0),
            (None, Some(upper)) if upper < 0.0 => (f64::NEG_INFINITY, upper),
            (lower, upper) => (lower.unwrap_or(0.0), upper.unwrap_or(f64::INFINITY)),
        }
    }
}
