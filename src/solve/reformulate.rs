//! Reformulation of a problem with constraints between integers (`aardal2000`, sections 2 and 3).
//!
//! The elimination's expansion `x = T y + t` has integer entries for integers, but these may be large. A
//! chain of constraints with coefficients of one digit leads to entries of ten digits. The terms of the
//! objective in y then reach 1e15 and cancel, so that the bound and the solution have no correct digits.
//! The same integers are `x0 + K z` with a short basis K and a nearby x0 ([`AffineLattice`]). The problem
//! is stated again in z and the caller's continuous unknowns, from the caller's numbers. It is then solved
//! like any other problem.

use super::candidate::Candidate;
use super::eliminated::EliminatedProblem;
use super::{Counts, Seconds, Solution};
use crate::eliminate::{Elimination, ReducedModel};
use crate::error::{Error, Result};
use crate::lattice::AffineLattice;
use crate::linalg::CompensatedSum;
use crate::monitor::Monitor;
use crate::problem::{Model, Problem};
use crate::search::LARGEST_INTEGER;
use crate::search::{Factors, Options};

/// Entries up to this size are harmless: their squares leave twelve digits for the result.
const HARMLESS: f64 = 1000.0;

/// The reformulation is used if it reduces the largest entry by at least this factor.
const WORTH_IT: f64 = 16.0;

/// Larger bases are not reduced: in vectors, and in entries.
const MOST: usize = 64;
const MOST_NUMBERS: usize = 1 << 20;

/// A sum has cancelled if it is this small relative to its terms.
const CANCELLED: f64 = 64.0 * f64::EPSILON;

/// The problem in the continuous unknowns and, after these, z.
struct Reformulation {
    affine: AffineLattice,
    /// By unknown of the caller: its number among the integers or among the continuous unknowns.
    place: Vec<Place>,
    continuous: usize,
}

#[derive(Clone, Copy)]
enum Place {
    Integer(usize),
    Continuous(usize),
}

/// A constant, and coefficients with their unknowns.
struct Form {
    constant: f64,
    terms: Vec<(usize, f64)>,
}

/// Solves the reformulated problem. None if the numbers in the expansion of `reduced` are small enough, or
/// if the reformulation does not make them much smaller.
///
/// # Errors
/// The errors of a solve, except those that the reformulation may cause.
pub(super) fn solve_reformulated(
    of: &EliminatedProblem,
    reduced: &ReducedModel,
    options: &Options,
    monitor: &mut Monitor,
) -> Result<Option<Solution>> {
    let Some(short) = Reformulation::new(of.model, reduced) else {
        return Ok(None);
    };
    let problem = short.problem(of.problem, of.model.guess())?;
    let earlier = short.restrict(of.earlier);
    match solve(&problem, &earlier, options, monitor) {
        Ok(solution) => in_callers_unknowns(of, &short, solution, monitor),
        Err(Error::Unbounded { direction, .. }) => {
            let (variable, direction) = short.direction(&direction);
            Err(Error::Unbounded {
                variable,
                direction,
            })
        }
        Err(Error::NotConvex { direction, .. }) => {
            let (variable, direction) = short.direction(&direction);
            Err(Error::NotConvex {
                variable,
                direction,
            })
        }
        Err(error @ (Error::Cancelled | Error::TimeLimit | Error::OutOfMemory { .. })) => {
            Err(error)
        }
        Err(_) => Ok(None),
    }
}

/// None if some of the caller's integers are too large to be exact.
fn in_callers_unknowns(
    of: &EliminatedProblem,
    short: &Reformulation,
    found: Solution,
    monitor: &Monitor,
) -> Result<Option<Solution>> {
    let candidate = Candidate {
        values: short.expand(&found.values),
        energy: found.energy,
        lower_bound: found.lower_bound.unwrap_or(f64::NEG_INFINITY),
        status: found.status,
        complete: found.complete,
        stopped_by: found.stopped_by,
        has_integers: found.counts.reduced_integers > 0,
    };
    if candidate.values.iter().any(|x| x.abs() > LARGEST_INTEGER) {
        return Ok(None);
    }
    let (candidate, verdict) = candidate.verified(of.problem)?;
    Ok(Some(Solution {
        values: candidate.values,
        energy: verdict.energy,
        lower_bound: Some(candidate.lower_bound),
        status: candidate.status,
        complete: candidate.complete,
        stopped_by: candidate.stopped_by,
        work: found.work,
        counts: Counts {
            variables: of.model.variables(),
            integers: of.model.integer().iter().filter(|&&i| i).count(),
            constraints: of.model.constraints().rows(),
            inequalities: 0,
            ..found.counts
        },
        seconds: Seconds {
            total: monitor.seconds(),
            ..found.seconds
        },
        max_constraint_violation: verdict.constraint_violation,
        max_integrality_violation: verdict.integrality_violation,
    }))
}

