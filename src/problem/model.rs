//! The validated problem, as the solver reads it.

use std::sync::Arc;

use super::{CycleHint, Pins, Problem, RowList};
use crate::error::{Error, Result};
use crate::linalg::Sparse;
use crate::monitor::{both, may_continue, may_continue_at, span};

/// The least number of unknowns for which a part of the assembly is worth a thread.
const WORTH_A_THREAD: usize = 10_000;

/// A problem that was checked and assembled. It does not change afterwards.
///
/// The least-squares rows are summed into Q, q and c. The rows themselves are kept too, shared with the
/// problem, because some steps of the solver read them.
#[derive(Debug, Clone)]
pub struct Model {
    hessian: Arc<Sparse>,
    gradient: Vec<f64>,
    constant: f64,
    least_squares: RowList,
    weights: Arc<Vec<f64>>,
    constraints: Arc<Sparse>,
    constraint_rhs: Vec<f64>,
    integer: Arc<Vec<bool>>,
    pinned: Pins,
    guess: Arc<Vec<f64>>,
    cycles: Arc<CycleHint>,
    ignored_hint: Option<usize>,
}

impl Model {
    /// Checks and assembles `problem`.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an integer unknown pinned
    /// to a fraction, [`Error::Overflow`] where sums overflow, [`Error::OutOfMemory`].
    pub fn new(problem: &Problem) -> Result<Self> {
        let _span = span("model");
        pins_are_integer(problem)?;
        let n = problem.variables;
        let rows = &problem.least_squares;
        let products = problem.weights.iter().enumerate().flat_map(|(k, &w)| {
            let row = rows.row(k);
            row.clone().enumerate().flat_map(move |(a, (i, u))| {
                // Each unordered pair once. A repeated variable is paired with itself twice.
                let square = (i as u32, i as u32, 2.0 * w * u * u);
                let others = row.clone().take(a).map(move |(j, v)| {
                    let twice = if i == j { 2.0 } else { 1.0 };
                    (i.max(j) as u32, i.min(j) as u32, twice * 2.0 * w * u * v)
                });
                std::iter::once(square).chain(others)
            })
        });
        let entries = problem.quadratic.iter().copied().chain(products);
        let others = || {
            let linear = linear_part(problem)?;
            may_continue()?;
            let fault = problem
                .cycles
                .fault(&problem.least_squares, &problem.integer);
            may_continue()?;
            let constraints = problem.constraints.to_sparse(n)?;
            Ok::<_, Error>((linear, fault, constraints))
        };
        let (hessian, others) = both(
            n >= WORTH_A_THREAD,
            || Sparse::from_triplets(n, n, entries),
            others,
        );
        let hessian = hessian?;
        may_continue()?;
        if let Some(at) = hessian.values().iter().position(|v| !v.is_finite()) {
            let i = hessian.offsets().partition_point(|&start| start <= at) - 1;
            let j = hessian.indices()[at];
            return Err(Error::Overflow {
                what: format!("the sum of quadratic entries ({i}, {j}) overflows"),
                index: Some(i),
            });
        }
        may_continue()?;
        let ((gradient, constant), ignored_hint, constraints) = others?;
        if let Some((i, j, _)) = constraints.entries().find(|(_, _, v)| !v.is_finite()) {
            return Err(Error::Overflow {
                what: format!("constraint {i}: the sum of coefficients of variable {j} overflows"),
                index: Some(i as usize),
            });
        }
        Ok(Model {
            cycles: match ignored_hint {
                None => problem.cycles.clone(),
                Some(_) => Arc::default(),
            },
            ignored_hint,
            hessian: Arc::new(hessian),
            gradient,
            constant,
            least_squares: problem.least_squares.clone(),
            weights: problem.weights.clone(),
            constraints: Arc::new(constraints),
            constraint_rhs: problem.constraints.rhs().to_vec(),
            integer: problem.integer.clone(),
            pinned: problem.pinned.clone(),
            guess: problem.guess.clone(),
        })
    }

