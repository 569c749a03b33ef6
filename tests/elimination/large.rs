//! Elimination of thousands of rows stays cheap, and the reduced model stays sparse.

use std::time::{Duration, Instant};

use roundel::internals::eliminate::ReducedModel;
use roundel::{Model, Options, Problem, Strategy, solve};

use super::common::Random;
use super::{reduce, violation};

/// A generous limit: a slow machine without optimisation takes a tenth of it. An algorithm quadratic in the
/// number of rows takes minutes.
const BOUND: Duration = Duration::from_secs(20);

fn reduce_in_time(problem: &Problem) -> ReducedModel {
    let start = Instant::now();
    let reduced = reduce(problem).unwrap();
    let taken = start.elapsed();
    assert!(taken < BOUND, "{taken:?}");
    reduced
}

/// A grid of `side` by `side` unknowns with squared differences of neighbours, after `extra` others.
fn grid(side: usize, extra: usize) -> Problem {
    let mut problem = Problem::new(side * side + extra).unwrap();
    let at = |r: usize, c: usize| extra + r * side + c;
    for r in 0..side {
        for c in 0..side {
            if c + 1 < side {
                problem
                    .add_least_squares(&[at(r, c), at(r, c + 1)], &[1.0, -1.0], 0.3, 1.0)
                    .unwrap();
            }
            if r + 1 < side {
                problem
                    .add_least_squares(&[at(r, c), at(r + 1, c)], &[1.0, -1.0], -0.2, 1.0)
                    .unwrap();
            }
        }
    }
    problem
}

#[test]
fn a_chain_of_equal_unknowns_leaves_one_unknown() {
    let side = 150;
    for reversed in [false, true] {
        let mut problem = grid(side, 0);
        let n = side * side;
        for i in 1..n {
            let i = if reversed { n - i } else { i };
            problem
                .add_constraint(&[i - 1, i], &[1.0, -1.0], 0.0)
                .unwrap();
        }
        let reduced = reduce_in_time(&problem);
        assert_eq!(reduced.dim(), 1);
        assert_eq!(reduced.expansion().matrix().len(), n);
    }
}

#[test]
fn a_chain_in_random_order_leaves_one_unknown() {
    let n = 20_000;
    let mut problem = Problem::new(n).unwrap();
    for k in 0..n - 1 {
        // 7919 is coprime to n - 1, so each link comes once, far from its neighbours.
        let i = k * 7919 % (n - 1);
        problem
            .add_constraint(&[i, i + 1], &[1.0, -1.0], 0.0)
            .unwrap();
    }
    let reduced = reduce_in_time(&problem);
    assert_eq!(reduced.dim(), 1);
    assert_eq!(reduced.expansion().matrix().len(), n);
}

#[test]
fn features_on_integer_isolines_leave_one_integer_each() {
    let (features, side) = (400, 150);
    let mut problem = grid(side, features);
    problem
        .set_integers(&(0..features).collect::<Vec<_>>())
        .unwrap();
    for v in 0..side * side {
        problem
            .add_constraint(&[v % features, features + v], &[1.0, -1.0], 0.0)
            .unwrap();
    }
    let reduced = reduce_in_time(&problem);
    assert_eq!(reduced.integers().len(), features);
    assert_eq!(reduced.dim(), features);
    assert_eq!(reduced.expansion().matrix().len(), features + side * side);
}

#[test]
fn closed_loops_leave_one_unknown_each_and_their_last_row_is_redundant() {
    let (loops, length) = (100, 225);
    let mut problem = grid(150, 0);
    for l in 0..loops {
        for k in 0..length {
            let (i, j) = (l * length + k, l * length + (k + 1) % length);
            // Around the loop, the jumps 1/3 and -1/3 cancel only up to rounding.
            let jump = match k % 3 {
                0 => 1.0 / 3.0,
                1 => -0.1,
                _ => 0.1 - 1.0 / 3.0,
            };
            problem.add_constraint(&[i, j], &[1.0, -1.0], jump).unwrap();
        }
    }
    let reduced = reduce_in_time(&problem);
    assert_eq!(reduced.dim(), loops);
    assert_eq!(reduced.expansion().matrix().len(), loops * length);
}

