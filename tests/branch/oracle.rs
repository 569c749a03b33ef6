//! The answer in exact arithmetic: all integers within the bounds that matter, and for each the real unknowns
//! by an exact quadratic program.

use super::instance::{Instance, NONE};
use super::lcp::{Answer, Program};
use super::rational::{Quadratic, exact, zero};
use num_rational::BigRational;

/// Integers without a bound are first tried up to this distance from zero.
const NEAR: f64 = 12.0;

/// More points than this are not tried.
const POINTS: u64 = 60_000;

#[derive(Debug)]
pub enum Truth {
    Optimum(BigRational),
    Infeasible,
    /// The energy falls for ever from some point.
    Unbounded,
    /// A row of reals has no point, or nothing near zero, and beyond is not decided.
    NothingNear,
    /// The numbers are too large for the oracle.
    TooLarge,
}

/// Numbers are multiplied by this power of two to become integers.
fn whole(values: &mut dyn Iterator<Item = f64>) -> Option<Vec<i128>> {
    let mut values: Vec<f64> = values.collect();
    while values.iter().any(|v| v.fract() != 0.0) {
        values.iter_mut().for_each(|v| *v *= 2.0);
        if values.iter().any(|v| v.abs() > 1e18) {
            return None;
        }
    }
    Some(values.iter().map(|&v| v as i128).collect())
}

/// A real unknown as multiples of unknowns that are not negative: `x = offset + sum_k sign_k y_k`.
struct Real {
    at: usize,
    offset: f64,
    columns: Vec<(usize, f64)>,
}

/// The program of the real unknowns, with the others fixed.
struct Continuous {
    program: Program,
    reals: Vec<Real>,
}

/// None where a number is too large, `Some(None)` where a row without real unknowns does not hold.
fn continuous(of: &Instance, is_real: &[bool], x: &[f64]) -> Option<Option<Continuous>> {
    let n = of.unknowns();
    let mut columns = 0;
    let mut reals = Vec::new();
    let mut x = x.to_vec();
    let mut uppers = Vec::new();
    for j in (0..n).filter(|&j| is_real[j]) {
        let (lower, upper) = of.limits(j);
        let own = columns;
        let (offset, parts) = match (lower.is_finite(), upper.is_finite()) {
            (true, _) => (lower, vec![(own, 1.0)]),
            (false, true) => (upper, vec![(own, -1.0)]),
            (false, false) => (0.0, vec![(own, 1.0), (own + 1, -1.0)]),
        };
        if lower.is_finite() && upper.is_finite() {
            uppers.push((own, upper - lower));
        }
        columns += parts.len();
        x[j] = offset;
        reals.push(Real {
            at: j,
            offset,
            columns: parts,
        });
    }
    let (mut rows, mut sides) = (Vec::new(), Vec::new());
    for (own, width) in uppers {
        let row = (0..columns).map(|k| if k == own { -1.0 } else { 0.0 });
        let mut row = whole(&mut row.chain([-width]))?;
        sides.push(row.pop()?);
        rows.push(row);
    }
    for row in &of.rows {
        let fixed: f64 = row.coefficients.iter().zip(&x).map(|(a, x)| a * x).sum();
        let mut dense = vec![0.0; columns];
        for real in &reals {
            for &(k, sign) in &real.columns {
                dense[k] = sign * row.coefficients[real.at];
            }
        }
        for (sign, side) in [(1.0, row.lower), (-1.0, row.upper)] {
            let side = sign * (side - fixed);
            if side == -NONE {
                continue;
            }
            if dense.iter().all(|a| *a == 0.0) {
                if side > 0.0 {
                    return Some(None);
                }
                continue;
            }
            let mut row = whole(&mut dense.iter().map(|a| sign * a).chain([side]))?;
            sides.push(row.pop()?);
            rows.push(row);
        }
    }
    let (hessian, gradient) = of.summed();
    let mut slopes = vec![0.0; columns];
    let mut curved = vec![vec![0.0; columns]; columns];
    for a in &reals {
        let slope = gradient[a.at] + (0..n).map(|j| hessian[a.at][j] * x[j]).sum::<f64>();
        for &(k, sign) in &a.columns {
            slopes[k] = sign * slope;
            for b in &reals {
                for &(l, other) in &b.columns {
                    curved[k][l] = sign * other * hessian[a.at][b.at];
                }
            }
        }
    }
    let objective = whole(&mut curved.into_iter().flatten().chain(slopes))?;
    let (hessian, gradient) = objective.split_at(columns * columns);
    Some(Some(Continuous {
        program: Program {
            hessian: hessian.chunks(columns.max(1)).map(<[_]>::to_vec).collect(),
            gradient: gradient.to_vec(),
            rows,
            sides,
        },
        reals,
    }))
}

/// Whether the problem has a point when all unknowns are real.
pub fn is_feasible_in_reals(of: &Instance) -> Option<bool> {
    let n = of.unknowns();
    if (0..n).any(|j| of.limits(j).0 > of.limits(j).1) {
        return Some(false);
    }
    match continuous(of, &vec![true; n], &vec![0.0; n])? {
        None => Some(false),
        Some(continuous) => continuous.program.is_feasible(),
    }
}

