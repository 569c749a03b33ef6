//! Small problems with chains of integer constraints. Their numbers are halves up to 8, but elimination
//! may lead to numbers of ten digits. The guarantees of a solution hold all the same.

use crate::common::{Random, solve_briefly};
use roundel::internals::eliminate::eliminate;
use roundel::solve::verify;
use roundel::{Error, Options, Problem, SolveStatus, Solver, Strategy, Triangle};
use roundel::{Model, Monitor, WarmStart, solve};

/// Indices, coefficients, right side.
type Row<'a> = (&'a [usize], &'a [f64], f64);

fn problem(variables: usize, constraints: &[Row], squares: &[(Row, f64)]) -> Problem {
    let mut problem = Problem::new(variables).unwrap();
    for (indices, values, rhs) in constraints {
        problem.add_constraint(indices, values, *rhs).unwrap();
    }
    for ((indices, values, rhs), weight) in squares {
        problem
            .add_least_squares(indices, values, *rhs, *weight)
            .unwrap();
    }
    problem
}

/// The largest coefficient by which an eliminated integer depends on a reduced one.
fn largest_step(problem: &Problem) -> f64 {
    let model = Model::new(problem).unwrap();
    let reduced = eliminate(&model, &mut Monitor::default()).unwrap();
    let integer = |&(i, _, _): &(u32, u32, f64)| model.integer()[i as usize];
    let steps = reduced.expansion().matrix().entries().filter(integer);
    steps.map(|(_, _, t)| t.abs()).fold(0.0, f64::max)
}

/// Found by the fuzzer: four constraints, of which two become constraints between integers once a shared
/// unknown is eliminated. The relaxation lost most digits, because it was computed in reduced integers.
#[test]
fn the_relaxation_satisfies_the_constraints_as_well_as_a_solution() {
    let constraints: [Row; 4] = [
        (&[5, 2, 1, 3], &[0.5, 4.5, -8.0, 2.5], 2.5),
        (&[4, 0, 2, 5], &[4.0, 4.0, 0.5, -7.0], 4.5),
        (&[5, 2, 1, 0], &[0.5, 4.5, -8.0, -8.0], -8.0),
        (&[2, 0, 3, 3], &[-6.5, 6.5, 4.0, 4.0], 4.0),
    ];
    let squares: [(Row, f64); 9] = [
        ((&[0, 3], &[9.5, -4.0], -8.0), 8.0),
        ((&[0, 5], &[8.5, 4.5], 2.5), 2.5),
        ((&[0, 4], &[-8.0, 5.0], 0.5), 5.0),
        ((&[5, 3, 4], &[-8.0, 5.0, -8.0], -8.0), 8.0),
        ((&[3, 2], &[-0.5, -2.5], 3.0), 2.0),
        ((&[2, 4, 1], &[4.0, -1.0, 0.5], -1.0), 1.0),
        ((&[3, 1, 2, 4], &[5.5, 4.0, -2.5, -1.0], 1.0), 0.5),
        ((&[5, 1, 0], &[1.0, 3.5, -16.0], -8.0), 8.0),
        ((&[1], &[1.0], 0.0), 1.0),
    ];
    let mut problem = problem(6, &constraints, &squares);
    problem.set_integers(&[0, 1, 4, 5]).unwrap();
    let relaxed = solve_briefly(&problem, Strategy::Relax).unwrap();
    assert!(relaxed.max_constraint_violation() < 1e-12);
    assert!(relaxed.gap().unwrap() < 1e-9, "{relaxed:?}");
    let solution = solve_briefly(&problem, Strategy::Exact).unwrap();
    assert!(solution.energy() >= relaxed.energy());
}

/// Constraints between six integers.
const CHAIN: [Row; 5] = [
    (&[4, 0, 1], &[6.5, -4.0, -4.0], 68.5),
    (&[2, 3, 1], &[-3.0, 7.5, 6.5], 22.0),
    (&[0, 1, 2], &[-4.5, -2.5, -5.5], 10.5),
    (&[5, 4, 1], &[-8.0, -4.5, 4.5], 7.5),
    (&[2, 0, 4], &[7.0, 8.0, 4.5], 10.5),
];

