//! A problem with the names that files give its parts.

use std::collections::HashSet;

use super::lines::quoted;
use super::names::{check_name, check_title};
use crate::error::{Error, Result};
use crate::problem::Problem;

/// A problem and its names. There is one name for each variable and each constraint, and a file can hold all
/// of them.
#[derive(Debug, Clone)]
pub struct NamedProblem {
    pub(crate) problem: Problem,
    pub(crate) names: Names,
    pub(crate) maximise: bool,
    /// The line of a file on which Q has an entry of each unknown; 0 for none, and empty without a file or Q.
    pub(crate) lines: Vec<usize>,
}

/// The names of a problem's parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Names {
    pub title: String,
    pub objective: String,
    pub variables: Vec<String>,
    pub constraints: Vec<String>,
    pub inequalities: Vec<String>,
}

impl Names {
    /// The names `OBJ`, x0, x1, ..., c0, c1, ... and r0, r1, ...
    pub fn numbered(variables: usize, constraints: usize, inequalities: usize) -> Self {
        Names {
            title: String::new(),
            objective: "OBJ".into(),
            variables: (0..variables).map(|i| format!("x{i}")).collect(),
            constraints: (0..constraints).map(|i| format!("c{i}")).collect(),
            inequalities: (0..inequalities).map(|i| format!("r{i}")).collect(),
        }
    }
}

impl Names {
    /// The names that a format can hold: those that are `allowed`, and others changed by `change` and made
    /// unique. Second, the names of rows.
    pub(in crate::problem) fn writable(
        &self,
        allowed: impl Fn(&str) -> bool,
        change: impl Fn(&str) -> String,
    ) -> (Names, HashSet<String>) {
        let objective = std::slice::from_ref(&self.objective);
        let lists = [objective, &self.constraints, &self.inequalities];
        let mut rows = HashSet::new();
        for names in lists {
            rows.extend(names.iter().filter(|name| allowed(name)).cloned());
        }
        let mut variables: HashSet<String> = self.variables.iter().cloned().collect();
        variables.retain(|name| allowed(name));
        let written = |names: &[String], taken: &mut HashSet<String>| {
            let written = names.iter().map(|name| {
                if allowed(name) {
                    return name.clone();
                }
                let mut other = change(name);
                while !taken.insert(other.clone()) {
                    other.push('_');
                }
                other
            });
            written.collect::<Vec<String>>()
        };
        let names = Names {
            title: self.title.clone(),
            objective: written(objective, &mut rows).concat(),
            variables: written(&self.variables, &mut variables),
            constraints: written(&self.constraints, &mut rows),
            inequalities: written(&self.inequalities, &mut rows),
        };
        (names, rows)
    }
}

impl NamedProblem {
    /// `problem` without a title, with the objective `OBJ`, variables x0, x1, ..., constraints c0, c1, ...
    /// and inequalities r0, r1, ...
    pub fn new(problem: Problem) -> Self {
        let rows = (problem.constraints(), problem.inequalities());
        let names = Names::numbered(problem.variables(), rows.0, rows.1);
        NamedProblem {
            problem,
            names,
            maximise: false,
            lines: Vec::new(),
        }
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
        let names = Names {
            title: title.to_owned(),
            objective: objective.to_owned(),
            variables,
            constraints,
            inequalities,
        };
        Ok(NamedProblem {
            problem,
            names,
            maximise: false,
            lines: Vec::new(),
        })
    }

    /// The problem.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// Returns the problem, which minimises, without its names.
    pub fn into_problem(self) -> Problem {
        self.problem
    }

    /// Whether the file maximises. The problem then minimises the negated objective: the value of the file's
    /// objective is minus the energy, and a lower bound of the energy is minus an upper bound of the value.
    pub fn maximises(&self) -> bool {
        self.maximise
    }

    /// The same problem, stated in files as maximisation of the negated objective if `maximise` is set.
    pub fn maximising(self, maximise: bool) -> Self {
        NamedProblem { maximise, ..self }
    }

    /// `error` with the line of the file and the name of the unknown, if it is [`Error::NotConvex`] and the file has
    /// an entry of Q for the unknown. A reader sees only what single entries show; this is for the solver's error.
    pub fn located(&self, error: Error) -> Error {
        match error {
            Error::NotConvex {
                variable,
                direction,
            } if self.lines.get(variable).is_some_and(|line| *line > 0) => Error::NotConvexAt {
                line: self.lines[variable],
                what: format!(
                    "the objective is not convex: it curves {} along a direction that moves variable {}",
                    if self.maximise {
                        "upwards"
                    } else {
                        "downwards"
                    },
                    quoted(&self.names.variables[variable])
                ),
                variable,
                direction,
            },
            error => error,
        }
    }

    /// The title, which may be empty.
    pub fn title(&self) -> &str {
        &self.names.title
    }

    /// The name of the objective.
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
    let mut seen: HashSet<&str> = taken.iter().map(String::as_str).collect();
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

    fn named(objective: &str, variables: [&str; 2], constraint: &str) -> Result<NamedProblem> {
        let mut problem = Problem::new(2).unwrap();
        problem.add_constraint(&[0], &[1.0], 0.0).unwrap();
        let variables = variables.map(String::from).to_vec();
        NamedProblem::with_names(
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
        let none = NamedProblem::with_names(problem.clone(), "", "f", vec![], vec![], vec![]);
        assert!(matches!(
            none,
            Err(Error::LengthMismatch { expected: 1, .. })
        ));
        let title =
            NamedProblem::with_names(problem, "a\nb", "f", vec!["x".into()], vec![], vec![]);
        assert!(matches!(title, Err(Error::InvalidArgument { .. })));
    }
}
