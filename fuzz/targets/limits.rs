//! Random small problems with inequalities and bounds, through the C interface: a solution is within all limits,
//! no point of a grid is better than its bound, and where all unknowns are integers it is the best of all points.
//! Some inequalities come during the solve.
#![no_main]

use std::ffi::c_void;
use std::ptr::{null, null_mut};

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use roundel::capi::roundel_status::*;
use roundel::capi::*;

fuzz_target!(|bytes: &[u8]| {
    let _ = run(&mut Unstructured::new(bytes));
});

/// `lower <= coefficients . x <= upper`.
struct Row {
    coefficients: Vec<f64>,
    lower: f64,
    upper: f64,
}

impl Row {
    fn holds(&self, x: &[f64], room: f64) -> bool {
        let value = product(&self.coefficients, x);
        value >= self.lower - room && value <= self.upper + room
    }
}

fn product(a: &[f64], x: &[f64]) -> f64 {
    a.iter().zip(x).map(|(a, x)| a * x).sum()
}

/// A multiple of 1/2 from -4 to 4, so that all sums are exact.
fn half(u: &mut Unstructured) -> Result<f64> {
    Ok(f64::from(u.int_in_range(-8i8..=8)?) / 2.0)
}

fn halves(u: &mut Unstructured, n: usize) -> Result<Vec<f64>> {
    (0..n).map(|_| half(u)).collect()
}

fn row(u: &mut Unstructured, n: usize) -> Result<Row> {
    let coefficients = halves(u, n)?;
    let lower = if u.arbitrary()? { half(u)? } else { f64::NEG_INFINITY };
    let upper = if u.arbitrary()? { lower.max(-4.0) + half(u)?.abs() } else { f64::INFINITY };
    Ok(Row { coefficients, lower, upper })
}

unsafe extern "C" fn late(
    candidate: *const roundel_candidate,
    rows: *mut roundel_problem,
    user: *mut c_void,
) -> i32 {
    // SAFETY: the library gives a candidate, and the target its rows.
    let (candidate, given) = unsafe { (&*candidate, &*user.cast::<Vec<Row>>()) };
    // SAFETY: the values have the count that the candidate says.
    let x = unsafe { std::slice::from_raw_parts(candidate.values, candidate.count) };
    for row in given.iter().filter(|row| !row.holds(x, 1e-7)) {
        assert_eq!(add(rows, row), ROUNDEL_OK);
    }
    0
}

fn add(problem: *mut roundel_problem, row: &Row) -> roundel_status {
    let n = row.coefficients.len();
    let all: Vec<i32> = (0..n as i32).collect();
    let (at, values) = (all.as_ptr(), row.coefficients.as_ptr());
    // SAFETY: a live handle, and arrays of n entries.
    unsafe { roundel_problem_add_inequality(problem, n, at, values, row.lower, row.upper, null_mut()) }
}