/// Five constraints leave one integer, whose steps are 1e5 from a point at 1e10. Its energy had no correct
/// digit left, and 4.8e13 was reported as the least one.
#[test]
fn a_solution_called_optimal_is_optimal_behind_a_chain_of_constraints() {
    let squares: [(Row, f64); 3] = [
        ((&[5, 1], &[-1.0, 8.0], 7.0), 4.0),
        ((&[1], &[6.5], 3.0), 3.5),
        ((&[0, 1, 4], &[2.0, -1.5, 4.0], 5.5), 7.0),
    ];
    let mut problem = problem(6, &CHAIN, &squares);
    let terms = (&[3], &[2], &[1.0]);
    problem
        .add_quadratic_triplets(Triangle::Lower, terms.0, terms.1, terms.2)
        .unwrap();
    problem.set_integers(&[0, 1, 2, 3, 4, 5]).unwrap();
    assert!(largest_step(&problem) > 1e4, "{}", largest_step(&problem));
    for strategy in Strategy::ALL {
        let solution = solve_briefly(&problem, strategy).unwrap();
        let relaxed = strategy == Strategy::Relax;
        assert!(relaxed || solution.energy() == 8103.25, "{strategy:?}");
        assert!(solution.lower_bound().unwrap() > 1798.6, "{strategy:?}");
    }
    let proved = solve_briefly(&problem, Strategy::Exact).unwrap();
    assert_eq!(proved.status(), SolveStatus::Optimal);
}

/// The same constraints, with a continuous unknown.
#[test]
fn solving_again_behind_a_chain_of_constraints_equals_a_first_solve() {
    let squares: [(Row, f64); 4] = [
        ((&[5, 1], &[-1.0, 8.0], 7.0), 4.0),
        ((&[1], &[6.5], 3.0), 3.5),
        ((&[0, 4, 6], &[2.0, -1.5, 4.0], 5.5), 7.0),
        ((&[6, 3], &[1.0, -1.0], 0.5), 1.0),
    ];
    let mut problem = problem(7, &CHAIN, &squares);
    problem.set_integers(&[0, 1, 2, 3, 4, 5]).unwrap();
    assert!(largest_step(&problem) > 1e4, "{}", largest_step(&problem));
    let options = Options::default();
    let mut solver = Solver::new(&problem).unwrap();
    let points = [
        [0.0; 6],
        [-5.0, -4.0, 4.0, 8.0, 5.0, -6.0],
        [1.0, 2.0, -3.0, 0.0, 7.0, 40.0],
        [0.0; 6],
    ];
    for point in points {
        let row = |(indices, values, _): &Row| {
            let terms = indices.iter().zip(*values);
            terms.map(|(&i, v)| v * point[i]).sum()
        };
        let rhs: Vec<f64> = CHAIN.iter().map(row).collect();
        solver.set_constraint_right_sides(&rhs).unwrap();
        problem.set_constraint_right_sides(&rhs).unwrap();
        let again = solver.solve(&options).unwrap();
        let fresh = solve(&problem, &options).unwrap();
        assert_eq!(again.values(), fresh.values());
        assert_eq!(fresh.status(), SolveStatus::Optimal);
        let warm = Options {
            warm_start: WarmStart::Offer,
            ..options.clone()
        };
        let warm = solver.solve(&warm).unwrap();
        assert_eq!(warm.energy(), fresh.energy());
    }
}

