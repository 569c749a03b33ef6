//! Corrections of rounding errors of the dual active-set method: the point is moved to its active rows, and point
//! and multipliers are refined by their residuals.

use super::dual_active_set::{Active, DualActiveSet};

/// Active rows may be missed by this, relative to the sizes of their sides, before the point is corrected.
const EXACT: f64 = 1e-13;

/// Steps of iterative refinement at the end of a solve.
const REFINEMENTS: usize = 2;

impl DualActiveSet<'_> {
    /// Moves the point to where the active rows hold.
    pub(super) fn correct(&mut self, most: usize) {
        for _ in 0..most {
            let missed = |a: &Active| self.product(a.row as usize, &self.point) - self.held(*a);
            let mut missed: Vec<f64> = self.active.iter().map(missed).collect();
            let is_exact =
                |(m, a): (&f64, &Active)| m.abs() <= EXACT * self.held(*a).abs().max(1.0);
            if missed.iter().zip(&self.active).all(is_exact) {
                return;
            }
            self.factor.solve(&mut missed);
            self.work += (missed.len() * missed.len()) as u64;
            self.step(&missed);
        }
    }

    /// Iterative refinement of point and multipliers: where only little was added to a singular Hessian, `P` is
    /// large and its rounding errors show in the slopes.
    pub(super) fn refine(&mut self) {
        for _ in 0..REFINEMENTS {
            let mut slopes = self.form.hessian.mul_symmetric(&self.point);
            for (j, slope) in slopes.iter_mut().enumerate() {
                *slope += self.inverse.added[j] * self.point[j] + self.gradient[j];
            }
            let n = self.limits.len();
            for active in &self.active {
                match (active.row as usize).checked_sub(n) {
                    None => slopes[active.row as usize] += active.multiplier,
                    Some(row) => {
                        let row = self.form.rows.row(row);
                        row.for_each(|(j, a)| slopes[j] += active.multiplier * a);
                    }
                }
            }
            let step = self.inverse.mul(&slopes);
            self.work += (self.form.hessian.len() + n) as u64;
            for (x, step) in self.point.iter_mut().zip(&step) {
                *x -= step;
            }
            let missed = |a: &Active| self.product(a.row as usize, &self.point) - self.held(*a);
            let mut missed: Vec<f64> = self.active.iter().map(missed).collect();
            self.factor.solve(&mut missed);
            self.work += (missed.len() * missed.len()) as u64;
            self.step(&missed);
            for (active, missed) in self.active.iter_mut().zip(&missed) {
                let new = active.multiplier + missed;
                if new * active.multiplier > 0.0 {
                    active.multiplier = new;
                }
            }
        }
    }
}
