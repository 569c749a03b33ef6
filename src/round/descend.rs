//! Coordinate descent on the integers, each of which is moved alone as long as that lowers the energy.
//!
//! Greedy rounding never takes a decision back. Where integers pull at each other, as the seams of a map do, a few
//! sweeps that move one integer at a time, with all others held and the continuous unknowns following, end lower.

use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::search::{Factors, Search};

/// The most sweeps over all integers. A few suffice.
const SWEEPS: usize = 100;

/// Offers what becomes of `integers`, whose energy is that of `R (z - z*)` above the relaxation's, where `R'R` is the
/// Schur complement on the integers `z`.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the errors of [`Search::offer`].
pub(super) fn descend(
    model: &ReducedModel,
    mut integers: Vec<f64>,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let relaxed = model
        .integers()
        .iter()
        .map(|&i| search.relaxed()[i as usize]);
    let offset: Vec<f64> = integers.iter().zip(relaxed).map(|(z, x)| z - x).collect();
    let (factor, _) = factors.schur_block(model)?;
    let moved = moves(factor, &offset, || !search.monitor.ends());
    if moved.iter().any(|&step| step != 0.0) {
        for (z, step) in integers.iter_mut().zip(moved) {
            *z += step;
        }
        search.offer(factors, &integers)?;
    }
    Ok(())
}

/// The whole steps from `offset` to a point that no step of one coordinate brings nearer to zero, where distances are
/// those of the upper triangular `factor`, given by columns.
fn moves(factor: &[f64], offset: &[f64], mut go_on: impl FnMut() -> bool) -> Vec<f64> {
    let m = offset.len();
    let column = |i: usize| &factor[i * m..=i * m + i];
    let mut residual = vec![0.0; m];
    let add = |residual: &mut [f64], i: usize, step: f64| {
        for (r, f) in residual.iter_mut().zip(column(i)) {
            *r += step * f;
        }
    };
    for (i, &x) in offset.iter().enumerate() {
        add(&mut residual, i, x);
    }
    let mut moved = vec![0.0; m];
    for _ in 0..SWEEPS {
        let mut has_moved = false;
        for i in 0..m {
            let own = column(i);
            let slope: f64 = residual.iter().zip(own).map(|(r, f)| r * f).sum();
            let curvature: f64 = own.iter().map(|f| f * f).sum();
            let step = -(slope / curvature).round();
            // An undetermined integer has no curvature, and stays.
            if step.is_finite() && step != 0.0 && 2.0 * slope.abs() > curvature * step.abs() {
                add(&mut residual, i, step);
                moved[i] += step;
                has_moved = true;
            }
        }
        if !has_moved || !go_on() {
            break;
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_random::Random;

    #[test]
    fn no_step_of_one_integer_lowers_the_energy_any_further() {
        let m = 12;
        let mut random = Random::new(3);
        let mut factor = vec![0.0; m * m];
        for i in 0..m {
            for r in 0..=i {
                factor[i * m + r] = random.next();
            }
        }
        factor[4 * m..5 * m].fill(0.0);
        let offset: Vec<f64> = (0..m).map(|_| 5.0 * random.next()).collect();
        let energy = |x: &[f64]| {
            let row = |r: usize| -> f64 { (0..m).map(|i| factor[i * m + r] * x[i]).sum() };
            (0..m).map(|r| row(r).powi(2)).sum::<f64>()
        };
        let moved = moves(&factor, &offset, || true);
        assert!(moved.iter().all(|step| step.fract() == 0.0) && moved[4] == 0.0);
        let mut end: Vec<f64> = offset
            .iter()
            .zip(&moved)
            .map(|(x, step)| x + step)
            .collect();
        let least = energy(&end);
        assert!(least < 0.5 * energy(&offset));
        for i in 0..m {
            for step in [-1.0, 1.0] {
                end[i] += step;
                assert!(energy(&end) >= least - 1e-12);
                end[i] -= step;
            }
        }
    }
}