/// Six constraints determine every unknown. The continuous unknown used to have few digits, and so did the
/// bound.
#[test]
fn the_bound_of_a_single_feasible_point_is_its_energy() {
    let constraints: [Row; 6] = [
        (&[4, 2, 1], &[-8.0, -8.0, 0.5], -69.5),
        (&[1, 3, 0, 2], &[-4.0, 0.5, -2.0, -6.5], -33.5),
        (&[4, 3, 2], &[6.5, -12.0, 0.5], 76.5),
        (&[4, 1], &[-1.5, -7.0], -47.0),
        (&[1, 3, 5], &[4.5, -5.0, 5.5], -8.75),
        (&[5, 1, 2], &[3.5, -4.5, -6.0], -54.75),
    ];
    let squares: [(Row, f64); 5] = [
        ((&[3, 1, 0], &[-2.0, -3.0, -5.0], 7.0), 5.5),
        ((&[2, 5, 0], &[8.0, -1.0, -3.5], -5.0), 6.0),
        ((&[2], &[3.5], -2.0), 3.5),
        ((&[3, 4], &[-1.5, 0.5], -6.5), 2.0),
        ((&[2, 0], &[1.5, 4.0], -4.0), 8.0),
    ];
    let mut problem = problem(6, &constraints, &squares);
    problem.set_integers(&[0, 1, 2, 3, 4]).unwrap();
    for strategy in Strategy::ALL {
        let solution = solve_briefly(&problem, strategy).unwrap();
        assert_eq!(solution.values(), [3.0, 5.0, 1.0, -2.0, 8.0, -7.5]);
        assert_eq!(solution.status(), SolveStatus::Optimal);
        assert!(solution.gap().unwrap() < 1e-9, "{solution:?}");
    }
}

/// An unknown without a square that occurs in a product with another. Its pivot is zero, not negative.
#[test]
fn a_product_with_an_unknown_without_curvature_is_not_convex() {
    let squares: [(Row, f64); 2] = [
        ((&[2, 0, 1], &[13.5, -2.0, 0.5], -8.0), 2.5),
        ((&[2, 0, 1], &[4.5, 2.0, -2.5], 3.5), 8.0),
    ];
    let mut problem = problem(4, &[], &squares);
    problem
        .add_quadratic_triplets(Triangle::Lower, &[3, 1], &[1, 1], &[0.5, 5.0])
        .unwrap();
    problem.set_integers(&[0, 1, 2, 3]).unwrap();
    for strategy in Strategy::ALL {
        let error = solve_briefly(&problem, strategy);
        assert!(matches!(error, Err(Error::NotConvex { .. })), "{error:?}");
    }
}

/// A product of two unknowns whose squares cancel once other unknowns are eliminated.
#[test]
fn a_product_of_unknowns_whose_squares_cancel_is_not_convex() {
    let constraints: [Row; 1] = [(&[5, 1, 0, 4], &[6.5, 7.5, -0.5, -4.5], -121.0)];
    let squares: [(Row, f64); 3] = [
        ((&[4, 2, 5], &[1.5, 5.0, -3.0], 4.0), 4.5),
        ((&[3], &[2.0], -5.5), 0.5),
        ((&[0, 4], &[5.0, -3.5], -8.0), 3.5),
    ];
    let mut problem = problem(6, &constraints, &squares);
    problem
        .add_quadratic_triplets(Triangle::Lower, &[5], &[4], &[1.125])
        .unwrap();
    problem.set_integers(&[0, 1, 4, 5]).unwrap();
    for strategy in Strategy::ALL {
        let error = solve_briefly(&problem, strategy);
        assert!(matches!(error, Err(Error::NotConvex { .. })), "{error:?}");
    }
}

/// The constraints determine `x0 = 0`. Rounding errors of that zero looked like a slope of `x2` in `x0 x2`.
#[test]
fn rounding_errors_of_a_right_side_do_not_count_as_a_slope() {
    let constraints: [Row; 6] = [
        (&[3, 4], &[-0.5, -1.0], -2.0),
        (&[4, 3, 1], &[-4.0, 6.5, 5.5], -41.75),
        (&[4, 1], &[-0.5, 2.5], -5.5),
        (&[1, 3, 0], &[4.5, -0.5, 3.5], -5.25),
        (&[4, 0, 1, 5], &[-3.5, 6.5, 4.5, 4.0], 5.0),
        (&[5], &[3.0], 18.0),
    ];
    let mut problem = problem(6, &constraints, &[]);
    problem
        .add_quadratic_triplets(Triangle::Lower, &[2], &[0], &[1.0])
        .unwrap();
    problem.set_integers(&[5]).unwrap();
    for strategy in Strategy::ALL {
        let solution = solve_briefly(&problem, strategy);
        assert!(solution.is_ok(), "{strategy:?}: {solution:?}");
    }
}

