//! Problems with the largest and the smallest numbers that doubles can represent: every solve ends, with
//! a solution or an error.

use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use roundel::{Options, Problem, Strategy, Triangle, solve};

/// Whether `solve` ends within a minute, with finite values or an error.
fn ends(problem: Problem) -> bool {
    ends_with(problem, Options::default())
}

fn ends_with(problem: Problem, options: Options) -> bool {
    let (say, hear) = mpsc::channel();
    thread::spawn(move || {
        let found = solve(&problem, &options);
        let _ = say.send(found.map(|s| s.values().iter().all(|x| x.is_finite())));
    });
    let said = hear.recv_timeout(Duration::from_secs(60));
    said.is_ok_and(|found| found.unwrap_or(true))
}

/// Found by the fuzzer. The squares of these numbers are zero, so an energy is 0/0, and the improvement
/// of charges waited for it to decrease.
#[test]
fn a_solve_ends_where_squares_underflow() {
    let q = [
        1.6493382969313916e-229,
        1.7524219404896036e-229,
        1.8619483117702038e-229,
    ];
    let mut problem = Problem::new(2).unwrap();
    problem
        .add_quadratic_triplets(Triangle::Lower, &[0, 1, 1], &[0, 0, 1], &q)
        .unwrap();
    problem
        .add_linear(&[1.1339200791403318e-229, 1.2047900840866025e-229])
        .unwrap();
    problem.set_integers(&[1]).unwrap();
    assert!(ends(problem));
}

/// Found by the fuzzer. The reduced lattice is singular up to rounding errors and its points are huge. The
/// improvement of blocks alternated between two of them.
#[test]
fn a_solve_ends_where_the_lattice_is_nearly_singular() {
    let rows: [&[f64]; 6] = [
        &[608.75],
        &[90.0, 157.5],
        &[524.0, 157.5, 1269.0],
        &[168.0, 270.0, 448.0, 1492.0],
        &[34.5, 0.0, 0.0, 0.0, 9.0],
        &[164.0, 101.25, 477.5, 140.0, -12.0, 217.25],
    ];
    let mut problem = Problem::new(6).unwrap();
    for (i, row) in rows.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            problem
                .add_quadratic_triplets(Triangle::Lower, &[i], &[j], &[value])
                .unwrap();
        }
    }
    problem
        .add_linear(&[-347.75, -146.25, -471.5, -600.0, -7.5, -166.25])
        .unwrap();
    problem.set_integers(&[0, 1, 4, 5]).unwrap();
    let options = Options {
        strategy: Strategy::Exact,
        nodes: 500,
        ..Options::default()
    };
    assert!(ends_with(problem, options));
}

#[test]
fn a_solve_ends_at_every_scale() {
    for exponent in (-300..=300).step_by(20) {
        let scale = 10f64.powi(exponent);
        let mut problem = Problem::new(4).unwrap();
        let edges = [([0, 1, 3], 0.4), ([1, 2, 3], 0.3), ([0, 2, 3], 0.7)];
        let mut rows = edges.iter().map(|(at, rhs)| {
            problem.add_least_squares(at, &[scale, -scale, 0.5 * scale], rhs * scale, 1.0)
        });
        // A scale whose square overflows is refused when the row is added or when the problem is solved.
        let given = rows.all(|row| row.is_ok());
        if given {
            problem.set_integers(&[3]).unwrap();
            assert!(ends(problem), "1e{exponent}");
        }
    }
}

/// The only term is the square of `x + sqrt2 y + sqrt3 z + sqrt5 w - 0.3`. Larger integers make it
/// smaller without end, so no point attains the least value.
#[test]
fn a_dense_lattice_is_rounded_without_an_error() {
    let mut problem = Problem::new(4).unwrap();
    problem.set_integers(&[0, 1, 2, 3]).unwrap();
    let flat = [1.0, 2f64.sqrt(), 3f64.sqrt(), 5f64.sqrt()];
    problem
        .add_least_squares(&[0, 1, 2, 3], &flat, 0.3, 1.0)
        .unwrap();
    for strategy in [
        Strategy::Greedy,
        Strategy::Lattice,
        Strategy::Exact,
        Strategy::Auto,
    ] {
        let options = Options {
            strategy,
            nodes: 10_000,
            ..Options::default()
        };
        let solution = solve(&problem, &options).unwrap();
        assert!(solution.energy() < 0.3 * 0.3 + 1e-12, "{strategy:?}");
    }
}

/// Found by the fuzzer. The integers of these constraints are multiples of one parameter around 6e8 plus
/// offsets of 1e14. The continuous unknowns that depend on them kept only six digits.
#[test]
fn continuous_unknowns_keep_their_digits_behind_a_chain_of_integer_constraints() {
    let rows: [(&[usize], &[f64], f64); 7] = [
        (&[5, 2, 1, 3], &[0.5, 4.5, -8.0, 2.5], 2.5),
        (&[4, 0, 2, 5], &[4.0, 4.0, 0.5, -7.0], 4.5),
        (&[3, 0, 2], &[6.5, 4.5, 4.0], 4.0),
        (&[5, 2, 1, 3], &[0.5, 4.5, -8.0, 2.5], 2.5),
        (&[2, 0, 4], &[-6.5, -5.5, 2.5], 0.5),
        (&[0, 1, 4], &[-4.0, 4.0, 5.0], -8.0),
        (&[4, 0, 2, 5], &[4.0, 4.0, 0.5, -7.0], 4.5),
    ];
    let mut problem = Problem::new(6).unwrap();
    for (indices, values, rhs) in rows {
        problem.add_constraint(indices, values, rhs).unwrap();
    }
    problem
        .add_least_squares(&[0, 3], &[9.5, -4.0], -8.0, 8.0)
        .unwrap();
    problem.set_integers(&[0, 1, 4, 5]).unwrap();
    for strategy in [Strategy::Adaptive, Strategy::Exact, Strategy::Auto] {
        let options = Options {
            strategy,
            ..Options::default()
        };
        let solution = solve(&problem, &options).unwrap();
        let violation = solution.max_constraint_violation();
        assert!(violation < 1e-12, "{strategy:?}: {violation}");
        assert_eq!(solution.max_integrality_violation(), 0.0);
    }
}
