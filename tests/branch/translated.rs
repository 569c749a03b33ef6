//! Problems in which all points may move for ever at the same energy.

use super::instance::{Instance, NONE, Row};
use super::random::Random;
use super::{chance, equalities, integrality, linear, ranges, singular, whole};

/// Problems of other kinds in differences to one or two further integers, and rows and bounds that hold from some step
/// on. The truth is that of the problem before.
pub fn translated(seed: u64) -> Instance {
    let origin = match seed % 5 {
        0 => ranges(seed),
        1 => equalities(seed),
        2 => linear(seed),
        3 => singular(seed),
        _ => integrality(seed),
    };
    let random = &mut Random::new(seed ^ 0xaa);
    let origin = with_rows_for_bounds(origin);
    let mut of = origin.clone();
    let mut direction = Vec::new();
    for _ in 0..1 + random.below(2) {
        let steps = of.integer.iter().map(|&integer| {
            let by = if integer { 1.0 } else { 0.25 };
            by * whole(random, 2)
        });
        direction = steps.collect();
        of = in_differences(&of, &direction);
        direction.push(1.0);
    }
    if chance(random, 50) {
        direction.iter_mut().for_each(|d| *d = -*d);
    }
    for _ in 0..random.below(3) {
        hold_from_some_step(random, &mut of, &direction);
    }
    of.origin = Some(Box::new(origin));
    of
}

/// A row or a bound that the direction leads away from.
fn hold_from_some_step(random: &mut Random, of: &mut Instance, direction: &[f64]) {
    let n = of.unknowns();
    let (j, side) = (random.below(n), whole(random, 9) + 0.5);
    if direction[j] > 0.0 {
        of.lower[j] = side;
    } else if direction[j] < 0.0 {
        of.upper[j] = side;
    } else {
        let mut coefficients: Vec<f64> = (0..n).map(|_| whole(random, 2)).collect();
        let change: f64 = coefficients.iter().zip(direction).map(|(a, d)| a * d).sum();
        coefficients[j] = 1.0;
        let (lower, upper) = match change {
            change if change > 0.0 => (side, NONE),
            change if change < 0.0 => (-NONE, side),
            _ => (-NONE, NONE),
        };
        of.rows.push(Row {
            coefficients,
            lower,
            upper,
            is_constraint: false,
        });
    }
}

/// The bounds of unknowns as rows.
fn with_rows_for_bounds(mut of: Instance) -> Instance {
    let n = of.unknowns();
    for j in 0..n {
        let mut coefficients = vec![0.0; n];
        coefficients[j] = 1.0;
        of.rows.push(Row {
            coefficients,
            lower: std::mem::replace(&mut of.lower[j], -NONE),
            upper: std::mem::replace(&mut of.upper[j], NONE),
            is_constraint: false,
        });
    }
    of
}

/// The problem with `x - z steps` for each `x`, where `z` is a further integer.
fn in_differences(of: &Instance, steps: &[f64]) -> Instance {
    let longer = |row: &[f64]| {
        let along: f64 = row.iter().zip(steps).map(|(a, d)| a * d).sum();
        let mut row = row.to_vec();
        row.push(-along);
        row
    };
    let rows = of.hessian.iter().map(|row| longer(row.as_slice()));
    let mut hessian: Vec<Vec<f64>> = rows.collect();
    let column = (0..=of.unknowns()).map(|j| {
        let column: Vec<f64> = hessian.iter().map(|row| row[j]).collect();
        -column.iter().zip(steps).map(|(a, d)| a * d).sum::<f64>()
    });
    let column = column.collect();
    hessian.push(column);
    let mut of = Instance {
        squares: of
            .squares
            .iter()
            .map(|(row, rhs, weight)| (longer(row), *rhs, *weight))
            .collect(),
        hessian,
        linear: longer(&of.linear),
        rows: of
            .rows
            .iter()
            .map(|row| Row {
                coefficients: longer(&row.coefficients),
                ..row.clone()
            })
            .collect(),
        ..of.clone()
    };
    of.integer.push(true);
    of.lower.push(-NONE);
    of.upper.push(NONE);
    of.pins.push(None);
    of
}
