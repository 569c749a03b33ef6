//! The problems whose proofs are altered.

use roundel::{Problem, Triangle};

const NONE: f64 = f64::INFINITY;

/// Two parts and a pinned unknown. x0, x1 are integers with the free real x2 and a row that binds, x3, x4, x5 are
/// integers with a row of even coefficients whose sides are odd, and a constraint; x6 is pinned. Both trees branch.
pub fn small() -> Problem {
    let mut problem = Problem::new(7).unwrap();
    problem.add_least_squares(&[0], &[1.0], 2.4, 1.0).unwrap();
    problem.add_least_squares(&[1], &[1.0], 3.6, 1.0).unwrap();
    problem
        .add_least_squares(&[0, 1, 2], &[1.0, -1.0, 1.0], 0.3, 0.7)
        .unwrap();
    problem
        .add_least_squares(&[2, 6], &[1.0, 0.5], 0.9, 0.2)
        .unwrap();
    problem
        .add_quadratic_triplets(
            Triangle::Lower,
            &[3, 4, 4, 5],
            &[3, 3, 4, 5],
            &[2.0, 0.5, 3.0, 1.0],
        )
        .unwrap();
    problem
        .add_linear(&[0.0, 0.0, 0.0, -3.1, 1.7, -0.4, 0.0])
        .unwrap();
    problem.add_constant(1.25).unwrap();
    // Row 0.
    problem
        .add_constraint(&[3, 4, 5], &[1.0, 1.0, -1.0], 1.0)
        .unwrap();
    // Rows 1 and 2.
    problem
        .add_inequality(&[0, 1, 2], &[2.0, 3.0, 0.5], -NONE, 12.25)
        .unwrap();
    problem
        .add_inequality(&[3, 4], &[2.0, -4.0], -5.0, 7.0)
        .unwrap();
    let all: Vec<usize> = (0..7).collect();
    let lower = [0.0, 0.0, -NONE, -3.0, -3.0, -6.0, -NONE];
    let upper = [10.0, 10.0, NONE, 3.0, 3.0, 6.0, NONE];
    problem.set_bounds(&all, &lower, &upper).unwrap();
    problem.set_integers(&[0, 1, 3, 4, 5]).unwrap();
    problem.pin(6, 2.5).unwrap();
    problem
}

/// No point: of five integers on a cycle no two neighbours may be one, and their sum with a small real is to be above
/// two. Reals could, which only branches and sums of rows exclude.
pub fn empty() -> Problem {
    let mut problem = Problem::new(6).unwrap();
    for j in 0..6 {
        problem.add_least_squares(&[j], &[1.0], 0.4, 1.0).unwrap();
    }
    for j in 0..5 {
        problem
            .add_inequality(&[j, (j + 1) % 5], &[1.0, 1.0], -NONE, 1.0)
            .unwrap();
    }
    let all = [0, 1, 2, 3, 4, 5];
    problem.add_inequality(&all, &[1.0; 6], 2.2, NONE).unwrap();
    problem
        .set_bounds(&all, &[0.0; 6], &[1.0, 1.0, 1.0, 1.0, 1.0, 0.125])
        .unwrap();
    problem.set_integers(&[0, 1, 2, 3, 4]).unwrap();
    problem
}

/// Differences of three integers and a real number, which moves by halves. A bound and a row hold them from some step
/// on, and x4 moves apart.
pub fn translated() -> Problem {
    let mut problem = Problem::new(5).unwrap();
    for (row, side) in [
        ([-1.0, 1.0, 0.0, 0.0], 0.375),
        ([0.0, -1.0, 1.0, 0.0], 0.625),
        ([-0.5, 0.0, 0.0, 1.0], 0.25),
        ([0.0, 0.5, -1.0, 1.0], 0.5),
    ] {
        problem
            .add_least_squares(&[0, 1, 2, 3], &row, side, 1.0)
            .unwrap();
    }
    problem.add_least_squares(&[4], &[1.0], 0.5, 1.0).unwrap();
    problem
        .add_inequality(&[0, 1, 2], &[2.0, 1.0, -3.0], -4.5, -0.5)
        .unwrap();
    problem
        .add_inequality(&[0, 3], &[1.0, 1.0], 20.0, NONE)
        .unwrap();
    problem
        .set_bounds(&[1, 4], &[7.0, 0.0], &[NONE, 9.0])
        .unwrap();
    problem.set_integers(&[0, 1, 2, 4]).unwrap();
    problem
}

/// A knapsack of sixteen binaries with three limits.
pub fn many_nodes() -> Problem {
    let n = 16;
    let mut problem = Problem::new(n).unwrap();
    let all: Vec<usize> = (0..n).collect();
    let number = |k: usize, of: usize| ((k * k * 31 + 7 * k) % of) as f64;
    let sizes: Vec<f64> = all.iter().map(|&k| 20.0 + number(k, 17)).collect();
    let worth: Vec<f64> = all.iter().map(|&k| -20.0 - number(k + 3, 13)).collect();
    problem.add_linear(&worth).unwrap();
    for &k in &all {
        problem.add_least_squares(&[k], &[1.0], 0.5, 0.25).unwrap();
    }
    problem.add_inequality(&all, &sizes, -NONE, 150.5).unwrap();
    for of in [23, 29] {
        let sizes: Vec<f64> = all.iter().map(|&k| 20.0 + number(k + of, of)).collect();
        problem.add_inequality(&all, &sizes, -NONE, 163.5).unwrap();
    }
    problem.set_binaries(&all).unwrap();
    problem
}