#[test]
fn integers_tied_to_one_stay_sparse() {
    let n = 20_000;
    let mut problem = Problem::new(n).unwrap();
    problem.set_integers(&(0..n).collect::<Vec<_>>()).unwrap();
    for i in 1..n {
        problem
            .add_constraint(&[0, i], &[-2.0, 1.0], i as f64)
            .unwrap();
    }
    let reduced = reduce_in_time(&problem);
    assert_eq!(reduced.dim(), 1);
    assert_eq!(reduced.expansion().matrix().len(), n);
}

fn holds_and_stays_sparse(problem: &Problem, gone: usize) -> ReducedModel {
    let reduced = reduce_in_time(problem);
    let n = problem.variables();
    assert_eq!(reduced.dim(), n - gone);
    assert!(reduced.expansion().matrix().len() <= 4 * n);
    assert!(
        reduced.hessian().len() <= 40 * n,
        "{}",
        reduced.hessian().len()
    );
    let model = Model::new(problem).unwrap();
    let y: Vec<f64> = (0..reduced.dim()).map(|i| (i % 11) as f64 - 5.0).collect();
    let x = reduced.expansion().expand(&y);
    assert!(violation(&model, &x) < 1e-9);
    let mut energy = model.constant();
    for (x, qx) in x.iter().zip(model.hessian().mul_symmetric(&x)) {
        energy += 0.5 * x * qx;
    }
    for (x, q) in x.iter().zip(model.gradient()) {
        energy += x * q;
    }
    let (value, _) = reduced.energy(&y);
    let linear = reduced.gradient().iter().zip(&y);
    let quadratic = reduced.hessian().entries();
    let size = reduced.constant().abs()
        + linear.map(|(g, y)| (g * y).abs()).sum::<f64>()
        + quadratic
            .map(|(i, j, v)| (v * y[i as usize] * y[j as usize]).abs())
            .sum::<f64>();
    assert!((value - energy).abs() <= 1e-10 * size);
    reduced
}

#[test]
fn a_mean_over_all_unknowns_keeps_the_hessian_sparse() {
    let side = 142;
    let n = side * side;
    let mut problem = grid(side, 0);
    // Areas differ by a factor of a thousand, as on real meshes.
    let area: Vec<f64> = (0..n)
        .map(|i| 10f64.powi((i * 31 % 7) as i32 - 3))
        .collect();
    problem
        .add_constraint(&(0..n).collect::<Vec<_>>(), &area, 2.5)
        .unwrap();
    for i in (0..n - side).step_by(97) {
        problem
            .add_constraint(&[i, i + side], &[1.0, -1.0], 0.1)
            .unwrap();
    }
    let short = (0..n - side).step_by(97).count();
    holds_and_stays_sparse(&problem, 1 + short);
}

#[test]
fn the_mean_of_a_star_does_not_couple_all_its_arms() {
    let n = 20_000;
    let mut problem = Problem::new(n).unwrap();
    for i in 1..n {
        problem
            .add_least_squares(&[0, i], &[1.0, -1.0], 0.0, 1.0)
            .unwrap();
    }
    problem
        .add_constraint(&(0..n).collect::<Vec<_>>(), &vec![1.0; n], 0.0)
        .unwrap();
    holds_and_stays_sparse(&problem, 1);
}

#[test]
fn a_second_mean_over_the_same_unknowns_keeps_the_hessian_sparse_too() {
    let side = 142;
    let n = side * side;
    let mut problem = grid(side, 0);
    let all: Vec<usize> = (0..n).collect();
    problem.add_constraint(&all, &vec![1.0; n], 0.0).unwrap();
    let column: Vec<f64> = (0..n)
        .map(|i| 1.0 + (i % side) as f64 / side as f64)
        .collect();
    problem.add_constraint(&all, &column, 1.0).unwrap();
    let reduced = reduce_in_time(&problem);
    assert_eq!(reduced.dim(), n - 2);
    assert!(
        reduced.hessian().len() <= 200 * n,
        "{}",
        reduced.hessian().len()
    );
    let x = reduced.expansion().expand(&vec![1.0; n - 2]);
    assert!(violation(&Model::new(&problem).unwrap(), &x) < 1e-9);
}

