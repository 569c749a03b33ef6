//! The relaxation, in which all integers are real. Its minimum is a lower bound for every solution.

use crate::eliminate::ReducedModel;
use crate::error::{Error, Result};
use crate::linalg::{Lowest, Minimum, sum_below};
use crate::monitor::{in_blocks, may_continue};
use crate::problem::Model;
use crate::search::{Factors, Strategy};

/// The relaxation's minimiser and the bound that it proves.
#[derive(Debug, Clone)]
pub(crate) struct Relaxation {
    pub point: Vec<f64>,
    /// An estimate of the energy above the minimum.
    pub excess: f64,
    pub lower_bound: f64,
}

/// Minimises the reduced objective of `whole` over real unknowns, with a factor that `strategy` needs as
/// well.
///
/// # Errors
/// [`Error::Unbounded`] and [`Error::NotConvex`], each with a direction, and an error for lack of memory.
pub(crate) fn relax(
    whole: &Model,
    model: &ReducedModel,
    strategy: Strategy,
    factors: &mut Factors,
) -> Result<Relaxation> {
    if let Some(i) = negative_diagonal(model) {
        let mut direction = vec![0.0; model.dim()];
        direction[i] = 1.0;
        return Err(not_convex(model, &direction));
    }
    let rounding = || model.gradient_rounding(whole);
    match factors.minimise(model, strategy, rounding)? {
        Minimum::At(Lowest { point, excess }) => {
            may_continue()?;
            let (energy, error) = model.energy(&point);
            Ok(Relaxation {
                point,
                excess,
                lower_bound: sum_below(&[energy, -2.0 * excess, -error]),
            })
        }
        Minimum::Unbounded(v) => Err(unbounded(model, &v)),
        Minimum::NotConvex(v) => Err(not_convex(model, &v)),
    }
}

/// A diagonal entry that is negative by more than the rounding errors of its row.
fn negative_diagonal(model: &ReducedModel) -> Option<usize> {
    let is_negative = |&i: &usize| {
        let diagonal = model.hessian().diagonal(i);
        let size = || model.hessian().row(i).map(|(_, v)| v.abs()).sum::<f64>();
        diagonal < 0.0 && diagonal < -1e-9 * size()
    };
    let firsts = in_blocks(model.dim(), |mut block| block.find(is_negative));
    firsts.into_iter().flatten().next()
}

/// The error for a reduced direction along which the objective decreases without limit.
fn unbounded(model: &ReducedModel, direction: &[f64]) -> Error {
    let (variable, direction) = in_callers_unknowns(model, direction);
    Error::Unbounded {
        variable,
        direction,
    }
}

/// The error for a reduced direction along which the objective curves downwards.
fn not_convex(model: &ReducedModel, direction: &[f64]) -> Error {
    let (variable, direction) = in_callers_unknowns(model, direction);
    Error::NotConvex {
        variable,
        direction,
    }
}

/// The direction in the caller's unknowns, scaled to a largest entry of one, and the place of that entry.
fn in_callers_unknowns(model: &ReducedModel, direction: &[f64]) -> (usize, Vec<f64>) {
    let mut v = model.expansion().expand_direction(direction);
    let mut at = 0;
    for i in 1..v.len() {
        if v[i].abs() > v[at].abs() {
            at = i;
        }
    }
    let largest = v[at].abs();
    if largest > 0.0 {
        v.iter_mut().for_each(|v| *v /= largest);
    }
    (at, v)
}
