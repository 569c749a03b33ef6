//! Random small problems whose optimum can be found by enumeration.
//!
//! An instance has least-squares rows with integer coefficients in a few *core* integers `y` and
//! continuous unknowns. The solver sees `y = P z` with a random unimodular P, which hides the core. Core
//! coordinates without a row make the problem semi-definite, pinned ones give constraints, and shears make
//! it ill-conditioned.

use super::checker::Exact;
use super::common::Random;
use roundel::{Problem, Result};

/// Right sides are integer multiples of 1/8.
pub const PARTS: i64 = 8;

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    Definite,
    IllConditioned,
    SemiDefinite,
    Constrained,
    EqualOptima,
}

#[derive(Debug)]
pub struct Instance {
    /// The number of core integers that have rows; they come first.
    pub core: usize,
    pub continuous: usize,
    /// The values of the core integers without rows; `None` where the value is free.
    pub pinned: Vec<Option<i64>>,
    /// Coefficients of the core integers with rows, then of the continuous unknowns.
    pub rows: Vec<Vec<i64>>,
    /// Right sides in units of `1 / PARTS`.
    pub rhs: Vec<i64>,
    /// The rows of P.
    shear: Vec<Vec<i64>>,
}

impl Instance {
    pub fn random(kind: Kind, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut below = |n: i64| ((random.next() + 1.0) / 2.0 * n as f64) as i64;
        let core = 1 + below(5) as usize;
        let continuous = below(3) as usize;
        let pinned: Vec<Option<i64>> = match kind {
            Kind::SemiDefinite => (0..=below(4)).map(|_| None).collect(),
            Kind::Constrained => (0..=below(2)).map(|_| Some(below(7) - 3)).collect(),
            _ => Vec::new(),
        };
        let mut rows = Vec::new();
        let mut rhs = Vec::new();
        if kind == Kind::EqualOptima {
            // Each core integer has a row of its own, with a half as right side.
            for i in 0..core {
                let mut row = vec![0; core + continuous];
                row[i] = 2 + below(3);
                rhs.push(row[i] * PARTS / 2 * (2 * below(4) + 1));
                rows.push(row);
            }
            for i in 0..continuous {
                let mut row = vec![0; core + continuous];
                row[core + i] = 1 + below(3);
                rhs.push(below(80) - 40);
                rows.push(row);
            }
        } else {
            for k in 0..core + continuous + 1 + below(3) as usize {
                let own = k % (core + continuous);
                let scale = match kind {
                    Kind::IllConditioned => 10i64.pow(below(4) as u32),
                    _ => 1,
                };
                let mut row: Vec<i64> = (0..core + continuous).map(|_| below(5) - 2).collect();
                row[own] += 3;
                rhs.push(scale * (below(160) - 80));
                rows.push(row.into_iter().map(|v| scale * v).collect());
            }
        }
        let integers = core + pinned.len();
        let mut shear: Vec<Vec<i64>> = (0..integers)
            .map(|i| (0..integers).map(|j| i64::from(i == j)).collect())
            .collect();
        let steps = if kind == Kind::IllConditioned { 4 } else { 2 };
        for _ in 0..steps * integers {
            let (i, j) = (
                below(integers as i64) as usize,
                below(integers as i64) as usize,
            );
            let q = below(5) - 2;
            if i != j {
                let from = shear[j].clone();
                shear[i].iter_mut().zip(from).for_each(|(a, f)| *a += q * f);
            }
        }
        Instance {
            core,
            continuous,
            pinned,
            rows,
            rhs,
            shear,
        }
    }

    /// The problem as the solver sees it: the integers z, then the continuous unknowns.
    pub fn problem(&self) -> Result<Problem> {
        let integers = self.shear.len();
        let mut problem = Problem::new(integers + self.continuous)?;
        problem.set_integers(&(0..integers).collect::<Vec<_>>())?;
        for (row, &rhs) in self.rows.iter().zip(&self.rhs) {
            let mut seen = vec![0i64; integers + self.continuous];
            for (&a, p) in row[..self.core].iter().zip(&self.shear) {
                seen.iter_mut().zip(p).for_each(|(s, p)| *s += a * p);
            }
            seen[integers..].copy_from_slice(&row[self.core..]);
            let (indices, values) = sparse(&seen);
            problem.add_least_squares(&indices, &values, rhs as f64 / PARTS as f64, 1.0)?;
        }
        for (pin, row) in self.pinned.iter().zip(&self.shear[self.core..]) {
            if let Some(value) = pin {
                let (indices, values) = sparse(row);
                problem.add_constraint(&indices, &values, *value as f64)?;
            }
        }
        Ok(problem)
    }

    /// The exact least energy for the integers of `values`, which must be integral and satisfy the
    /// constraints.
    pub fn energy_at(&self, values: &[f64]) -> Exact {
        let integers = self.shear.len();
        let z: Vec<i64> = values[..integers].iter().map(|v| *v as i64).collect();
        assert!(z.iter().zip(values).all(|(&z, &v)| z as f64 == v));
        let dot = |p: &Vec<i64>| p.iter().zip(&z).map(|(p, z)| p * z).sum::<i64>();
        let y: Vec<i64> = self.shear.iter().map(dot).collect();
        let pins = self.pinned.iter().zip(&y[self.core..]);
        assert!(pins.clone().all(|(pin, y)| pin.is_none_or(|p| p == *y)));
        Exact::least(self, &y[..self.core])
    }
}

fn sparse(row: &[i64]) -> (Vec<usize>, Vec<f64>) {
    let entries = row.iter().enumerate().filter(|&(_, &v)| v != 0);
    entries.map(|(i, &v)| (i, v as f64)).unzip()
}
