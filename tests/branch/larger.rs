//! Problems with more binaries and unknowns than the other kinds.

use super::instance::{Instance, NONE, Row};
use super::random::Random;
use super::{
    Draft, bounds, chance, equalities, free, linear, ranges, singular, some, switches, unknowns,
    whole,
};

/// Five to nine binaries in sets, covers, choices, knapsacks and implications, and up to two reals.
pub fn binaries(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let (count, reals) = (5 + random.below(5), random.below(3));
    let mut draft = unknowns(random, count, reals);
    for j in 0..count {
        (draft.of.lower[j], draft.of.upper[j]) = (0.0, 1.0);
        draft.point[j] = random.below(2) as f64;
    }
    draft.linear(random, 6);
    let squares = random.below(count);
    draft.squares(random, squares);
    if chance(random, 30) {
        draft.definite(random);
    }
    for _ in 0..1 + random.below(5) {
        binary_row(random, &mut draft, count);
    }
    for x in count..count + reals {
        let z = random.below(count);
        let mut row = vec![0.0; count + reals];
        (row[x], row[z]) = (1.0, -(1.0 + random.below(4) as f64));
        let at = draft.value(&row).max(0.0);
        draft.row(row, -NONE, at);
    }
    draft.done()
}

fn binary_row(random: &mut Random, draft: &mut Draft, count: usize) {
    let mut row = vec![0.0; draft.dim()];
    let some_of: Vec<usize> = (0..count).filter(|_| chance(random, 50)).collect();
    match random.below(5) {
        // An implication.
        0 => {
            let (i, j) = (random.below(count), random.below(count));
            row[i] += 1.0;
            row[j] -= 1.0;
            let at = draft.value(&row).max(0.0);
            draft.row(row, -NONE, at);
        }
        // A knapsack.
        1 => {
            some_of.iter().for_each(|&j| row[j] = some(random, 9));
            let at = draft.value(&row);
            draft.row(row, -NONE, at + random.below(4) as f64);
        }
        // A sum that is at most, at least or exactly what it is at the point.
        kind => {
            some_of.iter().for_each(|&j| row[j] = 1.0);
            let at = draft.value(&row);
            match kind {
                2 => draft.row(row, -NONE, at.max(1.0)),
                3 => draft.row(row, at.min(1.0), NONE),
                _ => draft.equality(row),
            }
        }
    }
}

/// Demands of some times, from what is stored and from what is made where a binary allows it. The unknowns of a time
/// are what is made, what is stored after it, and the binary.
pub fn lots(seed: u64) -> Instance {
    let random = &mut Random::new(seed);
    let times = 2 + random.below(2);
    let n = 3 * times;
    let most = 6.0 + random.below(4) as f64;
    let mut of = free(random, (0..n).map(|j| j % 3 == 2).collect());
    of.lower.fill(0.0);
    for is_made in (2..n).step_by(3) {
        of.upper[is_made] = 1.0;
    }
    for time in 0..times {
        let (made, stored, is_made) = (3 * time, 3 * time + 1, 3 * time + 2);
        of.linear[made] = random.below(5) as f64 / 4.0;
        of.linear[is_made] = 2.0 + random.below(8) as f64;
        of.hessian[made][made] = 0.25;
        of.hessian[stored][stored] = [0.5, 1.0][random.below(2)];
        let (mut balance, mut limit) = (vec![0.0; n], vec![0.0; n]);
        (balance[made], balance[stored]) = (1.0, -1.0);
        if time > 0 {
            balance[stored - 3] = 1.0;
        }
        (limit[made], limit[is_made]) = (1.0, -most);
        let demand = random.below(4) as f64;
        let rows = [(balance, demand, demand, true), (limit, -NONE, 0.0, false)];
        of.rows
            .extend(rows.map(|(coefficients, lower, upper, is_constraint)| Row {
                coefficients,
                lower,
                upper,
                is_constraint,
            }));
    }
    of.rows.sort_by_key(|row| !row.is_constraint);
    of
}

/// Two problems side by side, which a row or a square may link.
pub fn pairs(seed: u64) -> Instance {
    let kinds = [bounds, ranges, equalities, linear, singular, switches];
    let random = &mut Random::new(seed ^ 0xee);
    let mut small = || {
        let mut of = kinds[random.below(kinds.len())](random.below(1 << 20) as u64);
        while of.integer.iter().filter(|integer| **integer).count() > 2 {
            of = kinds[random.below(kinds.len())](random.below(1 << 20) as u64);
        }
        of
    };
    let (first, second) = (small(), small());
    let mut of = beside(first, second);
    let n = of.unknowns();
    let mut row = vec![0.0; n];
    (row[random.below(n)], row[n - 1]) = (some(random, 3), some(random, 3));
    let side = whole(random, 5);
    match seed % 3 {
        0 => {}
        1 => of.squares.push((row, side, 1.0)),
        _ => of.rows.push(Row {
            coefficients: row,
            lower: -NONE,
            upper: side + 4.0,
            is_constraint: false,
        }),
    }
    of
}

fn beside(mut of: Instance, second: Instance) -> Instance {
    let (m, n) = (of.unknowns(), second.unknowns());
    let before = |row: &mut Vec<f64>| row.extend(vec![0.0; n]);
    let after = |mut row: Vec<f64>| {
        row.splice(0..0, vec![0.0; m]);
        row
    };
    of.rows
        .iter_mut()
        .for_each(|row| before(&mut row.coefficients));
    of.squares.iter_mut().for_each(|(row, ..)| before(row));
    of.hessian.iter_mut().for_each(before);
    of.hessian.extend(second.hessian.into_iter().map(after));
    of.rows.extend(second.rows.into_iter().map(|row| Row {
        coefficients: after(row.coefficients),
        ..row
    }));
    of.rows.sort_by_key(|row| !row.is_constraint);
    let squares = second.squares.into_iter();
    of.squares
        .extend(squares.map(|(row, rhs, weight)| (after(row), rhs, weight)));
    of.linear.extend(second.linear);
    of.lower.extend(second.lower);
    of.upper.extend(second.upper);
    of.pins.extend(second.pins);
    of.integer.extend(second.integer);
    of.constant += second.constant;
    of
}
