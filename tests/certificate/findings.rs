//! Wrong or weak answers that others found by exact arithmetic, each named after what it showed.

use super::random::Random;
use roundel::{Error, Options, Problem, Solution, SolveStatus, Strategy, Triangle, solve};

fn by(problem: &Problem, strategy: Strategy) -> Solution {
    let options = Options {
        strategy,
        ..Options::default()
    };
    solve(problem, &options).unwrap()
}

fn rows(rows: &[(&[f64], f64)], integers: &[usize]) -> Problem {
    let unknowns = rows[0].0.len();
    let mut problem = Problem::new(unknowns).unwrap();
    let all: Vec<usize> = (0..unknowns).collect();
    for (row, rhs) in rows {
        problem.add_least_squares(&all, row, *rhs, 1.0).unwrap();
    }
    problem.set_integers(integers).unwrap();
    problem
}

/// `1/2 x'Qx + q'x + c` with the lower triangle of Q by rows.
fn quadratic(lower: &[&[f64]], linear: &[f64], constant: f64, integers: &[usize]) -> Problem {
    let mut problem = Problem::new(linear.len()).unwrap();
    for (i, row) in lower.iter().enumerate() {
        for (j, &v) in row.iter().enumerate() {
            problem
                .add_quadratic_triplets(Triangle::Lower, &[i], &[j], &[v])
                .unwrap();
        }
    }
    problem.add_linear(linear).unwrap();
    problem.add_constant(constant).unwrap();
    problem.set_integers(integers).unwrap();
    problem
}

/// Two unknowns, condition number 14; 1.45095 was called optimal.
#[test]
fn an_integer_near_1_600_000_is_decided_rightly() {
    let problem = rows(
        &[
            (&[-3.0, -3.0], 769_911.859_375),
            (&[5.0, 5.0], -1_283_184.281_25),
            (&[-3.0, -2.0], -1_084_342.562_5),
        ],
        &[0],
    );
    let solution = by(&problem, Strategy::Exact);
    assert_eq!(solution.values()[0], 1_597_617.0);
    assert_eq!(solution.status(), SolveStatus::Optimal);
}

/// The terms of the energy are 1e17, and the result was -8.70 for -5.72.
#[test]
fn an_energy_of_five_among_terms_of_1e17_is_exact() {
    let lower: [&[f64]; 2] = [&[4.0], &[-2.0, 20.0]];
    let linear = [-200_000_001.3, -1_800_000_000.357_143];
    let problem = quadratic(&lower, &linear, 1.000_000_001_657_142_9e17, &[0]);
    for strategy in [Strategy::Exact, Strategy::Auto] {
        let solution = by(&problem, strategy);
        assert!((solution.energy() + 5.721_526_789).abs() < 1e-8);
        assert!(solution.lower_bound().unwrap() <= solution.energy());
        assert_eq!(solution.status(), SolveStatus::Optimal);
    }
}

/// 0.2328 was called optimal.
#[test]
fn the_better_neighbour_of_an_integer_near_1e7_is_found() {
    let lower: [&[f64]; 2] = [&[2.0], &[10.0, 82.0]];
    let linear = [-56_072_868.5, -519_791_376.5];
    let problem = quadratic(&lower, &linear, 1_681_749_529_986_403.8, &[0]);
    let energy = by(&problem, Strategy::Exact).energy();
    assert!((energy - 0.138_719_512_195).abs() < 1e-11, "{energy}");
}

/// Condition number 4e11; the bound was 2.8e-7 above the optimum, 0.004299876822.
#[test]
fn the_bound_of_an_ill_conditioned_ambiguity_problem_is_below_its_optimum() {
    let lower: [&[f64]; 4] = [
        &[1_030_784.073_734_119_1],
        &[-519_429.703_897_802_04, 261_749.501_380_279_17],
        &[
            235_739.153_065_930_6,
            -118_792.986_406_188_17,
            53_913.277_980_933_1,
        ],
        &[
            156_530.336_464_650_23,
            -78_878.310_592_272_62,
            35_798.311_090_034_26,
            23_770.008_553_427_273,
        ],
    ];
    let linear = [
        -87_162_579.180_375_52,
        43_922_712.670_758_4,
        -19_933_983.376_205_765,
        -13_236_125.973_534_46,
    ];
    let problem = quadratic(&lower, &linear, 3_685_211_774.697_898, &[0, 1, 2, 3]);
    let solution = by(&problem, Strategy::Exact);
    assert!(solution.is_complete());
    assert!(solution.lower_bound().unwrap() <= 0.004_299_876_822_2);
    assert!(solution.energy() < 0.004_299_876_822_3);
}

