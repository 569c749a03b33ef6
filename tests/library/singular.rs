//! Lattices that are singular up to rounding errors, or whose rank double precision cannot decide. A solve
//! takes little work, is no worse than rounding, and never calls optimal a solution that is not.

use crate::common::{Random, solve_briefly};
use roundel::{Problem, Solution, SolveStatus, Strategy, Triangle};

/// A number of multiplications that no problem of eight unknowns needs: forty times the most that any of
/// 100,000 random problems took.
const PLENTY: u64 = 1_000_000;

const OF_LATTICES: [Strategy; 3] = [Strategy::Lattice, Strategy::Exact, Strategy::Auto];

/// Indices, coefficients, right side and weight of a least-squares row.
type Row<'a> = (&'a [usize], &'a [f64], f64, f64);

fn problem(variables: usize, integers: &[usize], rows: &[Row]) -> Problem {
    let mut problem = Problem::new(variables).unwrap();
    for (indices, values, rhs, weight) in rows {
        problem
            .add_least_squares(indices, values, *rhs, *weight)
            .unwrap();
    }
    problem.set_integers(integers).unwrap();
    problem
}

fn solved(problem: &Problem, strategy: Strategy) -> Solution {
    solve_briefly(problem, strategy).unwrap()
}

/// Found by the fuzzer. The improvement of blocks moved 400,000 times along a vector whose length was only
/// rounding error, and its answer was called optimal.
#[test]
fn a_degenerate_lattice_keeps_the_rounded_solution() {
    let rows: [Row; 5] = [
        (&[5, 1, 0, 4], &[4.0, -8.0, -5.0, -2.5], -2.5, 0.5),
        (&[5, 3, 0], &[-8.0, 2.5, 5.0], 2.5, 5.0),
        (&[1, 3], &[2.5, 12.0], 4.0, 4.5),
        (&[2, 3, 5], &[-8.0, -5.5, -3.5], -3.0, 8.0),
        (&[2, 1, 5, 0], &[7.0, 4.5, 4.5, 2.5], 2.5, 2.5),
    ];
    let problem = problem(6, &[0, 1, 4], &rows);
    let rounded = solved(&problem, Strategy::Adaptive).energy();
    for strategy in OF_LATTICES {
        let solution = solved(&problem, strategy);
        assert!(solution.work() < PLENTY, "{strategy:?}");
        assert!(solution.energy() <= rounded, "{strategy:?}");
        assert_eq!(solution.status(), SolveStatus::Feasible, "{strategy:?}");
    }
}

/// Found by the fuzzer. Variable 2 compensates for every value of integer 5. The rounding errors that this
/// left led to integers of 1e16 and to an energy of -6e17, below the proved bound.
#[test]
fn an_integer_without_influence_on_the_energy_stays_small() {
    let rows: [Row; 3] = [
        (&[0, 1, 3], &[7.0, -1.0, 8.0], 3.5, 1.5),
        (&[5, 2, 3], &[5.0, -5.5, 8.0], 8.0, 8.0),
        (&[0], &[-24.0], -8.0, 8.0),
    ];
    let mut problem = problem(6, &[1, 3, 5], &rows);
    problem
        .add_quadratic_triplets(Triangle::Lower, &[1, 0, 3], &[0, 0, 3], &[8.0, 4.5, 1.5])
        .unwrap();
    // The minimum over x0, for given integers 1 and 3.
    let energy = |y: f64, z: f64| {
        let a = 0.5 * 4.5 + 1.5 * 49.0 + 8.0 * 576.0;
        let b = 8.0 * y + 2.0 * 1.5 * 7.0 * (8.0 * z - y - 3.5) - 2.0 * 8.0 * 24.0 * 8.0;
        let c = 0.75 * z * z + 1.5 * (8.0 * z - y - 3.5).powi(2) + 8.0 * 64.0;
        c - b * b / (4.0 * a)
    };
    let near = (-400..400).flat_map(|y| (-60..60).map(move |z| (f64::from(y), f64::from(z))));
    let least = near
        .map(|(y, z)| energy(y, z))
        .fold(f64::INFINITY, f64::min);
    for strategy in OF_LATTICES {
        let solution = solved(&problem, strategy);
        assert!(solution.work() < PLENTY, "{strategy:?}");
        let excess = solution.energy() - least;
        assert!(excess.abs() < 1e-8 * least.abs(), "{strategy:?}: {excess}");
        assert!(solution.values()[5].abs() < 1e3, "{strategy:?}");
    }
    let proved = solved(&problem, Strategy::Exact);
    assert_eq!(proved.status(), SolveStatus::Optimal);
}

impl Random {
    /// A random multiple of 1/2 from -8 to 8. If `wild`, now and then a number is added that makes relations
    /// between integers impossible or almost so.
    fn half_or_wild(&mut self, wild: bool) -> f64 {
        let half = self.below(33) as f64 / 2.0 - 8.0;
        match self.below(9) {
            0 if wild => half + 2f64.sqrt(),
            1 if wild => half + 3f64.sqrt(),
            2 if wild => half + 1e-9,
            _ => half,
        }
    }

    /// A random problem of few least-squares rows with few unknowns each, often fewer rows than integers.
    fn dependent_problem(&mut self) -> Problem {
        let n = 1 + self.below(8);
        let wild = self.below(2) == 0;
        let mut problem = Problem::new(n).unwrap();
        for _ in 0..1 + self.below(n + 2) {
            let terms = 1 + self.below(4);
            let indices: Vec<usize> = (0..terms).map(|_| self.below(n)).collect();
            let values: Vec<f64> = (0..terms).map(|_| self.half_or_wild(wild)).collect();
            let weight = (1 + self.below(16)) as f64 / 2.0;
            problem
                .add_least_squares(&indices, &values, self.half_or_wild(wild), weight)
                .unwrap();
        }
        let integers: Vec<usize> = (0..n).filter(|_| self.below(3) > 0).collect();
        problem.set_integers(&integers).unwrap();
        problem
    }
}

#[test]
fn small_lattices_take_little_work_and_are_no_worse_than_rounding() {
    let mut random = Random::new(1);
    let mut bounded = 0;
    for round in 0..3000 {
        let problem = random.dependent_problem();
        // A tiny coefficient in the wrong place can make it undecidable whether there is a minimum.
        let Ok(rounded) = solve_briefly(&problem, Strategy::Adaptive) else {
            continue;
        };
        bounded += 1;
        let rounded = rounded.energy();
        let solutions = OF_LATTICES.map(|strategy| (strategy, solved(&problem, strategy)));
        let of_lattices = solutions.iter().map(|(_, s)| s.energy());
        let least = of_lattices.fold(rounded, f64::min);
        let tolerance = 1e-6 * least.max(1.0);
        for (strategy, solution) in &solutions {
            let energy = solution.energy();
            assert!(solution.work() < PLENTY, "{round}, {strategy:?}");
            assert!(energy <= rounded + tolerance, "{round}, {strategy:?}");
            let optimal = solution.status() == SolveStatus::Optimal;
            assert!(
                !optimal || energy <= least + tolerance,
                "{round}, {strategy:?}"
            );
        }
    }
    assert!(bounded > 2700, "{bounded}");
}
