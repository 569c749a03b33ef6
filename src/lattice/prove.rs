//! A schedule of enumerations whose radii grow to that of the best point: a bound at any time.
//!
//! A ball that was searched to its end without finding a point proves its radius. The nodes of
//! an enumeration are predicted well by the volumes of balls over those of the projected lattices
//! (Hanrot, Stehle 2007, section 4; Gama, Nguyen, Regev 2010, section 2), so radii are chosen
//! whose enumerations cost sixteen times as much from one to the next: all smaller balls together
//! cost a fifteenth of the last.

use super::Basis;

/// Nodes of the first enumeration.
pub const FIRST: f64 = 1e4;

/// The factor between one enumeration's nodes and the next one's.
pub const GROWTH: f64 = 16.0;

/// The nodes to expect of an enumeration within squared distance `square`.
pub fn predicted_nodes(basis: &Basis, square: f64) -> f64 {
    let m = basis.rank();
    // The logarithm of the volume of the ball over the product of the levels.
    let mut log = 0.0;
    let mut nodes = 0.0;
    for d in 1..=m {
        log += log_unit_ball(d) - log_unit_ball(d - 1) + 0.5 * square.ln();
        log -= basis.r(m - d, m - d).ln();
        nodes += log.exp();
    }
    nodes
}

/// The squared radius whose enumeration should take so many nodes, but at most `largest`.
pub fn radius_for(basis: &Basis, nodes: f64, largest: f64) -> f64 {
    if predicted_nodes(basis, largest) <= nodes {
        return largest;
    }
    let (mut low, mut high) = (0.0, largest);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if predicted_nodes(basis, middle) <= nodes {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
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

    #[test]
    fn predictions_come_true_within_a_factor_of_two() {
        let n = 14;
        let entry = |i: usize, j: usize| {
            if i == j {
                2.0
            } else {
                1.0 / (1 + i + j) as f64
            }
        };
        let values = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let mut basis = Basis::new(&Gram::new(n, values).unwrap());
        lll(&mut basis, 5).unwrap();
        let point: Vec<f64> = (0..n).map(|i| 0.37 * i as f64).collect();
        let target = Target::new(&basis, &point).unwrap();
        // Few lattice points lie in small balls, so radii stay below the closest one.
        let radius = radius_for(&basis, 3000.0, f64::MAX);
        let limits = Limits {
            radius,
            margin: 0.0,
            nodes: u64::MAX,
        };
        let found = enumerate(&basis, &target, limits, &mut |_| false);
        // Each visited node is looked at once more when its level ends.
        let ratio = found.nodes as f64 / 3000.0;
        assert!((0.5..4.0).contains(&ratio), "{ratio}");
    }
}