fn solve(
    problem: &Problem,
    earlier: &[f64],
    options: &Options,
    monitor: &mut Monitor,
) -> Result<Solution> {
    let model = Model::new(problem)?;
    let mut eliminated = EliminatedProblem {
        problem,
        model: &model,
        elimination: &Elimination::new(&model, options.ordering, monitor)?,
        factors: &mut Factors::new(options.ordering),
        earlier,
    };
    let (reduced, clock) = eliminated.reduce(monitor)?;
    eliminated.search(reduced, &clock, options, monitor)
}

impl Reformulation {
    /// None if the numbers are small already, or if they do not become smaller.
    fn new(model: &Model, reduced: &ReducedModel) -> Option<Self> {
        let mut continuous = 0;
        let mut integers = Vec::new();
        let place = (model.integer().iter().enumerate())
            .map(|(i, &is_integer)| {
                if is_integer {
                    integers.push(i);
                    Place::Integer(integers.len() - 1)
                } else {
                    continuous += 1;
                    Place::Continuous(continuous - 1)
                }
            })
            .collect();
        let (matrix, offset) = (reduced.expansion().matrix(), reduced.expansion().offset());
        let largest = |i: &usize| {
            let row = matrix.row(*i).map(|(_, t)| t.abs());
            row.fold(offset[*i].abs(), f64::max)
        };
        let size = integers.iter().map(largest).fold(0.0, f64::max);
        let m = reduced.integers().len();
        if size <= HARMLESS || m == 0 || m > MOST || m * integers.len() > MOST_NUMBERS {
            return None;
        }
        let mut column = vec![0; reduced.dim()];
        for (k, &y) in reduced.integers().iter().enumerate() {
            column[y as usize] = k;
        }
        let mut basis = vec![vec![0.0; integers.len()]; m];
        for (at, &i) in integers.iter().enumerate() {
            for (y, t) in matrix.row(i) {
                basis[column[y]][at] = t;
            }
        }
        let of_integers = |v: &[f64]| integers.iter().map(|&i| v[i]).collect::<Vec<f64>>();
        let mut affine = AffineLattice::new(&of_integers(offset), &basis);
        affine.shorten().ok()?;
        affine.approach(&of_integers(model.guess())).ok()?;
        let short = Reformulation {
            affine,
            place,
            continuous,
        };
        (WORTH_IT * short.affine.size() <= size).then_some(short)
    }

    fn variables(&self) -> usize {
        self.continuous + self.affine.dim()
    }

    /// One of the caller's unknowns.
    fn form(&self, i: usize) -> Form {
        match self.place[i] {
            Place::Continuous(at) => Form {
                constant: 0.0,
                terms: vec![(at, 1.0)],
            },
            Place::Integer(at) => {
                let entries =
                    (0..self.affine.dim()).map(|k| (self.continuous + k, self.affine.entry(at, k)));
                Form {
                    constant: self.affine.origin(at),
                    terms: entries.filter(|e| e.1 != 0.0).collect(),
                }
            }
        }
    }

    /// One of the caller's rows: indices and coefficients of the remaining unknowns, and the right side.
    fn row(
        &self,
        row: impl Iterator<Item = (usize, f64)>,
        rhs: f64,
    ) -> (Vec<usize>, Vec<f64>, f64) {
        let mut sums = vec![Sum::default(); self.variables()];
        let mut right = Sum::default();
        right.add(rhs, 1.0);
        for (i, a) in row {
            let form = self.form(i);
            right.add(-a, form.constant);
            form.terms.iter().for_each(|&(j, v)| sums[j].add(a, v));
        }
        let left = sums
            .iter()
            .map(Sum::value)
            .enumerate()
            .filter(|e| e.1 != 0.0);
        let (indices, coefficients) = left.unzip();
        (indices, coefficients, right.value())
    }

    fn problem(&self, given: &Problem, guess: &[f64]) -> Result<Problem> {
        let mut problem = Problem::new(self.variables())?;
        self.add_quadratic(given, &mut problem)?;
        let (rows, weights) = given.least_squares();
        for (k, &weight) in weights.iter().enumerate() {
            let (indices, coefficients, rhs) = self.row(rows.row(k), rows.rhs()[k]);
            problem.add_least_squares(&indices, &coefficients, rhs, weight)?;
        }
        let rows = given.constraint_rows();
        for k in 0..rows.len() {
            let (indices, coefficients, rhs) = self.row(rows.row(k), rows.rhs()[k]);
            // The remainder of a constraint between integers holds for all z.
            if !indices.is_empty() {
                problem.add_constraint(&indices, &coefficients, rhs)?;
            }
        }
        for (place, pin) in self.place.iter().zip(given.pins().iter()) {
            if let (&Place::Continuous(at), &Some(value)) = (place, pin) {
                problem.pin(at, value)?;
            }
        }
        problem.set_integers(&(self.continuous..self.variables()).collect::<Vec<_>>())?;
        problem.set_guess(&self.restrict(guess))?;
        Ok(problem)
    }

