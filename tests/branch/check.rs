//! Solves an instance and holds everything that the library says against the exact answer.

use super::instance::Instance;
use super::oracle::{Truth, is_feasible_in_reals, truth};
use super::random::Random;
use super::rational::{exact, zero};
use num_rational::BigRational;
use roundel::{Error, Options, Solution, SolveStatus, Strategy, solve};

/// Energies may be off by this part of the sizes of their terms.
const ROUNDING: f64 = 1e-12;

/// The energy of a solution may be off the optimum by this part of the sizes of its terms: rows may be
/// violated by 1e-9.
const CLOSE: f64 = 2e-9;

/// Rows and bounds may be violated by this part of the sizes of their terms.
const VIOLATION: f64 = 1e-9;

/// What became of the problems of a kind.
#[derive(Default, Debug)]
pub struct Tally {
    pub optimal: usize,
    pub infeasible: usize,
    pub unbounded: usize,
    pub not_convex: usize,
    /// What the oracle could not decide.
    pub undecided: usize,
    /// Sets of rows and bounds at fault, those that are minimal, and those that the oracle could not decide.
    pub conflicts: usize,
    pub minimal: usize,
    pub open: usize,
}

pub fn float(x: &BigRational) -> f64 {
    let mut shift = zero();
    // The text of a quotient has too many digits; the whole part and 2^-60ths of the rest are enough.
    let whole = x.trunc();
    let scale = exact(2f64.powi(60));
    shift += ((x - &whole) * &scale).trunc();
    let number = |x: &BigRational| x.to_string().parse::<f64>().unwrap();
    number(&whole) + number(&shift) / 2f64.powi(60)
}

fn by(instance: &Instance, strategy: Strategy) -> Result<Solution, Error> {
    let options = Options {
        strategy,
        time_limit: 20.0,
        ..Options::default()
    };
    solve(&instance.problem(), &options)
}

fn is_infeasible(error: &Error) -> bool {
    error.code() == "infeasible" || error.code() == "no_integer_solution"
}

/// Holds a point and its energy against the instance. Returns its error, in words.
fn check_point(of: &Instance, solution: &Solution, with_integers: bool) -> Result<(), String> {
    let x = solution.values();
    for j in 0..of.unknowns() {
        let (lower, upper) = of.limits(j);
        let room = VIOLATION * x[j].abs().max(1.0);
        if x[j] < lower - room || x[j] > upper + room {
            return Err(format!("x{j} is {} outside {lower}..{upper}", x[j]));
        }
        if with_integers && of.integer[j] && x[j].fract() != 0.0 {
            return Err(format!("x{j} is {}, which is no integer", x[j]));
        }
    }
    for (k, row) in of.rows.iter().enumerate() {
        let terms = || row.coefficients.iter().zip(x).map(|(a, x)| a * x);
        let value: f64 = terms().sum();
        let room = VIOLATION * terms().map(f64::abs).sum::<f64>().max(1.0);
        if value < row.lower - room || value > row.upper + room {
            return Err(format!(
                "row {k} is {value} outside {}..{}",
                row.lower, row.upper
            ));
        }
    }
    let point: Vec<_> = x.iter().map(|&x| exact(x)).collect();
    let there = float(&of.objective().energy(&point));
    let error = (there - solution.energy()).abs();
    if error > ROUNDING * of.energy_size(x).max(1e-3) {
        return Err(format!("energy {} where it is {there}", solution.energy()));
    }
    Ok(())
}

