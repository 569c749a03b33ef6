//! The dual active-set method for strictly convex quadratic programs with two-sided rows and bounds.
//!
//! `goldfarb1983` in the form of `arnstrom2022` (DAQP): every iterate is dual feasible, so its dual objective
//! is a lower bound, and a solve starts from the active rows of the node above. With `P = (Q + added)^-1` and
//! the active rows `W`, the point is `x = x_0 - P A_W' mu`, where `x_0` is the minimiser without rows and `mu`
//! solves `A_W P A_W' mu = A_W x_0 - b_W`. A multiplier is positive for an upper side, negative for a lower
//! side, and has any sign where both sides are equal.
//!
//! `P` is known by blocks ([`Inverse`]), and so the products of rows with `P` are sparse wherever Q is.

use super::form::{Form, Interval};
use super::inverse::Inverse;
use super::shared::{Image, Shared};
use super::working_set::Ldl;
use crate::monitor::may_continue;

/// A row whose square that the others leave is below this part of its own depends on them.
pub(super) const DEPENDENT: f64 = 1e-9;

/// Rows may be violated by this, relative to the sizes of their sides.
pub(super) const FEASIBLE: f64 = 1e-9;

/// A violation so many times larger than what active rows miss is none of rounding errors.
const SURE: f64 = 1e3;

/// The largest number of corrections.
const CORRECTIONS: usize = 2;

/// The factor is made again after this many removals. After more, its rounding errors cost more steps than they save.
const REFRESH: usize = 60;

/// The multiplications after which the solve looks whether the call is to end.
const LOOK: u64 = 1_000_000;

/// How a solve ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outcome {
    /// At the minimiser.
    Optimal,
    /// No point is within all limits: the sum of the rows with these multipliers contradicts their sides.
    Infeasible(Vec<(u32, f64)>),
    /// The dual objective has reached the cutoff.
    Cutoff,
    /// After the largest number of iterations, or because the call is to end.
    Stopped,
}

/// A row that is held at one of its sides. Rows are numbered after the unknowns, whose numbers stand for
/// their bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Active {
    pub row: u32,
    /// Whether it is held at its upper side.
    pub upper: bool,
    pub multiplier: f64,
}

/// The active rows with their multipliers, from which another solve may start.
pub(super) type WarmStart = Vec<Active>;

/// The active rows, their factor and the point.
#[derive(Debug, Clone)]
pub(super) struct State {
    active: Vec<Active>,
    factor: Ldl,
    point: Vec<f64>,
}

const NOT_ACTIVE: u32 = u32::MAX;

/// A quadratic program whose bounds and linear terms change from solve to solve.
#[derive(Debug)]
pub(super) struct DualActiveSet<'a> {
    pub(super) form: &'a Form,
    pub(super) inverse: &'a Inverse,
    /// `P a` for each row.
    images: &'a [Image],
    /// `(a'Pa)^-1/2` for each unknown and each row, by which violations are compared.
    scales: &'a [f64],
    pub(super) limits: Vec<Interval>,
    pub(super) gradient: Vec<f64>,
    /// The minimiser without rows.
    centre: Vec<f64>,
    pub(super) active: Vec<Active>,
    /// The place of each unknown and row in `active`.
    pub(super) place: Vec<u32>,
    pub(super) factor: Ldl,
    removals: usize,
    /// By active row, as far as known: how far the minimiser without rows misses it, and the same after the
    /// substitution with L.
    missed: Vec<f64>,
    substituted: Vec<f64>,
    /// Rows that are violated only by rounding errors.
    is_ignored: Vec<bool>,
    ignored: Vec<u32>,
    pub(super) point: Vec<f64>,
    scattered: Vec<f64>,
    dual_objective: f64,
    /// The iterations of all solves, and their multiplications.
    pub iterations: u64,
    pub work: u64,
    /// The work after which the next look is due, and whether the last one found that the call is to end.
    next_look: u64,
    is_over: bool,
}

