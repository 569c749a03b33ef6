//! Solves under inequalities between integers that hold where they can, with the existing elimination and factors.
//!
//! The minimum of the objective over the continuous unknowns is `E* + 1/2 |R (z - z*)|^2` in the reduced
//! integers z. Here `R` is the factor of their Schur complement, and `z*` and `E*` are the integers and the
//! energy of the relaxation. Rows between integers alone are rows in z, so that the problem in z is small and
//! dense:
//!
//! ```text
//! minimise    1/2 |R (z - z*)|^2 + 1/2 sum_k w_k s_k^2
//! subject to  a_k . z + s_k >= l_k,   s_k >= 0,   z integer
//! ```
//!
//! The slacks `s_k` leave every integer point feasible, so that rows which contradict each other need no
//! search for those at fault. The search starts at the lattice point for which the rows are springs of rest
//! length `l_k`, and goes on by branch and bound in a reduced basis, where each unknown has an influence of
//! its own. Many integers start at the nearest ones to `z*` instead, and move by one, alone and in cascades
//! ([`super::cascades`]).

use std::collections::BTreeSet;

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, MatMut, MatRef, Par};

use super::Solution;
use super::cascades;
use super::eliminated::{EliminatedProblem, SearchResult, sizes};
use super::expand::clean;
use super::relax::{Relaxation, relax};
use super::run::solve_eliminated;
use crate::branch;
use crate::eliminate::{Elimination, ReducedModel};
use crate::error::Result;
use crate::lattice::{Basis, lll};
use crate::linalg::with_wide_registers;
use crate::monitor::Monitor;
use crate::problem::{Model, Problem};
use crate::search::{Factors, Options, Search, SolveStatus, Strategy, of_relaxation};

/// The most integers for which the problem in them is solved as a dense one.
const DENSE: usize = 2000;

/// The most integers for which branch and bound is tried.
const SEARCHED: usize = 600;

/// The nodes of branch and bound.
const NODES: u64 = 200;

/// The multiplications of branch and bound.
const WORK: u64 = 2_000_000_000;

/// Smaller sums of coefficients are rounding errors of zero.
const NOTHING: f64 = 1e-9;

/// Whether a problem has too many integers for branch and bound under soft rows: then rows cost little.
pub(crate) fn has_many_integers(solution: &Solution) -> bool {
    solution.counts().reduced_integers > SEARCHED
}

/// `a . x >= least` for unknowns that integers decide. A point that misses it by `s` costs
/// `weight / 2 s^2`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SoftRow {
    /// Unknowns and coefficients. An unknown may occur several times.
    pub terms: Vec<(usize, f64)>,
    pub least: f64,
    pub weight: f64,
}

impl SoftRow {
    /// Whether a point misses the row. The row's value is a whole number but for rounding errors.
    pub fn is_missed(&self, values: &[f64]) -> bool {
        self.missed_by(values) > 0.5
    }

    /// By how much a point misses the row.
    fn missed_by(&self, values: &[f64]) -> f64 {
        (self.least - self.value(values)).max(0.0)
    }

    /// The left side at a point.
    pub(super) fn value(&self, values: &[f64]) -> f64 {
        self.terms.iter().map(|&(i, c)| c * values[i]).sum()
    }
}

