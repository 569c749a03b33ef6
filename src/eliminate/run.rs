//! The elimination from start to end.

use std::sync::{Arc, OnceLock};

use super::record::Record;
use super::steps::{Definitions, Step};
use super::substitution::Substitution;
use super::tableau::Tableau;
use super::{
    Expansion, ReducedModel, Rounding, back, continuous, hold, integral, project, right_sides,
    rounding, subtree, sweep,
};
use crate::error::Result;
use crate::linalg::{Ordering, Sparse, principal_submatrix};
use crate::monitor::{Monitor, Phase, both, may_continue, span};
use crate::problem::{Model, Problem};

/// The least number of unknowns that are worth a thread.
const LEAST: usize = 1 << 14;

/// Eliminates the equality constraints and the pinned unknowns of `model`, in an order that keeps the reduced
/// Hessian sparse.
///
/// The reduced unknowns are the caller's unknowns that remain, in their order, followed by those that the
/// elimination introduced. The map `T y + t` is one to one between the `y` with integer entries where
/// required and the solutions of the constraints with integers where required.
///
/// # Errors
/// As [`Elimination::new`] and [`Elimination::reduce`].
pub fn eliminate(model: &Model, monitor: &mut Monitor) -> Result<ReducedModel> {
    Elimination::new(model, Ordering::FillReducing, monitor)?.reduce(model, monitor)
}

/// The equations of an elimination: the constraints, and those that define the unknowns that it introduced.
#[derive(Debug)]
pub(crate) struct Equations {
    /// Which one was solved for which unknown, in their order. Definitions are counted after the constraints.
    pub solved: Vec<(u32, u32)>,
    /// Each introduced unknown as a sum of terms of unknowns with lower numbers.
    pub defined: Vec<Vec<(u32, f64)>>,
    /// The numbers of all unknowns here: those of the caller are their own, and the introduced ones follow in the order of
    /// their definitions.
    pub numbers: Vec<u32>,
}

/// Everything in the reduced model except its linear part. It depends only on the coefficients of the
/// constraints and of Q, and on the set of pinned unknowns.
#[derive(Debug)]
pub struct Elimination {
    pub(super) record: Record,
    definitions: Definitions,
    in_constraints: Vec<bool>,
    /// The reduced unknowns.
    free: Vec<u32>,
    matrix: Arc<Sparse>,
    hessian: Arc<Sparse>,
    /// The [bound](Rounding::curvature) for this Hessian, once it has been asked for.
    curvature: OnceLock<Arc<Vec<f64>>>,
}

impl Elimination {
    /// Eliminates the constraints and the pinned unknowns of `model`, whatever the right sides and
    /// the pinned values.
    ///
    /// With [`Ordering::Natural`] rows and pivots are taken in the order given, which serves to measure
    /// what a better order gains. With [`Ordering::LargestPivot`] the row with the fewest entries comes
    /// first as well, but is solved for its first largest continuous unknown, or else its first
    /// integer with coefficient 1 or -1, and long rows do not wait. That is the elimination of
    /// `bommes2012`, chapter 5, which keeps other integers.
    ///
    /// # Errors
    /// [`NotSupported`](crate::Error::NotSupported) for a relation of integers with incommensurable
    /// coefficients, [`Overflow`](crate::Error::Overflow) where integers beyond 2^53 would be
    /// needed, [`OutOfMemory`](crate::Error::OutOfMemory), and what `monitor` asks for.
    pub fn new(model: &Model, ordering: Ordering, monitor: &mut Monitor) -> Result<Self> {
        let _span = span("eliminate");
        monitor.progress(Phase::Eliminate, 0.0)?;
        let mut tableau = Tableau::new(model, ordering)?;
        let rows = tableau.rows.len().max(1) as f64;
        let mut done = 0usize;
        while let Some(r) = tableau.take_next() {
            done += 1;
            monitor.progress(Phase::Eliminate, 0.5 * done as f64 / rows)?;
            eliminate_row(&mut tableau, r)?;
        }
        while let Some(r) = tableau.take_long() {
            done += 1;
            monitor.progress(Phase::Eliminate, 0.5 * done as f64 / rows)?;
            sweep::sweep(&mut tableau, r, monitor)?;
            subtree::shorten(&mut tableau, r, monitor)?;
            eliminate_row(&mut tableau, r)?;
        }
        may_continue()?;
        let (matrix, free) = back::substitute_back(&tableau, monitor)?;
        may_continue()?;
        let pins = model.pinned().iter().flatten().count();
        let hessian = if tableau.stack.len() == 0 {
            project::with_diagonal(Arc::clone(model.shared_hessian()))?
        } else if tableau.stack.len() == pins {
            let of_free = principal_submatrix(model.hessian(), &free)?;
            may_continue()?;
            project::with_diagonal(Arc::new(of_free))?
        } else {
            Arc::new(project::hessian(model.hessian(), &matrix, monitor)?)
        };
        may_continue()?;
        let mut in_constraints = vec![false; model.variables()];
        for (_, j, _) in model.constraints().entries() {
            in_constraints[j as usize] = true;
        }
        monitor.progress(Phase::Eliminate, 1.0)?;
        Ok(Elimination {
            record: Record {
                scales: tableau.rows.iter().map(|row| row.scale).collect(),
                pinned: model.pinned().iter().map(Option::is_some).collect(),
                unknowns: tableau.unknowns,
                stack: tableau.stack,
                steps: tableau.steps,
            },
            definitions: tableau.definitions,
            in_constraints,
            free,
            matrix: Arc::new(matrix),
            hessian,
            curvature: OnceLock::new(),
        })
    }

