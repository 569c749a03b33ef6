//! A schedule of enumerations whose radii grow up to the distance of the best point. It yields a bound at
//! any time.
//!
//! If a ball contains no point, its radius is a bound. The nodes of an enumeration are predicted by the
//! volumes of balls divided by those of the projected lattices (`hanrot2007`, section 4; `gama2010`,
//! section 2). A known lower bound for the undecided coordinates of a level leaves a smaller ball for the
//! decided ones. The prediction uses the average volume of that ball ([`Diagonals::moments`]). Each
//! enumeration should cost sixteen times as much as the one before. So all smaller balls together cost a
//! fifteenth of the last.

use super::{Basis, Diagonals};

/// The nodes of the first enumeration.
pub const FIRST: f64 = 1e4;

/// The ratio of the nodes of an enumeration to those of the one before.
pub const GROWTH: f64 = 16.0;

/// The predicted nodes of an enumeration within squared distance `square`.
pub fn predicted_nodes(basis: &Basis, diagonals: Option<&Diagonals>, square: f64) -> f64 {
    sum_of_levels(&levels(basis, diagonals), square)
}

/// The squared radius, at most `largest`, for which this number of nodes is predicted.
pub fn radius_for(basis: &Basis, diagonals: Option<&Diagonals>, nodes: f64, largest: f64) -> f64 {
    let levels = levels(basis, diagonals);
    if sum_of_levels(&levels, largest) <= nodes {
        return largest;
    }
    // Bisection on the exponent, since a radius may have any magnitude.
    let (mut low, mut high) = (f64::MIN_POSITIVE.ln(), largest.ln());
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if sum_of_levels(&levels, middle.exp()) <= nodes {
            low = middle;
        } else {
            high = middle;
        }
    }
    low.exp()
}

/// The data that predict the nodes of a level.
struct Level {
    /// The number of coordinates decided on this level.
    decided: f64,
    /// The logarithm of the unit ball's volume divided by the volume of the lattice projected to these
    /// coordinates.
    log_volume: f64,
    /// The mean and variance of the bound for the undecided coordinates.
    added: (f64, f64),
}

fn levels(basis: &Basis, diagonals: Option<&Diagonals>) -> Vec<Level> {
    let m = basis.rank();
    let mut lattice = 0.0;
    let level = |d: usize| {
        lattice += basis.r(m - d, m - d).ln();
        Level {
            decided: d as f64,
            log_volume: log_unit_ball(d) - lattice,
            added: diagonals.map_or((0.0, 0.0), |all| all.moments(m - d)),
        }
    };
    (1..=m).map(level).collect()
}

/// The predicted nodes of a ball on all levels.
fn sum_of_levels(levels: &[Level], square: f64) -> f64 {
    levels.iter().map(|level| level.nodes(square)).sum()
}

impl Level {
    /// The expected volume of the remaining ball, from the greatest term of its integral (Laplace's
    /// method). The bound is assumed to be normally distributed and is not negative.
    fn nodes(&self, square: f64) -> f64 {
        let half = 0.5 * self.decided;
        let (mean, variance) = self.added;
        if variance == 0.0 {
            return (self.log_volume + half * square.ln()).exp();
        }
        let root = ((square - mean).powi(2) + 4.0 * half * variance).sqrt();
        let added = (0.5 * (square + mean - root)).max(0.0);
        let left = square - added;
        let unlikely = 0.5 * (added - mean).powi(2) / variance;
        let width = (1.0 + half * variance / (left * left)).sqrt();
        (self.log_volume + half * left.ln() - unlikely).exp() / width
    }
}

/// The logarithm of the volume of the unit ball: `V_d = V_(d-2) 2 pi / d`.
fn log_unit_ball(d: usize) -> f64 {
    let (mut log, mut k) = match d % 2 {
        0 => (0.0, 2),
        _ => (std::f64::consts::LN_2, 3),
    };
    while k <= d {
        log += (std::f64::consts::TAU / k as f64).ln();
        k += 2;
    }
    log
}

#[cfg(test)]
mod tests {
    use super::super::near_points::MOST;
    use super::super::{Gram, Limits, Target, enumerate, lll};
    use super::*;
    use crate::test_random::Random;

    #[test]
    fn unit_balls_have_their_volumes() {
        use std::f64::consts::PI;
        let volumes = [1.0, 2.0, PI, 4.0 / 3.0 * PI, PI * PI / 2.0];
        for (d, v) in volumes.into_iter().enumerate() {
            assert!((log_unit_ball(d).exp() - v).abs() < 1e-12, "{d}");
        }
    }

