//! Solves under further constraints between integers, with the existing elimination and factors.
//!
//! The minimum of the objective over the continuous unknowns is `E* + 1/2 |R (z - z*)|^2` in the reduced
//! integers z. Here `R` is the factor of their Schur complement, and `z*` and `E*` are the integers and the
//! energy of the relaxation. Constraints between integers alone are rows in z. So the constrained problem
//! in z is small and dense. It is solved like any other problem, and its integers are offered to the search
//! of the whole problem.

use super::Solution;
use super::eliminated::{EliminatedProblem, SearchResult};
use super::expand::clean;
use super::relax::{Relaxation, relax};
use super::run::solve_eliminated;
use crate::eliminate::{Elimination, ReducedModel};
use crate::error::Result;
use crate::monitor::Monitor;
use crate::problem::RowList;
use crate::problem::{Model, Problem};
use crate::search::{Factors, Options, Search, SolveStatus, Strategy, WarmStart, of_relaxation};

/// Solves under further constraints. None if a solve from the start is needed. That is so if the
/// constraints contain unknowns that are not integer, if there are many integers, with a warm start, or for
/// a strategy with a proof, since a proof must account for the rounding of all data.
///
/// The bound is that of the relaxation without the further constraints.
///
/// # Errors
/// As [`solve`](crate::solve()); [`Infeasible`](crate::Error::Infeasible) and
/// [`NoIntegerSolution`](crate::Error::NoIntegerSolution) name the row that contradicts the problem
/// or the rows before it.
pub(super) fn solve_subject_to(
    mut of: EliminatedProblem,
    rows: &RowList,
    options: &Options,
    monitor: &mut Monitor,
) -> Result<Option<Solution>> {
    let is_plain = options.warm_start == WarmStart::Off
        && matches!(
            options.strategy,
            Strategy::Direct
                | Strategy::Greedy
                | Strategy::Adaptive
                | Strategy::Multiple
                | Strategy::Lattice
        );
    if !is_plain {
        return Ok(None);
    }
    let (reduced, clock) = of.reduce(monitor)?;
    if !of.factors.has_schur_factor(&reduced) {
        return Ok(None);
    }
    let Some(rows) = between_integers(&reduced, rows) else {
        return Ok(None);
    };
    let relaxed = || relax(of.model, &reduced, options.strategy, of.factors);
    let relaxation = monitor.watching(relaxed)?;
    let small = of_integers(&reduced, &relaxation, &rows, of.factors)?;
    let model = Model::new(&small)?;
    let eliminated = EliminatedProblem {
        problem: &small,
        model: &model,
        elimination: &Elimination::new(&model, options.ordering, monitor)?,
        factors: &mut Factors::new(options.ordering),
        earlier: model.guess(),
    };
    let decided = solve_eliminated(eliminated, options, monitor)?;
    let Relaxation {
        point, lower_bound, ..
    } = relaxation;
    let mut search = Search::new(&reduced, point, lower_bound, monitor);
    search.offer(of.factors, decided.values())?;
    let best = search.into_best()?;
    let mut values = reduced.expansion().expand(&best.point);
    clean(&mut values, of.model, options.strategy);
    let decided = SearchResult {
        energy: best.energy,
        lower_bound,
        status: SolveStatus::unproved(decided.stopped_by()),
        complete: false,
        stopped_by: decided.stopped_by(),
        work: of_relaxation(&reduced) + decided.work(),
        values,
    };
    of.conclude(&reduced, decided, &clock, monitor).map(Some)
}

/// A constraint in the reduced integers: their places among all integers, the coefficients, and the right
/// side.
type Row = (Vec<usize>, Vec<f64>, f64);

/// Converts rows in the caller's unknowns to rows in the reduced integers. None if they contain other
/// unknowns.
fn between_integers(model: &ReducedModel, rows: &RowList) -> Option<Vec<Row>> {
    let mut place = vec![None; model.dim()];
    for (k, &i) in model.integers().iter().enumerate() {
        place[i as usize] = Some(k);
    }
    let expansion = model.expansion();
    let of_row = |k: usize| {
        let (mut indices, mut coefficients) = (Vec::new(), Vec::new());
        let mut rhs = rows.rhs()[k];
        for (i, c) in rows.row(k) {
            rhs -= c * expansion.offset()[i];
            for (y, t) in expansion.matrix().row(i) {
                indices.push(place[y]?);
                coefficients.push(c * t);
            }
        }
        Some((indices, coefficients, rhs))
    };
    (0..rows.len()).map(of_row).collect()
}