    /// The reduced model for the linear term, right sides, pinned values and guess of `model`, which
    /// has the Q, constraint coefficients and integers of the one eliminated.
    ///
    /// All unknowns pinned there must be pinned here; others may be, if they
    /// [can be held](Self::can_hold).
    ///
    /// # Errors
    /// [`Infeasible`](crate::Error::Infeasible) and
    /// [`NoIntegerSolution`](crate::Error::NoIntegerSolution) with the row at which it shows,
    /// [`Overflow`](crate::Error::Overflow), and what `monitor` asks for.
    pub fn reduce(&self, model: &Model, monitor: &mut Monitor) -> Result<ReducedModel> {
        let offset = right_sides::offset(&self.record, model, monitor)?;
        may_continue()?;
        let held: Vec<(u32, f64)> = (self.free.iter().enumerate())
            .filter_map(|(y, &u)| {
                let pin = model.pinned().get(u as usize);
                pin.map(|value| (y as u32, value))
            })
            .collect();
        if held.is_empty() {
            return self.linear_part(model, &self.hessian, &self.matrix, offset, &self.free);
        }
        let kept = hold::kept(self.free.len(), &held);
        let hessian = Arc::new(principal_submatrix(&self.hessian, &kept)?);
        let (matrix, offset) = hold::expansion(&self.matrix, offset, &kept, &held)?;
        let free: Vec<u32> = kept.iter().map(|&y| self.free[y as usize]).collect();
        self.linear_part(model, &hessian, &Arc::new(matrix), offset, &free)
    }

    fn linear_part(
        &self,
        model: &Model,
        hessian: &Arc<Sparse>,
        matrix: &Arc<Sparse>,
        offset: Vec<f64>,
        free: &[u32],
    ) -> Result<ReducedModel> {
        let expansion = Expansion::new(Arc::clone(matrix), offset);
        let is_integer = |&y: &u32| self.record.unknowns.integer[free[y as usize] as usize];
        let (gradient, constant) = project::linear(model, &expansion)?;
        may_continue()?;
        let ((integers, continuous), guess) = both(
            free.len() >= LEAST,
            || (0..free.len() as u32).partition(is_integer),
            || {
                let guess = self.definitions.evaluate(model.guess());
                free.iter().map(|&u| guess[u as usize]).collect()
            },
        );
        Ok(ReducedModel {
            hessian: Arc::clone(hessian),
            gradient,
            constant,
            integers,
            continuous,
            guess,
            origin: Vec::new(),
            rounding: Rounding::default(),
            free: free.to_vec(),
            expansion,
        })
    }

    /// The [bound](Rounding::curvature) for the Hessian of `reduced`, which was made from `problem`. It is kept if
    /// no unknowns are held.
    pub(super) fn curvature(
        &self,
        problem: &Problem,
        model: &Model,
        reduced: &ReducedModel,
    ) -> Arc<Vec<f64>> {
        let made = || Arc::new(rounding::curvature(problem, model, reduced));
        match Arc::ptr_eq(&self.hessian, &reduced.hessian) {
            true => Arc::clone(self.curvature.get_or_init(made)),
            false => made(),
        }
    }

    /// The equations of the elimination, as a proof tells them.
    pub(crate) fn equations(&self) -> Equations {
        let (stack, definitions) = (&self.record.stack, &self.definitions);
        let rows = self.record.scales.len() as u32;
        let numbers = definitions.numbers(self.record.pinned.len());
        let by_first = definitions.by_first();
        let steps = self.record.steps.iter();
        let solves = steps.filter(|step| matches!(step, Step::Solve { .. } | Step::Introduce));
        let all = (0..stack.len()).map(|k| stack.get(k).0);
        let of_rows = all.filter(|by| by.constraint != Substitution::NO_CONSTRAINT);
        let solved = solves.zip(of_rows).map(|(step, by)| {
            let row = match step {
                Step::Introduce => rows + by_first.get(&by.pivot).map_or(0, |&k| k as u32),
                _ => by.constraint,
            };
            (row, numbers[by.pivot as usize])
        });
        Equations {
            solved: solved.collect(),
            defined: definitions.sums(&numbers),
            numbers,
        }
    }