impl<'a> DualActiveSet<'a> {
    pub fn new(form: &'a Form, shared: &'a Shared) -> Self {
        let n = form.dim();
        let mut solver = DualActiveSet {
            form,
            inverse: &shared.inverse,
            images: &shared.images,
            scales: &shared.scales,
            limits: form.limits.clone(),
            gradient: form.gradient.clone(),
            centre: Vec::new(),
            active: Vec::new(),
            place: vec![NOT_ACTIVE; n + form.rows.rows()],
            factor: Ldl::default(),
            removals: 0,
            missed: Vec::new(),
            substituted: Vec::new(),
            is_ignored: vec![false; n + form.rows.rows()],
            ignored: Vec::new(),
            point: vec![0.0; n],
            scattered: vec![0.0; n],
            dual_objective: f64::NEG_INFINITY,
            iterations: 0,
            work: 0,
            next_look: LOOK,
            is_over: false,
        };
        solver.set_gradient(form.gradient.clone());
        solver
    }

    /// The minimiser after a solve.
    pub fn point(&self) -> &[f64] {
        &self.point
    }

    /// The active rows after a solve.
    pub fn active(&self) -> &[Active] {
        &self.active
    }

    /// The dual objective after a solve, without the constant of the form.
    pub fn dual_objective(&self) -> f64 {
        self.dual_objective
    }

    /// The state from which solves go on.
    pub fn state(&self) -> State {
        State {
            active: self.active.clone(),
            factor: self.factor.clone(),
            point: self.point.clone(),
        }
    }

    /// Goes back to an earlier state.
    pub fn go_back(&mut self, state: &State) {
        for active in &self.active {
            self.place[active.row as usize] = NOT_ACTIVE;
        }
        self.active.clone_from(&state.active);
        for (k, active) in self.active.iter().enumerate() {
            self.place[active.row as usize] = k as u32;
        }
        self.factor.clone_from(&state.factor);
        self.point.clone_from(&state.point);
    }

    pub fn limits(&self) -> &[Interval] {
        &self.limits
    }