    /// The Gram matrix of `n` vectors that are nearly orthogonal.
    fn reduced(n: usize) -> Basis {
        let entry = |i: usize, j: usize| match i == j {
            true => 2.0,
            false => 1.0 / (1 + i + j) as f64,
        };
        let values = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let mut basis = Basis::new(&Gram::new(n, values).unwrap());
        lll(&mut basis, 5, &mut |_| false).unwrap();
        basis
    }

    /// The ratio of actual to predicted nodes, on average over targets.
    fn ratio(basis: &Basis, diagonals: Option<&Diagonals>, predicted: f64) -> f64 {
        let radius = radius_for(basis, diagonals, predicted, f64::MAX);
        // With this margin the points found do not shrink the ball, while they are few.
        let limits = Limits {
            radius,
            margin: radius,
            nodes: u64::MAX,
        };
        let mut random = Random::new(1);
        let targets = 400;
        let mut nodes = 0;
        for _ in 0..targets {
            let point: Vec<f64> = (0..basis.rank()).map(|_| random.next()).collect();
            let target = Target::new(basis, &point).unwrap();
            let found = enumerate(basis, &target, diagonals, limits, &mut |_| false);
            assert!(found.complete && found.near.len() < MOST);
            nodes += found.nodes;
        }
        nodes as f64 / targets as f64 / predicted
    }

    #[test]
    fn predictions_come_true() {
        // Each visited node is visited once more when its level ends.
        let basis = reduced(60);
        let plain = ratio(&basis, None, 1000.0);
        assert!((1.8..2.2).contains(&plain), "{plain}");
        let basis = reduced(24);
        let diagonals = Diagonals::new(&basis, &mut || false).unwrap();
        let cut = ratio(&basis, Some(&diagonals), 100.0);
        assert!((1.8..2.2).contains(&cut), "{cut}");
    }

    /// The probability that the bound is this number of steps of this length, for uniformly distributed
    /// fractional parts. The coordinates are added one by one.
    fn spread(diagonal: &[f64], step: f64, steps: usize) -> Vec<f64> {
        let mut likely = vec![0.0; steps];
        likely[0] = 1.0;
        for d in diagonal {
            // If x is uniform in (-1/2, 1/2), d x^2 is below y with this probability.
            let below = |y: f64| (2.0 * (y.max(0.0) / d).sqrt()).min(1.0);
            let adds = |j: usize| {
                let at = j as f64;
                below((at + 0.5) * step) - below((at - 0.5) * step)
            };
            let adds: Vec<f64> = (0..steps).map(adds).collect();
            let sum = |k: usize| (0..=k).map(|j| adds[j] * likely[k - j]).sum();
            likely = (0..steps).map(sum).collect();
        }
        likely
    }

    #[test]
    fn predictions_with_diagonals_are_the_volumes_of_what_is_left() {
        // Orthogonal edges of different lengths.
        let (n, steps) = (12, 1000);
        let square_of = |i: usize| 1.0 + (5 * i % n) as f64 / 6.0;
        let entry = |k: usize| match k / n == k % n {
            true => square_of(k % n),
            false => 0.0,
        };
        let gram = Gram::new(n, (0..n * n).map(entry).collect()).unwrap();
        let basis = Basis::new(&gram);
        let diagonals = Diagonals::new(&basis, &mut || false).unwrap();
        let mean = diagonals.moments(n).0;
        for part in [0.7, 1.0, 1.5] {
            let square = part * mean;
            let step = square / steps as f64;
            let on_level = |undecided: usize| -> f64 {
                let decided = n - undecided;
                let edges: f64 = (undecided..n).map(square_of).product();
                let ball = log_unit_ball(decided).exp() / edges.sqrt();
                let likely = spread(diagonals.level(undecided), step, steps);
                let left = |j: usize| (square - j as f64 * step).powf(0.5 * decided as f64);
                (0..steps).map(|j| ball * likely[j] * left(j)).sum()
            };
            let expected: f64 = (0..n).map(on_level).sum();
            let predicted = predicted_nodes(&basis, Some(&diagonals), square);
            let ratio = predicted / expected;
            assert!((0.98..1.07).contains(&ratio), "{part}: {ratio}");
            let back = radius_for(&basis, Some(&diagonals), predicted, f64::MAX);
            assert!((back / square - 1.0).abs() < 1e-9, "{back} for {square}");
        }
    }
}