/// Whether the rows and bounds leave a direction in which the energy falls for ever.
fn has_ray(of: &Instance) -> Option<bool> {
    let n = of.unknowns();
    let (hessian, gradient) = of.summed();
    let recession = |side: f64| if side.is_finite() { 0.0 } else { side };
    let mut cone = of.clone();
    cone.pins = of.pins.iter().map(|pin| pin.map(|_| 0.0)).collect();
    cone.lower = of.lower.iter().map(|&l| recession(l)).collect();
    cone.upper = of.upper.iter().map(|&u| recession(u)).collect();
    for row in &mut cone.rows {
        (row.lower, row.upper) = (recession(row.lower), recession(row.upper));
    }
    let flat = hessian.into_iter().map(|row| (row, 0.0, 0.0));
    for (coefficients, lower, upper) in flat.chain([(gradient, -NONE, -1.0)]) {
        cone.rows.push(super::instance::Row {
            coefficients,
            lower,
            upper,
            is_constraint: false,
        });
    }
    debug_assert_eq!(cone.unknowns(), n);
    is_feasible_in_reals(&cone)
}

struct Search<'a> {
    of: &'a Instance,
    objective: &'a Quadratic,
    integers: Vec<usize>,
    is_real: Vec<bool>,
    box_of: Vec<(f64, f64)>,
    best: Option<BigRational>,
    /// Whether any point is enough.
    any: bool,
    points: u64,
}

impl Search<'_> {
    /// None where it is too large.
    fn run(&mut self, depth: usize, x: &mut Vec<f64>) -> Option<()> {
        if self.any && self.best.is_some() || !self.can_hold(depth, x) {
            return Some(());
        }
        if depth == self.integers.len() {
            self.points += 1;
            if self.points > POINTS {
                return None;
            }
            return self.leaf(x);
        }
        let j = self.integers[depth];
        let (mut value, upper) = self.box_of[j];
        while value <= upper {
            x[j] = value;
            self.run(depth + 1, x)?;
            value += 1.0;
        }
        x[j] = 0.0;
        Some(())
    }

    /// Whether the bounds of what is not fixed leave room for all rows.
    fn can_hold(&self, depth: usize, x: &[f64]) -> bool {
        let fixed = &self.integers[..depth];
        self.of.rows.iter().all(|row| {
            let (mut least, mut most) = (0.0, 0.0);
            for (j, &a) in row
                .coefficients
                .iter()
                .enumerate()
                .filter(|(_, a)| **a != 0.0)
            {
                let (lower, upper) = match fixed.contains(&j) {
                    true => (x[j], x[j]),
                    false => self.box_of[j],
                };
                least += (a * lower).min(a * upper);
                most += (a * lower).max(a * upper);
            }
            least <= row.upper && most >= row.lower
        })
    }

    fn leaf(&mut self, x: &[f64]) -> Option<()> {
        let Some(continuous) = continuous(self.of, &self.is_real, x)? else {
            return Some(());
        };
        let point = if continuous.reals.is_empty() {
            x.iter().map(|&x| exact(x)).collect()
        } else {
            if self.any {
                if continuous.program.is_feasible()? {
                    self.best = Some(zero());
                }
                return Some(());
            }
            let (numerators, denominator) = match continuous.program.solve() {
                Answer::TooLarge => return None,
                Answer::None => return Some(()),
                Answer::Minimiser(numerators, denominator) => (numerators, denominator),
            };
            let mut point: Vec<BigRational> = x.iter().map(|&x| exact(x)).collect();
            for real in &continuous.reals {
                point[real.at] = exact(real.offset);
                for &(k, sign) in &real.columns {
                    let value = BigRational::new(numerators[k].into(), denominator.into());
                    point[real.at] += exact(sign) * value;
                }
            }
            point
        };
        let energy = self.objective.energy(&point);
        if self.best.as_ref().is_none_or(|best| energy < *best) {
            self.best = Some(energy);
        }
        Some(())
    }
}

/// A box around all integers whose energy is at most `most`: squares of one unknown bound it, where nothing
/// else falls without a limit. `near` replaces what is unlimited.
fn boxes(of: &Instance, most: Option<f64>, near: Option<f64>) -> Option<Vec<(f64, f64)>> {
    let n = of.unknowns();
    let mut floor = of.constant;
    for j in 0..n {
        let (lower, upper) = of.limits(j);
        if of.linear[j] != 0.0 {
            floor += (of.linear[j] * lower).min(of.linear[j] * upper);
        }
    }
    if of.hessian.iter().flatten().any(|h| *h != 0.0) {
        floor = -NONE;
    }
    let of_unknown = |j: usize| {
        let (mut lower, mut upper) = of.limits(j);
        if !of.integer[j] {
            return Some((lower, upper));
        }
        for (row, rhs, weight) in &of.squares {
            let alone = row.iter().enumerate().all(|(k, a)| (k == j) == (*a != 0.0));
            if let (true, Some(most), true) = (alone, most, floor.is_finite()) {
                let radius = ((most - floor).max(0.0) / weight).sqrt() * (1.0 + 1e-9) + 1e-9;
                let ends = [(rhs - radius) / row[j], (rhs + radius) / row[j]];
                lower = lower.max(ends[0].min(ends[1]) - 1e-6);
                upper = upper.min(ends[0].max(ends[1]) + 1e-6);
            }
        }
        if let Some(near) = near {
            if !lower.is_finite() {
                lower = if upper.is_finite() {
                    upper.min(near) - 2.0 * near
                } else {
                    -near
                };
            }
            if !upper.is_finite() {
                upper = lower.max(-near) + 2.0 * near;
            }
        }
        (lower.is_finite() && upper.is_finite()).then(|| (lower.ceil(), upper.floor()))
    };
    (0..n).map(of_unknown).collect()
}

