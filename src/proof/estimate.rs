//! A minorant's least value from below, in floats with all rounding errors counted.
//!
//! Most leaves are far above the bound that they must prove, and this is enough for them; the others are decided
//! in exact numbers. Every number is a ball: a float, and how far the true number may be from it.

use super::exact::Exact;
use super::format::Certificate;
use super::minorant::PartObjective;
use super::problem::{ExactProblem, Limits, Side};

/// Half a unit in the last place of 1, and a little more.
const UNIT: f64 = 0.5 * f64::EPSILON * (1.0 + 1e-6);

/// Integers up to this, and halves between them, are floats.
const LARGEST_INTEGER: f64 = (1u64 << 51) as f64;

/// All numbers within `radius` of `middle`.
#[derive(Debug, Clone, Copy, Default)]
struct Ball {
    middle: f64,
    radius: f64,
}

impl Ball {
    /// A ball around an exact number.
    fn around(x: &Exact) -> Self {
        Ball::rounded(x.near(), 3.0 * f64::MIN_POSITIVE)
    }

    fn float(x: f64) -> Self {
        Ball {
            middle: x,
            radius: 0.0,
        }
    }

    /// A middle that was rounded at most four times, and a radius before the rounding of its own.
    fn rounded(middle: f64, radius: f64) -> Self {
        let rounding = 4.0 * UNIT * middle.abs();
        Ball {
            middle,
            radius: (radius + rounding) * (1.0 + 8.0 * UNIT) + f64::MIN_POSITIVE,
        }
    }

    fn plus(self, other: Ball) -> Self {
        let middle = self.middle + other.middle;
        Ball {
            middle,
            radius: (self.radius + other.radius + UNIT * middle.abs()) * (1.0 + 4.0 * UNIT),
        }
    }

    fn times(self, other: Ball) -> Self {
        let middle = self.middle * other.middle;
        let spread = self.middle.abs() * other.radius
            + other.middle.abs() * self.radius
            + self.radius * other.radius;
        Ball {
            middle,
            radius: (spread + UNIT * middle.abs()) * (1.0 + 8.0 * UNIT) + f64::MIN_POSITIVE,
        }
    }

    fn minus(self) -> Self {
        Ball {
            middle: -self.middle,
            ..self
        }
    }

    fn least(self) -> f64 {
        (self.middle - self.radius).next_down()
    }

    fn largest(self) -> f64 {
        (self.middle.abs() + self.radius) * (1.0 + 2.0 * UNIT)
    }
}

/// `weight (terms . x - rhs)^2`.
#[derive(Debug)]
struct SquareOfBalls {
    weight: Ball,
    rhs: Ball,
    terms: Vec<(usize, Ball)>,
}

/// The objective of a part in balls.
#[derive(Debug, Default)]
pub(super) struct Floats {
    quadratic: Vec<(usize, usize, Ball)>,
    linear: Vec<Ball>,
    squares: Vec<SquareOfBalls>,
    curvature: Vec<Ball>,
    inverse_curvature: Vec<Ball>,
}

impl Floats {
    pub fn of(part: &PartObjective) -> Self {
        let entries = part.quadratic.iter();
        let squares = part.squares.iter().map(|square| {
            let terms = square.terms.iter().map(|(j, a)| (*j, Ball::around(a)));
            SquareOfBalls {
                weight: Ball::around(&square.weight),
                rhs: Ball::around(&square.rhs),
                terms: terms.collect(),
            }
        });
        Floats {
            quadratic: entries.map(|(i, j, v)| (*i, *j, Ball::around(v))).collect(),
            linear: part.linear.iter().map(Ball::around).collect(),
            squares: squares.collect(),
            curvature: part.curvature.iter().map(Ball::around).collect(),
            inverse_curvature: part.inverse_curvature.iter().map(Ball::around).collect(),
        }
    }
}

/// A minorant in balls, as [`Minorant`](super::minorant::Minorant) is in exact numbers.
#[derive(Debug)]
pub(super) struct Estimate {
    constant: Ball,
    slopes: Vec<Ball>,
    point: Vec<Ball>,
}

