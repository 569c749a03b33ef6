//! The section ROWS.

use super::lines::Line;
use crate::error::Result;
use crate::problem::files::lines::quoted;
use crate::problem::files::names::NameList;

/// The role of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Row {
    /// The first `N` row.
    Objective,
    /// Another `N` row, which has no meaning.
    Ignored,
    /// The constraint of this number.
    Constraint(usize),
}

/// What a constraint says of its row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Relation {
    Equal,
    AtMost,
    AtLeast,
}

/// The rows read so far.
pub(super) struct Rows {
    names: NameList,
    kinds: Vec<Row>,
    objective: Option<usize>,
    /// One for each constraint.
    relations: Vec<Relation>,
}

impl Rows {
    pub fn new() -> Self {
        Rows {
            names: NameList::new("row"),
            kinds: Vec::new(),
            objective: None,
            relations: Vec::new(),
        }
    }

    /// Reads `TYPE NAME`.
    pub fn read(&mut self, line: &Line) -> Result<()> {
        let &[kind, name] = line.fields() else {
            return Err(line.wrong_length("the type and name of a row"));
        };
        let relation = match kind {
            "E" => Some(Relation::Equal),
            "L" => Some(Relation::AtMost),
            "G" => Some(Relation::AtLeast),
            "N" => None,
            _ => return Err(line.fault(format!("there is no row type {}", quoted(kind)))),
        };
        let number = self.names.insert(line.number, name)?;
        self.kinds.push(match (relation, self.objective) {
            (Some(_), _) => Row::Constraint(self.relations.len()),
            (None, None) => Row::Objective,
            (None, Some(_)) => Row::Ignored,
        });
        match relation {
            Some(relation) => self.relations.push(relation),
            None => self.objective = self.objective.or(Some(number)),
        }
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
        let number = self.names.find(line.number, name)?;
        Ok((number, self.kinds[number]))
    }

    /// What each constraint says.
    pub fn relations(&self) -> &[Relation] {
        &self.relations
    }

    /// The names of the objective and of the constraints.
    pub fn into_names(self) -> (String, Vec<String>) {
        let mut objective = String::new();
        let mut constraints = Vec::with_capacity(self.relations.len());
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
