//! Separation constraints. They separate two cones, two corners of a triangle or two feature curves that
//! the integers of a map have collapsed.

use super::SeamlessMap;
use crate::eliminate::eliminate;
use crate::error::{Error, Result};
use crate::monitor::Monitor;
use crate::problem::RowList;
use crate::problem::{Model, Problem};
use crate::search::Options;
use crate::solve::{Solution, Solver, solve_with};

/// `b - a = by` for two unknowns `[a, b]` of a map, both decided by integers; `by` is a whole number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SeparationConstraint {
    pub(crate) unknowns: [usize; 2],
    pub(crate) by: f64,
}

impl SeparationConstraint {
    /// Constrains one coordinate, 0 for u and 1 for v, of two copies of vertices.
    pub(crate) fn new(copies: [u32; 2], axis: usize, by: f64) -> Self {
        let unknowns = copies.map(|copy| 2 * copy as usize + axis);
        SeparationConstraint { unknowns, by }
    }

    /// Whether a map gives both unknowns one value, or puts them in the wrong order.
    pub(crate) fn is_collapsed(&self, map: &SeamlessMap) -> bool {
        let [a, b] = self.unknowns.map(|unknown| map.values()[unknown].round());
        (b - a) * self.by <= 0.0
    }

    fn row(&self) -> ([usize; 2], [f64; 2], f64) {
        let [a, b] = self.unknowns;
        ([b, a], [1.0, -1.0], self.by)
    }
}

/// Solves with these constraints added. A constraint that contradicts the problem or the constraints
/// before it is left out; `None` if no constraint remains.
///
/// # Errors Those of [`solve_with`], except for constraints that contradict each other.
pub(crate) fn solve_separated<'a>(
    solver: &mut Solver,
    constraints: &mut Vec<SeparationConstraint>,
    options: &Options,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Option<Solution>> {
    while !constraints.is_empty() {
        let mut rows = RowList::default();
        let variables = solver.problem().variables();
        for (indices, coefficients, rhs) in constraints.iter().map(SeparationConstraint::row) {
            let what = "separation constraint";
            rows.push(what, variables, &indices, &coefficients, rhs)?;
        }
        match solver.solve_subject_to(&rows, options, monitor()) {
            Ok(Some(solution)) => return Ok(Some(solution)),
            Ok(None) => {
                let problem = with_separation(solver.problem(), constraints, monitor)?;
                let solved = problem.map(|problem| solve_with(&problem, options, monitor()));
                return solved.transpose();
            }
            Err(
                Error::Infeasible { constraint, .. } | Error::NoIntegerSolution { constraint, .. },
            ) => constraints.remove(constraint),
            Err(error) => return Err(error),
        };
    }
    Ok(None)
}

/// The problem with these constraints added. A constraint that contradicts the problem or the constraints
/// before it is left out; `None` if no constraint remains.
///
/// # Errors Those of [`eliminate`], except for constraints that contradict each other.
fn with_separation<'a>(
    stated: &Problem,
    constraints: &mut Vec<SeparationConstraint>,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Option<Problem>> {
    // Feasibility does not depend on the objective, and is decided faster without it.
    let bare = without_objective(stated)?;
    while !constraints.is_empty() {
        let row = match eliminate(&Model::new(&with(&bare, constraints)?)?, &mut monitor()) {
            Ok(_) => return with(stated, constraints).map(Some),
            Err(
                Error::Infeasible { constraint, .. } | Error::NoIntegerSolution { constraint, .. },
            ) => constraint,
            Err(error) => return Err(error),
        };
        let at = row.checked_sub(stated.constraints());
        constraints.remove(at.unwrap_or(constraints.len() - 1));
    }
    Ok(None)
}

fn with(stated: &Problem, constraints: &[SeparationConstraint]) -> Result<Problem> {
    let mut problem = stated.clone();
    for (indices, coefficients, rhs) in constraints.iter().map(SeparationConstraint::row) {
        problem.add_constraint(&indices, &coefficients, rhs)?;
    }
    Ok(problem)
}

/// A problem with the constraints, integers and pins of another, and without its objective.
fn without_objective(stated: &Problem) -> Result<Problem> {
    let mut bare = constraints_of(stated)?;
    let integers = stated.integers().iter().enumerate();
    let integers: Vec<usize> = integers.filter_map(|(i, &is)| is.then_some(i)).collect();
    bare.set_integers(&integers)?;
    for (i, pin) in stated.pins().iter().enumerate() {
        if let Some(value) = *pin {
            bare.pin(i, value)?;
        }
    }
    Ok(bare)
}

/// A problem with only the constraints of another.
pub(crate) fn constraints_of(stated: &Problem) -> Result<Problem> {
    let mut bare = Problem::new(stated.variables())?;
    let rows = stated.constraint_rows();
    for row in 0..rows.len() {
        let (indices, coefficients): (Vec<_>, Vec<_>) = rows.row(row).unzip();
        bare.add_constraint(&indices, &coefficients, rows.rhs()[row])?;
    }
    Ok(bare)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(a: usize, b: usize, by: f64) -> SeparationConstraint {
        let unknowns = [a, b];
        SeparationConstraint { unknowns, by }
    }

    #[test]
    fn what_contradicts_an_earlier_constraint_or_the_problem_is_left_out() {
        let mut stated = Problem::new(4).unwrap();
        stated.add_constraint(&[0, 1], &[1.0, -1.0], 0.0).unwrap();
        stated.set_integers(&[0, 1, 2, 3]).unwrap();
        stated.pin(3, 2.0).unwrap();
        let given = vec![
            apart(0, 1, 1.0),
            apart(1, 2, 1.0),
            apart(0, 2, 2.0),
            apart(2, 3, 0.5),
            apart(2, 3, 1.0),
        ];
        let mut stays = given.clone();
        let found = with_separation(&stated, &mut stays, &Monitor::default).unwrap();
        assert_eq!(found.unwrap().constraints(), 3);
        assert_eq!(stays, [apart(1, 2, 1.0), apart(2, 3, 1.0)]);

        let mut stays = given;
        let mut solver = Solver::new(&stated).unwrap();
        let options = Options::default();
        let solution = solve_separated(&mut solver, &mut stays, &options, &Monitor::default);
        assert_eq!(solution.unwrap().unwrap().values(), [0.0, 0.0, 1.0, 2.0]);
        assert_eq!(stays, [apart(1, 2, 1.0), apart(2, 3, 1.0)]);

        let mut none = vec![apart(0, 1, 1.0)];
        let found = with_separation(&stated, &mut none, &Monitor::default);
        assert!(found.unwrap().is_none());
    }
}
