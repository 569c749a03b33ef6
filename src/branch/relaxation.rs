//! The continuous relaxation of a node, and its bound.
//!
//! The dual active-set method needs a Hessian that is definite. Where it is not, a small multiple of a diagonal
//! is added and taken out again by [proximal steps](super::proximal). On a linear part one or two of them are exact.

use super::dual_active_set::{Active, DualActiveSet, Outcome};
use super::form::{Form, Interval};
use super::interior::{self, Ended};
use super::propagate::Propagator;
use super::proximal::{Led, Proximal};
use super::safe_bound::safe_bound;
use super::shared::Shared;
use crate::proof::{Multiplied, Step};

/// The diagonal added to a singular block, relative to the size of the objective. A smaller one takes fewer proximal
/// steps; below 1e-6, rounding errors of the active rows take the bounds of `watercontamination0202r` away.
const ADDED: f64 = 3e-6;

/// The largest number of proximal steps of a solve.
const STEPS: usize = 30;

/// Proximal steps end when the bound is within this part of the energy.
const CLOSE: f64 = 1e-10;

/// Where integers are fractional, proximal steps also end when the bound is closer to the energy than this part of the
/// distance from the energy to the cutoff.
const PART: f64 = 1e-2;

/// They do not end so where the bound differs from the energy by more than this part of it.
const ROUGH: f64 = 1e-3;

/// A value this close to an integer may become one by further steps.
const NEAR: f64 = 1e-3;

/// The largest number of times that bounds are tightened through all rows before the interior-point method.
const ROUNDS: usize = 5;

/// Iterations of one solve of the dual active-set method, for each unknown and row.
const ITERATIONS: usize = 20;

/// What a solve tells a proof.
#[derive(Debug, Default)]
pub(super) struct Kept {
    /// The best bound, with its point and multipliers.
    pub bound: f64,
    pub certificate: Multiplied,
    /// The bounds that were tightened before, until a row was missed.
    pub steps: Vec<Step>,
    pub missed: Option<usize>,
    /// The rows that contradict each other within the tightened bounds.
    pub contradiction: Vec<(u32, f64)>,
}

/// The relaxation of a form whose bounds change from node to node.
#[derive(Debug)]
pub(super) struct Relaxation<'a> {
    pub solver: DualActiveSet<'a>,
    /// The centre of the next proximal step, or nothing where the Hessian is definite.
    centre: Option<Vec<f64>>,
    /// The iterations that each of its solves may take.
    pub most: u64,
    /// What tightens the bounds of real unknowns, where an interior-point method solves the relaxations.
    pub interior: Option<Propagator>,
    /// What a proof is made from.
    pub kept: Option<Kept>,
}

/// What a solve of a relaxation has found.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Relaxed {
    /// The minimiser is at the solver's point; no point has less energy than the bound.
    Solved { bound: f64 },
    /// No point has less energy than the bound, which is at least the cutoff.
    Cutoff { bound: f64 },
    /// The energy falls for ever in this direction.
    Unbounded(Vec<f64>),
    /// No point is within the limits; the rows and their multipliers show it, or bounds tightened through rows if
    /// there are none.
    Infeasible(Vec<(u32, f64)>),
    /// The iterations were not enough, or the call is to end. The bound is true.
    Stopped { bound: f64 },
}

/// What is added to the diagonal of a singular block, for each unknown: small in the units of the objective
/// and of the unknown.
pub(super) fn regularization(form: &Form) -> Vec<f64> {
    let size = |limits: &Interval| match limits.width() {
        width if width.is_finite() && width > 0.0 => width.clamp(1e-3, 1e3),
        _ => 1.0,
    };
    let sizes: Vec<f64> = form.limits.iter().map(size).collect();
    let mut largest: f64 = 0.0;
    for (q, size) in form.gradient.iter().zip(&sizes) {
        largest = largest.max((q * size).abs());
    }
    for (i, j, v) in form.hessian.entries() {
        largest = largest.max((v * sizes[i as usize] * sizes[j as usize]).abs());
    }
    let scale = if largest > 0.0 { largest } else { 1.0 };
    sizes.iter().map(|s| ADDED * scale / (s * s)).collect()
}

