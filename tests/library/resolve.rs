//! A re-solve gives the same result as a first solve, whatever was changed in between.

use crate::common::{Random, orientation_field, parametrization};
use proptest::prelude::*;
use proptest::strategy::Strategy as Generated;
use roundel::Ordering;
use roundel::{Error, Options, Problem, Result, Solution, Solver, Strategy, WarmStart, solve};

/// The parts of a random problem. The constraints hold at the integer point that they were made from.
#[derive(Debug, Clone)]
struct Recipe {
    integers: usize,
    continuous: usize,
    constraints: Vec<Vec<(usize, i64)>>,
    seed: u64,
}

/// The constraints use two thirds of the unknowns, so that some unknowns are in none.
fn recipe() -> impl Generated<Value = Recipe> {
    (2usize..=8, 2usize..=8, 0usize..=5, any::<u64>()).prop_flat_map(
        |(integers, continuous, rows, seed)| {
            let n = integers + continuous;
            let entry = (0..n).prop_map(|j| j - j % 3).prop_flat_map(move |j| {
                let neighbour = (j + 1).min(n - 1);
                (prop_oneof![Just(j), Just(neighbour)], -3i64..=3)
            });
            let row = prop::collection::vec(entry, 1..5);
            prop::collection::vec(row, rows).prop_map(move |constraints| Recipe {
                integers,
                continuous,
                constraints,
                seed,
            })
        },
    )
}

#[derive(Debug, Clone)]
enum Change {
    Linear(u64),
    LeastSquares(u64),
    /// Right sides that some integer point satisfies.
    Feasible(u64),
    /// Any whole numbers as right sides.
    Any(u64),
    Pin(usize, i64),
    Unpin(usize),
    Guess(u64),
}

fn change() -> impl Generated<Value = Change> {
    prop_oneof![
        any::<u64>().prop_map(Change::Linear),
        any::<u64>().prop_map(Change::LeastSquares),
        any::<u64>().prop_map(Change::Feasible),
        any::<u64>().prop_map(Change::Any),
        (0usize..16, -3i64..=3).prop_map(|(i, v)| Change::Pin(i, v)),
        (0usize..16).prop_map(Change::Unpin),
        any::<u64>().prop_map(Change::Guess),
    ]
}

impl Recipe {
    fn unknowns(&self) -> usize {
        self.integers + self.continuous
    }

    /// The right sides of the constraints at a random integer point.
    fn right_sides(&self, seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let point: Vec<f64> = (0..self.unknowns())
            .map(|_| (9.0 * random.next()).round())
            .collect();
        let dot = |row: &Vec<(usize, i64)>| row.iter().map(|&(j, v)| v as f64 * point[j]).sum();
        self.constraints.iter().map(dot).collect()
    }

    fn problem(&self) -> Result<Problem> {
        let mut random = Random::new(self.seed);
        let n = self.unknowns();
        let mut problem = Problem::new(n)?;
        // Integers and continuous unknowns alternate while there are both.
        problem.set_integers(&self.integer_unknowns())?;
        for i in 0..n {
            let (j, k) = ((i + 1) % n, (i * i + 3) % n);
            let rhs = 3.0 * random.next();
            problem.add_least_squares(&[i, j, k], &[1.0, -0.7, 0.4], rhs, 1.0)?;
            problem.add_least_squares(&[i], &[1.0], random.next(), 0.1)?;
        }
        let rhs = self.right_sides(self.seed ^ 1);
        for (row, rhs) in self.constraints.iter().zip(rhs) {
            let indices: Vec<usize> = row.iter().map(|e| e.0).collect();
            let coefficients: Vec<f64> = row.iter().map(|e| e.1 as f64).collect();
            problem.add_constraint(&indices, &coefficients, rhs)?;
        }
        Ok(problem)
    }

    fn integer_unknowns(&self) -> Vec<usize> {
        let alternating = (0..self.unknowns()).filter(|i| i % 2 == 0);
        alternating.take(self.integers).collect()
    }

    fn apply(&self, change: &Change, solver: &mut Solver) -> Result<()> {
        let n = self.unknowns();
        let numbers = |seed: u64, len: usize, scale: f64| -> Vec<f64> {
            let mut random = Random::new(seed);
            (0..len).map(|_| scale * random.next()).collect()
        };
        match *change {
            Change::Linear(seed) => solver.set_linear(&numbers(seed, n, 2.0)),
            Change::LeastSquares(seed) => {
                solver.set_least_squares_right_sides(&numbers(seed, 2 * n, 4.0))
            }
            Change::Feasible(seed) => solver.set_constraint_right_sides(&self.right_sides(seed)),
            Change::Any(seed) => {
                let mut rhs = numbers(seed, self.constraints.len(), 5.0);
                rhs.iter_mut().for_each(|d| *d = d.round());
                solver.set_constraint_right_sides(&rhs)
            }
            Change::Pin(i, value) => solver.pin(i % n, value as f64),
            Change::Unpin(i) => solver.unpin(i % n),
            Change::Guess(seed) => solver.set_guess(&numbers(seed, n, 3.0)),
        }
    }
}

