//! The relaxation around its own minimiser, to the last digit.
//!
//! The first relaxation is solved around zero. Where integers are large or the Hessian is ill-conditioned, its
//! minimiser has few correct digits. The model is then stated again around it ([`Centre`]) and solved again,
//! until the minimiser is at the centre. This is iterative refinement with residuals in twice the
//! working precision (`higham2002`, section 12.1).

use super::eliminated::EliminatedProblem;
use super::relax::{Relaxation, relax};
use crate::eliminate::{Centre, ReducedModel};
use crate::error::{Error, Result};
use crate::linalg::sum_below;
use crate::monitor::span;
use crate::round;
use crate::search::Strategy;

/// The most rounds. Each one gains the digits that the factor has, so three are usual.
const ROUNDS: usize = 8;

/// A minimiser whose integers are this near to zero is at the centre.
const NEAR: f64 = 0.75;

/// Integers up to this size are decided around zero by [`Strategy::Multiple`]: its iterations depend on their
/// starts, and its published decisions were made around zero.
const SMALL: f64 = 1024.0;

/// The model around the relaxation's minimiser, with its integers rounded, and the relaxation of this model.
///
/// # Errors
/// Those of [`relax`].
pub(super) fn around_relaxation(
    of: &mut EliminatedProblem,
    reduced: &ReducedModel,
    strategy: Strategy,
) -> Result<(Centre, Relaxation)> {
    let _span = span("relax");
    let (centre, mut relaxation) = centred(of, reduced, strategy)?;
    // Where the factor takes a small curvature for none, the minimum may be anywhere below.
    if let Some((direction, pivot)) = of.factors.null_direction(centre.model(), strategy)?
        && !centre.is_flat(of.problem, &direction, pivot)
    {
        relaxation.lower_bound = f64::NEG_INFINITY;
    }
    Ok((centre, relaxation))
}

fn centred(
    of: &mut EliminatedProblem,
    reduced: &ReducedModel,
    strategy: Strategy,
) -> Result<(Centre, Relaxation)> {
    let mut relaxation = relax(of.model, reduced, strategy, of.factors)?;
    let mut at = rounded(reduced, &relaxation.point);
    if strategy == Strategy::Multiple && farthest(reduced, &at) <= SMALL {
        at.fill(0.0);
        let centre = Centre::new(of.problem, of.model, of.elimination, reduced, &at)?;
        return Ok(moved(centre, relaxation, &at));
    }
    let mut centre = Centre::new(of.problem, of.model, of.elimination, reduced, &at)?;
    for _ in 0..ROUNDS {
        let next = match relax(of.model, centre.model(), strategy, of.factors) {
            // The first relaxation had a minimum, so this is rounding in directions without curvature.
            Err(Error::Unbounded { .. } | Error::NotConvex { .. }) => {
                return Ok(moved(centre, relaxation, &at));
            }
            other => other?,
        };
        let step = rounded(reduced, &next.point);
        if farthest(reduced, &next.point) <= NEAR {
            return Ok((centre, next));
        }
        relaxation = next;
        at = at.iter().zip(&step).map(|(a, s)| a + s).collect();
        relaxation.point = at.clone();
        centre = Centre::new(of.problem, of.model, of.elimination, reduced, &at)?;
    }
    let last = relax(of.model, centre.model(), strategy, of.factors);
    match last {
        Ok(last) => Ok((centre, last)),
        Err(_) => Ok(moved(centre, relaxation, &at)),
    }
}

/// The relaxation with its minimiser as a step from the centre, which is at `at`.
fn moved(centre: Centre, relaxation: Relaxation, at: &[f64]) -> (Centre, Relaxation) {
    let step: Vec<f64> = relaxation
        .point
        .iter()
        .zip(at)
        .map(|(y, a)| y - a)
        .collect();
    let (energy, error) = centre.model().energy(&step);
    let lower_bound = sum_below(&[energy, -2.0 * relaxation.excess, -error]);
    let relaxation = Relaxation {
        point: step,
        lower_bound,
        ..relaxation
    };
    (centre, relaxation)
}

/// The largest magnitude of the integers.
fn farthest(reduced: &ReducedModel, point: &[f64]) -> f64 {
    let integers = reduced.integers().iter();
    integers.fold(0.0, |most: f64, &i| most.max(point[i as usize].abs()))
}

/// The point with its integers rounded.
fn rounded(reduced: &ReducedModel, point: &[f64]) -> Vec<f64> {
    let mut rounded = point.to_vec();
    for &i in reduced.integers() {
        rounded[i as usize] = round::nearest(point[i as usize]);
    }
    rounded
}