    /// The model of `problem`, which differs from this one's problem only in linear terms, right sides, pins
    /// and guess. The two models share everything else.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub(crate) fn with_data_of(&self, problem: &Problem) -> Result<Self> {
        pins_are_integer(problem)?;
        let (gradient, constant) = linear_part(problem)?;
        Ok(Model {
            hessian: Arc::clone(&self.hessian),
            gradient,
            constant,
            least_squares: problem.least_squares.clone(),
            weights: self.weights.clone(),
            constraints: Arc::clone(&self.constraints),
            constraint_rhs: problem.constraints.rhs().to_vec(),
            integer: self.integer.clone(),
            pinned: problem.pinned.clone(),
            guess: problem.guess.clone(),
            cycles: self.cycles.clone(),
            ignored_hint: self.ignored_hint,
        })
    }

    /// The same constraints with other right sides, and with every pinned unknown pinned to zero.
    pub(crate) fn with_constraint_right_sides(&self, rhs: Vec<f64>) -> Self {
        Model {
            constraint_rhs: rhs,
            pinned: self.pinned.at_zero(),
            ..self.clone()
        }
    }

    /// Number of unknowns.
    pub fn variables(&self) -> usize {
        self.gradient.len()
    }

    /// Lower triangle of Q, least-squares rows included.
    pub fn hessian(&self) -> &Sparse {
        &self.hessian
    }

    /// The same, to be shared.
    pub(crate) fn shared_hessian(&self) -> &Arc<Sparse> {
        &self.hessian
    }

    /// q, least-squares rows included.
    pub fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    /// The sums of the absolute values of the terms of q.
    pub(crate) fn gradient_size(&self) -> Vec<f64> {
        let mut size: Vec<f64> = self.gradient.iter().map(|q| q.abs()).collect();
        for (k, &w) in self.weights.iter().enumerate() {
            let rhs = self.least_squares.rhs()[k];
            for (i, u) in self.least_squares.row(k) {
                size[i] += (2.0 * w * rhs * u).abs();
            }
        }
        size
    }

    /// c, least-squares rows included.
    pub fn constant(&self) -> f64 {
        self.constant
    }

    /// The least-squares rows as given, and their weights.
    pub fn least_squares(&self) -> (&RowList, &[f64]) {
        (&self.least_squares, &self.weights)
    }

    /// C, one row for each constraint.
    pub fn constraints(&self) -> &Sparse {
        &self.constraints
    }

    /// d, one number for each constraint.
    pub fn constraint_rhs(&self) -> &[f64] {
        &self.constraint_rhs
    }

    /// Whether each unknown is integer.
    pub fn integer(&self) -> &[bool] {
        &self.integer
    }

    /// The value of each pinned unknown.
    pub fn pinned(&self) -> &Pins {
        &self.pinned
    }

    /// The values that unknowns keep if the objective does not determine them.
    pub fn guess(&self) -> &[f64] {
        &self.guess
    }

    /// The cycles of the caller's hint, checked. There are none if the hint was wrong.
    pub fn cycles(&self) -> &CycleHint {
        &self.cycles
    }

    /// The cycle for which the caller's hint was ignored.
    pub fn ignored_hint(&self) -> Option<usize> {
        self.ignored_hint
    }
}

/// q and c, with the contributions of the least-squares rows.
fn linear_part(problem: &Problem) -> Result<(Vec<f64>, f64)> {
    let mut gradient = problem.linear.to_vec();
    let mut constant = problem.constant;
    for (k, &w) in problem.weights.iter().enumerate() {
        may_continue_at(k)?;
        let rhs = problem.least_squares.rhs()[k];
        for (i, u) in problem.least_squares.row(k) {
            gradient[i] -= 2.0 * w * rhs * u;
        }
        constant += w * rhs * rhs;
    }
    if let Some(i) = gradient.iter().position(|v| !v.is_finite()) {
        return Err(Error::Overflow {
            what: format!("the sum of linear terms of variable {i} overflows"),
            index: Some(i),
        });
    }
    if !constant.is_finite() {
        return Err(Error::Overflow {
            what: "the constant of the objective overflows".into(),
            index: None,
        });
    }
    Ok((gradient, constant))
}

fn pins_are_integer(problem: &Problem) -> Result<()> {
    for (i, pin) in problem.pinned.iter().enumerate() {
        if let (true, &Some(v)) = (problem.integer[i], pin)
            && v != v.round()
        {
            return Err(Error::InvalidArgument {
                what: format!("integer variable {i} is pinned to {v}"),
                index: Some(i),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constraint_whose_coefficients_overflow_is_named() {
        let mut problem = Problem::new(2).unwrap();
        problem.add_constraint(&[0], &[1.0], 0.0).unwrap();
        let huge = [f64::MAX, f64::MAX];
        problem.add_constraint(&[1, 1], &huge, 0.0).unwrap();
        let error = Model::new(&problem).unwrap_err();
        assert!(
            matches!(error, Error::Overflow { index: Some(1), .. }),
            "{error}"
        );
    }
}
