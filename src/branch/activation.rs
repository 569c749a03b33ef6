//! A violated row of the dual active-set method becomes active.
//!
//! Where it depends on the active rows, one of these leaves for it; where none can, their combination shows that no
//! point exists (`goldfarb1983`).

use super::dual_active_set::{Active, DEPENDENT, DualActiveSet};

/// What is left of a square below this part of it is a rounding error.
const LOST: f64 = 1e-15;

/// Sides contradict each other if they miss each other by this part of their sizes.
const CONTRADICTION: f64 = 1e-8;

/// A sum below this part of its terms' sizes is zero.
const CANCELLED: f64 = 1e-8;

/// Steps of iterative refinement of a dual direction.
const REFINEMENTS: usize = 2;

/// An entry of a dual direction below this part of the largest is a rounding error.
const NOTHING: f64 = 1e-11;

impl DualActiveSet<'_> {
    /// Whether the active rows in this direction cancel a row. Where some unknowns have a curvature and others
    /// only the small one that was added, the norm of `P` does not show it.
    fn cancels(&mut self, row: usize, sign: f64, direction: &[f64]) -> bool {
        let (sums, sizes) = self.combined(row, sign, direction);
        let mut pairs = sums.iter().zip(&sizes);
        pairs.all(|(sum, size): (&f64, &f64)| sum.abs() <= CANCELLED * size)
    }

    /// `A_W' direction + sign a`, and the sums of the sizes of its terms.
    fn combined(&mut self, row: usize, sign: f64, direction: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (form, n) = (self.form, self.limits.len());
        let mut sizes = vec![0.0; n];
        let mut sums = vec![0.0; n];
        let mut add = |row: usize, by: f64| {
            let mut term = |j: usize, v: f64| {
                sums[j] += v;
                sizes[j] += v.abs();
            };
            match row.checked_sub(n) {
                None => term(row, by),
                Some(row) => form.rows.row(row).for_each(|(j, a)| term(j, a * by)),
            }
        };
        add(row, sign);
        for (held, &d) in self.active.iter().zip(direction) {
            add(held.row as usize, d);
        }
        self.work += n as u64;
        (sums, sizes)
    }

    /// Iterative refinement of a direction, so that what it leaves of a row that depends on the active rows is zero.
    fn refine_direction(&mut self, row: usize, sign: f64, direction: &mut [f64]) {
        for _ in 0..REFINEMENTS {
            let (sums, _) = self.combined(row, sign, direction);
            let image = self.inverse.mul(&sums);
            let product = |held: &Active| self.product(held.row as usize, &image);
            let mut step: Vec<f64> = self.active.iter().map(product).collect();
            self.factor.solve(&mut step);
            self.work += (step.len() * step.len()) as u64;
            direction.iter_mut().zip(&step).for_each(|(d, s)| *d -= s);
        }
    }

    /// Whether the sides of a combination of rows contradict each other by more than rounding errors.
    fn contradicts(&self, row: Active, sign: f64, direction: &[f64]) -> bool {
        let own = sign * self.held(row);
        let held = self.active.iter().zip(direction);
        let held = held
            .filter(|(_, d)| **d != 0.0)
            .map(|(a, d)| d * self.held(*a));
        let (sum, size) = held.fold((own, own.abs()), |(s, m), t: f64| (s + t, m + t.abs()));
        -sum > CONTRADICTION * size.max(1.0)
    }

    /// Makes a violated row active. If it depends on the active rows, one of these leaves for it; if none can,
    /// their combination is the certificate that no point exists.
    pub(super) fn activate(&mut self, row: usize, upper: bool) -> Option<Vec<(u32, f64)>> {
        let sign = if upper { 1.0 } else { -1.0 };
        let mut active = Active {
            row: row as u32,
            upper,
            multiplier: 0.0,
        };
        loop {
            let (entries, left, square) = self.factor_row(row);
            // Of more rows than unknowns, one depends on the others.
            let is_full = self.active.len() >= self.limits.len();
            if left > DEPENDENT * square && !is_full {
                self.append(active, entries, left);
                return None;
            }
            // `A_W' direction + sign a = 0`, and `entries` are `D^-1 L^-1 A_W P a`.
            let mut direction: Vec<f64> = entries.iter().map(|l| -sign * l).collect();
            self.factor.solve_transposed(&mut direction);
            if left > LOST * square {
                self.refine_direction(row, sign, &mut direction);
            }
            let largest = direction.iter().fold(1.0, |m: f64, d| m.max(d.abs()));
            let is_nothing = |d: &&mut f64| d.abs() <= NOTHING * largest;
            direction
                .iter_mut()
                .filter(is_nothing)
                .for_each(|d| *d = 0.0);
            if left > LOST * square && !is_full && !self.cancels(row, sign, &direction) {
                self.append(active, entries, left);
                return None;
            }
            let mut first: Option<(usize, f64)> = None;
            for (k, (held, d)) in self.active.iter().zip(&direction).enumerate() {
                let falls = if held.upper { *d < 0.0 } else { *d > 0.0 };
                if falls && !self.interval(held.row as usize).is_point() {
                    let step = (held.multiplier / -*d).max(0.0);
                    if first.is_none_or(|(_, best)| step < best) {
                        first = Some((k, step));
                    }
                }
            }
            let Some((at, step)) = first else {
                if !self.contradicts(active, sign, &direction) {
                    self.ignore(row);
                    return None;
                }
                let rows = self.active.iter().zip(&direction);
                let rows = rows.filter(|(_, d)| **d != 0.0);
                let rows = rows.map(|(held, d)| (held.row, *d));
                return Some(rows.chain([(row as u32, sign)]).collect());
            };
            for (held, d) in self.active.iter_mut().zip(&direction) {
                held.multiplier += step * d;
            }
            active.multiplier += step * sign;
            self.remove(at);
        }
    }
}