/// The problem in the integers alone, with the continuous unknowns minimised out.
fn of_integers(
    model: &ReducedModel,
    relaxation: &Relaxation,
    rows: &[Row],
    factors: &mut Factors,
) -> Result<Problem> {
    let m = model.integers().len();
    let integers = model.integers().iter();
    let wanted: Vec<f64> = integers.map(|&i| relaxation.point[i as usize]).collect();
    let mut small = Problem::new(m)?;
    small.set_integers(&(0..m).collect::<Vec<_>>())?;
    small.set_constant(model.energy(&relaxation.point).0)?;
    let (r, _) = factors.schur_block(model)?;
    for k in 0..m {
        let columns: Vec<usize> = (k..m).filter(|j| r[j * m + k] != 0.0).collect();
        let row: Vec<f64> = columns.iter().map(|j| r[j * m + k]).collect();
        let rhs = columns.iter().zip(&row).map(|(&j, r)| r * wanted[j]).sum();
        if !columns.is_empty() {
            small.add_least_squares(&columns, &row, rhs, 0.5)?;
        }
    }
    for (indices, coefficients, rhs) in rows {
        small.add_constraint(indices, coefficients, *rhs)?;
    }
    Ok(small)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::solve::{Solver, solve};

    /// A ring of springs. Each third node is an integer, and a seam with an integer step connects two
    /// nodes.
    fn ring(seed: u32) -> Problem {
        let n = 24;
        let mut problem = Problem::new(n + 1).unwrap();
        for i in 0..n {
            let length = f64::from(seed * 31 + i as u32).sin() * 1.7;
            let stiffness = 1.0 + 0.3 * f64::from(i as u32).cos();
            problem
                .add_least_squares(&[(i + 1) % n, i], &[1.0, -1.0], length, stiffness)
                .unwrap();
            problem.add_least_squares(&[i], &[1.0], 0.4, 0.1).unwrap();
        }
        problem
            .add_constraint(&[4, 16, n], &[1.0, -1.0, -2.0], 0.0)
            .unwrap();
        let mut integers: Vec<usize> = (0..n).step_by(6).collect();
        integers.push(n);
        problem.set_integers(&integers).unwrap();
        problem
    }

    fn rows(of: &[(usize, usize, f64)]) -> RowList {
        let mut rows = RowList::default();
        for &(i, j, by) in of {
            rows.push("row", 25, &[i, j], &[1.0, -1.0], by).unwrap();
        }
        rows
    }

    fn lattice() -> Options {
        Options {
            strategy: Strategy::Lattice,
            ..Options::default()
        }
    }

    #[test]
    fn constraints_between_integers_are_kept_at_the_least_energy() {
        for seed in 0..12 {
            let stated = ring(seed);
            let mut solver = Solver::new(&stated).unwrap();
            let free = solver.solve(&lattice()).unwrap();
            let by = [(0, 6, 2.0), (12, 24, f64::from(seed) - 5.0)];
            let found = solver
                .solve_subject_to(&rows(&by), &lattice(), Monitor::default())
                .unwrap()
                .unwrap();
            let x = found.values();
            assert!(by.iter().all(|&(i, j, by)| x[i] - x[j] == by));
            assert_eq!(found.max_integrality_violation(), 0.0);
            assert!(found.max_constraint_violation() < 1e-12);

            let mut whole = stated.clone();
            for (i, j, by) in by {
                whole.add_constraint(&[i, j], &[1.0, -1.0], by).unwrap();
            }
            let least = solve(&whole, &Options::default()).unwrap();
            assert_eq!(least.status(), SolveStatus::Optimal);
            assert!((found.energy() - least.energy()).abs() < 1e-9 * least.energy());
            assert!(found.lower_bound().unwrap() <= least.energy());
            // The further constraints do not affect the next solve.
            assert_eq!(solver.solve(&lattice()).unwrap().values(), free.values());
        }
    }

    #[test]
    fn the_row_that_contradicts_the_others_is_named() {
        let mut solver = Solver::new(&ring(1)).unwrap();
        let contradiction = rows(&[(0, 6, 1.0), (6, 12, 1.0), (0, 12, 3.0)]);
        let error = solver.solve_subject_to(&contradiction, &lattice(), Monitor::default());
        assert!(
            matches!(error, Err(Error::Infeasible { constraint: 2, .. })),
            "{error:?}"
        );
        let fraction = rows(&[(0, 6, 0.5)]);
        let error = solver.solve_subject_to(&fraction, &lattice(), Monitor::default());
        assert!(
            matches!(error, Err(Error::NoIntegerSolution { constraint: 0, .. })),
            "{error:?}"
        );
        assert!(solver.solve(&lattice()).is_ok());
    }

    #[test]
    fn what_needs_a_solve_from_the_start_is_left_to_it() {
        let mut solver = Solver::new(&ring(1)).unwrap();
        let continuous = rows(&[(0, 1, 1.0)]);
        let found = solver.solve_subject_to(&continuous, &lattice(), Monitor::default());
        assert!(matches!(found, Ok(None)));
        let proof = solver.solve_subject_to(
            &rows(&[(0, 6, 1.0)]),
            &Options::default(),
            Monitor::default(),
        );
        assert!(matches!(proof, Ok(None)));
    }
}