    fn add_quadratic(&self, given: &Problem, problem: &mut Problem) -> Result<()> {
        let n = self.variables();
        let mut constant = Sum::default();
        constant.add(given.constant(), 1.0);
        let mut linear = vec![Sum::default(); n];
        for (i, &q) in given
            .linear()
            .iter()
            .enumerate()
            .filter(|(_, q)| **q != 0.0)
        {
            let form = self.form(i);
            constant.add(q, form.constant);
            form.terms.iter().for_each(|&(j, v)| linear[j].add(q, v));
        }
        let mut quadratic = std::collections::BTreeMap::<(usize, usize), Sum>::new();
        for &(i, j, v) in given.quadratic() {
            let (a, b) = (self.form(i as usize), self.form(j as usize));
            let half = if i == j { 0.5 * v } else { v };
            constant.add(half * a.constant, b.constant);
            a.terms
                .iter()
                .for_each(|&(p, u)| linear[p].add(half * u, b.constant));
            b.terms
                .iter()
                .for_each(|&(q, w)| linear[q].add(half * w, a.constant));
            for &(p, u) in &a.terms {
                for &(q, w) in &b.terms {
                    let twice = if p == q { 2.0 * half } else { half };
                    let sum = quadratic.entry((p.max(q), p.min(q))).or_default();
                    sum.add(twice * u, w);
                }
            }
        }
        let (rows, rest): (Vec<usize>, Vec<(usize, f64)>) = quadratic
            .into_iter()
            .map(|((p, q), sum)| (p, (q, sum.value())))
            .unzip();
        let (cols, values): (Vec<usize>, Vec<f64>) = rest.into_iter().unzip();
        problem.add_quadratic_triplets(crate::problem::Triangle::Lower, &rows, &cols, &values)?;
        problem.add_linear(&linear.iter().map(Sum::value).collect::<Vec<_>>())?;
        problem.add_constant(constant.value())
    }

    /// Converts the caller's unknowns to those of this problem. The integers become the nearest point in
    /// the span of the lattice.
    fn restrict(&self, x: &[f64]) -> Vec<f64> {
        let (mut all, mut integers) = (Vec::with_capacity(self.variables()), Vec::new());
        for (place, &x) in self.place.iter().zip(x) {
            match place {
                Place::Continuous(_) => all.push(x),
                Place::Integer(_) => integers.push(x),
            }
        }
        all.extend(self.affine.coordinates(&integers));
        all
    }

    /// Converts the unknowns of this problem to the caller's.
    fn expand(&self, y: &[f64]) -> Vec<f64> {
        self.caller(y, &self.affine.point(&y[self.continuous..]))
    }

    /// Converts a direction to the caller's unknowns and scales it to a largest entry of one. Returns the
    /// place of that entry as well.
    fn direction(&self, v: &[f64]) -> (usize, Vec<f64>) {
        let mut v = self.caller(v, &self.affine.direction(&v[self.continuous..]));
        let at = (0..v.len()).fold(0, |at, i| if v[i].abs() > v[at].abs() { i } else { at });
        let largest = v[at].abs();
        if largest > 0.0 {
            v.iter_mut().for_each(|v| *v /= largest);
        }
        (at, v)
    }

    fn caller(&self, y: &[f64], integers: &[f64]) -> Vec<f64> {
        let value = |place: &Place| match *place {
            Place::Continuous(at) => y[at],
            Place::Integer(at) => integers[at],
        };
        self.place.iter().map(value).collect()
    }
}

/// The bound below which a sum is zero after its terms have cancelled.
#[derive(Clone, Copy)]
struct Sum {
    sum: CompensatedSum,
    size: f64,
}

impl Default for Sum {
    fn default() -> Self {
        Sum {
            sum: CompensatedSum::new(0.0),
            size: 0.0,
        }
    }
}

impl Sum {
    fn add(&mut self, a: f64, b: f64) {
        self.sum.add_product(a, b);
        self.size += (a * b).abs();
    }

    fn value(&self) -> f64 {
        let value = self.sum.value();
        if value.abs() <= CANCELLED * self.size {
            0.0
        } else {
            value
        }
    }
}
