//! A problem in the form that branch and bound reads: one list of two-sided rows, and bounds.

use super::dual_active_set::FEASIBLE;
use crate::error::{Conflicting, Error, Result};
use crate::linalg::Sparse;
use crate::problem::{Model, Problem};

/// The most by which an integer is outside of an interval that counts as within.
const MOST: f64 = 1e-6;

/// All numbers from `lower` to `upper`. A side that does not limit is infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Interval {
    pub lower: f64,
    pub upper: f64,
}

impl Interval {
    pub const ALL: Interval = Interval {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };

    pub fn point(value: f64) -> Self {
        Interval {
            lower: value,
            upper: value,
        }
    }

    /// What is in both.
    pub fn and(self, other: Interval) -> Self {
        Interval {
            lower: self.lower.max(other.lower),
            upper: self.upper.min(other.upper),
        }
    }

    /// The integers within, as the interval from the least to the largest. Those outside by no more than what is
    /// feasible for rows are within: sides are often an integer but for rounding errors, as `1.1 * 900` is.
    pub fn of_integers(self) -> Self {
        let room = |side: f64| (FEASIBLE * side.abs().max(1.0)).min(MOST);
        Interval {
            lower: (self.lower - room(self.lower)).ceil(),
            upper: (self.upper + room(self.upper)).floor(),
        }
    }

    /// The multiples of a positive number within, as the interval from the least to the largest.
    pub fn of_multiples(self, divisor: f64) -> Self {
        let quotients = Interval {
            lower: self.lower / divisor,
            upper: self.upper / divisor,
        };
        let quotients = quotients.of_integers();
        Interval {
            lower: quotients.lower * divisor,
            upper: quotients.upper * divisor,
        }
    }

    /// The integers on one side of `value`: those above it where `x` is above it, else those below. Where `value` is an
    /// end, those on the other side.
    pub fn without(self, value: f64, x: f64) -> Self {
        match x > value && value < self.upper || value <= self.lower {
            true => Interval {
                lower: value + 1.0,
                ..self
            },
            false => Interval {
                upper: value - 1.0,
                ..self
            },
        }
    }

    pub fn is_point(self) -> bool {
        self.lower == self.upper
    }

    pub fn is_empty(self) -> bool {
        self.lower > self.upper
    }

    /// The side that the sign of a multiplier belongs to: a positive multiplier holds the upper side.
    pub fn side(self, multiplier: f64) -> f64 {
        if multiplier > 0.0 {
            self.upper
        } else {
            self.lower
        }
    }

    pub fn nearest(self, value: f64) -> f64 {
        value.max(self.lower).min(self.upper)
    }

    pub fn width(self) -> f64 {
        self.upper - self.lower
    }
}

/// A row `sum_j a_j x_j >= side`.
pub(super) type AtLeast = (Vec<(u32, f64)>, f64);

/// `minimise 1/2 x'Qx + q'x + c` over `x` within `limits`, `Ax` within `row_limits`, some unknowns integer.
#[derive(Debug, Clone)]
pub(super) struct Form {
    /// Lower triangle of Q.
    pub hessian: Sparse,
    /// q.
    pub gradient: Vec<f64>,
    /// c.
    pub constant: f64,
    /// A.
    pub rows: Sparse,
    pub row_limits: Vec<Interval>,
    /// What the caller calls each row.
    pub origins: Vec<Conflicting>,
    pub limits: Vec<Interval>,
    /// What `limits` and the rows imply for each unknown. Only bounds on the energy use it.
    pub boxes: Vec<Interval>,
    pub integer: Vec<bool>,
}

impl Form {
    /// The form of a problem. Pins become bounds.
    ///
    /// # Errors
    /// [`Error::Overflow`] where sums overflow, [`Error::OutOfMemory`].
    pub fn of(problem: &Problem, model: &Model) -> Result<Self> {
        let n = model.variables();
        let inequalities = problem.inequality_rows();
        let two_sided = inequalities.to_sparse(n)?;
        if let Some((i, j, _)) = two_sided.entries().find(|(_, _, v)| !v.is_finite()) {
            return Err(Error::Overflow {
                what: format!("inequality {i}: the sum of coefficients of variable {j} overflows"),
                index: Some(i as usize),
            });
        }
        let equalities = model.constraints().clone();
        let [first, second] = [equalities.rows(), two_sided.rows()];
        let rhs = model.constraint_rhs().iter();
        let sides = inequalities.lower().iter().zip(inequalities.upper());
        let sides = sides.map(|(&lower, &upper)| Interval { lower, upper });
        let limits = (0..n).map(|j| {
            let (lower, upper) = problem.limits_of(j);
            let limits = Interval { lower, upper };
            model.pinned()[j].map_or(limits, |pin| limits.and(Interval::point(pin)))
        });
        let limits: Vec<Interval> = limits.collect();
        Ok(Form {
            hessian: without_zeros(model.hessian())?,
            gradient: model.gradient().to_vec(),
            constant: model.constant(),
            rows: without_zeros(&Sparse::stacked(vec![Ok(equalities), Ok(two_sided)])?)?,
            row_limits: rhs.map(|&d| Interval::point(d)).chain(sides).collect(),
            origins: (0..first)
                .map(Conflicting::Constraint)
                .chain((0..second).map(Conflicting::Inequality))
                .collect(),
            boxes: limits.clone(),
            limits,
            integer: model.integer().to_vec(),
        })
    }

    /// The form with more rows, of which the caller does not know.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn with_rows(&self, rows: &[AtLeast]) -> Result<Self> {
        let mut next = self.clone();
        let mut entries: Vec<(u32, u32, f64)> = self.rows.entries().collect();
        for (row, side) in rows {
            let i = next.row_limits.len();
            entries.extend(row.iter().map(|&(j, a)| (i as u32, j, a)));
            next.row_limits.push(Interval {
                lower: *side,
                upper: f64::INFINITY,
            });
            next.origins.push(Conflicting::Inequality(i));
        }
        let count = next.row_limits.len();
        next.rows = Sparse::from_triplets(count, self.dim(), entries.into_iter())?;
        Ok(next)
    }

    /// Number of unknowns.
    pub fn dim(&self) -> usize {
        self.gradient.len()
    }

    /// Whether an unknown is 0 or 1.
    pub fn is_binary(&self, j: usize) -> bool {
        let limits = self.limits[j];
        self.integer[j] && limits.lower == 0.0 && limits.upper == 1.0
    }

    /// A bound on the rounding errors of the objective at a point.
    pub fn rounding(&self, x: &[f64]) -> f64 {
        let products = self.hessian.entries();
        let products = products.map(|(i, j, v)| (v * x[i as usize] * x[j as usize]).abs());
        let linear = x.iter().zip(&self.gradient).map(|(x, q)| (x * q).abs());
        let size = self.constant.abs() + products.sum::<f64>() + linear.sum::<f64>();
        8.0 * f64::EPSILON * size
    }

    /// The objective at a point.
    pub fn energy(&self, x: &[f64]) -> f64 {
        let curved = self.hessian.mul_symmetric(x);
        let terms = x.iter().zip(&self.gradient).zip(&curved);
        self.constant + terms.map(|((x, q), c)| x * (q + 0.5 * c)).sum::<f64>()
    }
}

/// The matrix without entries that are zero.
pub(super) fn without_zeros(matrix: &Sparse) -> Result<Sparse> {
    let entries = matrix.entries().filter(|&(_, _, v)| v != 0.0);
    Sparse::from_triplets(matrix.rows(), matrix.cols(), entries)
}