/// Solves under further rows between integers. None if there are too many integers. Rows with other unknowns,
/// and those that no unknown changes, are left out.
///
/// The bound is that of the relaxation without the rows.
///
/// # Errors
/// As [`solve`](crate::solve()).
pub(super) fn solve_softly(
    mut of: EliminatedProblem,
    rows: &[SoftRow],
    options: &Options,
    monitor: &mut Monitor,
) -> Result<Option<Solution>> {
    let (reduced, clock) = of.reduce(monitor)?;
    let m = reduced.integers().len();
    if m > DENSE {
        return Ok(None);
    }
    let rows = between_integers(&reduced, rows);
    let relaxed = || relax(of.model, &reduced, Strategy::Lattice, of.factors);
    let relaxation = monitor.watching(relaxed)?;
    let integers = reduced.integers().iter();
    let wanted: Vec<f64> = integers.map(|&i| relaxation.point[i as usize]).collect();
    let factor = of.factors.schur_block(&reduced)?;
    let dense = Dense {
        rows: &rows,
        wanted: &wanted,
        factor,
    };
    let options = Options {
        strategy: Strategy::Lattice,
        ..options.clone()
    };
    let (decided, work) = match m <= SEARCHED {
        true => dense.searched(&options, &mut monitor.silent())?,
        false => {
            let nearest = wanted.iter().map(|x| x.round()).collect();
            cascades::descend(
                &rows,
                &dense.gram(),
                &wanted,
                nearest,
                &mut monitor.silent(),
            )
        }
    };
    let Relaxation {
        point, lower_bound, ..
    } = relaxation;
    let mut search = Search::new(&reduced, point, lower_bound, monitor);
    search.offer(of.factors, &decided)?;
    let stopped_by = search.stopped_by();
    let best = search.into_best()?;
    let mut values = reduced.expansion().expand(&best.point);
    clean(&mut values, of.model, options.strategy);
    let decided = SearchResult {
        energy: best.energy,
        lower_bound,
        status: SolveStatus::unproved(stopped_by),
        complete: false,
        stopped_by,
        work: of_relaxation(&reduced) + work,
        values,
    };
    of.conclude(sizes(&reduced), decided, &clock, monitor)
        .map(Some)
}

/// Converts rows in the caller's unknowns to rows in the reduced integers, each row once.
fn between_integers(model: &ReducedModel, rows: &[SoftRow]) -> Vec<SoftRow> {
    let mut place = vec![None; model.dim()];
    for (k, &i) in model.integers().iter().enumerate() {
        place[i as usize] = Some(k);
    }
    let expansion = model.expansion();
    let mut sums = vec![0.0; model.dim()];
    let mut known = BTreeSet::new();
    let mut found = Vec::new();
    for row in rows {
        let mut least = row.least;
        let mut touched = Vec::new();
        for &(i, c) in &row.terms {
            least -= c * expansion.offset()[i];
            for (y, t) in expansion.matrix().row(i) {
                sums[y] += c * t;
                touched.push(y);
            }
        }
        touched.sort_unstable();
        touched.dedup();
        let terms = touched
            .iter()
            .map(|&y| (place[y], std::mem::take(&mut sums[y])));
        let terms: Option<Vec<(usize, f64)>> = terms
            .filter(|(_, c)| c.abs() > NOTHING)
            .map(|(place, c)| Some((place?, c)))
            .collect();
        let Some(terms) = terms.filter(|terms| !terms.is_empty()) else {
            continue;
        };
        let bits = |&(k, c): &(usize, f64)| (k, c.to_bits());
        if known.insert((terms.iter().map(bits).collect::<Vec<_>>(), least.to_bits())) {
            found.push(SoftRow {
                terms,
                least,
                ..*row
            });
        }
    }
    found
}

/// The problem in the integers alone.
struct Dense<'a> {
    rows: &'a [SoftRow],
    /// The integers of the relaxation.
    wanted: &'a [f64],
    /// `R` by columns, and whether no pivot is zero.
    factor: (&'a [f64], bool),
}