/// `auto` judged 500 integers by their number, and ended 60 % above the optimum.
#[test]
fn fifty_blocks_of_ten_integers_are_proved_block_by_block() {
    let mut random = Random::new(3);
    let mut problem = Problem::new(500).unwrap();
    for block in 0..50 {
        let own: Vec<usize> = (10 * block..10 * block + 10).collect();
        for _ in 0..14 {
            let row: Vec<f64> = own.iter().map(|_| random.next()).collect();
            let rhs = 9.0 * random.next();
            problem.add_least_squares(&own, &row, rhs, 1.0).unwrap();
        }
    }
    problem.set_integers(&(0..500).collect::<Vec<_>>()).unwrap();
    let auto = by(&problem, Strategy::Auto);
    assert!(auto.is_complete(), "{:?}", auto.status());
    assert_eq!(auto.values(), by(&problem, Strategy::Exact).values());
}

/// `exact` gave up for their number.
#[test]
fn a_thousand_separate_integers_are_proved() {
    let mut random = Random::new(4);
    let mut problem = Problem::new(1100).unwrap();
    for i in 0..1100 {
        let rhs = 9.0 * random.next();
        let slope = 1.0 + random.unit();
        problem.add_least_squares(&[i], &[slope], rhs, 1.0).unwrap();
    }
    problem
        .set_integers(&(0..1100).collect::<Vec<_>>())
        .unwrap();
    for strategy in [Strategy::Exact, Strategy::Auto] {
        let solution = by(&problem, strategy);
        assert_eq!(solution.status(), SolveStatus::Optimal, "{strategy:?}");
    }
}

/// A closest-vector problem modulo 97 was searched whole and called feasible, for a gap of 3e-9.
#[test]
fn what_was_enumerated_whole_is_optimal() {
    let n = 24;
    let mut random = Random::new(5);
    let mut problem = Problem::new(n).unwrap();
    for i in 0..n {
        let target = random.below(97) as f64 + 0.5;
        if i < n / 2 {
            problem
                .add_least_squares(&[i], &[1.0], target, 1.0)
                .unwrap();
            continue;
        }
        let mut indices: Vec<usize> = (0..n / 2).collect();
        let mut row: Vec<f64> = (0..n / 2).map(|_| random.below(97) as f64).collect();
        indices.push(i);
        row.push(97.0);
        problem
            .add_least_squares(&indices, &row, target, 1.0)
            .unwrap();
    }
    problem.set_integers(&(0..n).collect::<Vec<_>>()).unwrap();
    let solution = by(&problem, Strategy::Exact);
    assert!(solution.is_complete());
    assert_eq!(solution.status(), SolveStatus::Optimal);
}

/// Integers of four and five digits left "a relation of integers whose coefficients have no common measure".
/// Such a relation may need numbers beyond 2^53: then the error says so.
#[test]
fn two_constraints_with_one_real_unknown_leave_an_exact_relation_of_integers() {
    for (largest, least_solved) in [(1_000, 200), (10_000, 150), (100_000, 1)] {
        let mut random = Random::new(7);
        let mut solved = 0;
        for _ in 0..200 {
            let mut below = |most: usize| random.below(2 * most) as i64 - most as i64;
            let rows = [0; 2].map(|_| [0; 4].map(|_| 2 * below(largest / 2) + 1));
            let point = [0; 4].map(|_| below(1_000));
            solved += usize::from(solves_relation(rows, point));
        }
        assert!(solved >= least_solved, "{largest}: {solved}");
    }
}

/// Whether there is a solution, which is then right, of two constraints that hold at `point`, where all
/// unknowns but the first are integers.
fn solves_relation(rows: [[i64; 4]; 2], point: [i64; 4]) -> bool {
    let all = [0, 1, 2, 3];
    let right_sides = rows.map(|row| (0..4).map(|i| row[i] * point[i]).sum::<i64>());
    let mut problem = Problem::new(4).unwrap();
    for (row, right_side) in rows.iter().zip(right_sides) {
        let row = row.map(|a| a as f64);
        problem
            .add_constraint(&all, &row, right_side as f64)
            .unwrap();
    }
    for i in all {
        let target = point[i] as f64 + 0.3;
        problem
            .add_least_squares(&[i], &[1.0], target, 1.0)
            .unwrap();
    }
    problem.set_integers(&all[1..]).unwrap();
    let solution = match solve(&problem, &Options::default()) {
        Err(Error::Overflow { .. }) => return false,
        solution => solution.unwrap(),
    };
    let x = solution.values();
    // The combination of the rows without the real unknown is a relation of whole numbers.
    let combined = |a: i64, b: i64| i128::from(rows[1][0] * a - rows[0][0] * b);
    let relation = |i: usize| combined(rows[0][i], rows[1][i]) * x[i] as i128;
    let sum: i128 = (1..4).map(relation).sum();
    assert_eq!(sum, combined(right_sides[0], right_sides[1]), "{rows:?}");
    assert!(solution.energy() <= 4.0 * 0.09 + 1e-9, "{rows:?}");
    true
}