impl Estimate {
    /// The estimate of a certificate, or nothing for one with fractions, with faults, or with rows of other parts.
    pub fn of(
        problem: &ExactProblem,
        part: &PartObjective,
        floats: &Floats,
        certificate: &Certificate,
    ) -> Option<Self> {
        if certificate.point.len() != part.members.len() {
            return None;
        }
        let point: Option<Vec<Ball>> = certificate
            .point
            .iter()
            .map(|x| x.float().map(Ball::float))
            .collect();
        let point = point?;
        let mut constant = Ball::default();
        let mut slopes = vec![Ball::default(); point.len()];
        for &(i, j, v) in &floats.quadratic {
            slopes[i] = slopes[i].plus(v.times(point[j]));
            if i != j {
                slopes[j] = slopes[j].plus(v.times(point[i]));
            }
        }
        for (slope, x) in slopes.iter().zip(&point) {
            constant = constant.plus(slope.times(*x).times(Ball::float(-0.5)));
        }
        for (slope, q) in slopes.iter_mut().zip(&floats.linear) {
            *slope = slope.plus(*q);
        }
        for SquareOfBalls { weight, rhs, terms } in &floats.squares {
            let products = terms.iter().map(|(j, a)| a.times(point[*j]));
            let sum = products.fold(Ball::default(), Ball::plus);
            let pull = weight.times(sum.plus(rhs.minus())).times(Ball::float(2.0));
            let squares = rhs.times(*rhs).plus(sum.times(sum).minus());
            constant = constant.plus(weight.times(squares));
            for (j, a) in terms {
                slopes[*j] = slopes[*j].plus(pull.times(*a));
            }
        }
        for (row, multiplier) in &certificate.multipliers {
            let row = problem.rows.get(*row as usize)?;
            let multiplier = multiplier.float()?;
            let side = row.side(match multiplier > 0.0 {
                true => Side::Upper,
                false => Side::Lower,
            });
            let multiplier = Ball::float(multiplier);
            let held = multiplier.times(Ball::around(side.as_ref()?));
            constant = constant.plus(held.minus());
            for (j, a) in &row.terms {
                let k = part.place_of(*j)?;
                slopes[k] = slopes[k].plus(multiplier.times(Ball::around(a)));
            }
        }
        Some(Estimate {
            constant,
            slopes,
            point,
        })
    }

    /// A number that the minorant is nowhere below within the limits.
    pub fn least(&self, limits: &Limits, part: &PartObjective, floats: &Floats) -> f64 {
        let mut sum = self.constant;
        for (k, slope) in self.slopes.iter().enumerate() {
            let end = |side| limits.side(part.members[k], side).as_ref();
            let curvature = floats.curvature[k].middle;
            if curvature < 0.0 {
                // It is least at one of the ends.
                let (Some(lower), Some(upper)) = (end(Side::Lower), end(Side::Upper)) else {
                    return f64::NEG_INFINITY;
                };
                let [a, b] = [lower, upper].map(|end| self.term_at(k, Ball::around(end), floats));
                sum = sum.plus(if a.least() < b.least() { a } else { b });
                continue;
            }
            if curvature > 0.0
                && part.integer[k]
                && let Some(term) =
                    self.least_of_integer(k, [Side::Lower, Side::Upper].map(end), floats)
            {
                sum = sum.plus(term);
                continue;
            }
            if slope.middle == 0.0 && slope.radius == 0.0 {
                continue;
            }
            let term = match (end(Side::Lower), end(Side::Upper)) {
                (Some(lower), _) if slope.middle > slope.radius => slope.times(Ball::around(lower)),
                (_, Some(upper)) if -slope.middle > slope.radius => {
                    slope.times(Ball::around(upper))
                }
                (Some(lower), Some(upper)) => {
                    let most = Ball::around(lower)
                        .largest()
                        .max(Ball::around(upper).largest());
                    Ball::rounded(-slope.largest() * most, 0.0)
                }
                _ if curvature == 0.0 => return f64::NEG_INFINITY,
                _ => {
                    let inverse = floats.inverse_curvature[k];
                    let fall = slope.times(*slope).times(inverse).times(Ball::float(-0.5));
                    slope.times(self.point[k]).plus(fall)
                }
            };
            sum = sum.plus(term);
        }
        let least = sum.least();
        if least.is_nan() {
            f64::NEG_INFINITY
        } else {
            least
        }
    }

