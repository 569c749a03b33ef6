//! A reduced model around a point, from the caller's numbers in twice the working precision.
//!
//! With integers near 1e8 the terms of the objective are 1e16 times its value, so that a reduced model around
//! zero has no correct digits. Around a point near the minimum the same objective has a small linear term,
//! a constant near the minimum, and steps y of about one. The point, the energy and the gradient there are
//! computed in twice the working precision from the caller's own terms ([`Objective`]). The Hessian
//! does not depend on the point.

use std::sync::Arc;

use super::rounding::roundings_of_expansion;
use super::{Elimination, Expansion, ReducedModel, Rounding, right_sides};
use crate::error::Result;
use crate::linalg::{CompensatedSum, TwoFold};
use crate::monitor::{
    Monitor, collect_if_wanted, collect_in_parts, in_parts, joined, may_continue, span,
};
use crate::problem::{Model, Objective, Problem};

/// The rounding error of a null direction, for each unknown.
const FLAT: f64 = 8.0 * f64::EPSILON;

/// A point that satisfies the constraints, and the reduced model around it.
#[derive(Debug, Clone)]
pub struct Centre {
    /// The caller's unknowns at the point.
    point: Vec<TwoFold>,
    /// The objective at the point.
    energy: TwoFold,
    model: ReducedModel,
}

/// The least number of unknowns that are worth a thread.
const LEAST: usize = 1 << 13;

impl Centre {
    /// The model of `problem` around the point where the unknowns of `reduced` are `y`.
    ///
    /// # Errors
    /// The end of the call.
    pub fn new(
        problem: &Problem,
        model: &Model,
        elimination: &Elimination,
        reduced: &ReducedModel,
        y: &[f64],
    ) -> Result<Self> {
        let _span = span("centre");
        let mut point = expand(reduced, y)?;
        may_continue()?;
        if model.constraints().rows() > 0 {
            satisfy(&mut point, model, elimination);
        }
        may_continue()?;
        let at = |i: usize| point[i];
        let energy = Objective(problem).energy(at);
        may_continue()?;
        let slopes = Objective(problem).gradient(at)?;
        may_continue()?;
        let (gradient, slope) = reduced_gradient(reduced, &slopes);
        let guess = reduced.guess.iter().zip(y).map(|(g, y)| g - y).collect();
        may_continue()?;
        let origin = (0..y.len()).map(|a| reduced.origin(a) + y[a]).collect();
        may_continue()?;
        let curvature = elimination.curvature(problem, model, reduced);
        may_continue()?;
        let moved = ReducedModel {
            hessian: Arc::clone(&reduced.hessian),
            gradient,
            constant: energy.value.high,
            integers: reduced.integers.clone(),
            continuous: reduced.continuous.clone(),
            guess,
            origin,
            rounding: Rounding {
                curvature,
                slope,
                constant: energy.error + energy.value.low.abs(),
            },
            free: reduced.free.clone(),
            expansion: Expansion::new(
                Arc::clone(reduced.expansion.shared_matrix()),
                point.iter().map(|x| x.high).collect(),
            ),
        };
        may_continue()?;
        Ok(Centre {
            point,
            energy: energy.value,
            model: moved,
        })
    }

    /// Whether the objective of `problem` has no curvature along the direction `y`, up to the rounding of the
    /// direction itself, which a solve by a factor with this smallest pivot made. A Hessian with a condition
    /// number beyond 1e13 seems to be singular, but is not.
    pub fn is_flat(&self, problem: &Problem, y: &[f64], smallest_pivot: f64) -> bool {
        let direction = direction(&self.model, y);
        let matrix = self.model.expansion.matrix();
        let magnitude = |i| matrix.row(i).map(|(a, t)| (t * y[a]).abs()).sum();
        let magnitude: Vec<f64> = collect_in_parts(matrix.rows(), LEAST, magnitude);
        let (curvature, size) = Objective(problem).curvature(&direction, &magnitude);
        let rounding = self.model.dim() as f64 * FLAT;
        curvature.abs() * smallest_pivot.min(1.0) <= rounding * rounding * size
    }

    /// The reduced model around the point.
    pub fn model(&self) -> &ReducedModel {
        &self.model
    }

    /// The objective at the point, from the caller's numbers.
    pub(crate) fn energy(&self) -> TwoFold {
        self.energy
    }