/// The energy decreases without end along `x4 = 7.5 x0 + 6.5`. The elimination makes its numbers large.
#[test]
fn an_unbounded_objective_behind_a_chain_of_constraints_is_reported() {
    let constraints: [Row; 4] = [
        (&[3, 4], &[3.0, -7.5], 43.5),
        (&[5, 2], &[6.5, -6.0], 36.25),
        (&[1, 3, 5, 0], &[-2.0, -6.5, 6.0, 6.0], 58.5),
        (&[0, 2], &[2.0, 7.5], 11.5),
    ];
    let squares: [(Row, f64); 1] = [((&[4, 0], &[1.0, -7.5], 6.5), 6.5)];
    let mut problem = problem(6, &constraints, &squares);
    problem.add_linear_term(0, -4.0).unwrap();
    problem.set_integers(&[0, 1, 2, 3, 4]).unwrap();
    for strategy in Strategy::ALL {
        let error = solve_briefly(&problem, strategy).unwrap_err();
        let Error::Unbounded { direction, .. } = error else {
            panic!("{strategy:?}: {error}")
        };
        assert!(direction[0] > 0.0);
        assert!((direction[4] - 7.5 * direction[0]).abs() < 1e-9);
        assert!((3.0 * direction[3] - 7.5 * direction[4]).abs() < 1e-9);
    }
}

/// A problem, the same with right sides of zero for testing directions, and a feasible point if known.
struct Chain {
    problem: Problem,
    homogeneous: Problem,
    at: Option<Vec<f64>>,
}

impl Random {
    /// A random multiple of 1/2 from -8 to 8.
    fn number(&mut self) -> f64 {
        self.below(33) as f64 / 2.0 - 8.0
    }

    fn terms(&mut self, n: usize) -> (Vec<usize>, Vec<f64>) {
        let count = 1 + self.below(4);
        let indices = (0..count).map(|_| self.below(n)).collect();
        (indices, (0..count).map(|_| self.number()).collect())
    }

    /// A random problem of up to six unknowns and as many constraints. Three of four problems are feasible
    /// at a known point of halves and integers.
    fn problem(&mut self) -> Chain {
        let n = [1, 2, 3, 4, 4, 5, 5, 6, 6, 6, 6][self.below(11)];
        let density = 1 + self.below(4);
        let integers: Vec<usize> = (0..n).filter(|_| self.below(4) < density).collect();
        let mut at: Vec<f64> = (0..n).map(|_| self.number()).collect();
        integers.iter().for_each(|&i| at[i] = at[i].round());
        let feasible = self.below(4) > 0;
        let mut problem = Problem::new(n).unwrap();
        let mut homogeneous = problem.clone();
        for _ in 0..self.below(n + 1) {
            let (indices, values) = self.terms(n);
            let there = || indices.iter().zip(&values).map(|(&i, v)| v * at[i]).sum();
            let rhs = if feasible { there() } else { self.number() };
            problem.add_constraint(&indices, &values, rhs).unwrap();
            homogeneous.add_constraint(&indices, &values, 0.0).unwrap();
        }
        for _ in 0..self.below(n + 3) {
            let (indices, values) = self.terms(n);
            let (rhs, weight) = (self.number(), self.number().abs());
            problem
                .add_least_squares(&indices, &values, rhs, weight)
                .unwrap();
        }
        for _ in 0..self.below(3) {
            let (i, j, v) = (self.below(n), self.below(n), self.number());
            let v = if i == j { v.abs() } else { v / 4.0 };
            let (row, col) = (i.max(j), i.min(j));
            problem
                .add_quadratic_triplets(Triangle::Lower, &[row], &[col], &[v])
                .unwrap();
        }
        if self.below(3) == 0 {
            let (i, v) = (self.below(n), self.number());
            problem.add_linear_term(i, v).unwrap();
        }
        if self.below(6) == 0 {
            let i = self.below(n);
            problem.pin(i, at[i]).unwrap();
            homogeneous.pin(i, 0.0).unwrap();
        }
        problem.set_integers(&integers).unwrap();
        Chain {
            problem,
            homogeneous,
            at: feasible.then_some(at),
        }
    }
}