/// The rows and bounds that an error names must have no point together.
fn check_conflict(of: &Instance, error: &Error, tally: &mut Tally) -> Result<(), String> {
    let Error::Contradiction {
        elements, index, ..
    } = error
    else {
        return Ok(());
    };
    if elements.is_empty() || index.is_none() {
        return Err("no element is named".to_owned());
    }
    tally.conflicts += 1;
    let kept = of.only(elements);
    match truth(&kept) {
        Truth::Infeasible => {}
        Truth::NothingNear | Truth::TooLarge => {
            tally.open += 1;
            return Ok(());
        }
        Truth::Optimum(_) | Truth::Unbounded => {
            return Err(format!("{elements:?} do not contradict each other"));
        }
    }
    let of_reals = is_feasible_in_reals(&kept) == Some(false);
    if of_reals && elements.len() > of.unknowns() + 1 {
        return Err(format!("{elements:?}: more than the unknowns and one"));
    }
    let needed = |k: usize| {
        let mut fewer = elements.clone();
        fewer.remove(k);
        !matches!(truth(&of.only(&fewer)), Truth::Infeasible)
    };
    tally.minimal += usize::from((0..elements.len()).all(needed));
    Ok(())
}

/// Holds the answer of `exact` against the truth.
pub fn check(of: &Instance, tally: &mut Tally) -> Result<(), String> {
    let truth = truth(of);
    match (by(of, Strategy::Auto), &truth) {
        (Ok(solution), truth) => {
            check_point(of, &solution, true)?;
            let size = of.energy_size(solution.values()).max(1.0);
            let (energy, bound) = (solution.energy(), solution.lower_bound().unwrap());
            let optimum = match truth {
                Truth::Optimum(optimum) => optimum,
                Truth::TooLarge => {
                    tally.undecided += 1;
                    return Ok(());
                }
                other => return Err(format!("{energy} is called optimal: {other:?}")),
            };
            let least = float(optimum);
            // An energy of zero is found with rounding errors, which leave a bound of zero apart.
            let is_nothing = energy - bound <= ROUNDING * size;
            if solution.status() != SolveStatus::Optimal && !is_nothing {
                return Err(format!("{:?} at {energy}, {least}", solution.status()));
            }
            if exact(bound) > *optimum && energy - bound > 0.0 || bound > least + CLOSE * size {
                return Err(format!("bound {bound} above {least}"));
            }
            if (energy - least).abs() > CLOSE * size {
                return Err(format!("{energy} is called optimal, {least}"));
            }
            if least - bound > 1e-7 * size {
                return Err(format!("a bound of {bound} for {least}"));
            }
            tally.optimal += 1;
        }
        (Err(error), Truth::Infeasible | Truth::NothingNear) if is_infeasible(&error) => {
            check_conflict(of, &error, tally)?;
            tally.infeasible += 1;
        }
        (Err(Error::Unbounded { direction, .. }), Truth::Unbounded | Truth::NothingNear) => {
            check_ray(of, &direction)?;
            tally.unbounded += 1;
        }
        (Err(_), Truth::TooLarge) => tally.undecided += 1,
        (Err(error), truth) => {
            return Err(format!(
                "{error}: {}",
                match truth {
                    Truth::Optimum(optimum) => format!("the optimum is {}", float(optimum)),
                    other => format!("{other:?}"),
                }
            ));
        }
    }
    check_strategies(of, &truth)
}

/// The direction must leave no limits, have no curvature, and a negative slope.
fn check_ray(of: &Instance, direction: &[f64]) -> Result<(), String> {
    let room = 1e-6;
    let leaves = |d: f64, lower: f64, upper: f64| {
        (d > room && upper.is_finite()) || (d < -room && lower.is_finite())
    };
    for (j, &d) in direction.iter().enumerate() {
        let (lower, upper) = of.limits(j);
        if leaves(d, lower, upper) {
            return Err(format!("the ray {direction:?} leaves the bounds of x{j}"));
        }
    }
    let along = |row: &[f64]| row.iter().zip(direction).map(|(a, d)| a * d).sum::<f64>();
    for (k, row) in of.rows.iter().enumerate() {
        if leaves(along(&row.coefficients), row.lower, row.upper) {
            return Err(format!("the ray {direction:?} leaves row {k}"));
        }
    }
    let (hessian, gradient) = of.summed();
    if hessian.iter().any(|row| along(row).abs() > 100.0 * room) || along(&gradient) >= 0.0 {
        return Err(format!(
            "the energy does not fall for ever along {direction:?}"
        ));
    }
    Ok(())
}

