//! A small problem in the caller's numbers, which are small multiples of powers of two, so that sums of a few
//! products are exact in floats.

use super::random::Random;
use super::rational::{Quadratic, exact};
use roundel::{Conflicting, Problem, Triangle};

pub const NONE: f64 = f64::INFINITY;

/// `lower <= row . x <= upper`; an equality constraint if `is_constraint`.
#[derive(Clone, Debug)]
pub struct Row {
    pub coefficients: Vec<f64>,
    pub lower: f64,
    pub upper: f64,
    pub is_constraint: bool,
}

#[derive(Clone, Debug)]
pub struct Instance {
    pub integer: Vec<bool>,
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    pub pins: Vec<Option<f64>>,
    /// Least-squares rows: coefficients, right side, weight.
    pub squares: Vec<(Vec<f64>, f64, f64)>,
    /// What is added to Q, as a full matrix.
    pub hessian: Vec<Vec<f64>>,
    pub linear: Vec<f64>,
    pub constant: f64,
    pub rows: Vec<Row>,
    /// An instance that the oracle decides, with the same truth. Its rows are the first of these.
    pub origin: Option<Box<Instance>>,
}

impl Instance {
    pub fn unknowns(&self) -> usize {
        self.linear.len()
    }

    /// The bounds of an unknown, with its pin.
    pub fn limits(&self, j: usize) -> (f64, f64) {
        match self.pins[j] {
            Some(v) => (v.max(self.lower[j]), v.min(self.upper[j])),
            None => (self.lower[j], self.upper[j]),
        }
    }

    pub fn problem(&self) -> Problem {
        let n = self.unknowns();
        let all: Vec<usize> = (0..n).collect();
        let mut problem = Problem::new(n).unwrap();
        for (row, rhs, weight) in &self.squares {
            problem.add_least_squares(&all, row, *rhs, *weight).unwrap();
        }
        for i in 0..n {
            for j in (0..=i).filter(|&j| self.hessian[i][j] != 0.0) {
                let value = [self.hessian[i][j]];
                problem
                    .add_quadratic_triplets(Triangle::Lower, &[i], &[j], &value)
                    .unwrap();
            }
        }
        problem.add_linear(&self.linear).unwrap();
        problem.add_constant(self.constant).unwrap();
        for row in &self.rows {
            if row.is_constraint {
                problem
                    .add_constraint(&all, &row.coefficients, row.lower)
                    .unwrap();
            } else {
                problem
                    .add_inequality(&all, &row.coefficients, row.lower, row.upper)
                    .unwrap();
            }
        }
        problem.set_bounds(&all, &self.lower, &self.upper).unwrap();
        for (j, pin) in self.pins.iter().enumerate() {
            if let Some(value) = pin {
                problem.pin(j, *value).unwrap();
            }
        }
        let integers: Vec<usize> = all.into_iter().filter(|&j| self.integer[j]).collect();
        problem.set_integers(&integers).unwrap();
        problem
    }

    pub fn objective(&self) -> Quadratic {
        let n = self.unknowns();
        let mut sum = Quadratic::zero(n);
        for i in 0..n {
            for j in 0..n {
                sum.hessian[i][j] = exact(self.hessian[i][j]);
            }
            sum.gradient[i] = exact(self.linear[i]);
        }
        sum.constant = exact(self.constant);
        for (row, rhs, weight) in &self.squares {
            let row: Vec<_> = row.iter().map(|&a| exact(a)).collect();
            sum.add_square(&row, &exact(*rhs), &exact(*weight));
        }
        sum
    }

    /// Q and q in floats. No sum is rounded.
    pub fn summed(&self) -> (Vec<Vec<f64>>, Vec<f64>) {
        let n = self.unknowns();
        let (mut hessian, mut gradient) = (self.hessian.clone(), self.linear.clone());
        for (row, rhs, weight) in &self.squares {
            for i in 0..n {
                for j in 0..n {
                    hessian[i][j] += 2.0 * weight * row[i] * row[j];
                }
                gradient[i] -= 2.0 * weight * row[i] * rhs;
            }
        }
        (hessian, gradient)
    }

