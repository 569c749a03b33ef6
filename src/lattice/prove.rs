//! A schedule of enumerations whose radii grow up to the distance of the best point, so that there is a bound
//! at any time.
//!
//! If a ball contains no point, its radius is a bound. The nodes of
//! an enumeration are predicted by the volumes of balls over those of the projected lattices
//! (`hanrot2007`, section 4; `gama2010`, section 2). Where a lower
//! bound is known for the undecided coordinates of a level, the decided ones are left with a smaller ball,
//! whose average volume is used ([`Diagonals::moments`]). Radii are chosen so that each enumeration costs
//! sixteen times as much as the one before. All smaller balls together then cost a fifteenth of the last.

use super::{Basis, Diagonals};

/// Nodes of the first enumeration.
pub const FIRST: f64 = 1e4;

/// The factor between one enumeration's nodes and the next one's.
pub const GROWTH: f64 = 16.0;

/// The nodes to expect of an enumeration within squared distance `square`.
pub fn predicted_nodes(basis: &Basis, diagonals: Option<&Diagonals>, square: f64) -> f64 {
    sum_of_levels(&levels(basis, diagonals), square)
}

/// The squared radius whose enumeration should take so many nodes, but at most `largest`.
pub fn radius_for(basis: &Basis, diagonals: Option<&Diagonals>, nodes: f64, largest: f64) -> f64 {
    let levels = levels(basis, diagonals);
    if sum_of_levels(&levels, largest) <= nodes {
        return largest;
    }
    // By halving the exponent's range: radii may be of any size.
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

/// What decides how many nodes a level has.
struct Level {
    /// Coordinates decided there.
    decided: f64,
    /// The logarithm of the volume of the unit ball over that of the lattice projected to them.
    log_volume: f64,
    /// Mean and variance of what the undecided coordinates add.
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

/// The nodes on all levels of a ball.
fn sum_of_levels(levels: &[Level], square: f64) -> f64 {
    levels.iter().map(|level| level.nodes(square)).sum()
}

impl Level {
    /// The expected volume of the ball that is left, by the greatest term of its integral
    /// (Laplace's method): what is added is taken for normally distributed, and is not negative.
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
    use super::super::{Gram, Limits, Target, enumerate, lll};
    use super::*;

    #[test]
    fn unit_balls_have_their_volumes() {
        use std::f64::consts::PI;
        let volumes = [1.0, 2.0, PI, 4.0 / 3.0 * PI, PI * PI / 2.0];
        for (d, v) in volumes.into_iter().enumerate() {
            assert!((log_unit_ball(d).exp() - v).abs() < 1e-12, "{d}");
        }
    }

    /// Nodes of an enumeration by nodes predicted, on average over targets.
    fn ratio(with_diagonals: bool, predicted: f64) -> f64 {
        // Few lattice points lie in balls of many dimensions, so radii stay as they are.
        let n = 60;
        let entry = |i: usize, j: usize| {
            if i == j {
                2.0
            } else {
                1.0 / (1 + i + j) as f64
            }
        };
        let values = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let mut basis = Basis::new(&Gram::new(n, values).unwrap());
        lll(&mut basis, 5, &mut |_| false).unwrap();
        let diagonals = with_diagonals.then(|| Diagonals::new(&basis, &mut || false).unwrap());
        let diagonals = diagonals.as_ref();
        let limits = Limits {
            radius: radius_for(&basis, diagonals, predicted, f64::MAX),
            margin: 0.0,
            nodes: u64::MAX,
        };
        let targets = 20;
        let nodes = |t: usize| {
            let spread = |i: usize| 43758.5453 * ((i + 91 * t) as f64 * 12.9898).sin();
            let point: Vec<f64> = (0..n).map(|i| spread(i).fract()).collect();
            let target = Target::new(&basis, &point).unwrap();
            enumerate(&basis, &target, diagonals, limits, &mut |_| false).nodes
        };
        (0..targets).map(nodes).sum::<u64>() as f64 / targets as f64 / predicted
    }

    #[test]
    fn predictions_come_true_within_a_factor_of_two() {
        // Each visited node is looked at once more when its level ends.
        let ratio = ratio(false, 3000.0);
        assert!((1.0..4.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn predictions_with_diagonals_are_not_too_low() {
        // What is cut on one level is not there to be cut on the next, which nobody predicts.
        let ratio = ratio(true, 300.0);
        assert!((0.01..4.0).contains(&ratio), "{ratio}");
    }
}
