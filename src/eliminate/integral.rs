//! Rows with integer unknowns only: they get integer coefficients and are solved by unimodular steps.
//!
//! A row with a coefficient of 1 or -1 is solved for that unknown. Any other row gets a new integer t, as in
//! the equality step of the Omega test (`pugh1991`, section 2.2). The step is that of Euclid's algorithm; its
//! repetition computes Hermite's normal form.
//!
//! ```text
//! t = x_k + sum_i q_i x_i,    a_k the least coefficient,  q_i = a_i / a_k rounded,
//! ```
//!
//! The row then reads `a_k t + sum_i (a_i - q_i a_k) x_i = b`, where each coefficient but one is at most half
//! of `a_k`. Since `x_k` and `t` determine each other with integer coefficients, the integer solutions stay
//! the same.

use super::ratio::gcd;
use super::row::{Row, representable};
use super::steps::Step;
use super::substitution::Substitution;
use super::tableau::Tableau;
use super::unknowns::Unknowns;
use crate::error::Result;

/// Solves the integral row `r`.
pub(super) fn eliminate(tableau: &mut Tableau, r: usize) -> Result<()> {
    loop {
        let (row, factor) = (r as u32, divide_by_common_factor(&mut tableau.rows[r]));
        tableau.steps.push(Step::Divide { row, factor });
        let entries = &tableau.rows[r].entries;
        let units = (0..entries.len()).filter(|&at| entries[at].1.abs() == 1.0);
        match units.min_by_key(|&at| tableau.cost(entries[at].0)) {
            Some(at) => return tableau.solve_for(r, at),
            None => euclidean_step(tableau, r)?,
        }
    }
}

/// Divides the coefficients by their greatest common divisor, and returns it.
fn divide_by_common_factor(row: &mut Row) -> f64 {
    let factor = row.entries.iter().fold(0.0, |g, e| gcd(g, e.1));
    row.entries.iter_mut().for_each(|e| e.1 /= factor);
    row.magnitude = row.entries.iter().fold(0.0, |m: f64, e| m.max(e.1.abs()));
    factor
}

fn euclidean_step(tableau: &mut Tableau, r: usize) -> Result<()> {
    let row = &tableau.rows[r];
    let least = row
        .entries
        .iter()
        .map(|&(j, a)| (a.abs() as u64, tableau.cost(j), j, a))
        .min_by_key(|&(size, count, j, _)| (size, count, j));
    let Some((_, _, pivot, divisor)) = least else {
        return Err(tableau.overflow(r));
    };
    let mut definition = vec![(pivot, 1.0)];
    let mut remainders = Vec::with_capacity(row.entries.len());
    let mut terms = Vec::with_capacity(row.entries.len());
    for &(j, a) in row.entries.iter().filter(|e| e.0 != pivot) {
        let (quotient, remainder) = divide(a, divisor);
        if quotient != 0.0 {
            definition.push((j, quotient));
            terms.push((j, -quotient));
        }
        if remainder != 0.0 {
            remainders.push((j, remainder));
        }
    }
    let t = tableau.unknowns.introduce(true, Unknowns::NOWHERE, 0);
    tableau.definitions.push(t, definition, 1.0);
    remainders.push((t, divisor));
    let largest = terms.iter().fold(1.0, |m: f64, e| m.max(e.1.abs()));
    representable(largest, true).map_err(|_| tableau.overflow(r))?;
    terms.push((t, 1.0));
    tableau.rows[r].entries = remainders;
    let by = Substitution {
        pivot,
        constraint: r as u32,
        largest,
        magnitude: largest,
        denominator: Some(1.0),
    };
    tableau.stack.push(by, terms);
    tableau.steps.push(Step::Introduce);
    tableau.apply_last()
}

/// Quotient and remainder, with a remainder of least absolute value.
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
    use super::divide;

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
}
