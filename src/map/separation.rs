//! Constraints added to a problem, without those that contradict the others.

use crate::eliminate::eliminate;
use crate::problem::RowList;
use crate::{Error, Model, Monitor, Options, Problem, Result, Solution, Solver, solve_with};

/// A constraint that something asks for, on top of those that there are.
pub(crate) trait Wish {
    /// The two unknowns, their coefficients, and the right side.
    fn row(&self) -> ([usize; 2], [f64; 2], f64);
}

/// The problem with the wishes as constraints, those left out that contradict it or the wishes before
/// them; none if none is left.
///
/// # Errors
/// Those of [`eliminate`], but for constraints that contradict each other.
pub(super) fn with_separation<'a, W: Wish>(
    stated: &Problem,
    wishes: &mut Vec<W>,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Option<Problem>> {
    // Whether constraints can hold does not depend on the objective, and is told faster without.
    let bare = without_objective(stated)?;
    while !wishes.is_empty() {
        let row = match eliminate(&Model::new(&with(&bare, wishes)?)?, &mut monitor()) {
            Ok(_) => return with(stated, wishes).map(Some),
            Err(
                Error::Infeasible { constraint, .. } | Error::NoIntegerSolution { constraint, .. },
            ) => constraint,
            Err(error) => return Err(error),
        };
        let at = row.checked_sub(stated.constraints());
        wishes.remove(at.unwrap_or(wishes.len() - 1));
    }
    Ok(None)
}

/// The solution under the wishes as further constraints, those left out that contradict the problem or
/// the wishes before them; none if none is left.
///
/// # Errors
/// Those of [`solve_with`], but for constraints that contradict each other.
pub(crate) fn solve_separated<'a, W: Wish>(
    solver: &mut Solver,
    wishes: &mut Vec<W>,
    options: &Options,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Option<Solution>> {
    while !wishes.is_empty() {
        let mut rows = RowList::default();
        for (indices, coefficients, rhs) in wishes.iter().map(Wish::row) {
            let variables = solver.problem().variables();
            rows.push("wish", variables, &indices, &coefficients, rhs)?;
        }
        match solver.solve_subject_to(&rows, options, monitor()) {
            Ok(Some(solution)) => return Ok(Some(solution)),
            Ok(None) => {
                let problem = with_separation(solver.problem(), wishes, monitor)?;
                let solved = problem.map(|problem| solve_with(&problem, options, monitor()));
                return solved.transpose();
            }
            Err(
                Error::Infeasible { constraint, .. } | Error::NoIntegerSolution { constraint, .. },
            ) => wishes.remove(constraint),
            Err(error) => return Err(error),
        };
    }
    Ok(None)
}

fn with<W: Wish>(stated: &Problem, wishes: &[W]) -> Result<Problem> {
    let mut problem = stated.clone();
    for (indices, coefficients, rhs) in wishes.iter().map(Wish::row) {
        problem.add_constraint(&indices, &coefficients, rhs)?;
    }
    Ok(problem)
}

/// The constraints, integers and pins of a problem alone.
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

/// The constraints of a problem alone.
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

    struct Differ(usize, usize, f64);

    impl Wish for Differ {
        fn row(&self) -> ([usize; 2], [f64; 2], f64) {
            ([self.1, self.0], [1.0, -1.0], self.2)
        }
    }

    #[test]
    fn what_contradicts_an_earlier_wish_or_the_problem_is_left_out() {
        let mut stated = Problem::new(4).unwrap();
        stated.add_constraint(&[0, 1], &[1.0, -1.0], 0.0).unwrap();
        stated.set_integers(&[0, 1, 2, 3]).unwrap();
        stated.pin(3, 2.0).unwrap();
        let mut wishes = vec![
            Differ(0, 1, 1.0),
            Differ(1, 2, 1.0),
            Differ(0, 2, 2.0),
            Differ(2, 3, 0.5),
            Differ(2, 3, 1.0),
        ];
        let found = with_separation(&stated, &mut wishes, &Monitor::default).unwrap();
        assert_eq!(found.unwrap().constraints(), 3);
        let left: Vec<_> = wishes.iter().map(|w| (w.0, w.1, w.2)).collect();
        assert_eq!(left, [(1, 2, 1.0), (2, 3, 1.0)]);
        let mut none = vec![Differ(0, 1, 1.0)];
        assert!(
            with_separation(&stated, &mut none, &Monitor::default)
                .unwrap()
                .is_none()
        );
    }
}