impl<'a> Relaxation<'a> {
    pub fn new(form: &'a Form, shared: &'a Shared) -> Self {
        Relaxation {
            interior: interior::is_for(form).then(|| Propagator::new(form)),
            ..Relaxation::without_interior(form, shared)
        }
    }

    fn without_interior(form: &'a Form, shared: &'a Shared) -> Self {
        let is_definite = shared.inverse.is_definite();
        let nearest = |limits: &Interval| limits.nearest(0.0);
        Relaxation {
            solver: DualActiveSet::new(form, shared),
            centre: (!is_definite).then(|| form.limits.iter().map(nearest).collect()),
            most: (ITERATIONS * (form.dim() + form.rows.rows() + 10)) as u64,
            interior: None,
            kept: None,
        }
    }

    /// Another relaxation of the same form.
    pub fn another(&self, shared: &'a Shared) -> Self {
        let form = self.solver.form();
        let interior = self.interior.as_ref().map(Propagator::another);
        Relaxation {
            interior,
            ..Relaxation::without_interior(form, shared)
        }
    }

    /// The bound that the solver's point and multipliers prove within `boxes`.
    fn bound(&mut self, boxes: &[Interval]) -> f64 {
        let form = self.solver.form();
        self.solver.work += (form.hessian.len() + form.rows.len()) as u64 * 3;
        let (point, active) = (self.solver.point(), self.solver.active());
        let bound = safe_bound(form, self.solver.inverse(), boxes, point, active);
        if let Some(kept) = &mut self.kept
            && (kept.certificate.point.is_empty() || bound > kept.bound)
        {
            let rows = active.iter().filter_map(|held| {
                let row = held.row.checked_sub(form.dim() as u32)?;
                Some((row, held.multiplier))
            });
            let (point, multipliers) = (point.to_vec(), rows.collect());
            kept.bound = bound;
            kept.certificate = Multiplied { point, multipliers };
        }
        bound
    }

    /// Solves the relaxation with the solver's limits. The minimum is above `cutoff` if the result says so;
    /// `boxes` are bounds on all unknowns for all points that matter.
    pub fn solve(&mut self, cutoff: f64, boxes: &[Interval]) -> Relaxed {
        let form = self.solver.form();
        if let Some(solved) = self.solve_inside(cutoff, boxes) {
            return solved;
        }
        let Some(centre) = self.centre.take() else {
            let level = cutoff - form.constant;
            return match self.solver.solve(level + 1e-9 * level.abs(), self.most) {
                Outcome::Optimal => Relaxed::Solved {
                    bound: self.bound(boxes),
                },
                Outcome::Cutoff => Relaxed::Cutoff {
                    bound: self.bound(boxes),
                },
                Outcome::Infeasible(rows) => Relaxed::Infeasible(rows),
                Outcome::Stopped => Relaxed::Stopped {
                    bound: self.bound(boxes),
                },
            };
        };
        let mut best = f64::NEG_INFINITY;
        let mut result = None;
        let mut steps = Proximal::from(centre);
        for _ in 0..STEPS {
            let gradient = steps.gradient(form, &self.solver.inverse().added);
            self.solver.set_gradient(gradient);
            let before = self.solver.iterations;
            match self.solver.solve(f64::INFINITY, self.most) {
                Outcome::Infeasible(rows) => {
                    result = Some(Relaxed::Infeasible(rows));
                    break;
                }
                Outcome::Stopped => {
                    result = Some(Relaxed::Stopped { bound: best });
                    break;
                }
                Outcome::Optimal | Outcome::Cutoff => {}
            }
            best = best.max(self.bound(boxes));
            if best >= cutoff {
                result = Some(Relaxed::Cutoff { bound: best });
                break;
            }
            let (point, limits) = (self.solver.point(), self.solver.limits());
            let is_new = self.solver.iterations > before + 1;
            let added = &self.solver.inverse().added;
            let has_moved = match steps.follow(form, limits, added, point, is_new) {
                Led::To { has_moved } => has_moved,
                Led::Away(ray) => {
                    result = Some(Relaxed::Unbounded(ray));
                    break;
                }
            };
            if !has_moved || self.is_close(best, cutoff) {
                break;
            }
        }
        self.centre = Some(steps.centre);
        result.unwrap_or(Relaxed::Solved { bound: best })
    }

