//! Problems of other kinds in other forms, which have the truth of what they were before.

use super::instance::{Instance, NONE, Row};
use super::random::Random;
use super::{chance, contradictory, degenerate, equalities, free_integers, integrality, linear};
use super::{ranges, singular, some, switches, whole};

/// Integers and reals up to a million from zero.
pub fn far(seed: u64) -> Instance {
    let origin = match seed % 7 {
        0 => ranges(seed),
        1 => equalities(seed),
        2 => linear(seed),
        3 => singular(seed),
        4 => degenerate(seed),
        5 => free_integers(seed),
        _ => integrality(seed),
    };
    let random = &mut Random::new(seed ^ 0x77);
    let size = [256, 4096, 65_536, 1 << 20][random.below(4)];
    let n = origin.unknowns();
    let shift: Vec<f64> = (0..n).map(|_| whole(random, size)).collect();
    let along = |row: &[f64]| row.iter().zip(&shift).map(|(a, s)| a * s).sum::<f64>();
    let mut of = origin.clone();
    for (j, by) in shift.iter().enumerate() {
        of.lower[j] += by;
        of.upper[j] += by;
    }
    for row in &mut of.rows {
        let by = along(&row.coefficients);
        (row.lower, row.upper) = (row.lower + by, row.upper + by);
    }
    for (row, rhs, _) in &mut of.squares {
        *rhs += along(row);
    }
    for (slope, row) in of.linear.iter_mut().zip(&origin.hessian) {
        *slope -= along(row);
    }
    of.constant -= 0.5 * (along(&origin.linear) + along(&of.linear));
    of.origin = Some(Box::new(origin));
    of
}

/// Reals in other units, and rows in others still.
pub fn units(seed: u64) -> Instance {
    let origin = match seed % 5 {
        0 => ranges(seed),
        1 => equalities(seed),
        2 => linear(seed),
        3 => singular(seed),
        _ => switches(seed),
    };
    let random = &mut Random::new(seed ^ 0x99);
    let power = |random: &mut Random| 2f64.powi(random.below(21) as i32 - 10);
    let mut of = origin.clone();
    let mut unit = |is_integer: &bool| match is_integer {
        true => 1.0,
        false => power(random),
    };
    let units: Vec<f64> = of.integer.iter().map(&mut unit).collect();
    let scale = |row: &mut Vec<f64>, by: f64| {
        row.iter_mut().zip(&units).for_each(|(a, u)| *a *= by * u);
    };
    for (j, unit) in units.iter().enumerate() {
        of.lower[j] /= unit;
        of.upper[j] /= unit;
        scale(&mut of.hessian[j], *unit);
    }
    scale(&mut of.linear, 1.0);
    for row in &mut of.rows {
        let by = power(random);
        scale(&mut row.coefficients, by);
        (row.lower, row.upper) = (by * row.lower, by * row.upper);
    }
    for (row, rhs, weight) in &mut of.squares {
        let by = power(random);
        scale(row, by);
        (*rhs, *weight) = (by * *rhs, *weight / (by * by));
    }
    of.origin = Some(Box::new(origin));
    of
}

/// Some sums of unknowns as further reals, which equations define.
pub fn defined(seed: u64) -> Instance {
    let origin = match seed % 6 {
        0 => ranges(seed),
        1 => equalities(seed),
        2 => linear(seed),
        3 => singular(seed),
        4 => contradictory(seed),
        _ => integrality(seed),
    };
    let random = &mut Random::new(seed ^ 0x33);
    let mut of = origin.clone();
    for _ in 0..1 + random.below(3) {
        define(random, &mut of);
    }
    of.rows.sort_by_key(|row| !row.is_constraint);
    of.origin = Some(Box::new(origin));
    of
}

/// One further real, which rows and squares have in place of others.
fn define(random: &mut Random, of: &mut Instance) {
    let n = of.unknowns();
    let (mut sum, side) = (vec![0.0; n], whole(random, 3));
    for _ in 0..2 {
        sum[random.below(n)] = some(random, 2) / 2.0;
    }
    let longer = |row: &mut Vec<f64>, by: f64| {
        row.iter_mut().zip(&sum).for_each(|(a, s)| *a -= by * s);
        row.push(by);
    };
    let mut by = || match chance(random, 60) {
        true => some(random, 2),
        false => 0.0,
    };
    for row in &mut of.rows {
        let by = by();
        longer(&mut row.coefficients, by);
        (row.lower, row.upper) = (row.lower + by * side, row.upper + by * side);
    }
    for (row, rhs, _) in &mut of.squares {
        let by = by();
        longer(row, by);
        *rhs += by * side;
    }
    let by = by();
    longer(&mut of.linear, by);
    of.constant -= by * side;
    of.hessian.iter_mut().for_each(|row| row.push(0.0));
    of.hessian.push(vec![0.0; n + 1]);
    of.integer.push(false);
    of.lower.push(-NONE);
    of.upper.push(NONE);
    of.pins.push(None);
    let mut coefficients: Vec<f64> = sum.iter().map(|s| -s).collect();
    coefficients.push(1.0);
    of.rows.push(Row {
        coefficients,
        lower: side,
        upper: side,
        is_constraint: true,
    });
}

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