    /// What the terms of an integer with a positive curvature are nowhere below, unless rounding errors hide where they
    /// are least.
    fn least_of_integer(
        &self,
        k: usize,
        ends: [Option<&Exact>; 2],
        floats: &Floats,
    ) -> Option<Ball> {
        let (slope, curvature) = (self.slopes[k], floats.curvature[k]);
        let [lower, upper] = ends.map(|end| end.map(Exact::near));
        let free = (self.point[k].middle - slope.middle / curvature.middle).round();
        let at = free.max(lower.unwrap_or(free));
        let at = at.min(upper.unwrap_or(at));
        if at.abs() > LARGEST_INTEGER {
            return None;
        }
        // What the terms gain from one integer to the next, at most by rounding errors less than nothing. The next gain
        // is larger by the curvature.
        let gain = |from: f64| {
            let middle = Ball::float(from + 0.5).plus(self.point[k].minus());
            slope.plus(curvature.times(middle))
        };
        let up = match upper == Some(at) {
            true => 0.0,
            false => gain(at).least(),
        };
        let down = match lower == Some(at) {
            true => 0.0,
            false => gain(at - 1.0).minus().least(),
        };
        let lost = up.min(down).min(0.0);
        let term = self.term_at(k, Ball::float(at), floats);
        (-lost <= 0.5 * curvature.middle).then(|| term.plus(Ball::float(lost)))
    }

    /// The terms of one unknown at a value.
    fn term_at(&self, k: usize, at: Ball, floats: &Floats) -> Ball {
        let distance = at.plus(self.point[k].minus());
        let square = distance.times(distance).times(Ball::float(0.5));
        self.slopes[k]
            .times(at)
            .plus(square.times(floats.curvature[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::format::{Inequality, Number, Square, Statement};
    use crate::proof::minorant::{Minorant, Split};
    use crate::test_random::Random;

    /// A problem of three unknowns, the last of which has no bound, with numbers of all sizes.
    fn statement(random: &mut Random) -> Statement {
        let size = |random: &mut Random| random.next() * 2f64.powi(random.below(40) as i32 - 20);
        let terms = |random: &mut Random| (0..3).map(|j| (j, size(random))).collect();
        Statement {
            variables: 3,
            quadratic: vec![(0, 0, 3.3), (1, 0, 0.7), (1, 1, size(random))],
            linear: terms(random),
            constant: 0.0,
            least_squares: vec![Square {
                weight: size(random).abs(),
                rhs: size(random),
                terms: terms(random),
            }],
            constraints: Vec::new(),
            inequalities: vec![Inequality {
                lower: Some(size(random)),
                upper: None,
                terms: terms(random),
            }],
            bounds: vec![(0, Some(-0.3), Some(1e3)), (1, Some(-1.7e6), Some(0.1))],
            integers: Vec::new(),
            pins: Vec::new(),
        }
    }

    #[test]
    fn estimates_are_below_the_exact_minimum_and_near_it() {
        let random = &mut Random::new(7);
        let mut close = 0;
        for _ in 0..2000 {
            let (problem, limits) = ExactProblem::of(&statement(random)).unwrap();
            let mut split = Split::of(&problem, &limits, &[vec![0, 1, 2]]).unwrap();
            let part = &mut split.parts[0];
            part.set_curvature(&[0.0, -0.25, 0.125]).unwrap();
            let certificate = Certificate {
                point: (0..3).map(|_| Number::Float(random.next() * 9.1)).collect(),
                multipliers: vec![(0, Number::Float(-random.unit()))],
            };
            let floats = Floats::of(part);
            let estimate = Estimate::of(&problem, part, &floats, &certificate).unwrap();
            let least = estimate.least(&limits, part, &floats);
            let minorant = Minorant::of(&problem, &limits, part, &certificate).unwrap();
            let exact = minorant.least(&limits, part).unwrap();
            assert!(Exact::of(least).unwrap() <= exact);
            close += usize::from(exact.near() - least <= 1e-9 * exact.near().abs());
        }
        assert!(close > 1900, "{close}");
    }
}