    /// Whether the bound is as close to the energy of the solver's point as further steps would matter.
    fn is_close(&self, bound: f64, cutoff: f64) -> bool {
        let energy = self.solver.form().energy(self.solver.point());
        let mut close = CLOSE * energy.abs().max(1e-3);
        if cutoff.is_finite() && !self.is_integral() {
            // The node is branched on whatever further steps find.
            let missing = (PART * (cutoff - energy)).min(ROUGH * energy.abs());
            close = close.max(missing);
        }
        energy - bound <= close
    }

    /// Whether further steps may leave all integers of the solver's point integral.
    fn is_integral(&self) -> bool {
        let unknowns = self.solver.form().integer.iter().zip(self.solver.point());
        let mut integers = unknowns.filter(|(is_integer, _)| **is_integer);
        integers.all(|(_, x)| (x - x.round()).abs() <= NEAR)
    }

    /// Starts the next solve from these rows. The interior-point method has no use for them.
    pub fn start_from(&mut self, warm: &[Active]) {
        if self.interior.is_none() {
            self.solver.start_from(warm);
        }
    }

    /// What the interior-point method says, where it is used and has a result.
    fn solve_inside(&mut self, cutoff: f64, boxes: &[Interval]) -> Option<Relaxed> {
        let form = self.solver.form();
        let propagator = self.interior.as_mut()?;
        let mut tight = boxes.to_vec();
        propagator.steps = self.kept.as_ref().map(|_| Vec::new());
        let tightened = propagator.all(form, &mut tight, true, ROUNDS);
        if let Some((kept, steps)) = self.kept.as_mut().zip(propagator.steps.take()) {
            kept.steps = steps;
            kept.missed = tightened.as_ref().err().copied();
        }
        if tightened.is_err() {
            return Some(Relaxed::Infeasible(Vec::new()));
        }
        match interior::solve(form, self.solver.limits(), &tight) {
            Ended::Solved { point, rows, work } => {
                self.solver.take(point, rows);
                self.solver.work += work;
                let bound = self.bound(&tight);
                Some(match bound >= cutoff {
                    true => Relaxed::Cutoff { bound },
                    false => Relaxed::Solved { bound },
                })
            }
            Ended::Empty(rows) => {
                if let Some(kept) = &mut self.kept {
                    kept.contradiction = rows;
                }
                Some(Relaxed::Infeasible(Vec::new()))
            }
            Ended::Stopped => Some(Relaxed::Stopped {
                bound: f64::NEG_INFINITY,
            }),
            Ended::Failed => {
                self.solver.start_from(&[]);
                None
            }
        }
    }

    /// An estimate of the minimum with the solver's limits after few iterations: a bound of the proximal
    /// problem, or infinity where no point exists.
    pub fn probe(&mut self, cutoff: f64, iterations: u64) -> f64 {
        let form = self.solver.form();
        let level = cutoff - form.constant;
        match self.solver.solve(level, iterations) {
            Outcome::Infeasible(_) => f64::INFINITY,
            _ => form.constant + self.solver.dual_objective(),
        }
    }

    /// The rows that are active, from which another node may start.
    pub fn active(&self) -> &[Active] {
        self.solver.active()
    }
}

#[cfg(test)]
mod tests {
    use super::super::implied_bounds::tests::layout;
    use super::super::safe_bound::is_contradiction;
    use super::*;
    use crate::{Model, Problem};

    fn solved(form: &Form, cutoff: f64) -> (f64, u64) {
        let shared = Shared::new(form, &regularization(form)).unwrap();
        let mut relaxation = Relaxation::new(form, &shared);
        match relaxation.solve(cutoff, &form.boxes) {
            Relaxed::Solved { bound } => (bound, relaxation.solver.iterations),
            other => panic!("{other:?}"),
        }
    }

    fn of_problem(problem: &Problem) -> Form {
        Form::of(problem, &Model::new(problem).unwrap()).unwrap()
    }