impl Dense<'_> {
    /// `G = R'R` by columns.
    fn gram(&self) -> Vec<f64> {
        let m = self.wanted.len();
        let factor = MatRef::from_column_major_slice(self.factor.0, m, m);
        let mut gram = vec![0.0; m * m];
        let product = MatMut::from_column_major_slice_mut(&mut gram, m, m);
        with_wide_registers(|| {
            let (whole, lower, upper) = (
                BlockStructure::Rectangular,
                BlockStructure::TriangularLower,
                BlockStructure::TriangularUpper,
            );
            let (left, right) = (factor.transpose(), factor);
            let (to, how) = (Accum::Replace, Par::Seq);
            matmul(product, whole, to, left, lower, right, upper, 1.0, how);
        });
        gram
    }

    /// The best point that branch and bound finds, and the work.
    fn searched(&self, options: &Options, monitor: &mut Monitor) -> Result<(Vec<f64>, u64)> {
        let (start, work) = self.start(options, monitor)?;
        let (better, searched) = self.better(start, monitor)?;
        Ok((better, work + searched))
    }

    /// The lattice point for which all rows are springs, and the work.
    fn start(&self, options: &Options, monitor: &mut Monitor) -> Result<(Vec<f64>, u64)> {
        let m = self.wanted.len();
        let r = self.factor.0;
        let mut small = Problem::new(m)?;
        small.set_integers(&(0..m).collect::<Vec<_>>())?;
        add_distance(&mut small, self.wanted, |k, j| r[j * m + k])?;
        for row in self.rows {
            let (indices, coefficients): (Vec<_>, Vec<_>) = row.terms.iter().copied().unzip();
            small.add_least_squares(&indices, &coefficients, row.least, 0.5 * row.weight)?;
        }
        let model = Model::new(&small)?;
        let eliminated = EliminatedProblem {
            problem: &small,
            model: &model,
            elimination: &Elimination::new(&model, options.ordering, monitor)?,
            factors: &mut Factors::new(options.ordering),
            earlier: model.guess(),
        };
        let decided = solve_eliminated(eliminated, options, monitor)?;
        Ok((decided.values().to_vec(), decided.work()))
    }

    /// The best point that branch and bound finds from this one, and the work.
    fn better(&self, start: Vec<f64>, monitor: &mut Monitor) -> Result<(Vec<f64>, u64)> {
        let m = self.wanted.len();
        let (factor, full) = self.factor;
        let mut basis = Basis::from_factor(m, factor.to_vec(), full);
        lll(&mut basis, 1, &mut |_| monitor.ends())?;
        if basis.rank() < m {
            return Ok((start, 0));
        }
        let mut small = Problem::new(m + self.rows.len())?;
        small.set_integers(&(0..m).collect::<Vec<_>>())?;
        add_distance(&mut small, &basis.coordinates(self.wanted), |k, j| {
            basis.r(k, j)
        })?;
        let columns: Vec<Vec<f64>> = (0..m).map(|j| basis.transform().column(j)).collect();
        for (k, row) in self.rows.iter().enumerate() {
            let slack = m + k;
            let entry = |j: usize| {
                row.terms
                    .iter()
                    .map(|&(i, c)| c * columns[j][i])
                    .sum::<f64>()
            };
            let (mut indices, mut coefficients): (Vec<usize>, Vec<f64>) = (0..m)
                .map(|j| (j, entry(j)))
                .filter(|(_, c)| *c != 0.0)
                .unzip();
            indices.push(slack);
            coefficients.push(1.0);
            small.add_inequality(&indices, &coefficients, row.least, f64::INFINITY)?;
            small.set_bounds(&[slack], &[0.0], &[f64::INFINITY])?;
            small.add_least_squares(&[slack], &[1.0], 0.0, 0.5 * row.weight)?;
        }
        let mut from = basis.coordinates(&start);
        from.extend(self.rows.iter().map(|row| row.missed_by(&start)));
        let found = branch::around(&small, from, NODES, WORK, monitor)?;
        let Some(y) = found.0 else {
            return Ok((start, found.1));
        };
        let mut z = vec![0.0; m];
        for (column, y) in columns.iter().zip(&y) {
            let y = y.round();
            z.iter_mut().zip(column).for_each(|(z, u)| *z += u * y);
        }
        Ok((z, found.1))
    }
}