/// Checks with the problem's own numbers that the objective decreases without end along the direction that
/// an error reports.
fn check_direction(chain: &Chain, error: &Error, name: &dyn Fn() -> String) {
    let Some(direction) = error.direction() else {
        return;
    };
    let verdict = verify(&chain.homogeneous, direction).unwrap();
    assert!(
        verdict.constraint_violation < 1e-9,
        "{}: {verdict:?}",
        name()
    );
    let Some(at) = &chain.at else { return };
    let energy = |t: f64| {
        let point = at.iter().zip(direction).map(|(x, v)| x + t * v);
        verify(&chain.problem, &point.collect::<Vec<_>>())
            .unwrap()
            .energy
    };
    let (back, here, on) = (energy(-1.0), energy(0.0), energy(1.0));
    let (slope, curvature) = ((on - back) / 2.0, (on - here) + (back - here));
    let noise = 1e-9 * (1.0 + here.abs());
    let falls_in_the_end = match error {
        Error::NotConvex { .. } => curvature < 0.0,
        _ => curvature < -noise || (slope < 0.0 && curvature < noise),
    };
    assert!(falls_in_the_end, "{}: {slope}, {curvature}", name());
}

/// Solves the problem by every strategy and checks the guarantees of each solution, alone and against the
/// others. Returns the number of solutions.
fn check_guarantees(chain: &Chain, name: &str) -> usize {
    let tried = Strategy::ALL.map(|strategy| (strategy, solve_briefly(&chain.problem, strategy)));
    let refused = tried
        .iter()
        .filter_map(|(s, t)| Some((s, t.as_ref().err()?)));
    for (strategy, error) in refused {
        check_direction(chain, error, &|| format!("{name}, {strategy:?}: {error:?}"));
    }
    let solved = || {
        tried
            .iter()
            .filter_map(|(s, t)| Some((s, t.as_ref().ok()?)))
    };
    let of_integers = solved().filter(|(_, t)| t.status() != SolveStatus::Relaxed);
    let least = of_integers.fold(f64::INFINITY, |least, (_, t)| least.min(t.energy()));
    for (strategy, solution) in solved() {
        let name = || format!("{name}, {strategy:?}: {solution:?}");
        let tolerance = 1e-6 * solution.energy().abs().max(1e3);
        let bound = solution.lower_bound().unwrap();
        assert!(
            solution.values().iter().all(|x| x.is_finite()),
            "{}",
            name()
        );
        assert!(solution.max_constraint_violation() < 1e-6, "{}", name());
        assert!(solution.energy() >= bound - tolerance, "{}", name());
        assert!(bound <= least + tolerance, "{}: {least} was found", name());
        if solution.status() != SolveStatus::Relaxed {
            assert_eq!(solution.max_integrality_violation(), 0.0, "{}", name());
        }
        if solution.status() == SolveStatus::Optimal {
            assert!(solution.energy() <= bound + tolerance, "{}", name());
            assert!(
                solution.energy() <= least + tolerance,
                "{}: {least}",
                name()
            );
        }
    }
    solved().count()
}

fn check_random_problems(problems: usize, seed: u64) {
    let mut solved = 0;
    for round in 0..problems as u64 {
        let chain = Random::new(seed.wrapping_add(round + 1)).problem();
        let name = format!("problem {round} of seed {seed}");
        solved += check_guarantees(&chain, &name);
    }
    let tried = problems * Strategy::ALL.len();
    assert!(2 * solved > tried, "{solved} of {tried} solved");
}

#[test]
fn the_guarantees_hold_for_twenty_thousand_problems() {
    check_random_problems(20_000, 8);
}

/// Takes minutes: `CHAINS_SEED=1 cargo test --release --test library -- integer_chains:: --ignored` tries other
/// problems for every seed.
#[test]
#[ignore = "takes minutes"]
fn the_guarantees_hold_for_two_million_problems() {
    let seed = std::env::var("CHAINS_SEED").map_or(1, |seed| seed.parse().unwrap());
    check_random_problems(2_000_000, seed << 32);
}