    /// The energy falls along `x2`, by steps that are short beside the width of `x0`.
    #[test]
    fn a_ray_is_found_beside_wide_bounds() {
        let mut problem = Problem::new(3).unwrap();
        let infinite = f64::INFINITY;
        problem
            .add_least_squares(&[0, 1], &[3.0, -1.0], 0.5, 1.0)
            .unwrap();
        problem.add_linear(&[0.0, 0.0, 1e-6]).unwrap();
        problem
            .set_bounds(&[0, 2], &[0.0, -infinite], &[400.0, infinite])
            .unwrap();
        let form = of_problem(&problem);
        let shared = Shared::new(&form, &regularization(&form)).unwrap();
        let found = Relaxation::new(&form, &shared).solve(infinite, &form.boxes);
        assert_eq!(found, Relaxed::Unbounded(vec![0.0, 0.0, -1.0]));
    }

    /// A slope that is small beside others in the objective makes steps short, and there are many to the limit.
    #[test]
    fn repeated_steps_are_made_at_once() {
        let mut problem = Problem::new(3).unwrap();
        problem
            .add_least_squares(&[0, 1], &[300.0, -1.0], 0.5, 1.0)
            .unwrap();
        problem.add_linear(&[0.0, 0.0, 1e-3]).unwrap();
        problem
            .add_inequality(&[1, 2], &[1.0, 1.0], -1e6, f64::INFINITY)
            .unwrap();
        problem.set_bounds(&[0, 1], &[0.0; 2], &[9.0; 2]).unwrap();
        let form = of_problem(&problem);
        let shared = Shared::new(&form, &regularization(&form)).unwrap();
        let mut relaxation = Relaxation::new(&form, &shared);
        let Relaxed::Solved { bound } = relaxation.solve(f64::INFINITY, &form.boxes) else {
            panic!("it has a minimum");
        };
        let least = -1e3 - 9e-3;
        assert!(bound <= least, "{bound}");
        assert!(form.energy(relaxation.solver.point()) < least + 1e-6);
    }

    /// Rounding errors leave `1e-12` of a row that has nothing to do with the contradiction, and a free unknown in it.
    #[test]
    fn a_negligible_multiplier_leaves_no_doubt() {
        let mut problem = Problem::new(2).unwrap();
        let infinite = f64::INFINITY;
        for (row, side) in [([1.0, 0.0], 1.0), ([-1.0, 0.0], 0.0), ([0.0, 1.0], 0.0)] {
            problem
                .add_inequality(&[0, 1], &row, side, infinite)
                .unwrap();
        }
        let form = of_problem(&problem);
        let rows = |third| [(2, -1.0), (3, -1.0), (4, third)];
        assert!(is_contradiction(&form, &form.boxes, &rows(-1e-12)));
        assert!(!is_contradiction(&form, &form.boxes, &rows(-1e-3)));
    }

    #[test]
    fn a_node_far_from_the_cutoff_takes_fewer_steps() {
        let mut form = layout(&[20.0, 21.0, 23.0, 26.0], &[5.0, 3.0, 6.0, 4.0], 0.1);
        form.constant += 100.0;
        // No distance is larger, and so the bound is not far off after some steps.
        for side in form.boxes.iter_mut() {
            side.upper = side.upper.min(50.0);
        }
        let mut real = form.clone();
        real.integer.fill(false);
        let (exact, steps) = solved(&real, f64::INFINITY);
        let (bound, fewer) = solved(&form, exact + 1e6);
        assert!(
            bound <= exact && exact - bound <= 1.1 * ROUGH * exact,
            "{exact} {bound}"
        );
        assert!(fewer < steps, "{fewer} {steps}");
        // Near the cutoff and without one, the bound is exact.
        for cutoff in [exact + 1e-5, f64::INFINITY] {
            let (bound, _) = solved(&form, cutoff);
            assert!((exact - bound).abs() <= 1e-7, "{exact} {bound}");
        }
        // Where all integers are integral, the bound is exact.
        let mut decided = layout(&[20.0, 30.0], &[5.0, 3.0], 0.1);
        decided.limits[3] = Interval::point(1.0);
        let (bound, _) = solved(&decided, 1e6);
        decided.integer.fill(false);
        let (exact, _) = solved(&decided, f64::INFINITY);
        assert!((exact - bound).abs() <= 1e-9, "{exact} {bound}");
    }
}