/// Adds `1/2 |R (z - wanted)|^2` for the upper triangular matrix with these entries.
fn add_distance(
    problem: &mut Problem,
    wanted: &[f64],
    entry: impl Fn(usize, usize) -> f64,
) -> Result<()> {
    let m = wanted.len();
    for k in 0..m {
        let columns: Vec<usize> = (k..m).filter(|&j| entry(k, j) != 0.0).collect();
        let row: Vec<f64> = columns.iter().map(|&j| entry(k, j)).collect();
        let rhs = columns.iter().zip(&row).map(|(&j, r)| r * wanted[j]).sum();
        if !columns.is_empty() {
            problem.add_least_squares(&columns, &row, rhs, 0.5)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
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

    /// `x_i - x_j >= least` as a soft row.
    fn row((i, j, least): (usize, usize, f64)) -> SoftRow {
        let terms = vec![(i, 1.0), (j, -1.0)];
        let weight = 1e3;
        SoftRow {
            terms,
            least,
            weight,
        }
    }

    fn softly(solver: &mut Solver, rows: &[(usize, usize, f64)]) -> Solution {
        let rows: Vec<SoftRow> = rows.iter().copied().map(row).collect();
        let monitor = Monitor::default();
        solver
            .solve_softly(&rows, &Options::default(), monitor)
            .unwrap()
    }

    #[test]
    fn rows_that_can_be_kept_are_kept_at_the_least_energy() {
        for seed in 0..12 {
            let stated = ring(seed);
            let mut solver = Solver::new(&stated).unwrap();
            let free = solver.solve(&Options::default()).unwrap();
            let by = [(0, 6, 2.0), (12, 24, f64::from(seed) - 5.0), (18, 12, 0.0)];
            let found = softly(&mut solver, &by);
            let x = found.values();
            assert!(by.iter().all(|&(i, j, by)| x[i] - x[j] >= by));
            assert_eq!(found.max_integrality_violation(), 0.0);
            assert!(found.max_constraint_violation() < 1e-12);
            assert_eq!(found.status(), SolveStatus::Feasible);

            let mut whole = stated.clone();
            for (i, j, by) in by {
                whole
                    .add_inequality(&[i, j], &[1.0, -1.0], by, f64::INFINITY)
                    .unwrap();
            }
            let least = solve(&whole, &Options::default()).unwrap();
            assert_eq!(least.status(), SolveStatus::Optimal);
            assert!((found.energy() - least.energy()).abs() < 1e-9 * least.energy());
            assert!(found.lower_bound().unwrap() <= free.energy());
            // The rows do not affect the next solve.
            let again = solver.solve(&Options::default()).unwrap();
            assert_eq!(again.values(), free.values());
        }
    }

    #[test]
    fn rows_that_contradict_each_other_share_what_is_missed() {
        let mut solver = Solver::new(&ring(1)).unwrap();
        let x = softly(&mut solver, &[(0, 6, 2.0), (6, 0, 2.0)]);
        // Each is missed by two: the squares of what is missed are least there.
        assert_eq!(x.values()[0], x.values()[6]);
    }

    #[test]
    fn rows_that_integers_do_not_decide_are_left_out() {
        let mut solver = Solver::new(&ring(1)).unwrap();
        let free = softly(&mut solver, &[]);
        let found = softly(&mut solver, &[(0, 1, 100.0), (6, 6, 1.0)]);
        assert_eq!(found.values(), free.values());
    }

    #[test]
    fn springs_do_where_there_are_many_integers() {
        for seed in 0..12 {
            let mut solver = Solver::new(&ring(seed)).unwrap();
            let dense = softly(&mut solver, &[(0, 6, 3.0)]);
            let monitor = Monitor::default();
            let rows = [row((0, 6, 3.0))];
            let sparse = solver
                .solve_with_springs(&rows, &Options::default(), monitor)
                .unwrap();
            let x = sparse.values();
            assert_eq!(x[0] - x[6], 3.0);
            assert!(dense.energy() <= sparse.energy() * (1.0 + 1e-12));
            assert!(sparse.lower_bound().unwrap() <= dense.energy());
        }
    }
}
