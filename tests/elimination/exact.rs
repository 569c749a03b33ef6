//! Exact linear algebra on small integer systems: the oracle of the other tests.

use super::System;

/// Whether a system has a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Solvable,
    /// No solution, even with real values for the integers.
    Contradictory,
    /// Solutions only with real values for the integers.
    NotInIntegers,
}

pub fn rank(rows: &[Vec<i64>]) -> usize {
    let cols = rows.first().map_or(0, Vec::len);
    eliminate_columns(rows, cols).1
}

/// Consequences of the rows that do not contain the first `cols` unknowns, and the number of pivots used.
pub fn eliminate_columns(rows: &[Vec<i64>], cols: usize) -> (Vec<Vec<i64>>, usize) {
    let mut rest: Vec<Vec<i128>> = rows
        .iter()
        .map(|row| row.iter().map(|&v| i128::from(v)).collect())
        .collect();
    let mut pivots = 0;
    for col in 0..cols {
        let Some(at) = rest.iter().position(|row| row[col] != 0) else {
            continue;
        };
        let pivot = rest.swap_remove(at);
        pivots += 1;
        for row in &mut rest {
            let (p, v) = (pivot[col], row[col]);
            for (a, b) in row.iter_mut().zip(&pivot) {
                *a = *a * p - b * v;
            }
            let divisor = row.iter().fold(0, |g, &v| gcd(g, v)).max(1);
            row.iter_mut().for_each(|v| *v /= divisor);
        }
    }
    let small = |v: &i128| i64::try_from(*v).unwrap();
    let rest = rest.iter().map(|row| row.iter().map(small).collect());
    (rest.collect(), pivots)
}

/// A system is solvable in integers exactly if the matrix and the matrix with its right side have the same
/// rank and the same greatest common divisor of their largest minors (Heger 1856).
pub fn verdict(system: &System) -> Verdict {
    let augmented: Vec<Vec<i64>> = system
        .rows
        .iter()
        .zip(&system.rhs)
        .map(|(row, &d)| {
            let (integer, continuous) = row.split_at(system.integers);
            [continuous, integer, &[d]].concat()
        })
        .collect();
    let (rest, _) = eliminate_columns(&augmented, system.continuous);
    let rest: Vec<Vec<i64>> = rest
        .into_iter()
        .map(|row| row[system.continuous..].to_vec())
        .collect();
    let left: Vec<Vec<i64>> = rest
        .iter()
        .map(|row| row[..system.integers].to_vec())
        .collect();
    let order = rank(&left);
    if order != rank(&rest) {
        Verdict::Contradictory
    } else if common_minor(&left, order) != common_minor(&rest, order) {
        Verdict::NotInIntegers
    } else {
        Verdict::Solvable
    }
}

/// Greatest common divisor of all minors of the given order.
fn common_minor(rows: &[Vec<i64>], order: usize) -> i128 {
    let cols = rows.first().map_or(0, Vec::len);
    let mut divisor = 0;
    for r in subsets(rows.len(), order) {
        for c in subsets(cols, order) {
            let minor: Vec<Vec<i128>> = r
                .iter()
                .map(|&i| c.iter().map(|&j| i128::from(rows[i][j])).collect())
                .collect();
            divisor = gcd(divisor, determinant(&minor));
        }
    }
    divisor
}

fn subsets(of: usize, size: usize) -> Vec<Vec<usize>> {
    (0..1usize << of)
        .filter(|mask| mask.count_ones() as usize == size)
        .map(|mask| (0..of).filter(|i| mask >> i & 1 == 1).collect())
        .collect()
}

fn determinant(a: &[Vec<i128>]) -> i128 {
    if a.is_empty() {
        return 1;
    }
    let without = |j: usize| -> Vec<Vec<i128>> {
        a[1..]
            .iter()
            .map(|row| [&row[..j], &row[j + 1..]].concat())
            .collect()
    };
    let sign = |j: usize| [1, -1][j % 2];
    (0..a.len())
        .map(|j| sign(j) * a[0][j] * determinant(&without(j)))
        .sum()
}

pub fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}