/// Three customers, each with a share of two places: x0 to x5, which the binaries x6 and x7 open. The share of the
/// second place may be negative, so that it has a row for each side.
pub fn switched() -> Problem {
    let mut problem = Problem::new(8).unwrap();
    for customer in 0..3 {
        let [first, second] = [2 * customer, 2 * customer + 1];
        let weights = [1.0 + 0.3 * customer as f64, 1.4 - 0.2 * customer as f64];
        for (x, weight) in [first, second].into_iter().zip(weights) {
            problem
                .add_least_squares(&[x], &[1.0], 0.0, weight)
                .unwrap();
        }
        problem
            .add_constraint(&[first, second], &[1.0, 1.0], 1.0)
            .unwrap();
        problem
            .add_inequality(&[first, 6], &[1.0, -1.0], -NONE, 0.0)
            .unwrap();
        problem
            .add_inequality(&[second, 7], &[2.0, -3.0], -NONE, 0.0)
            .unwrap();
        problem
            .add_inequality(&[second, 7], &[1.0, 0.5], 0.0, NONE)
            .unwrap();
        problem
            .set_bounds(&[first, second], &[0.0, -NONE], &[NONE, NONE])
            .unwrap();
    }
    problem
        .add_linear(&[0.1, 0.0, -0.1, 0.2, 0.0, 0.0, 1.1, 1.3])
        .unwrap();
    problem.set_binaries(&[6, 7]).unwrap();
    problem
}

/// Subdivisions of seven arcs around a triangle, whose sums at its corners are odd: halves are best, and the tree
/// branches.
pub fn odd_cycle() -> Problem {
    let mut problem = Problem::new(7).unwrap();
    let weights = [0.3, 0.7, 1.1, 0.9, 1.3, 0.6, 0.55];
    let targets = [0.5, 0.5, 0.5, 2.0, 2.0, 2.0, 1.4];
    for (j, (weight, target)) in weights.into_iter().zip(targets).enumerate() {
        problem
            .add_least_squares(&[j], &[1.0], target, weight)
            .unwrap();
    }
    for corner in 0..3 {
        let row = [corner, (corner + 1) % 3, 3 + corner];
        problem
            .add_constraint(&row, &[1.0, 1.0, -1.0], -1.0)
            .unwrap();
    }
    problem
        .add_inequality(&[3, 4, 6], &[1.0, -1.0, 1.0], -3.0, 3.0)
        .unwrap();
    let all: Vec<usize> = (0..7).collect();
    problem.set_bounds(&all, &[0.0; 7], &[9.0; 7]).unwrap();
    problem.set_integers(&all).unwrap();
    problem
}

/// For each of so many goods, demands of three times, from what is stored and from what is made where a binary allows
/// it. The unknowns of a time are what is made, what is stored after it, and the binary. Cuts raise the bound.
pub fn lots(goods: usize) -> Problem {
    let mut problem = Problem::new(9 * goods).unwrap();
    let costs = [0.5, 0.0, 6.0, 0.25, 0.0, 4.0, 0.0, 0.0, 5.0];
    let of_all: Vec<f64> = (0..9 * goods).map(|j| costs[j % 9]).collect();
    problem.add_linear(&of_all).unwrap();
    for k in 0..3 * goods {
        let (made, stored, is_made) = (3 * k, 3 * k + 1, 3 * k + 2);
        for (unknown, square) in [(made, 0.25), (stored, 1.0)] {
            problem
                .add_quadratic_triplets(Triangle::Lower, &[unknown], &[unknown], &[square])
                .unwrap();
            problem.set_bounds(&[unknown], &[0.0], &[NONE]).unwrap();
        }
        let row = [made, stored, stored.saturating_sub(3)];
        let terms = if k % 3 > 0 { 3 } else { 2 };
        let demand = [3.0, 2.0, 4.0][k % 3];
        problem
            .add_constraint(&row[..terms], &[1.0, -1.0, 1.0][..terms], demand)
            .unwrap();
        problem
            .add_inequality(&[made, is_made], &[1.0, -8.0], -NONE, 0.0)
            .unwrap();
        problem.set_binaries(&[is_made]).unwrap();
    }
    problem
}

/// Four integers and four reals on a cycle, with two equations: one gives a real, and one, of integers, has no coefficient
/// of one, so that an integer is defined before it is solved. x8 is pinned, and x9 is a part of its own.
pub fn lattice() -> Problem {
    let mut problem = Problem::new(10).unwrap();
    for j in 0..8 {
        let next = (j + 1) % 8;
        let (slope, weight) = (0.7 + 0.1 * j as f64, 1.0 + 0.3 * (j % 3) as f64);
        problem
            .add_least_squares(&[j, next], &[1.0, -slope], 0.4 + 0.7 * j as f64, weight)
            .unwrap();
    }
    problem
        .add_least_squares(&[0, 8], &[1.0, 0.5], 1.9, 0.4)
        .unwrap();
    problem.add_least_squares(&[9], &[2.0], 2.3, 0.7).unwrap();
    problem
        .add_constraint(&[0, 4, 5], &[1.0, 1.0, -1.0], 0.5)
        .unwrap();
    problem
        .add_constraint(&[0, 1, 2], &[4.0, 6.0, -10.0], 2.0)
        .unwrap();
    problem.set_integers(&[0, 1, 2, 3, 9]).unwrap();
    problem.pin(8, 1.5).unwrap();
    problem
}