    pub fn form(&self) -> &'a Form {
        self.form
    }

    /// The inverse of the Hessian.
    pub fn inverse(&self) -> &'a Inverse {
        self.inverse
    }

    pub fn set_limits(&mut self, variable: usize, limits: Interval) {
        self.limits[variable] = limits;
    }

    /// Replaces the linear term.
    pub fn set_gradient(&mut self, gradient: Vec<f64>) {
        self.centre = self.inverse.mul(&gradient);
        self.centre.iter_mut().for_each(|x| *x = -*x);
        self.gradient = gradient;
    }

    /// Starts the next solve from these rows.
    pub fn start_from(&mut self, warm: &[Active]) {
        for active in self.active.drain(..) {
            self.place[active.row as usize] = NOT_ACTIVE;
        }
        self.factor.clear();
        self.removals = 0;
        for &active in warm {
            if self.ends() {
                break;
            }
            self.push(active);
        }
    }

    /// Counts multiplications from this number on.
    pub fn count_from(&mut self, work: u64) {
        (self.work, self.next_look) = (work, work + LOOK);
    }

    /// Whether the call is to end. A solve from fewer active rows takes longer, and is right as well.
    fn ends(&mut self) -> bool {
        if self.work >= self.next_look {
            self.next_look = self.work + LOOK;
            self.is_over = may_continue().is_err();
        }
        self.is_over
    }

    /// Makes the factor again from the active rows.
    fn refresh(&mut self) {
        self.forget_from(0);
        let active = self.active.clone();
        self.start_from(&active);
    }

    pub(super) fn interval(&self, row: usize) -> Interval {
        let n = self.limits.len();
        match row.checked_sub(n) {
            None => self.limits[row],
            Some(row) => self.form.row_limits[row],
        }
    }

    /// The product of a row with a point.
    pub(super) fn product(&self, row: usize, x: &[f64]) -> f64 {
        match row.checked_sub(self.limits.len()) {
            None => x[row],
            Some(row) => self.form.rows.row(row).map(|(j, a)| a * x[j]).sum(),
        }
    }

    fn image(&self, row: usize) -> (&'a [u32], &'a [f64]) {
        match row.checked_sub(self.limits.len()) {
            None => self.inverse.column(row),
            Some(row) => (&self.images[row].0, &self.images[row].1),
        }
    }

    /// The row of the factor for a row that is not active, and what is left of its square.
    pub(super) fn factor_row(&mut self, row: usize) -> (Vec<f64>, f64, f64) {
        let (indices, values) = self.image(row);
        for (&j, v) in indices.iter().zip(values) {
            self.scattered[j as usize] = *v;
        }
        let products: Vec<f64> = self
            .active
            .iter()
            .map(|active| self.product(active.row as usize, &self.scattered))
            .collect();
        let square = self.product(row, &self.scattered);
        for &j in indices {
            self.scattered[j as usize] = 0.0;
        }
        let size = self.active.len() as u64;
        self.work += size * size / 2 + indices.len() as u64;
        let (entries, left) = self.factor.next_row(&products, square);
        (entries, left, square)
    }

    /// Makes a row active unless it depends on the active rows.
    fn push(&mut self, active: Active) {
        let row = active.row as usize;
        if self.place[row] != NOT_ACTIVE {
            return;
        }
        let (entries, left, square) = self.factor_row(row);
        if left > DEPENDENT * square {
            self.append(active, entries, left);
        }
    }

    pub(super) fn append(&mut self, active: Active, entries: Vec<f64>, diagonal: f64) {
        self.place[active.row as usize] = self.active.len() as u32;
        self.active.push(active);
        self.factor.append(entries, diagonal);
    }

    pub(super) fn remove(&mut self, at: usize) {
        let row = self.active.remove(at).row;
        self.place[row as usize] = NOT_ACTIVE;
        for (k, active) in self.active.iter().enumerate().skip(at) {
            self.place[active.row as usize] = k as u32;
        }
        self.factor.remove(at);
        self.forget_from(at);
        let rest = (self.active.len() - at) as u64;
        self.work += rest * rest;
        self.removals += 1;
        if self.removals >= REFRESH {
            self.refresh();
        }
    }

    /// The side that an active row is held at.
    pub(super) fn held(&self, active: Active) -> f64 {
        let interval = self.interval(active.row as usize);
        if active.upper {
            interval.upper
        } else {
            interval.lower
        }
    }

    /// Solves the program with the current limits and linear term, from the active rows of the last solve.
    ///
    /// It ends with [`Outcome::Cutoff`] where the dual objective, without the constant of the form, exceeds
    /// `cutoff`.
    pub fn solve(&mut self, cutoff: f64, most: u64) -> Outcome {
        self.forget_from(0);
        self.drop_wrong_signs();
        for row in self.ignored.drain(..) {
            self.is_ignored[row as usize] = false;
        }
        let unlimited: f64 = self
            .centre
            .iter()
            .zip(&self.gradient)
            .map(|(x, q)| 0.5 * x * q)
            .sum();
        let last = self.iterations + most;
        let mut added = NOT_ACTIVE;
        loop {
            if self.iterations >= last || self.ends() {
                return Outcome::Stopped;
            }
            self.iterations += 1;
            // The multipliers at which all active rows hold.
            let target = self.target();
            if let Some((at, step)) = self.blocking(&target) {
                for (active, new) in self.active.iter_mut().zip(&target) {
                    active.multiplier += step * (new - active.multiplier);
                }
                let active = self.active[at];
                if active.row == added && active.multiplier == 0.0 {
                    // Its multiplier moves away from zero but for rounding errors, and so these violate it.
                    self.ignore(added as usize);
                }
                self.remove(at);
                continue;
            }
            for (active, new) in self.active.iter_mut().zip(&target) {
                active.multiplier = *new;
            }
            let raised: f64 = target
                .iter()
                .zip(&self.missed)
                .map(|(m, v)| 0.5 * m * v)
                .sum();
            self.dual_objective = unlimited + raised;
            self.move_point();
            if self.dual_objective > cutoff {
                return Outcome::Cutoff;
            }
            let Some((row, upper)) = self.violated() else {
                if self.inverse.is_definite() {
                    self.correct(1);
                } else {
                    self.refine();
                }
                return Outcome::Optimal;
            };
            added = row as u32;
            if let Some(certificate) = self.activate(row, upper) {
                return Outcome::Infeasible(certificate);
            }
        }
    }

    /// The multipliers at which all active rows hold.
    fn target(&mut self) -> Vec<f64> {
        let done = self.missed.len();
        for k in done..self.active.len() {
            let active = self.active[k];
            let missed = self.product(active.row as usize, &self.centre) - self.held(active);
            self.missed.push(missed);
            self.substituted.push(missed);
        }
        self.factor.substitute(&mut self.substituted, done);
        let mut target = self.substituted.clone();
        self.factor.solve_substituted(&mut target);
        let size = target.len() as u64;
        self.work += size * (2 * size - done as u64) / 2;
        target
    }

    /// Forgets what was computed for the active rows from this one on.
    fn forget_from(&mut self, at: usize) {
        self.missed.truncate(at);
        self.substituted.truncate(at);
    }

    /// Holds each active row at the side that the sign of its multiplier belongs to, and removes it where
    /// that side does not limit.
    fn drop_wrong_signs(&mut self) {
        for at in (0..self.active.len()).rev() {
            let active = self.active[at];
            let interval = self.interval(active.row as usize);
            let side = interval.side(active.multiplier);
            self.active[at].upper = active.multiplier > 0.0;
            if !side.is_finite() || (active.multiplier == 0.0 && !interval.is_point()) {
                self.remove(at);
            }
        }
    }

    /// The first active row whose multiplier loses its sign on the way to `target`, and the part of the way
    /// until then.
    fn blocking(&self, target: &[f64]) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for (k, (active, &new)) in self.active.iter().zip(target).enumerate() {
            let lost = if active.upper { new < 0.0 } else { new > 0.0 };
            if lost && !self.interval(active.row as usize).is_point() {
                let part = (active.multiplier / (active.multiplier - new)).clamp(0.0, 1.0);
                if first.is_none_or(|(_, best)| part < best) {
                    first = Some((k, part));
                }
            }
        }
        first
    }

    /// `x = x_0 - P A_W' mu`.
    fn move_point(&mut self) {
        self.point.copy_from_slice(&self.centre);
        let multipliers: Vec<f64> = self.active.iter().map(|a| a.multiplier).collect();
        self.step(&multipliers);
    }

    /// The row that is violated most, and whether the point is above it. Where the small diagonal that was added makes
    /// `P` large, what the active rows miss by rounding errors is taken out of the point, by further steps of the same
    /// kind, unless the violation is far larger.
    fn violated(&mut self) -> Option<(usize, bool)> {
        if !self.inverse.is_definite() {
            if let Some((row, upper, violation)) = self.most_violated()
                && violation > SURE * self.largest_miss()
            {
                return Some((row, upper));
            }
            self.correct(CORRECTIONS);
        }
        let (row, upper, _) = self.most_violated()?;
        Some((row, upper))
    }

    /// How far the point is at most from the sides that active rows are held at.
    fn largest_miss(&self) -> f64 {
        let missed = |a: &Active| self.product(a.row as usize, &self.point) - self.held(*a);
        let missed = self.active.iter().map(|a| missed(a).abs());
        missed.fold(0.0, f64::max)
    }

    /// Subtracts `P A_W'` times these multipliers from the point.
    pub(super) fn step(&mut self, multipliers: &[f64]) {
        let mut work = 0;
        for (k, &multiplier) in multipliers.iter().enumerate() {
            if multiplier != 0.0 {
                let (indices, values) = self.image(self.active[k].row as usize);
                work += indices.len() as u64;
                if indices.len() == self.point.len() {
                    for (x, v) in self.point.iter_mut().zip(values) {
                        *x -= multiplier * v;
                    }
                } else {
                    for (&j, v) in indices.iter().zip(values) {
                        self.point[j as usize] -= multiplier * v;
                    }
                }
            }
        }
        self.work += work;
    }

    /// The row outside its limits whose violation is largest in the norm of Q, whether the point is above it, and how
    /// far.
    fn most_violated(&self) -> Option<(usize, bool, f64)> {
        let mut worst: Option<(usize, bool, f64)> = None;
        let mut most = 0.0;
        let mut look = |row: usize, value: f64, interval: Interval| {
            let (below, above) = (interval.lower - value, value - interval.upper);
            let upper = above > below;
            let (violation, side) = if upper {
                (above, interval.upper)
            } else {
                (below, interval.lower)
            };
            if violation > FEASIBLE * side.abs().max(1.0)
                && violation * self.scales[row] > most
                && self.place[row] == NOT_ACTIVE
                && !self.is_ignored[row]
            {
                most = violation * self.scales[row];
                worst = Some((row, upper, violation));
            }
        };
        for (j, (&x, &interval)) in self.point.iter().zip(&self.limits).enumerate() {
            look(j, x, interval);
        }
        let n = self.limits.len();
        for (i, &interval) in self.form.row_limits.iter().enumerate() {
            look(n + i, self.product(n + i, &self.point), interval);
        }
        worst
    }

    /// Leaves a row out until the end of the solve.
    pub(super) fn ignore(&mut self, row: usize) {
        self.is_ignored[row] = true;
        self.ignored.push(row as u32);
    }
}

#[cfg(test)]
#[path = "dual_active_set_tests.rs"]
mod tests;
