//! The problem without its constraints.

use std::sync::Arc;

use super::{Expansion, project};
use crate::linalg::{CANCELLED, CompensatedSum, Sparse};
use crate::problem::Model;

/// The problem `minimise 1/2 y'Hy + g'y + c`, where some entries of `y` are integer, without constraints.
///
/// First come the caller's unknowns that remain, in the caller's order. The unknowns that the elimination
/// introduced, integer or not, follow them.
#[derive(Debug, Clone)]
pub struct ReducedModel {
    pub(crate) hessian: Arc<Sparse>,
    pub(crate) gradient: Vec<f64>,
    pub(crate) constant: f64,
    pub(crate) integers: Vec<u32>,
    pub(crate) continuous: Vec<u32>,
    pub(crate) guess: Vec<f64>,
    /// The number of each reduced unknown among the caller's and the introduced ones.
    pub(super) free: Vec<u32>,
    pub(crate) expansion: Expansion,
}

impl ReducedModel {
    /// Number of reduced unknowns.
    pub fn dim(&self) -> usize {
        self.gradient.len()
    }

    /// Lower triangle of the reduced Hessian, every diagonal entry stored.
    pub fn hessian(&self) -> &Sparse {
        &self.hessian
    }

    /// The reduced linear term.
    pub fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    /// An estimate of the rounding error of each entry of the linear term. It is computed from the sizes of
    /// all terms in `model`, the model that was reduced. Where large terms cancel, it may exceed the entry.
    pub fn gradient_rounding(&self, model: &Model) -> Vec<f64> {
        project::linear_size(model, &self.expansion)
            .into_iter()
            .map(|size| CANCELLED * size)
            .collect()
    }

    /// The reduced constant.
    pub fn constant(&self) -> f64 {
        self.constant
    }

    /// The integer reduced unknowns, increasing.
    pub fn integers(&self) -> &[u32] {
        &self.integers
    }

    /// The continuous reduced unknowns, increasing.
    pub fn continuous(&self) -> &[u32] {
        &self.continuous
    }

    /// The values that reduced unknowns keep if the objective does not determine them.
    pub fn guess(&self) -> &[f64] {
        &self.guess
    }

    /// The affine map back to the caller's unknowns.
    pub fn expansion(&self) -> &Expansion {
        &self.expansion
    }

    /// The objective at `y` and the sum of the absolute values of its terms.
    ///
    /// The sum is compensated, because on real problems the constant is a million times the result.
    pub fn energy(&self, y: &[f64]) -> (f64, f64) {
        let mut sum = CompensatedSum::new(self.constant);
        let mut size = self.constant.abs();
        let mut add = |a: f64, b: f64| {
            sum.add_product(a, b);
            size += (a * b).abs();
        };
        for (g, y) in self.gradient.iter().zip(y) {
            add(*g, *y);
        }
        for i in 0..self.dim() {
            for (j, v) in self.hessian.row(i) {
                let half = if i == j { 0.5 } else { 1.0 };
                add(half * v * y[i], y[j]);
            }
        }
        (sum.value(), size)
    }
}