    /// The caller's unknowns at the step `y` from the point.
    pub fn expand(&self, y: &[f64]) -> Vec<TwoFold> {
        self.expand_each(y, |_, x| x)
    }

    /// What `value` makes of the number of each of the caller's unknowns and of the unknown at the step `y`.
    pub fn expand_each<T: Send>(
        &self,
        y: &[f64],
        value: impl Fn(usize, TwoFold) -> T + Sync,
    ) -> Vec<T> {
        let matrix = self.model.expansion.matrix();
        collect_in_parts(matrix.rows(), LEAST, |i| {
            let x = self.point[i];
            let mut sum = CompensatedSum::new(x.high);
            sum.add(x.low);
            matrix.row(i).for_each(|(a, t)| sum.add_product(t, y[a]));
            value(i, sum.two_fold())
        })
    }
}

/// The gradient in the reduced unknowns from that in the caller's, and the error of each entry.
fn reduced_gradient(reduced: &ReducedModel, slopes: &[TwoFold]) -> (Vec<f64>, Vec<f64>) {
    let matrix = reduced.expansion.matrix();
    let relative = roundings_of_expansion(reduced) as f64 * 0.5 * f64::EPSILON;
    // Each part looks at all entries and adds those of its own unknowns.
    let parts = in_parts(reduced.dim(), LEAST, |part| {
        let mut sums = vec![(CompensatedSum::new(0.0), 0.0); part.len()];
        for (i, g) in slopes.iter().enumerate() {
            for (a, t) in matrix.row(i) {
                if let Some((sum, error)) = sums.get_mut(a.wrapping_sub(part.start)) {
                    sum.add_multiple(t, *g);
                    *error += relative * (t * g.high).abs();
                }
            }
        }
        let entry = |(sum, error): &(CompensatedSum, f64)| {
            let g = sum.value();
            (g, error + 0.5 * f64::EPSILON * g.abs())
        };
        sums.iter().map(entry).collect()
    });
    joined(parts).into_iter().unzip()
}

/// The direction in the caller's unknowns of the direction `y` in those of `reduced`.
fn direction(reduced: &ReducedModel, y: &[f64]) -> Vec<TwoFold> {
    let matrix = reduced.expansion.matrix();
    let unknown = |i: usize| {
        let mut sum = CompensatedSum::new(0.0);
        matrix.row(i).for_each(|(a, t)| sum.add_product(t, y[a]));
        sum.two_fold()
    };
    collect_in_parts(matrix.rows(), LEAST, unknown)
}

/// The caller's unknowns at `y`, up to the rounding errors of the expansion.
///
/// # Errors
/// The end of the call.
fn expand(reduced: &ReducedModel, y: &[f64]) -> Result<Vec<TwoFold>> {
    let matrix = reduced.expansion.matrix();
    let offset = reduced.expansion.offset();
    let expanded = collect_if_wanted(offset.len(), LEAST, |i| {
        let mut sum = CompensatedSum::new(offset[i]);
        matrix.row(i).for_each(|(a, t)| sum.add_product(t, y[a]));
        sum.two_fold()
    });
    Ok(expanded?)
}

/// Moves `point` by the solution of the constraints for its own remainders, as iterative refinement does. A
/// point of integers, or one whose remainders are too small to be solved for, stays.
fn satisfy(point: &mut [TwoFold], model: &Model, elimination: &Elimination) {
    for (x, pin) in point.iter_mut().zip(model.pinned().iter()) {
        if let Some(value) = pin {
            *x = (*value).into();
        }
    }
    for _ in 0..2 {
        let constraints = model.constraints();
        let remainder = |k: usize| {
            let mut sum = CompensatedSum::new(model.constraint_rhs()[k]);
            constraints
                .row(k)
                .for_each(|(j, c)| sum.add_multiple(-c, point[j]));
            sum.value()
        };
        let remainders: Vec<f64> = (0..constraints.rows()).map(remainder).collect();
        if remainders.iter().all(|r| *r == 0.0) {
            return;
        }
        let homogeneous = model.with_constraint_right_sides(remainders);
        let step = right_sides::offset(&elimination.record, &homogeneous, &mut Monitor::default());
        let Ok(step) = step else { return };
        for ((x, step), is_integer) in point.iter_mut().zip(step).zip(model.integer()) {
            if !is_integer {
                let mut sum = CompensatedSum::new(x.high);
                sum.add(x.low);
                sum.add(step);
                *x = sum.two_fold();
            }
        }
    }
}
