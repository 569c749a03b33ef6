//! The choice of a curvature.
//!
//! A positive one makes bounds of unknowns without limits, whose slopes are rounding errors. A small negative one
//! covers a block that is singular up to the rounding of its entries; it needs limits. Integers that Q couples with
//! nothing get all the curvature that they have: a bound over integers is better for it.

use super::convex::{Block, GoesOn, blocks};
use super::exact::Exact;
use super::minorant::PartObjective;
use super::problem::{Limits, Side};

/// The parts of the diagonal that are tried, as powers of two.
const POSITIVE: [i32; 4] = [-4, -10, -20, -30];
const NEGATIVE: [i32; 3] = [-36, -32, -28];

/// A curvature of the objective: a power of two or its negative for each unknown of a block that has one, and that of
/// an integer alone, else zero.
pub(super) fn choose(part: &PartObjective, limits: &Limits, goes_on: GoesOn) -> Vec<f64> {
    let mut chosen = vec![0.0; part.members.len()];
    for block in blocks(part) {
        if let [k] = block.members[..]
            && part.integer[k]
            && let Some(own) = block.whole_curvature()
        {
            chosen[k] = own;
            continue;
        }
        let is_bounded = block.members.iter().all(|&k| {
            let side = |side| limits.side(part.members[k], side).is_some();
            side(Side::Lower) && side(Side::Upper)
        });
        if let Some(curvature) = of_block(&block, is_bounded, goes_on) {
            for (&k, d) in block.members.iter().zip(curvature) {
                chosen[k] = d;
            }
        }
    }
    chosen
}

fn of_block(block: &Block, is_bounded: bool, goes_on: GoesOn) -> Option<Vec<f64>> {
    let diagonal = block.diagonal();
    if diagonal.iter().any(|d| !(1e-150..1e150).contains(d)) {
        return None;
    }
    let of_power = |sign: f64, power: i32| -> Vec<f64> {
        let power_below = |d: &f64| sign * 2f64.powi(d.log2().floor() as i32 + power);
        diagonal.iter().map(power_below).collect()
    };
    let has = |curvature: &Vec<f64>| {
        let exact: Option<Vec<Exact>> = curvature.iter().map(|&d| Exact::of(d)).collect();
        exact.is_some_and(|exact| block.has_curvature_at_once(&exact, goes_on))
    };
    let positive = POSITIVE.into_iter().map(|power| of_power(1.0, power));
    if let Some(found) = positive.into_iter().find(has) {
        return Some(found);
    }
    if !is_bounded || block.has_curvature(&vec![Exact::zero(); diagonal.len()], goes_on) {
        return None;
    }
    NEGATIVE
        .into_iter()
        .map(|power| of_power(-1.0, power))
        .find(has)
}
