//! A bound on the rounding errors of a reduced model.
//!
//! An entry of Q that is the sum of k rounded products has an error of at most `k u / (1 - k u)` times the sum
//! of the absolute values of its terms (`higham2002`, section 3.1, with the rounding unit u). For least
//! squares this sum is at most `sqrt(Q_ii Q_jj)`. So the error of `x'Qx` is at most `sum_i e_i x_i^2`, where
//! `e_i` is the relative error times the number of entries of row i times `Q_ii`. In the reduced unknowns,
//! `x = T y`, it is at most `sum_a c_a y_a^2` with `c_a = sum_i e_i k_i T_ia^2`, where `k_i` is the number of
//! entries in row i of T. The products with T are computed in twice the working precision, so the
//! entries of `T'QT` are rounded once more.

use std::sync::Arc;

use super::ReducedModel;
use crate::linalg::Sparse;
use crate::monitor::both;
use crate::problem::{Model, Problem};

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// The least number of unknowns whose bounds are worth a thread.
const LEAST: usize = 1 << 15;

/// Bounds on the errors of a reduced model's numbers.
#[derive(Debug, Clone, Default)]
pub struct Rounding {
    /// By reduced unknown: the exact value of `y'Hy` differs from the computed one by at most
    /// `sum_a curvature[a] y_a^2`.
    pub curvature: Arc<Vec<f64>>,
    /// By reduced unknown: the error of the linear term.
    pub slope: Vec<f64>,
    /// The error of the constant.
    pub constant: f64,
}

impl Rounding {
    /// A bound on the error of the energy at `y`, apart from the rounding of its evaluation.
    pub fn of_energy(&self, y: &[f64]) -> f64 {
        let curvature = self.curvature.iter().zip(y).map(|(c, y)| c * y * y);
        let slope = self.slope.iter().zip(y).map(|(s, y)| (s * y).abs());
        0.5 * curvature.sum::<f64>() + slope.sum::<f64>() + self.constant
    }

    /// The bounds for the unknowns `members`, without the constant.
    pub fn of(&self, members: &[u32]) -> Rounding {
        let pick = |v: &[f64]| -> Vec<f64> {
            let of = |&a: &u32| v.get(a as usize).copied().unwrap_or(0.0);
            members.iter().map(of).collect()
        };
        Rounding {
            curvature: Arc::new(pick(&self.curvature)),
            slope: pick(&self.slope),
            constant: 0.0,
        }
    }
}

/// The error of `y'Hy`, as [`Rounding::curvature`], for the reduced Hessian of `model`.
pub(super) fn curvature(problem: &Problem, model: &Model, reduced: &ReducedModel) -> Vec<f64> {
    let mut curvature = vec![0.0; reduced.dim()];
    if model.constraints().rows() > 0 {
        let entries = entries_by_row(reduced.hessian());
        for (a, b, v) in reduced.hessian().entries() {
            if a == b {
                curvature[a as usize] = UNIT * entries[a as usize] * v.abs();
            }
        }
    }
    let roundings = roundings_in_q(problem, model) + 2 * roundings_of_expansion(reduced);
    if roundings > 0 {
        let relative = roundings as f64 * UNIT / (1.0 - roundings as f64 * UNIT);
        let (entries, diagonal) = both(
            problem.variables() >= LEAST,
            || entries_by_row(model.hessian()),
            || diagonal(problem),
        );
        let expansion = reduced.expansion().matrix();
        for i in 0..expansion.rows() {
            let row = expansion.row(i);
            let error = relative * entries[i] * diagonal[i] * row.len() as f64;
            row.for_each(|(a, t)| curvature[a] += error * t * t);
        }
    }
    curvature
}

/// The number of entries in each row of a symmetric matrix that is given by its lower triangle.
fn entries_by_row(lower: &Sparse) -> Vec<f64> {
    let mut entries = vec![0.0; lower.rows()];
    for (i, j, _) in lower.entries() {
        entries[i as usize] += 1.0;
        if i != j {
            entries[j as usize] += 1.0;
        }
    }
    entries
}

/// The largest number of roundings on the way to an entry of Q.
fn roundings_in_q(problem: &Problem, model: &Model) -> usize {
    let mut terms = vec![0usize; problem.variables()];
    let (rows, weights) = problem.least_squares();
    for k in 0..weights.len() {
        rows.row(k).for_each(|(i, _)| terms[i] += 1);
    }
    let most = terms.into_iter().max().unwrap_or(0);
    let summed = problem
        .quadratic()
        .len()
        .saturating_sub(model.hessian().len());
    match most {
        0 => summed,
        _ => most + summed + 4,
    }
}

/// The number of roundings in an entry of the expansion; none if all entries are whole numbers.
pub(super) fn roundings_of_expansion(reduced: &ReducedModel) -> usize {
    let expansion = reduced.expansion().matrix();
    let whole = expansion.values().iter().all(|t| *t == t.round());
    if whole {
        return 0;
    }
    let rows = 0..expansion.rows();
    4 + 2 * rows.map(|i| expansion.row(i).len()).max().unwrap_or(0)
}

/// Numbers `d` with `|Q_ij| <= sqrt(d_i d_j)` for the sums of the absolute values of all terms of Q.
fn diagonal(problem: &Problem) -> Vec<f64> {
    let mut d = vec![0.0; problem.variables()];
    for &(i, j, v) in problem.quadratic() {
        if i == j {
            d[i as usize] += v.abs();
        }
    }
    let (rows, weights) = problem.least_squares();
    for (k, w) in weights.iter().enumerate() {
        for (i, u) in rows.row(k) {
            d[i] += 2.0 * w * u * u;
        }
    }
    for &(i, j, v) in problem.quadratic() {
        let (i, j, v) = (i as usize, j as usize, v.abs());
        if i != j && v * v > d[i] * d[j] {
            d[i] += v;
            d[j] += v;
        }
    }
    d
}
