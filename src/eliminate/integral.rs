//! Rows of integer unknowns only: brought to integer coefficients, then solved by unimodular steps.
//!
//! A row with a coefficient of 1 or -1 is solved for that unknown. Any other gets, as in the
//! equality step of the Omega test (Pugh 1991, section 2.2; the idea is Euclid's, and repeated to
//! the end it is Hermite's normal form), a new integer
//!
//! ```text
//! t = x_k + sum_i q_i x_i,    a_k the least coefficient,  q_i = a_i / a_k rounded,
//! ```
//!
//! after which the row reads `a_k t + sum_i (a_i - q_i a_k) x_i = b`: its coefficients have at
//! least halved but for one. Since `x_k` and `t` give each other with integer coefficients, no
//! integer solution is lost and none is made up.

use super::ratio::integer_multiples;
use super::row::{Row, representable};
use super::stack::Substitution;
use super::tableau::Tableau;
use super::tolerance::{LARGEST, near_integer};
use super::unknowns::Unknowns;
use crate::{Error, Result};

/// Turns the coefficients of row `r`, which has integer unknowns only, into integers.
pub(super) fn make_integral(tableau: &mut Tableau, r: usize) -> Result<()> {
    let row = &mut tableau.rows[r];
    let Some(unit) = integer_multiples(row) else {
        return Err(Error::NotSupported {
            what: format!(
                "constraint {r}: {} leaves a relation of integers whose coefficients have no common measure",
                tableau.text(r)
            ),
            index: Some(r),
            line: None,
        });
    };
    let rhs = row.rhs / unit;
    let rounded = near_integer(rhs, row.rhs_magnitude / unit);
    if row.entries.iter().any(|e| e.1.abs() >= LARGEST) || rhs.abs() >= LARGEST {
        return Err(tableau.overflow(r));
    }
    let Some(rounded) = rounded else {
        return Err(tableau.no_integer_solution(r));
    };
    row.rhs = rounded;
    row.integral = true;
    Ok(())
}

/// Solves the integral row `r`.
pub(super) fn eliminate(tableau: &mut Tableau, r: usize) -> Result<()> {
    loop {
        if !divide_by_common_factor(&mut tableau.rows[r]) {
            return Err(tableau.no_integer_solution(r));
        }
        let entries = &tableau.rows[r].entries;
        let occurrences = &tableau.occurrences;
        let units = (0..entries.len()).filter(|&at| entries[at].1.abs() == 1.0);
        match units.min_by_key(|&at| occurrences.count(entries[at].0)) {
            Some(at) => return tableau.solve_for(r, at),
            None => euclidean_step(tableau, r)?,
        }
    }
}

/// Makes the coefficients coprime. False if the right side does not allow it.
fn divide_by_common_factor(row: &mut Row) -> bool {
    let factor = row.entries.iter().fold(0.0, |g, e| gcd(g, e.1));
    if row.rhs % factor != 0.0 {
        return false;
    }
    row.entries.iter_mut().for_each(|e| e.1 /= factor);
    row.rhs /= factor;
    row.magnitude = row.entries.iter().fold(0.0, |m: f64, e| m.max(e.1.abs()));
    row.rhs_magnitude = row.rhs.abs();
    true
}

/// Greatest common divisor of two integers, not negative. Remainders of doubles are exact.
fn gcd(a: f64, b: f64) -> f64 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0.0 {
        (a, b) = (b, a % b);
    }
    a
}

fn euclidean_step(tableau: &mut Tableau, r: usize) -> Result<()> {
    let row = &tableau.rows[r];
    let occurrences = &tableau.occurrences;
    let least = row
        .entries
        .iter()
        .map(|&(j, a)| (a.abs() as u64, occurrences.count(j), j, a))
        .min_by_key(|&(size, count, j, _)| (size, count, j));
    let Some((_, _, pivot, divisor)) = least else {
        return Err(tableau.infeasible(r));
    };
    let mut guess = tableau.unknowns.guess[pivot as usize];
    let mut remainders = Vec::with_capacity(row.entries.len());
    let mut terms = Vec::with_capacity(row.entries.len());
    for &(j, a) in row.entries.iter().filter(|e| e.0 != pivot) {
        let (quotient, remainder) = divide(a, divisor);
        if quotient != 0.0 {
            guess += quotient * tableau.unknowns.guess[j as usize];
            terms.push((j, -quotient));
        }
        if remainder != 0.0 {
            remainders.push((j, remainder));
        }
    }
    let t = tableau
        .unknowns
        .introduce(true, guess, Unknowns::NOWHERE, 0);
    remainders.push((t, divisor));
    let largest = terms.iter().fold(1.0, |m: f64, e| m.max(e.1.abs()));
    representable(largest, true).map_err(|_| tableau.overflow(r))?;
    terms.push((t, 1.0));
    tableau.rows[r].entries = remainders;
    let by = Substitution {
        pivot,
        constraint: r as u32,
        constant: 0.0,
        largest,
        magnitude: largest,
        rhs_magnitude: 0.0,
    };
    tableau.stack.push(by, terms);
    tableau.apply_last()
}

/// Quotient and remainder of least size.
fn divide(a: f64, by: f64) -> (f64, f64) {
    let (a, by) = (a as i64, by as i64);
    let (mut quotient, mut remainder) = (a / by, a % by);
    if 2 * remainder.abs() > by.abs() {
        let step = remainder.signum() * by.signum();
        quotient += step;
        remainder -= step * by;
    }
    (quotient as f64, remainder as f64)
}

#[cfg(test)]
mod tests {
    use super::{divide, gcd};

    #[test]
    fn quotient_and_remainder_make_up_the_number_and_the_remainder_is_least() {
        for a in -30..=30 {
            for by in (-7..=7).filter(|&by| by != 0) {
                let (q, r) = divide(f64::from(a), f64::from(by));
                assert_eq!(q * f64::from(by) + r, f64::from(a));
                assert!(2.0 * r.abs() <= f64::from(by).abs(), "{a} / {by}");
            }
        }
    }

    #[test]
    fn the_common_divisor_of_large_numbers_is_exact() {
        let p = 94_906_249.0; // prime, and near the root of 2^53
        assert_eq!(gcd(p * 94_906_260.0, -p * 7.0), p);
        assert_eq!(gcd(0.0, -6.0), 6.0);
    }
}