/// The least energy over the box, or nothing if it has no point. The outer None: too large.
fn least(of: &Instance, box_of: Vec<(f64, f64)>, any: bool) -> Option<Option<BigRational>> {
    let n = of.unknowns();
    let objective = of.objective();
    let mut search = Search {
        of,
        objective: &objective,
        integers: (0..n).filter(|&j| of.integer[j]).collect(),
        is_real: of.integer.iter().map(|i| !i).collect(),
        box_of,
        best: None,
        any,
        points: 0,
    };
    search.run(0, &mut vec![0.0; n])?;
    Some(search.best)
}

/// The truth about a problem whose objective is convex.
pub fn truth(of: &Instance) -> Truth {
    let of = of.origin.as_deref().unwrap_or(of);
    decide(of).unwrap_or(Truth::TooLarge)
}

/// Whether the greatest common divisor of a row of integers leaves no value between its sides.
fn misses_all_multiples(of: &Instance) -> Option<bool> {
    for row in &of.rows {
        let used = row.coefficients.iter().zip(&of.integer);
        if used.clone().any(|(a, integer)| *a != 0.0 && !integer) {
            continue;
        }
        let scale = 1e6_f64.log2().ceil().exp2();
        let sides = [row.lower, row.upper].map(|side| side * scale);
        let scaled = whole(&mut row.coefficients.iter().map(|a| a * scale))?;
        let divisor = scaled.iter().fold(0_i128, |g, &a| gcd(g, a.abs())) as f64;
        if divisor > 0.0 && (sides[0] / divisor).ceil() > (sides[1] / divisor).floor() {
            return Some(true);
        }
    }
    Some(false)
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The instance with the bounds of integers that its rows imply, rounded outwards.
fn implied(of: &Instance) -> Instance {
    let mut tight = of.clone();
    for _ in 0..20 {
        for row in &of.rows {
            for j in 0..of.unknowns() {
                let a = row.coefficients[j];
                if a == 0.0 || !of.integer[j] {
                    continue;
                }
                let (mut least, mut most) = (0.0, 0.0);
                for (k, &b) in row.coefficients.iter().enumerate() {
                    if k != j && b != 0.0 {
                        let (lower, upper) = tight.limits(k);
                        least += (b * lower).min(b * upper);
                        most += (b * lower).max(b * upper);
                    }
                }
                let ends = [(row.lower - most) / a, (row.upper - least) / a];
                let (lower, upper) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                tight.lower[j] = tight.lower[j].max((lower - 1e-6).ceil());
                tight.upper[j] = tight.upper[j].min((upper + 1e-6).floor());
            }
        }
    }
    tight
}

fn decide(given: &Instance) -> Option<Truth> {
    if !is_feasible_in_reals(given)? || misses_all_multiples(given)? {
        return Some(Truth::Infeasible);
    }
    let of = &implied(given);
    if !is_feasible_in_reals(of)? {
        return Some(Truth::Infeasible);
    }
    let finite = boxes(of, None, None);
    let is_finite = finite.is_some();
    if has_ray(of)? {
        let near = finite.or_else(|| boxes(of, None, Some(NEAR)))?;
        return Some(match least(of, near, true)? {
            Some(_) => Truth::Unbounded,
            None if is_finite => Truth::Infeasible,
            None => Truth::NothingNear,
        });
    }
    if let Some(finite) = finite {
        return Some(match least(of, finite, false)? {
            Some(energy) => Truth::Optimum(energy),
            None => Truth::Infeasible,
        });
    }
    let near = boxes(of, None, Some(NEAR))?;
    let Some(energy) = least(of, near.clone(), false)? else {
        return Some(Truth::NothingNear);
    };
    let most = super::check::float(&energy);
    let all = boxes(of, Some(most + 1e-6 * most.abs() + 1e-6), None)?;
    let inside = |a: &(f64, f64), b: &(f64, f64)| a.0 >= b.0 && a.1 <= b.1;
    if all
        .iter()
        .zip(&near)
        .zip(&of.integer)
        .all(|((a, b), i)| !i || inside(a, b))
    {
        return Some(Truth::Optimum(energy));
    }
    least(of, all, false)?.map(Truth::Optimum)
}