    /// The values of the caller's unknowns and of those that the elimination introduced, by the
    /// [numbers](Equations::numbers) of equations.
    pub(crate) fn with_introduced(&self, equations: &Equations, x: &[f64]) -> Vec<f64> {
        let all = self.definitions.evaluate(x);
        let mut values = vec![0.0; all.len()];
        for (number, value) in equations.numbers.iter().zip(all) {
            values[*number as usize] = value;
        }
        values
    }

    /// Whether `unknown` was pinned when the constraints were eliminated.
    pub fn was_pinned(&self, unknown: usize) -> bool {
        self.record.pinned[unknown]
    }

    /// Whether `unknown` can be pinned without another elimination: it is in no constraint.
    ///
    /// A pin in a constraint may change which unknowns are best kept, so that integers would be
    /// rounded in another order than by a solve from the start.
    pub fn can_hold(&self, unknown: usize) -> bool {
        !self.in_constraints[unknown]
    }

    /// The reduced unknowns of `reduced` where the caller's are `x`, provided that `x` satisfies the
    /// constraints; elsewhere the point that shares with `x` the unknowns that were kept.
    pub fn restrict(&self, reduced: &ReducedModel, x: &[f64]) -> Vec<f64> {
        let all = self.definitions.evaluate(x);
        reduced.free.iter().map(|&u| all[u as usize]).collect()
    }
}

fn eliminate_row(tableau: &mut Tableau, r: usize) -> Result<()> {
    let row = &tableau.rows[r];
    if row.entries.is_empty() {
        tableau.steps.push(Step::Check {
            row: r as u32,
            magnitude: row.magnitude,
            integral: row.integral,
        });
        return Ok(());
    }
    if row.continuous > 0 {
        continuous::eliminate(tableau, r)
    } else {
        integral::eliminate(tableau, r)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_constraints_a_hessian_with_its_diagonal_is_not_copied() {
        for diagonal in [3, 2] {
            let mut problem = Problem::new(3).unwrap();
            problem
                .add_least_squares(&[0, 1], &[1.0, -0.3], 1.0, 1.0)
                .unwrap();
            if diagonal == 3 {
                problem.add_least_squares(&[2], &[1.0], 1.0, 1.0).unwrap();
            }
            let model = Model::new(&problem).unwrap();
            let mut monitor = Monitor::default();
            let elimination =
                Elimination::new(&model, Ordering::FillReducing, &mut monitor).unwrap();
            let is_shared = Arc::ptr_eq(&elimination.hessian, model.shared_hessian());
            assert_eq!(is_shared, diagonal == 3);
            assert_eq!(
                elimination.hessian.diagonal(2),
                f64::from(diagonal - 2) * 2.0
            );
            assert_eq!(elimination.hessian.len(), 4);
        }
    }

    #[test]
    fn the_bound_of_the_hessian_is_made_once_unless_unknowns_are_held() {
        let mut problem = Problem::new(4).unwrap();
        for i in 1..4 {
            problem
                .add_least_squares(&[i - 1, i], &[1.0, -0.3], 1.0, 1.0)
                .unwrap();
        }
        problem.add_constraint(&[0, 1], &[1.0, 0.7], 2.0).unwrap();
        let mut monitor = Monitor::default();
        let model = Model::new(&problem).unwrap();
        let elimination = Elimination::new(&model, Ordering::FillReducing, &mut monitor).unwrap();
        let reduced = elimination.reduce(&model, &mut monitor).unwrap();
        let of = |problem: &Problem, model: &Model, reduced: &ReducedModel| {
            let made = rounding::curvature(problem, model, reduced);
            let bound = elimination.curvature(problem, model, reduced);
            assert_eq!(*bound, made);
            bound
        };
        let first = of(&problem, &model, &reduced);
        assert!(first.iter().all(|&bound| bound > 0.0));
        assert!(Arc::ptr_eq(&first, &of(&problem, &model, &reduced)));

        problem.pin(3, 5.0).unwrap();
        let model = Model::new(&problem).unwrap();
        let held = elimination.reduce(&model, &mut monitor).unwrap();
        assert_eq!(of(&problem, &model, &held).len(), first.len() - 1);
    }
}
