//! Rows that a caller adds during the search: the answer is that of the problem which has them from the
//! beginning.

use super::instance::Instance;
use super::random::Random;
use roundel::{Candidate, Error, Flow, LazyRows, Monitor, Options, Problem, solve};
use roundel::{SolveStatus, solve_with_lazy_rows};

/// The instance without its inequalities, which are left to the callback.
fn without_rows(of: &Instance) -> Problem {
    let mut left = of.clone();
    left.rows.retain(|row| row.is_constraint);
    left.problem()
}

/// Energy or error of the problem whose inequalities are added for candidates that violate them, or for any
/// candidate at random if `early`. Also returns the number of rows, and of relaxations that were shown.
fn lazily(of: &Instance, early: Option<u64>) -> (Result<f64, Error>, usize, usize) {
    let all: Vec<usize> = (0..of.unknowns()).collect();
    let mut random = early.map(Random::new);
    let mut relaxed = 0;
    let callback = |candidate: &Candidate, rows: &mut LazyRows| {
        assert_eq!(candidate.values.len(), of.unknowns());
        let whole = |(x, is): (&f64, &bool)| !is || x.fract() == 0.0;
        let is_integer = candidate.values.iter().zip(&of.integer).all(whole);
        assert_eq!(candidate.is_integer, is_integer);
        relaxed += usize::from(!is_integer);
        for row in of.rows.iter().filter(|row| !row.is_constraint) {
            let terms = row.coefficients.iter().zip(candidate.values);
            let value: f64 = terms.map(|(a, x)| a * x).sum();
            let is_violated = value < row.lower - 1e-7 || value > row.upper + 1e-7;
            if is_violated || random.as_mut().is_some_and(|r| r.below(3) == 0) {
                rows.add(&all, &row.coefficients, row.lower, row.upper)
                    .unwrap();
            }
        }
        Flow::Continue
    };
    let options = Options {
        time_limit: 20.0,
        ..Options::default()
    };
    let problem = without_rows(of);
    match solve_with_lazy_rows(&problem, &options, Monitor::default(), callback) {
        Ok(solution) => {
            assert_eq!(solution.status(), SolveStatus::Optimal);
            let rows = solution.counts().inequalities;
            (Ok(solution.energy()), rows, relaxed)
        }
        Err(error) => (Err(error), 0, relaxed),
    }
}

/// Holds lazy rows against rows that are there from the beginning. Returns whether there is a solution, and
/// how many relaxations were shown.
pub fn check(of: &Instance, seed: u64) -> Result<(Option<bool>, usize), String> {
    if matches!(
        solve(&without_rows(of), &Options::default()),
        Err(Error::Unbounded { .. })
    ) {
        // Nothing tells which rows would hold the energy.
        return Ok((None, 0));
    }
    let whole = solve(&of.problem(), &Options::default());
    let mut shown = 0;
    for early in [None, Some(seed)] {
        let (lazily, rows, relaxed) = lazily(of, early);
        shown += relaxed;
        match (&whole, &lazily) {
            (Ok(whole), Ok(energy)) => {
                let size = of.energy_size(whole.values()).max(1.0);
                if (whole.energy() - energy).abs() > 1e-8 * size {
                    return Err(format!("{energy} where it is {}", whole.energy()));
                }
                if rows > of.rows.len() {
                    return Err(format!("{rows} rows"));
                }
            }
            (Err(_), Err(error)) if error.code().contains("infeasible") => {}
            (Err(_), Err(error)) if error.code().contains("no_integer") => {}
            (whole, lazily) => {
                let whole = whole.as_ref().map(roundel::Solution::energy);
                return Err(format!("{lazily:?} where it is {whole:?}"));
            }
        }
    }
    Ok((Some(whole.is_ok()), shown))
}

/// A row that cuts off a point which was accepted before is an error that names it.
pub fn check_late_row() {
    let mut problem = Problem::new(3).unwrap();
    for i in 0..3 {
        problem.add_least_squares(&[i], &[1.0], 5.4, 1.0).unwrap();
    }
    problem
        .add_inequality(&[0, 1, 2], &[1.0; 3], f64::NEG_INFINITY, 7.0)
        .unwrap();
    problem.set_integers(&[0, 1, 2]).unwrap();
    let mut integers = 0;
    let callback = |candidate: &Candidate, rows: &mut LazyRows| {
        integers += usize::from(candidate.is_integer);
        if integers == 2 {
            rows.add(&[0], &[1.0], f64::NEG_INFINITY, -100.0).unwrap();
        }
        Flow::Continue
    };
    let found = solve_with_lazy_rows(&problem, &Options::default(), Monitor::default(), callback);
    let error = found.unwrap_err();
    assert_eq!(
        (error.code(), error.index()),
        ("invalid_argument", Some(1)),
        "{error}"
    );
}
