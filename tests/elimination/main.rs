//! Elimination of the equality constraints: the unknowns it keeps, the errors it reports and how it scales.

#[path = "../common/mod.rs"]
mod common;

mod brute_force;
#[cfg(feature = "gzip")]
mod corpus;
mod exact;
mod known;
mod large;
mod largest;
mod properties;

use roundel::internals::eliminate::{ReducedModel, eliminate};
use roundel::{Model, Monitor, Problem, Result};

/// A system of equations with integer coefficients. The integer unknowns come first.
#[derive(Debug, Clone)]
struct System {
    integers: usize,
    continuous: usize,
    rows: Vec<Vec<i64>>,
    rhs: Vec<i64>,
}

impl System {
    fn unknowns(&self) -> usize {
        self.integers + self.continuous
    }

    fn problem(&self) -> Result<Problem> {
        let mut problem = Problem::new(self.unknowns())?;
        problem.set_integers(&(0..self.integers).collect::<Vec<_>>())?;
        for (row, &rhs) in self.rows.iter().zip(&self.rhs) {
            add_row(&mut problem, row, rhs, 1.0)?;
        }
        Ok(problem)
    }

    fn reduce(&self) -> Result<ReducedModel> {
        reduce(&self.problem()?)
    }
}

fn add_row(problem: &mut Problem, row: &[i64], rhs: i64, factor: f64) -> Result<usize> {
    let indices: Vec<usize> = (0..row.len()).filter(|&j| row[j] != 0).collect();
    let coefficients: Vec<f64> = indices.iter().map(|&j| factor * row[j] as f64).collect();
    problem.add_constraint(&indices, &coefficients, factor * rhs as f64)
}

fn reduce(problem: &Problem) -> Result<ReducedModel> {
    eliminate(&Model::new(problem)?, &mut Monitor::default())
}

/// The largest violation of the constraints at `x`, relative to their terms.
fn violation(model: &Model, x: &[f64]) -> f64 {
    let rows = 0..model.constraints().rows();
    rows.map(|r| {
        let (mut sum, mut size) = (-model.constraint_rhs()[r], 1.0);
        for (j, v) in model.constraints().row(r) {
            sum += v * x[j];
            size += (v * x[j]).abs();
        }
        sum.abs() / size
    })
    .fold(0.0, f64::max)
}

/// Every integer point with coordinates from -`radius` to `radius`.
fn box_points(dim: usize, radius: i64) -> impl Iterator<Item = Vec<i64>> {
    let side = 2 * radius + 1;
    (0..side.pow(dim as u32)).map(move |mut code| {
        let mut digit = || {
            let d = code % side - radius;
            code /= side;
            d
        };
        (0..dim).map(|_| digit()).collect()
    })
}
