//! Applies the steps of a record to right sides and pinned values.
//!
//! The result is the offset `t` of the expansion `x = T y + t`, or the row that shows a contradiction. First
//! solves and later ones with other data both use this code, so that the same right sides give the same bits.

use super::errors::{infeasible, no_integer_solution, overflow};
use super::record::Record;
use super::row::{TooLarge, add_product};
use super::steps::Step;
use super::tolerance::{CONSISTENT, LARGEST, NOISE, WHOLE, near_integer};
use super::unknowns::Unknowns;
use crate::error::Result;
use crate::linalg::CompensatedSum;
use crate::monitor::Monitor;
use crate::problem::Model;

/// A number and the largest number used to compute it, to which noise is relative.
#[derive(Debug, Clone, Copy, Default)]
struct Side {
    value: f64,
    magnitude: f64,
}

/// The offset `t`, one number for each of the caller's unknowns, for the right sides and pinned values of
/// `model`.
pub(super) fn offset(record: &Record, model: &Model, monitor: &mut Monitor) -> Result<Vec<f64>> {
    let constants = constants(record, model, monitor)?;
    substitute_back(record, model, &constants, monitor)
}

/// The constant of every substitution.
fn constants(record: &Record, model: &Model, monitor: &mut Monitor) -> Result<Vec<f64>> {
    // An unknown that was pinned after the elimination is in no row, and no substitution replaces it.
    let pins = model.pinned().iter().enumerate();
    let mut constants: Vec<Side> = pins
        .filter(|&(i, _)| record.pinned[i])
        .filter_map(|(_, &pin)| pin)
        .map(|value| Side {
            value,
            magnitude: value.abs(),
        })
        .collect();
    let rows = record.scales.len();
    let sides: Result<Vec<Side>> = (0..rows).map(|r| given(record, model, r)).collect();
    let mut sides = sides?;
    for step in &record.steps {
        monitor.check()?;
        match *step {
            Step::Substitute {
                row,
                by,
                factor,
                integral,
            } => {
                let (side, by) = (&mut sides[row as usize], constants[by as usize]);
                side.value = add_product(side.value, -factor, by.value, integral)
                    .map_err(|_| overflow(model, row as usize))?;
                let factor = factor.abs();
                // Magnitudes are passed on as those of coefficients are; see `Row::grow`.
                let handed_on = (factor * by.value.abs()).max(factor.min(1.0) * by.magnitude);
                side.magnitude = side.magnitude.max(handed_on);
            }
            Step::MakeIntegral { row, unit } => {
                let side = &mut sides[row as usize];
                let value = side.value / unit;
                if value.is_nan() || value.abs() >= LARGEST {
                    return Err(overflow(model, row as usize));
                }
                let magnitude = side.magnitude / unit;
                side.value = near_integer(value, magnitude).ok_or_else(|| {
                    // Rounding errors of larger numbers may hide an integer.
                    let of = if magnitude < WHOLE {
                        no_integer_solution
                    } else {
                        overflow
                    };
                    of(model, row as usize)
                })?;
            }
            Step::Divide { row, factor } => {
                let side = &mut sides[row as usize];
                if side.value % factor != 0.0 {
                    return Err(no_integer_solution(model, row as usize));
                }
                side.value /= factor;
                side.magnitude = side.value.abs();
            }
            Step::Solve { row, pivot } => {
                let side = sides[row as usize];
                // Where a right side cancels, the rounding error that remains must not become a slope.
                let cancelled = side.value.abs() <= NOISE * side.magnitude;
                let value = if cancelled { 0.0 } else { side.value / pivot };
                constants.push(Side { value, ..side });
            }
            Step::Introduce => constants.push(Side::default()),
            Step::Check {
                row,
                magnitude,
                integral,
            } => {
                let side = sides[row as usize];
                let tolerance = CONSISTENT * magnitude.max(side.magnitude);
                let noise = !integral && side.value.abs() <= tolerance;
                if side.value != 0.0 && !noise {
                    return Err(infeasible(model, row as usize));
                }
            }
        }
    }
    Ok(constants.iter().map(|side| side.value).collect())
}

/// The right side of row `r` at the start of the elimination: scaled, with pinned unknowns moved to it.
fn given(record: &Record, model: &Model, r: usize) -> Result<Side> {
    let scale = record.scales[r];
    let rhs = model.constraint_rhs()[r] * scale;
    let mut magnitude = rhs.abs();
    let mut rest = CompensatedSum::new(rhs);
    for (j, v) in model.constraints().row(r) {
        if let Some(value) = model.pinned().get(j) {
            let v = v * scale;
            rest.add_product(-v, value);
            magnitude = magnitude.max((v * value).abs());
        }
    }
    let value = rest.value();
    if !value.is_finite() || !magnitude.is_finite() {
        return Err(overflow(model, r));
    }
    Ok(Side { value, magnitude })
}

/// Inserts the constants of later substitutions into the earlier ones.
fn substitute_back(
    record: &Record,
    model: &Model,
    constants: &[f64],
    monitor: &mut Monitor,
) -> Result<Vec<f64>> {
    let Record {
        stack, unknowns, ..
    } = record;
    let mut known = constants.to_vec();
    for k in (0..stack.len()).rev() {
        monitor.check()?;
        let (by, terms) = stack.get(k);
        let exact = unknowns.integer[by.pivot as usize];
        let mut offset = constants[k];
        let mut largest = offset.abs();
        let mut fits = Ok(());
        for &(j, c) in terms {
            let later = unknowns.replaced[j as usize];
            if later != Unknowns::FREE {
                let later = known[later as usize];
                largest = largest.max((c * later).abs());
                match add_product(offset, c, later, exact) {
                    Ok(sum) => offset = sum,
                    Err(TooLarge) => fits = Err(TooLarge),
                }
            }
        }
        if fits.is_err() || !offset.is_finite() {
            return Err(stack.too_large(k, |r| overflow(model, r)));
        }
        if !exact && offset.abs() <= NOISE * largest {
            offset = 0.0;
        }
        known[k] = offset;
    }
    let replaced = &unknowns.replaced[..model.variables()];
    let offset = |&k: &u32| match k {
        Unknowns::FREE => 0.0,
        k => known[k as usize],
    };
    Ok(replaced.iter().map(offset).collect())
}
