//! Proximal steps to a minimiser of a form that is not definite (`rockafellar1976`).
//!
//! Each step minimises `E(x) + 1/2 (x - y)' D (x - y)` with a centre `y`, which then follows the point: mixed with the
//! centres before where the steps change, and as far as the limits allow where they are all the same.

use super::form::{Form, Interval};
use super::working_set::Ldl;

/// The steps that mixing remembers.
const REMEMBERED: usize = 6;

/// A step whose square has changed by less than this part is the same as before: so are the steps along a ray.
const CHANGED: f64 = 1e-12;

/// A step below this part of all values is none.
const MOVED: f64 = 1e-10;

/// Repeated steps go beyond the limit by this factor, so that it does not lie within the tolerance of its row.
const BEYOND: f64 = 1.001;

/// Steps that differ by less than this part are the same: mixing makes no use of their difference.
const SAME: f64 = 1e-6;

/// A component of a direction below this part of the largest is zero.
const STILL: f64 = 1e-7;

/// The centre of the next step, and what the last steps were.
#[derive(Debug)]
pub(super) struct Proximal {
    pub centre: Vec<f64>,
    last: Vec<f64>,
    mixing: Mixing,
}

/// Where a step has led.
pub(super) enum Led {
    /// The values have moved, or not.
    To { has_moved: bool },
    /// The energy falls for ever in this direction.
    Away(Vec<f64>),
}

impl Proximal {
    pub fn from(centre: Vec<f64>) -> Self {
        Proximal {
            centre,
            last: Vec::new(),
            mixing: Mixing::default(),
        }
    }

    /// The gradient of the form with the pull to the centre.
    pub fn gradient(&self, form: &Form, added: &[f64]) -> Vec<f64> {
        let terms = form.gradient.iter().zip(added).zip(&self.centre);
        terms.map(|((q, added), y)| q - added * y).collect()
    }

    /// Moves the centre after a step has found a point, whose active rows are `new` or those of the step before.
    pub fn follow(
        &mut self,
        form: &Form,
        limits: &[Interval],
        added: &[f64],
        point: &[f64],
        new: bool,
    ) -> Led {
        let step: Vec<f64> = point.iter().zip(&self.centre).map(|(x, y)| x - y).collect();
        let moved = step
            .iter()
            .zip(point)
            .map(|(d, x)| d.abs() / x.abs().max(1.0));
        let has_moved = moved.fold(0.0, f64::max) > MOVED;
        let is_repeated = has_moved && is_same(&step, &self.last);
        if let Some(ray) = ray(form, limits, step.clone(), is_repeated) {
            return Led::Away(ray);
        }
        let more = match is_repeated {
            true => steps_within(form, limits, point, &step),
            false => 0.0,
        };
        if new {
            self.mixing = Mixing::default();
        }
        if more > 0.0 && more.is_finite() {
            for ((y, x), d) in self.centre.iter_mut().zip(point).zip(&step) {
                *y = x + BEYOND * more * d;
            }
            self.mixing = Mixing::default();
        } else {
            self.mixing.next(&mut self.centre, point, &step, added);
        }
        self.last = step;
        Led::To { has_moved }
    }
}

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
    /// Replaces the centre by the next one. `step` has led to the point, `weights` give its norm.
    fn next(&mut self, centre: &mut [f64], point: &[f64], step: &[f64], weights: &[f64]) {
        let product = |a: &[f64], b: &[f64]| -> f64 {
            let terms = a.iter().zip(b).zip(weights);
            terms.map(|((a, b), w)| a * b * w).sum()
        };
        let len = product(step, step);
        centre.copy_from_slice(point);
        let k = self.steps.len();
        let difference = |others: &[Vec<f64>], own: &[f64]| -> Vec<Vec<f64>> {
            let minus = |other: &Vec<f64>| own.iter().zip(other).map(|(a, b)| a - b).collect();
            others.iter().map(minus).collect()
        };
        let changes = difference(&self.steps, step);
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
        let mut weights: Vec<f64> = used.iter().map(|&i| product(&changes[i], step)).collect();
        factor.solve(&mut weights);
        for (&i, weight) in used.iter().zip(&weights) {
            for (y, (x, old)) in centre.iter_mut().zip(point.iter().zip(&self.points[i])) {
                *y -= weight * (x - old);
            }
        }
        if k < REMEMBERED {
            self.points.push(point.to_vec());
            self.steps.push(step.to_vec());
        } else {
            self.points[self.next].copy_from_slice(point);
            self.steps[self.next].copy_from_slice(step);
            self.next = (self.next + 1) % REMEMBERED;
        }
    }
}

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