/// The bits of the values, the energy and the bound, or the message of the error.
fn told(solution: Result<Solution>) -> std::result::Result<Vec<u64>, String> {
    let solution = solution.map_err(|error| format!("{} {error}", error.code()))?;
    let numbers = [solution.energy(), solution.lower_bound().unwrap_or(0.0)];
    let all = solution.values().iter().chain(&numbers);
    Ok(all.map(|x| x.to_bits()).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn after_every_change_the_solution_equals_that_of_a_first_solve(
        recipe in recipe(),
        changes in prop::collection::vec((change(), 0usize..4, any::<bool>()), 1..8),
    ) {
        let mut solver = Solver::new(&recipe.problem().unwrap()).unwrap();
        prop_assert_eq!(
            told(solver.solve(&Options::default())),
            told(solve(&recipe.problem().unwrap(), &Options::default()))
        );
        for (change, strategy, natural) in changes {
            recipe.apply(&change, &mut solver).unwrap();
            let options = Options {
                strategy: Strategy::ALL[strategy],
                ordering: Ordering::ALL[usize::from(natural)],
                exact_integers: 3,
                ..Options::default()
            };
            let fresh = told(solve(solver.problem(), &options));
            prop_assert_eq!(told(solver.solve(&options)), fresh, "{:?}", change);
        }
    }

    #[test]
    fn a_warm_start_is_no_worse_than_the_search_and_the_earlier_integers(
        recipe in recipe(),
        first in any::<u64>(),
        second in any::<u64>(),
    ) {
        let mut solver = Solver::new(&recipe.problem().unwrap()).unwrap();
        solver.solve(&Options::default()).unwrap();
        solver.set_least_squares_right_sides(
            &(0..2 * recipe.unknowns()).map(|i| ((first >> (i % 48)) & 15) as f64 * 0.3)
                .collect::<Vec<_>>(),
        ).unwrap();
        solver.set_constraint_right_sides(&recipe.right_sides(second)).unwrap();
        let how = |strategy, warm_start| Options { strategy, warm_start, ..Options::default() };
        let kept = solver.solve(&how(Strategy::Direct, WarmStart::Keep)).unwrap();
        prop_assert!(kept.max_integrality_violation() == 0.0);
        prop_assert!(kept.max_constraint_violation() < 1e-9);
        let cold = solve(solver.problem(), &how(Strategy::Direct, WarmStart::Off)).unwrap();
        let offered = solver.solve(&how(Strategy::Direct, WarmStart::Offer)).unwrap();
        let best = kept.energy().min(cold.energy());
        prop_assert!((offered.energy() - best).abs() <= 1e-9 * (1.0 + best.abs()));
    }

    #[test]
    fn the_natural_order_gives_a_relaxation_of_the_same_energy(recipe in recipe()) {
        let problem = recipe.problem().unwrap();
        let with = |ordering| Options { strategy: Strategy::Relax, ordering, ..Options::default() };
        let reducing = solve(&problem, &with(Ordering::FillReducing)).unwrap();
        let natural = solve(&problem, &with(Ordering::Natural)).unwrap();
        let (a, b) = (reducing.energy(), natural.energy());
        prop_assert!((a - b).abs() <= 1e-9 * (1.0 + a.abs()), "{a} {b}");
        prop_assert!(natural.max_constraint_violation() < 1e-9);
    }
}

/// x0 + x1 = d0, 2 x1 + 4 x2 = d1 and x0 + x1 = d2, where all unknowns but x0 are integer.
fn contradictable() -> Solver {
    let mut problem = Problem::new(3).unwrap();
    problem.set_integers(&[1, 2]).unwrap();
    for i in 0..3 {
        problem.add_least_squares(&[i], &[1.0], 0.4, 1.0).unwrap();
    }
    problem.add_constraint(&[0, 1], &[1.0, 1.0], 0.5).unwrap();
    problem.add_constraint(&[1, 2], &[2.0, 4.0], 2.0).unwrap();
    problem.add_constraint(&[0, 1], &[1.0, 1.0], 0.5).unwrap();
    Solver::new(&problem).unwrap()
}

#[test]
fn contradictory_right_sides_name_their_row_and_leave_the_solver_usable() {
    let mut solver = contradictable();
    let options = Options::default();
    let before = solver.solve(&options).unwrap();
    solver
        .set_constraint_right_sides(&[0.5, 2.0, 0.75])
        .unwrap();
    let error = solver.solve(&options).unwrap_err();
    assert_eq!((error.code(), error.index()), ("infeasible", Some(2)));
    assert!(error.to_string().contains("0.75"), "{error}");
    solver.set_constraint_right_sides(&[0.5, 3.0, 0.5]).unwrap();
    let error = solver.solve(&options).unwrap_err();
    let expected = ("no_integer_solution", Some(1));
    assert_eq!((error.code(), error.index()), expected);
    let lengths = solver.set_constraint_right_sides(&[0.5, 2.0]).unwrap_err();
    assert!(matches!(lengths, Error::LengthMismatch { expected: 3, .. }));
    let infinite = [0.5, f64::INFINITY, 0.5];
    let error = solver.set_constraint_right_sides(&infinite).unwrap_err();
    assert_eq!((error.code(), error.index()), ("not_finite", Some(1)));
    solver.set_constraint_right_sides(&[0.5, 2.0, 0.5]).unwrap();
    assert_eq!(solver.solve(&options).unwrap().values(), before.values());
}

#[test]
fn an_integer_pinned_to_a_fraction_is_refused_until_it_is_released() {
    let mut solver = contradictable();
    solver.pin(1, 0.5).unwrap();
    let error = solver.solve(&Options::default()).unwrap_err();
    assert_eq!((error.code(), error.index()), ("invalid_argument", Some(1)));
    solver.unpin(1).unwrap();
    assert!(solver.solve(&Options::default()).is_ok());
}

#[test]
fn later_solves_of_both_families_factor_nothing_and_equal_first_solves() {
    for problem in [orientation_field(12, 3), parametrization(9, 4)] {
        let mut problem = problem.unwrap();
        // A constraint whose right side can change.
        let n = problem.variables();
        problem.add_constraint(&[n - 1], &[1.0], 1.0).unwrap();
        let rows = problem.least_squares_rows();
        let mut solver = Solver::new(&problem).unwrap();
        for strategy in Strategy::ALL {
            let options = Options {
                strategy,
                exact_integers: 10,
                ..Options::default()
            };
            solver.solve(&options).unwrap();
            let targets: Vec<f64> = (0..rows).map(|k| (k as f64).sin()).collect();
            solver.set_least_squares_right_sides(&targets).unwrap();
            let again = solver.solve(&options).unwrap();
            let fresh = solve(solver.problem(), &options).unwrap();
            assert_eq!(told(Ok(again.clone())), told(Ok(fresh)), "{strategy:?}");
            assert!(again.counts().factor_nonzeros > 0);
        }
    }
}

#[test]
fn a_solver_follows_other_sides_and_bounds_into_limits_and_out_of_them() {
    // (x0 - 3)^2 + (x1 - 3)^2 with x0 + 2 x1 <= 4 and x0 an integer.
    let mut problem = Problem::new(2).unwrap();
    for i in 0..2 {
        problem.add_least_squares(&[i], &[1.0], 3.0, 1.0).unwrap();
    }
    let none = f64::INFINITY;
    problem
        .add_inequality(&[0, 1], &[1.0, 2.0], -none, 4.0)
        .unwrap();
    problem.set_integers(&[0]).unwrap();
    let mut solver = Solver::new(&problem).unwrap();
    let options = Options::default();
    let gives = |solver: &mut Solver, expected: [f64; 2]| {
        let solution = solver.solve(&options).unwrap();
        let near = |(a, b): (&f64, f64)| (a - b).abs() < 1e-9;
        assert!(
            solution.values().iter().zip(expected).all(near),
            "{:?}",
            solution.values()
        );
        assert_eq!(solution.counts().inequalities, 1);
        let fresh = solve(solver.problem(), &options).unwrap();
        assert_eq!(solution.values(), fresh.values());
    };
    gives(&mut solver, [2.0, 1.0]);
    solver.set_bounds(&[0], &[-none], &[1.0]).unwrap();
    gives(&mut solver, [1.0, 1.5]);
    solver.set_inequality_sides(&[-none], &[3.0]).unwrap();
    gives(&mut solver, [1.0, 1.0]);
    // What is refused changes nothing.
    let short = solver.set_inequality_sides(&[], &[9.0]);
    assert!(matches!(short, Err(Error::LengthMismatch { .. })));
    let turned = solver.set_bounds(&[1, 0], &[0.0, 2.0], &[1.0, 1.0]);
    assert_eq!(turned.unwrap_err().index(), Some(1));
    gives(&mut solver, [1.0, 1.0]);
    solver.set_inequality_sides(&[9.0], &[none]).unwrap();
    solver.set_bounds(&[1], &[-none], &[1.0]).unwrap();
    assert_eq!(solver.solve(&options).unwrap_err().code(), "infeasible");
    solver.set_bounds(&[0, 1], &[-none; 2], &[none; 2]).unwrap();
    gives(&mut solver, [3.0, 3.0]);
}
