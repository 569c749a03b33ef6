//! The choice of a curvature: it makes bounds of unknowns without limits, whose slopes are rounding errors.

use super::convex::{Block, blocks};
use super::exact::Exact;
use super::minorant::PartObjective;

/// The parts of the diagonal that are tried, as powers of two.
const TRIED: [i32; 4] = [-4, -10, -20, -30];

/// A curvature of the objective: a power of two for each unknown of a block that has one, else zero.
pub(super) fn choose(part: &PartObjective) -> Vec<f64> {
    let mut chosen = vec![0.0; part.members.len()];
    for block in blocks(part) {
        if let Some(curvature) = of_block(&block) {
            for (&k, d) in block.members.iter().zip(curvature) {
                chosen[k] = d;
            }
        }
    }
    chosen
}

fn of_block(block: &Block) -> Option<Vec<f64>> {
    let diagonal = block.diagonal();
    if diagonal.iter().any(|d| !(1e-150..1e150).contains(d)) {
        return None;
    }
    let of_power = |power: i32| -> Vec<f64> {
        let power_below = |d: &f64| 2f64.powi(d.log2().floor() as i32 + power);
        diagonal.iter().map(power_below).collect()
    };
    let has = |curvature: &Vec<f64>| {
        let exact: Option<Vec<Exact>> = curvature.iter().map(|&d| Exact::of(d)).collect();
        exact.is_some_and(|exact| block.has_curvature(&exact))
    };
    TRIED.into_iter().map(of_power).find(has)
}