fn run(u: &mut Unstructured) -> Result<()> {
    let n = u.int_in_range(1..=4)?;
    let all: Vec<i32> = (0..n as i32).collect();
    let mut squares = Vec::new();
    for _ in 0..u.int_in_range(1..=4)? {
        squares.push((halves(u, n)?, half(u)?, half(u)?.abs()));
    }
    let linear = halves(u, n)?;
    let mut lower = Vec::new();
    let mut upper = Vec::new();
    for _ in 0..n {
        let least = u.int_in_range(-3i8..=2)?;
        lower.push(f64::from(least));
        upper.push(f64::from(u.int_in_range(least..=3)?));
    }
    let continuous = u.int_in_range(0..=1)?.min(n - 1);
    let early: Vec<Row> = (0..u.int_in_range(0..=2)?).map(|_| row(u, n)).collect::<Result<_>>()?;
    let given: Vec<Row> = (0..u.int_in_range(0..=2)?).map(|_| row(u, n)).collect::<Result<_>>()?;

    let mut problem = null_mut();
    let mut solution = null_mut();
    // SAFETY: places for handles, live handles, and arrays of n entries.
    let status = unsafe {
        assert_eq!(roundel_problem_new(n, &raw mut problem), ROUNDEL_OK);
        for (row, rhs, weight) in &squares {
            let (at, row) = (all.as_ptr(), row.as_ptr());
            let status = roundel_problem_add_least_squares(problem, n, at, row, *rhs, *weight, null_mut());
            assert_eq!(status, ROUNDEL_OK);
        }
        assert_eq!(roundel_problem_add_linear(problem, linear.as_ptr(), n), ROUNDEL_OK);
        let bounds = roundel_problem_set_bounds(problem, n, all.as_ptr(), lower.as_ptr(), upper.as_ptr());
        assert_eq!(bounds, ROUNDEL_OK);
        let integers = roundel_problem_set_integers(problem, n - continuous, all.as_ptr());
        assert_eq!(integers, ROUNDEL_OK);
        for row in &early {
            assert_eq!(add(problem, row), ROUNDEL_OK);
        }
        let user = (&raw const given).cast_mut().cast();
        let out = &raw mut solution;
        roundel_problem_solve_lazy(problem, null(), null(), Some(late), user, out)
    };
    let rows = || early.iter().chain(&given);
    let energy_at = |x: &[f64]| {
        let squares = squares.iter();
        let squares = squares.map(|(row, rhs, weight)| weight * (product(row, x) - rhs).powi(2));
        squares.sum::<f64>() + product(&linear, x)
    };
    let mut best = f64::INFINITY;
    each_point(&lower, &upper, &mut vec![0.0; n], 0, &mut |x| {
        if rows().all(|row| row.holds(x, 0.0)) {
            best = best.min(energy_at(x));
        }
    });
    if status == ROUNDEL_OK {
        let (mut energy, mut bound) = (0.0, 0.0);
        let mut x = vec![0.0; n];
        // SAFETY: a live handle, and places for the results.
        unsafe {
            assert_eq!(roundel_solution_energy(solution, &raw mut energy), ROUNDEL_OK);
            let mut known = 0;
            let status = roundel_solution_lower_bound(solution, &raw mut known, &raw mut bound);
            assert!(status == ROUNDEL_OK && known == 1);
            assert_eq!(roundel_solution_values(solution, x.as_mut_ptr(), n), ROUNDEL_OK);
        }
        assert!(rows().all(|row| row.holds(&x, 1e-6)), "outside a row");
        let limits = lower.iter().zip(&upper).zip(&x);
        assert!(limits.clone().all(|((l, u), x)| *x >= l - 1e-6 && *x <= u + 1e-6), "outside a bound");
        assert!(x[..n - continuous].iter().all(|x| x.fract() == 0.0), "not an integer");
        assert!((energy - energy_at(&x)).abs() < 1e-6, "another energy");
        assert!(best >= bound - 1e-6, "a bound of {bound} above {best}");
        assert!(energy <= best + 1e-6, "{energy} where {best} is possible");
        assert!(continuous > 0 || energy >= best - 1e-6, "{energy} below {best}");
    } else {
        let is_none = matches!(status, ROUNDEL_ERROR_INFEASIBLE | ROUNDEL_ERROR_NO_INTEGER_SOLUTION);
        assert!(is_none, "{status:?}");
        assert!(best.is_infinite(), "no solution, but {best} is possible");
    }
    // SAFETY: live handles or NULL, which are not used below.
    unsafe {
        assert_eq!(roundel_solution_free(solution), ROUNDEL_OK);
        assert_eq!(roundel_problem_free(problem), ROUNDEL_OK);
    }
    Ok(())
}

/// Calls `see` for all integer points within the bounds.
fn each_point(lower: &[f64], upper: &[f64], x: &mut Vec<f64>, at: usize, see: &mut impl FnMut(&[f64])) {
    if at == x.len() {
        return see(x);
    }
    let mut value = lower[at];
    while value <= upper[at] {
        x[at] = value;
        each_point(lower, upper, x, at + 1, see);
        value += 1.0;
    }
}
