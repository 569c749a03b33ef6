//! An exact oracle: energies as fractions, and the least energy by enumeration of all candidates.

use super::instance::{Instance, PARTS};

/// A fraction with a positive denominator.
#[derive(Debug, Clone, Copy)]
pub struct Exact {
    numerator: i128,
    denominator: i128,
}

/// Floating-point numbers are rounded to fractions with this denominator.
const GRID: f64 = (1u64 << 40) as f64;

/// Boxes with more candidates are not enumerated.
const LARGEST_BOX: f64 = 20_000.0;

impl Exact {
    /// `value`, rounded to a multiple of 2^-40.
    pub fn whole(value: f64) -> Self {
        Exact {
            numerator: (value * GRID).round() as i128,
            denominator: GRID as i128,
        }
    }

    /// The least energy over the continuous unknowns for the core integers `y`. With residuals r at the
    /// integers and columns C of the continuous unknowns it is `r'r - r'C (C'C)^-1 C'r`, by Cramer's rule.
    pub fn least(instance: &Instance, y: &[i64]) -> Self {
        let core = instance.core;
        let residual = |(row, rhs): (&Vec<i64>, &i64)| -> i128 {
            let sum: i64 = row[..core].iter().zip(y).map(|(a, y)| a * y).sum();
            i128::from(PARTS * sum - rhs)
        };
        let r: Vec<i128> = instance
            .rows
            .iter()
            .zip(&instance.rhs)
            .map(residual)
            .collect();
        let c = |k: usize| {
            instance
                .rows
                .iter()
                .map(move |row| i128::from(row[core + k]))
        };
        let with = |k: usize| c(k).zip(&r).map(|(c, r)| c * r).sum::<i128>();
        let pair = |k: usize, l: usize| c(k).zip(c(l)).map(|(a, b)| a * b).sum::<i128>();
        let square: i128 = r.iter().map(|r| r * r).sum();
        let (numerator, denominator) = match instance.continuous {
            0 => (square, 1),
            1 => (square * pair(0, 0) - with(0).pow(2), pair(0, 0)),
            _ => {
                let determinant = pair(0, 0) * pair(1, 1) - pair(0, 1).pow(2);
                let (a, b) = (with(0), with(1));
                let taken = a * a * pair(1, 1) - 2 * a * b * pair(0, 1) + b * b * pair(0, 0);
                (square * determinant - taken, determinant)
            }
        };
        Exact {
            numerator,
            denominator: denominator * i128::from(PARTS * PARTS),
        }
    }

    pub fn value(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// Compares two energies of one instance. They have the same denominator; products would overflow.
    fn is_less(self, other: Self) -> bool {
        assert_eq!(self.denominator, other.denominator);
        self.numerator < other.numerator
    }

    /// Whether two energies differ by at most `tolerance`, relative to energies larger than one.
    pub fn close_to(self, other: Self, tolerance: f64) -> bool {
        (self.value() - other.value()).abs() <= tolerance * self.value().abs().max(1.0)
    }
}

/// Whether `bound` is at most `least`, up to the rounding of both to doubles.
pub fn holds(bound: f64, least: Exact) -> bool {
    bound <= least.value() + 1e-12 * least.value().abs().max(1.0)
}

/// The least energy of all integer points, or nothing where there are too many to enumerate.
///
/// The energy is a quadratic function of the core integers. Differences of its values at integer points
/// give its gradient and curvature exactly. All points as good as the rounded minimiser lie in an
/// ellipsoid, and that lies in a box.
pub fn least_energy(instance: &Instance) -> Option<Exact> {
    let n = instance.core;
    let denominator = Exact::least(instance, &vec![0; n]).denominator;
    if denominator == 0 {
        return None;
    }
    // Compute the differences exactly, then round once.
    let at = |base: &[i64], steps: &[(usize, i64)]| -> i128 {
        let mut y = base.to_vec();
        steps.iter().for_each(|&(i, s)| y[i] += s);
        Exact::least(instance, &y).numerator
    };
    let number = |v: i128| v as f64 / denominator as f64;
    let zero = vec![0; n];
    let entry = |i: usize, j: usize| {
        let single = at(&zero, &[(i, 1)]) + at(&zero, &[(j, 1)]);
        number(at(&zero, &[(i, 1), (j, 1)]) + at(&zero, &[]) - single)
    };
    let curvature: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| entry(i, j)).collect())
        .collect();
    let solve = |b: Vec<f64>| super::common::dense_solve(curvature.clone(), b);
    let downhill = |base: &[i64]| -> Vec<f64> {
        let fall = |i: usize| at(base, &[(i, -1)]) - at(base, &[(i, 1)]);
        (0..n).map(|i| 0.5 * number(fall(i))).collect()
    };
    // Newton's method until the step rounds to zero: the first steps are long and round much. Where the
    // condition is too bad for convergence, no box can be trusted.
    let mut rounded = zero.clone();
    let mut settled = false;
    for _ in 0..20 {
        let step = solve(downhill(&rounded));
        settled = step.iter().all(|s| s.abs() < 0.6);
        if settled {
            break;
        }
        rounded
            .iter_mut()
            .zip(step)
            .for_each(|(y, s)| *y += s.round() as i64);
    }
    if !settled {
        return None;
    }
    let slope = downhill(&rounded);
    let step = solve(slope.clone());
    let minimiser: Vec<f64> = rounded
        .iter()
        .zip(&step)
        .map(|(&y, s)| y as f64 + s)
        .collect();
    let room: f64 = slope.iter().zip(&step).map(|(g, s)| 0.5 * g * s).sum();
    let half = |i: usize| {
        let inverse = solve((0..n).map(|k| f64::from(u8::from(k == i))).collect())[i];
        (2.0 * room.max(0.0) * inverse).sqrt() * (1.0 + 1e-3) + 1e-3
    };
    let half: Vec<f64> = (0..n).map(half).collect();
    let size: f64 = half.iter().map(|h| 2.0 * h + 1.0).product();
    if !size.is_finite() || size > LARGEST_BOX {
        return None;
    }
    let low: Vec<i64> = (0..n)
        .map(|i| (minimiser[i] - half[i]).ceil() as i64)
        .collect();
    let high: Vec<i64> = (0..n)
        .map(|i| (minimiser[i] + half[i]).floor() as i64)
        .collect();
    let mut y = low.clone();
    let mut least = Exact::least(instance, &rounded);
    loop {
        let here = Exact::least(instance, &y);
        if here.is_less(least) {
            least = here;
        }
        let Some(i) = (0..n).find(|&i| y[i] < high[i]) else {
            return Some(least);
        };
        y[i] += 1;
        y[..i].copy_from_slice(&low[..i]);
    }
}
