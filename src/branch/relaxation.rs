//! The continuous relaxation of a node, and its bound.
//!
//! The dual active-set method needs a Hessian that is definite. Where it is not, a small multiple of a diagonal
//! is added and taken out again by proximal steps (`rockafellar1976`): each step minimises
//! `E(x) + 1/2 (x - y)' D (x - y)`, with `y` the point of the step before. On a linear part one or two steps
//! are exact.

use super::dual_active_set::{Active, DualActiveSet, Outcome};
use super::form::{Form, Interval};
use super::interior::{self, Ended};
use super::propagate::Propagator;
use super::safe_bound::safe_bound;
use super::shared::Shared;
use super::working_set::Ldl;
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
        let Some(mut centre) = self.centre.take() else {
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
        let mut mixing = Mixing::default();
        let mut last = Vec::new();
        for _ in 0..STEPS {
            let gradient = form
                .gradient
                .iter()
                .zip(&self.solver.inverse().added)
                .zip(&centre);
            let gradient = gradient.map(|((q, added), y)| q - added * y).collect();
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
            let energy = form.energy(self.solver.point());
            let moved = self.solver.point().iter().zip(&centre);
            let moved = moved.map(|(x, y)| (x - y).abs() / x.abs().max(1.0));
            let moved = moved.fold(0.0, f64::max);
            let step = self.solver.point().iter().zip(&centre).map(|(x, y)| x - y);
            let step: Vec<f64> = step.collect();
            let is_repeated = moved > MOVED && is_same(&step, &last);
            if let Some(ray) = ray(form, self.solver.limits(), step.clone(), is_repeated) {
                result = Some(Relaxed::Unbounded(ray));
                break;
            }
            if self.solver.iterations > before + 1 {
                mixing = Mixing::default();
            }
            let more = match is_repeated {
                true => steps_within(form, self.solver.limits(), self.solver.point(), &step),
                false => 0.0,
            };
            if more > 0.0 && more.is_finite() {
                for ((y, x), d) in centre.iter_mut().zip(self.solver.point()).zip(&step) {
                    *y = x + BEYOND * more * d;
                }
                mixing = Mixing::default();
            } else {
                mixing.next(
                    &mut centre,
                    self.solver.point(),
                    &self.solver.inverse().added,
                );
            }
            last = step;
            let mut close = CLOSE * energy.abs().max(1e-3);
            if cutoff.is_finite() && !self.is_integral() {
                // The node is branched on whatever further steps find.
                let missing = (PART * (cutoff - energy)).min(ROUGH * energy.abs());
                close = close.max(missing);
            }
            if energy - best <= close || moved <= MOVED {
                break;
            }
        }
        self.centre = Some(centre);
        result.unwrap_or(Relaxed::Solved { bound: best })
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

/// The steps that mixing remembers.
const REMEMBERED: usize = 6;

/// A step whose square has changed by less than this part is the same as before: so are the steps along a ray.
const CHANGED: f64 = 1e-12;

/// The next centre from the last ones, so that proximal steps converge like a Krylov method once the active rows
/// stay the same (Anderson mixing, `walker2011`).
#[derive(Debug, Default)]
struct Mixing {
    /// Points and steps, in a cycle.
    points: Vec<Vec<f64>>,
    steps: Vec<Vec<f64>>,
    next: usize,
}

impl Mixing {
    /// Replaces the centre by the next one. `point` is what the proximal step has found, `weights` give its norm.
    fn next(&mut self, centre: &mut [f64], point: &[f64], weights: &[f64]) {
        let step: Vec<f64> = point.iter().zip(&*centre).map(|(x, y)| x - y).collect();
        let product = |a: &[f64], b: &[f64]| -> f64 {
            let terms = a.iter().zip(b).zip(weights);
            terms.map(|((a, b), w)| a * b * w).sum()
        };
        let len = product(&step, &step);
        centre.copy_from_slice(point);
        let k = self.steps.len();
        let difference = |others: &[Vec<f64>], own: &[f64]| -> Vec<Vec<f64>> {
            let minus = |other: &Vec<f64>| own.iter().zip(other).map(|(a, b)| a - b).collect();
            others.iter().map(minus).collect()
        };
        let changes = difference(&self.steps, &step);
        let mut factor = Ldl::default();
        let mut used = Vec::new();
        for (i, change) in changes.iter().enumerate() {
            let products: Vec<f64> = used
                .iter()
                .map(|&j: &usize| product(change, &changes[j]))
                .collect();
            let square = product(change, change);
            let (row, left) = factor.next_row(&products, square);
            if left > 1e-10 * square && square > CHANGED * len {
                factor.append(row, left);
                used.push(i);
            }
        }
        let mut weights: Vec<f64> = used.iter().map(|&i| product(&changes[i], &step)).collect();
        factor.solve(&mut weights);
        for (&i, weight) in used.iter().zip(&weights) {
            for (y, (x, old)) in centre.iter_mut().zip(point.iter().zip(&self.points[i])) {
                *y -= weight * (x - old);
            }
        }
        if k < REMEMBERED {
            self.points.push(point.to_vec());
            self.steps.push(step);
        } else {
            self.points[self.next].copy_from_slice(point);
            self.steps[self.next] = step;
            self.next = (self.next + 1) % REMEMBERED;
        }
    }
}

/// A step below this part of all values is none.
const MOVED: f64 = 1e-10;

/// Repeated steps go beyond the limit by this factor, so that it does not lie within the tolerance of its row.
const BEYOND: f64 = 1.001;

/// Steps that differ by less than this part are the same: mixing makes no use of their difference.
const SAME: f64 = 1e-6;

/// A component of a direction below this part of the largest is zero.
const STILL: f64 = 1e-7;

/// Whether a step is the same as the last one. Along a curved direction, steps become shorter.
fn is_same(step: &[f64], last: &[f64]) -> bool {
    let differences = step.iter().zip(last).map(|(a, b)| (a - b).abs());
    let largest = step.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
    !last.is_empty() && differences.fold(0.0, f64::max) <= SAME * largest
}

/// How many more steps stay within the limits. Where steps are all the same, nothing else ends them.
fn steps_within(form: &Form, limits: &[Interval], point: &[f64], step: &[f64]) -> f64 {
    let within = |value: f64, rate: f64, size: f64, sides: Interval| {
        let side = if rate > 0.0 { sides.upper } else { sides.lower };
        match rate.abs() <= STILL * size {
            true => f64::INFINITY,
            false => ((side - value) / rate).max(0.0),
        }
    };
    let largest = step.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
    let unknowns = point.iter().zip(step).zip(limits);
    let unknowns = unknowns.map(|((&x, &d), &sides)| within(x, d, largest, sides));
    let rows = (0..).zip(&form.row_limits).map(|(i, &sides)| {
        let (mut value, mut rate, mut size) = (0.0, 0.0, 0.0);
        for (j, a) in form.rows.row(i) {
            value += a * point[j];
            rate += a * step[j];
            size += (a * step[j]).abs();
        }
        within(value, rate, size, sides)
    });
    unknowns.chain(rows).fold(f64::INFINITY, f64::min)
}

/// The direction, scaled to the largest absolute value 1, if the energy falls along it for ever: it has no
/// curvature, a negative slope, and leaves no limits. Its length must be larger than all widths of limits, or be that of
/// the step before.
fn ray(
    form: &Form,
    limits: &[Interval],
    mut direction: Vec<f64>,
    is_repeated: bool,
) -> Option<Vec<f64>> {
    let largest = direction.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
    let size = form.limits.iter().map(|l| match l.width() {
        width if width.is_finite() => width,
        _ => 0.0,
    });
    if largest <= size.fold(1.0, f64::max) && !is_repeated {
        return None;
    }
    direction.iter_mut().for_each(|d| {
        *d /= largest;
        if d.abs() <= STILL {
            *d = 0.0;
        }
    });
    let leaves = |d: f64, size: f64, limits: Interval| {
        (d > STILL * size && limits.upper.is_finite())
            || (d < -STILL * size && limits.lower.is_finite())
    };
    if direction
        .iter()
        .zip(limits)
        .any(|(&d, &l)| leaves(d, 1.0, l))
    {
        return None;
    }
    for (i, &sides) in form.row_limits.iter().enumerate() {
        let terms = form.rows.row(i).map(|(j, a)| a * direction[j]);
        let (sum, size) = terms.fold((0.0, 0.0), |(s, m): (f64, f64), t| (s + t, m + t.abs()));
        if leaves(sum, size, sides) {
            return None;
        }
    }
    let terms = form.gradient.iter().zip(&direction).map(|(q, d)| q * d);
    let (slope, size) = terms.fold((0.0, 0.0), |(s, m): (f64, f64), t| (s + t, m + t.abs()));
    let curved = form.hessian.mul_symmetric(&direction);
    let most = form
        .hessian
        .entries()
        .fold(0.0, |m: f64, (_, _, v)| m.max(v.abs()));
    let is_flat = curved.iter().all(|c| c.abs() <= STILL * most);
    (slope < -STILL * size && is_flat).then_some(direction)
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
