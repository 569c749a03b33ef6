//! The problem without its constraints.

use std::sync::Arc;

use super::{Expansion, Rounding, project};
use crate::linalg::{CANCELLED, CompensatedSum, Sparse};
use crate::monitor::in_blocks;
use crate::problem::Model;

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

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
    /// The values at which the unknowns are zero: none, or those of the [`Centre`](super::Centre).
    pub(super) origin: Vec<f64>,
    /// Bounds on the errors of the numbers above. They are known only around a centre.
    pub(crate) rounding: Rounding,
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

    /// The number of each reduced unknown among the caller's, after which those that the elimination introduced are
    /// counted.
    pub(crate) fn unknowns(&self) -> &[u32] {
        &self.free
    }

    /// The values that reduced unknowns keep if the objective does not determine them.
    pub fn guess(&self) -> &[f64] {
        &self.guess
    }

    /// The affine map back to the caller's unknowns.
    pub fn expansion(&self) -> &Expansion {
        &self.expansion
    }

    /// Bounds on the errors of the model's numbers. They are known only around a centre.
    pub fn rounding(&self) -> &Rounding {
        &self.rounding
    }

    /// The value at which reduced unknown `y` is zero.
    pub fn origin(&self, y: usize) -> f64 {
        self.origin.get(y).copied().unwrap_or(0.0)
    }

    /// The nearest integer to the value `step` of reduced unknown `y`. Exact halves of the whole value, which is
    /// the step and the [origin](Self::origin), are rounded away from zero, as everywhere in the library.
    pub fn nearest(&self, y: usize, step: f64) -> f64 {
        let below = step.floor();
        let is_half = step - below == 0.5;
        match is_half && self.origin(y) + step < 0.0 {
            true => below,
            false if is_half => below + 1.0,
            false => step.round(),
        }
    }

    /// The objective at `y`, and a bound on the error of this number. Around a centre the bound includes the
    /// rounding of the model itself.
    ///
    /// Products and sums are compensated (`ogita2005`, proposition 5.5), because on real problems the
    /// constant is a million times the result.
    pub fn energy(&self, y: &[f64]) -> (f64, f64) {
        let mut sum = CompensatedSum::new(self.constant);
        let mut size = self.constant.abs();
        let blocks = in_blocks(self.dim(), |block| {
            let (mut sum, mut size) = (CompensatedSum::new(0.0), 0.0);
            for i in block {
                sum.add_product(self.gradient[i], y[i]);
                size += (self.gradient[i] * y[i]).abs();
                for (j, v) in self.hessian.row(i) {
                    let v = if i == j { 0.5 * v } else { v };
                    sum.add_product_of_three(v, y[i], y[j]);
                    size += (v * y[i] * y[j]).abs();
                }
            }
            (sum, size)
        });
        for (of_block, its_size) in &blocks {
            sum.add_sum(of_block);
            size += its_size;
        }
        let gamma = (2 * self.hessian.len() + self.dim() + 4) as f64 * UNIT;
        let error = UNIT * sum.value().abs() + 2.0 * gamma * gamma * size;
        (sum.value(), error + self.rounding.of_energy(y))
    }
}