/// The other strategies end at a point within all limits, or with an error that is right.
fn check_strategies(of: &Instance, truth: &Truth) -> Result<(), String> {
    for strategy in [
        Strategy::Relax,
        Strategy::Direct,
        Strategy::Greedy,
        Strategy::Adaptive,
        Strategy::Lattice,
        Strategy::Exact,
    ] {
        let fault = |text: String| format!("{strategy:?}: {text}");
        match by(of, strategy) {
            Ok(solution) => {
                let is_relaxed = strategy == Strategy::Relax;
                check_point(of, &solution, !is_relaxed).map_err(fault)?;
                let size = of.energy_size(solution.values()).max(1.0);
                if let Truth::Optimum(optimum) = truth {
                    let bound = solution.lower_bound().unwrap();
                    let least = float(optimum);
                    if bound > least + 1e-11 * size {
                        return Err(fault(format!("bound {bound} above {least}")));
                    }
                    let above = solution.energy() - least;
                    let is_optimal = solution.status() == SolveStatus::Optimal;
                    let is_false = is_optimal && !is_relaxed && above > CLOSE * size;
                    if is_false || (is_relaxed && above > CLOSE * size) {
                        return Err(fault(format!("{} for {least}", solution.energy())));
                    }
                    if !is_relaxed && above < -CLOSE * size {
                        return Err(fault(format!("{} below {least}", solution.energy())));
                    }
                } else if !is_relaxed && !matches!(truth, Truth::TooLarge | Truth::Unbounded) {
                    return Err(fault(format!("a point, but {truth:?}")));
                }
            }
            Err(error) => {
                let is_right = match truth {
                    // Bounds of integers may fix what curves downwards, those of reals do not.
                    Truth::Optimum(_) => {
                        error.code() == "not_convex" && strategy == Strategy::Relax
                    }
                    Truth::Infeasible | Truth::NothingNear => {
                        is_infeasible(&error) || error.code() == "unbounded"
                    }
                    Truth::Unbounded => error.code() == "unbounded",
                    Truth::TooLarge => true,
                };
                if !is_right {
                    return Err(fault(format!("{error}, but {truth:?}")));
                }
            }
        }
    }
    Ok(())
}

/// The order of rows and unknowns and their units do not matter.
pub fn check_disguised(of: &Instance, seed: u64) -> Result<(), String> {
    let (other, factor) = of.disguised(&mut Random::new(seed));
    match (by(of, Strategy::Auto), by(&other, Strategy::Auto)) {
        (Ok(first), Ok(second)) => {
            let size = of.energy_size(first.values()).max(1.0);
            let second = second.energy() / factor;
            if (first.energy() - second).abs() > CLOSE * size {
                return Err(format!("{} and {second} in disguise", first.energy()));
            }
        }
        (Err(first), Err(second)) if first.code() == second.code() => {}
        (Err(first), Err(second)) if is_infeasible(&first) && is_infeasible(&second) => {}
        (first, second) => return Err(format!("{first:?}, in disguise {second:?}")),
    }
    Ok(())
}

/// All points of an objective that curves downwards are tried, as all its unknowns are integers.
pub fn check_not_convex(of: &Instance, tally: &mut Tally) -> Result<(), String> {
    match by(of, Strategy::Auto) {
        Err(Error::NotConvex { direction, .. }) => {
            let (hessian, _) = of.summed();
            let rows = hessian.iter().zip(&direction);
            let curvature = rows.map(|(row, d)| {
                let products = row.iter().zip(&direction);
                d * products.map(|(h, e)| h * e).sum::<f64>()
            });
            if curvature.sum::<f64>() >= 0.0 {
                return Err(format!("{direction:?} does not curve downwards"));
            }
            tally.not_convex += 1;
            Ok(())
        }
        _ => check(of, tally),
    }
}