    /// The sizes of the terms of the energy at a point.
    pub fn energy_size(&self, x: &[f64]) -> f64 {
        let n = self.unknowns();
        let mut size = self.constant.abs();
        for (row, rhs, weight) in &self.squares {
            let terms = row.iter().zip(x).map(|(a, x)| (a * x).abs());
            size += weight * (terms.sum::<f64>() + rhs.abs()).powi(2);
        }
        for i in 0..n {
            let row = self.hessian[i].iter().zip(x);
            size += row.map(|(h, y)| (h * x[i] * y).abs()).sum::<f64>();
            size += (self.linear[i] * x[i]).abs();
        }
        size
    }

    /// The same instance with only these rows and bounds, and no objective.
    pub fn only(&self, elements: &[Conflicting]) -> Instance {
        let n = self.unknowns();
        let mut kept = Instance {
            lower: vec![-NONE; n],
            upper: vec![NONE; n],
            pins: vec![None; n],
            rows: Vec::new(),
            squares: Vec::new(),
            hessian: vec![vec![0.0; n]; n],
            linear: vec![0.0; n],
            origin: self.origin_of(elements),
            ..self.clone()
        };
        let of_kind = |is_constraint: bool, k: usize| {
            let mut rows = self.rows.iter();
            let mut rows = rows.by_ref().filter(|r| r.is_constraint == is_constraint);
            rows.nth(k).cloned()
        };
        for element in elements {
            match *element {
                Conflicting::Constraint(k) => kept.rows.extend(of_kind(true, k)),
                Conflicting::Inequality(k) => kept.rows.extend(of_kind(false, k)),
                Conflicting::Bounds(j) if j >= n => {}
                Conflicting::Bounds(j) => {
                    kept.lower[j] = self.lower[j];
                    kept.upper[j] = self.upper[j];
                    kept.pins[j] = self.pins[j];
                }
            }
        }
        kept
    }

    /// The origin with only these, if it has all constraints.
    fn origin_of(&self, elements: &[Conflicting]) -> Option<Box<Instance>> {
        let constraints = |of: &Instance| of.rows.iter().filter(|row| row.is_constraint).count();
        let origin = self.origin.as_ref()?;
        (constraints(origin) == constraints(self)).then(|| Box::new(origin.only(elements)))
    }

    /// The same problem with its unknowns and rows in other orders, rows and the objective multiplied by
    /// powers of two. Also returns the factor of the objective.
    pub fn disguised(&self, random: &mut Random) -> (Instance, f64) {
        let n = self.unknowns();
        let order = shuffled(random, n);
        let power = |random: &mut Random| 2f64.powi(random.below(13) as i32 - 6);
        let factor = power(random);
        let pick = |v: &[f64], by: f64| order.iter().map(|&j| by * v[j]).collect::<Vec<f64>>();
        let rows = shuffled(random, self.rows.len());
        let rows = rows.iter().map(|&k| {
            let (row, by) = (&self.rows[k], power(random));
            Row {
                coefficients: pick(&row.coefficients, by),
                lower: by * row.lower,
                upper: by * row.upper,
                is_constraint: row.is_constraint,
            }
        });
        let rows = rows.collect();
        let squares = self.squares.iter();
        let squares = squares.map(|(row, rhs, weight)| (pick(row, 1.0), *rhs, factor * weight));
        let disguised = Instance {
            integer: order.iter().map(|&j| self.integer[j]).collect(),
            lower: pick(&self.lower, 1.0),
            upper: pick(&self.upper, 1.0),
            pins: order.iter().map(|&j| self.pins[j]).collect(),
            squares: squares.collect(),
            hessian: order
                .iter()
                .map(|&j| pick(&self.hessian[j], factor))
                .collect(),
            linear: pick(&self.linear, factor),
            constant: factor * self.constant,
            rows,
            origin: None,
        };
        (disguised, factor)
    }
}

fn shuffled(random: &mut Random, n: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for k in (1..n).rev() {
        order.swap(k, random.below(k + 1));
    }
    order
}