#[test]
fn a_long_sum_of_integers_stays_sparse_and_integer() {
    let n = 20_000;
    let mut problem = grid(141, n - 141 * 141);
    let all: Vec<usize> = (0..n).collect();
    problem.set_integers(&all).unwrap();
    let signs: Vec<f64> = (0..n).map(|i| [0.5, -0.5, 0.5][i % 3]).collect();
    problem.add_constraint(&all, &signs, 3.5).unwrap();
    let reduced = holds_and_stays_sparse(&problem, 1);
    assert_eq!(reduced.integers().len(), n - 1);
    let x = reduced.expansion().expand(&vec![3.0; n - 1]);
    assert!(x.iter().all(|v| v.fract() == 0.0));
    let sum: f64 = x.iter().zip(&signs).map(|(x, s)| x * s).sum();
    assert_eq!(sum, 3.5);
}

#[test]
fn uneven_weights_of_a_mean_do_not_cost_accuracy() {
    let side = 60;
    let relaxed = |problem: &Problem| {
        let options = Options {
            strategy: Strategy::Relax,
            ..Options::default()
        };
        solve(problem, &options).unwrap().energy()
    };
    let mut pinned = grid(side, 0);
    pinned
        .add_least_squares(&[17, 1234], &[1.0, -1.0], 40.0, 1.0)
        .unwrap();
    let mut with_mean = pinned.clone();
    pinned.pin(5, 1.0).unwrap();
    let n = side * side;
    let area: Vec<f64> = (0..n)
        .map(|i| 10f64.powi((i * 31 % 7) as i32 - 3))
        .collect();
    with_mean
        .add_constraint(&(0..n).collect::<Vec<_>>(), &area, 2.5)
        .unwrap();
    // The pin and the mean only select a point on the line of minimisers.
    let (a, b) = (relaxed(&pinned), relaxed(&with_mean));
    assert!((a - b).abs() <= 1e-10 * a, "{a} against {b}");
}

/// `rows` rows of `width` real coefficients that a known point satisfies. Each row starts `step` unknowns
/// after the one before.
fn band(n: usize, rows: usize, width: usize, step: usize) -> Problem {
    let mut random = Random::new(1);
    let mut problem = Problem::new(n).unwrap();
    let point: Vec<f64> = (0..n).map(|_| random.next()).collect();
    for r in 0..rows {
        let indices: Vec<usize> = (r * step..r * step + width).map(|j| j % n).collect();
        let row: Vec<f64> = indices.iter().map(|_| random.next()).collect();
        let rhs = indices.iter().zip(&row).map(|(&j, a)| a * point[j]).sum();
        problem.add_constraint(&indices, &row, rhs).unwrap();
    }
    problem
}

#[test]
fn the_rank_of_a_dense_system_is_found_after_hundreds_of_pivots() {
    let (n, rows) = (200, 150);
    let mut problem = band(n, rows, n, 0);
    let model = Model::new(&problem).unwrap();
    // Each of these rows depends on ten others.
    for k in 0..20 {
        let mut sum = vec![0.0; n];
        let mut rhs = 0.0;
        for r in 0..10 {
            let r = (k + 7 * r) % rows;
            rhs += model.constraint_rhs()[r];
            for (j, a) in model.constraints().row(r) {
                sum[j] += a;
            }
        }
        let all: Vec<usize> = (0..n).collect();
        problem.add_constraint(&all, &sum, rhs).unwrap();
    }
    let reduced = reduce_in_time(&problem);
    assert_eq!(reduced.dim(), n - rows);
    let x = reduced.expansion().expand(&vec![0.5; n - rows]);
    assert!(violation(&Model::new(&problem).unwrap(), &x) < 1e-9);
}

#[test]
fn coefficients_do_not_grow_along_a_band() {
    let (n, rows) = (20_000, 9_990);
    let problem = band(n, rows, 4, 2);
    let reduced = reduce_in_time(&problem);
    assert_eq!(reduced.dim(), n - rows);
    let matrix = reduced.expansion().matrix();
    let largest = matrix.values().iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    assert!(largest < 1e6, "{largest}");
    assert!(matrix.len() < 100 * n, "{}", matrix.len());
    let x = reduced.expansion().expand(&vec![0.5; n - rows]);
    assert!(violation(&Model::new(&problem).unwrap(), &x) < 1e-9);
}
