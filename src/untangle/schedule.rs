//! The schedule that closes the barrier: the energy changes from a smooth one to one that no fold can
//! pass.
//!
//! `garanzha2021`, section 3.2, equation (7): eps falls faster when the last minimisation gained more and
//! when fewer faces are folded.

use super::region::Moved;
use super::system::System;
use crate::error::Result;
use crate::monitor::Monitor;
use crate::monitor::Phase;

/// The first eps: the determinant at rest.
pub(super) const FIRST_EPS: f64 = 1.0;

/// The last eps: a smaller one changes nothing in double precision.
const LAST_EPS: f64 = 1e-9;

/// The least part by which eps falls: the value 1/10 for which the paper has its proof.
const LEAST_GAIN: f64 = 0.1;

/// A minimisation at fixed eps ends when a step gains less than this part of the energy.
const CONVERGED: f64 = 1e-3;

/// The most steps at one eps.
const INNER_STEPS: usize = 6;

/// Steps after the last fold is removed, which move triangles away from degenerate ones.
const POLISHING_STEPS: usize = 3;

/// The result of the work on a region.
#[derive(Default)]
pub(super) struct Outcome {
    /// Where the region has moved to, if that has fewer folds.
    pub better: Option<Moved>,
    /// Newton steps made.
    pub steps: usize,
}

/// Works on a region until nothing is folded, for at most `most_steps` steps, and leaves `x` as it was.
pub(super) fn undo_folds(
    system: &mut System,
    x: &mut [f64],
    most_steps: usize,
    first_eps: f64,
    monitor: &mut Monitor,
) -> Result<Outcome> {
    let before = system.folded(x);
    if before == 0 {
        return Ok(Outcome::default());
    }
    let saved = system.save(x);
    let (folded, steps) = close_barrier(system, x, most_steps, first_eps, monitor)?;
    let better = (folded < before).then(|| system.moved(x));
    system.restore(x, &saved);
    Ok(Outcome { better, steps })
}

/// Changes the energy of a region step by step. Returns the faces still folded, and the Newton steps made.
fn close_barrier(
    system: &mut System,
    x: &mut [f64],
    most_steps: usize,
    first_eps: f64,
    monitor: &mut Monitor,
) -> Result<(usize, usize)> {
    let mut eps = first_eps;
    let mut steps = 0;
    let mut folded = system.folded(x);
    while folded > 0 && steps < most_steps && eps > LAST_EPS {
        let start = system.energy(x, eps);
        let mut energy = start;
        for _ in 0..INNER_STEPS {
            monitor.progress(Phase::Untangle, steps as f64 / most_steps as f64)?;
            let before = energy;
            energy = monitor.watching(|| system.step(x, eps))?;
            steps += 1;
            folded = system.folded(x);
            if folded == 0 || energy >= before * (1.0 - CONVERGED) {
                break;
            }
        }
        eps = narrowed(eps, 1.0 - energy / start, system.least_determinant(x));
    }
    if folded == 0 {
        steps += polish(system, x, eps)?;
    }
    Ok((folded, steps))
}

/// The next eps, after a minimisation that gained the part `gain` of the energy.
fn narrowed(eps: f64, gain: f64, least: f64) -> f64 {
    let gain = gain.max(LEAST_GAIN);
    if least >= 0.0 {
        return (1.0 - gain) * eps;
    }
    let root = eps.hypot(least);
    (1.0 - gain * root / (root - least)) * eps
}

/// Makes steps that fold no face.
fn polish(system: &mut System, x: &mut [f64], eps: f64) -> Result<usize> {
    let eps = eps.min(system.least_determinant(x)).max(LAST_EPS);
    for step in 0..POLISHING_STEPS {
        let before = system.save(x);
        system.step(x, eps)?;
        if system.folded(x) > 0 {
            system.restore(x, &before);
            return Ok(step + 1);
        }
    }
    Ok(POLISHING_STEPS)
}
