//! A problem with the names that MPS gives its parts.

use super::lines::quoted;
use super::names::{check_name, check_title};
use crate::error::{Error, Result};
use crate::problem::Problem;

/// A problem and its names. There is one name for each variable and each constraint, and a file can hold all
/// of them.
#[derive(Debug, Clone)]
pub struct MpsProblem {
    pub(super) problem: Problem,
    pub(super) names: MpsNames,
}

/// The names of a problem's parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct MpsNames {
    pub title: String,
    pub objective: String,
    pub variables: Vec<String>,
    pub constraints: Vec<String>,
    pub inequalities: Vec<String>,
}

impl MpsNames {
    /// The names `OBJ`, x0, x1, ..., c0, c1, ... and r0, r1, ...
    pub fn numbered(variables: usize, constraints: usize, inequalities: usize) -> Self {
        MpsNames {
            title: String::new(),
            objective: "OBJ".into(),
            variables: (0..variables).map(|i| format!("x{i}")).collect(),
            constraints: (0..constraints).map(|i| format!("c{i}")).collect(),
            inequalities: (0..inequalities).map(|i| format!("r{i}")).collect(),
        }
    }
}

impl MpsProblem {
    /// `problem` without a title, with the objective `OBJ`, variables x0, x1, ..., constraints c0, c1, ...
    /// and inequalities r0, r1, ...
    pub fn new(problem: Problem) -> Self {
        let rows = (problem.constraints(), problem.inequalities());
        let names = MpsNames::numbered(problem.variables(), rows.0, rows.1);
        MpsProblem { problem, names }
    }

    /// `problem` with the caller's names. Names must not be empty or contain blanks. Each must be unique
    /// among the variables, or among the rows: constraints, inequalities and the objective. The title may be empty and may
    /// contain blanks.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for too few or too many names, and [`Error::InvalidArgument`] with the
    /// position of an invalid name.
    pub fn with_names(
        problem: Problem,
        title: &str,
        objective: &str,
        variables: Vec<String>,
        constraints: Vec<String>,
        inequalities: Vec<String>,
    ) -> Result<Self> {
        same_count("variable names", problem.variables(), variables.len())?;
        same_count("constraint names", problem.constraints(), constraints.len())?;
        let rows = problem.inequalities();
        same_count("inequality names", rows, inequalities.len())?;
        check_title(title).map_err(|what| Error::InvalidArgument { what, index: None })?;
        check_names("variable", &variables, &[])?;
        check_name(objective).map_err(|fault| Error::InvalidArgument {
            what: format!("objective {fault}"),
            index: None,
        })?;
        check_names("constraint", &constraints, &[objective.to_owned()])?;
        let taken = [&constraints[..], &[objective.to_owned()]].concat();
        check_names("inequality", &inequalities, &taken)?;
        let names = MpsNames {
            title: title.to_owned(),
            objective: objective.to_owned(),
            variables,
            constraints,
            inequalities,
        };
        Ok(MpsProblem { problem, names })
    }

    /// The problem.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// Returns the problem without its names.
    pub fn into_problem(self) -> Problem {
        self.problem
    }

    /// The title from `NAME`, which may be empty.
    pub fn title(&self) -> &str {
        &self.names.title
    }

    /// The name of the objective's row.
    pub fn objective(&self) -> &str {
        &self.names.objective
    }

    /// The names of the variables.
    pub fn variables(&self) -> &[String] {
        &self.names.variables
    }

    /// The names of the constraints, which are equalities.
    pub fn constraints(&self) -> &[String] {
        &self.names.constraints
    }

    /// The names of the inequalities.
    pub fn inequalities(&self) -> &[String] {
        &self.names.inequalities
    }
}

fn same_count(what: &'static str, expected: usize, actual: usize) -> Result<()> {
    crate::problem::check::same_length(what, expected, actual)
}

fn check_names(what: &str, names: &[String], taken: &[String]) -> Result<()> {
    let mut seen: std::collections::HashSet<&str> = taken.iter().map(String::as_str).collect();
    for (i, name) in names.iter().enumerate() {
        let fault = match check_name(name) {
            Err(fault) => fault,
            Ok(()) if !seen.insert(name) => format!("name {} is taken", quoted(name)),
            Ok(()) => continue,
        };
        return Err(Error::InvalidArgument {
            what: format!("{what} {i}: {fault}"),
            index: Some(i),
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(objective: &str, variables: [&str; 2], constraint: &str) -> Result<MpsProblem> {
        let mut problem = Problem::new(2).unwrap();
        problem.add_constraint(&[0], &[1.0], 0.0).unwrap();
        let variables = variables.map(String::from).to_vec();
        MpsProblem::with_names(
            problem,
            "",
            objective,
            variables,
            vec![constraint.into()],
            vec![],
        )
    }

    #[test]
    fn names_that_a_file_cannot_hold_are_refused() {
        assert!(named("f", ["a", "b"], "a").is_ok());
        let cases = [
            (named("", ["a", "b"], "c"), None),
            (named("f", ["a", "a"], "c"), Some(1)),
            (named("f", ["a", "b c"], "c"), Some(1)),
            (named("f", ["a\n", "b"], "c"), Some(0)),
            (named("f", ["a", ""], "c"), Some(1)),
            (named("f", ["a", "b"], "f"), Some(0)),
            (named("f", ["a", "b"], "'MARKER'"), Some(0)),
            (named("f", ["a", &"b".repeat(5000)], "c"), Some(1)),
        ];
        for (result, index) in cases {
            let error = result.unwrap_err();
            assert!(matches!(error, Error::InvalidArgument { .. }), "{error}");
            assert_eq!(error.index(), index, "{error}");
        }
    }

    #[test]
    fn too_few_names_and_titles_over_two_lines_are_refused() {
        let problem = Problem::new(1).unwrap();
        let none = MpsProblem::with_names(problem.clone(), "", "f", vec![], vec![], vec![]);
        assert!(matches!(
            none,
            Err(Error::LengthMismatch { expected: 1, .. })
        ));
        let title = MpsProblem::with_names(problem, "a\nb", "f", vec!["x".into()], vec![], vec![]);
        assert!(matches!(title, Err(Error::InvalidArgument { .. })));
    }
}
