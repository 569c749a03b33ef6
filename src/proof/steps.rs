//! Bounds that a row implies, checked by multiplications alone.

use super::exact::Exact;
use super::fault::{Checked, FaultKind, Wrong, wrong};
use super::format::Step;
use super::problem::{ExactProblem, ExactRow, Limits, Side};

/// Takes a step, if it is right.
///
/// # Errors
/// [`FaultKind::Reference`], [`FaultKind::Step`].
pub(super) fn take(problem: &mut ExactProblem, limits: &mut Limits, step: Step) -> Checked<()> {
    let (row, value) = match step {
        Step::Lower(row, _, value) | Step::Upper(row, _, value) => (row, value),
        Step::RowLower(row, value) | Step::RowUpper(row, value) => (row, value),
    };
    let count = problem.rows.len();
    if row as usize >= count {
        let text = format!("there is no row {row} of {count}");
        return wrong(FaultKind::Reference, text);
    }
    let Some(to) = Exact::of(value) else {
        return wrong(FaultKind::Step, format!("{value} is no bound"));
    };
    match step {
        Step::Lower(row, unknown, _) | Step::Upper(row, unknown, _) => {
            let side = match step {
                Step::Lower(..) => Side::Lower,
                _ => Side::Upper,
            };
            let of = &problem.rows[row as usize];
            let unknown = unknown as usize;
            if !is_implied(problem, limits, of, unknown, side, &to) {
                let text = format!("row {row} does not imply the bound {value} of x{unknown}");
                return wrong(FaultKind::Step, text);
            }
            limits.tighten(problem, unknown, side, to);
        }
        Step::RowLower(..) | Step::RowUpper(..) => {
            let side = match step {
                Step::RowLower(..) => Side::Lower,
                _ => Side::Upper,
            };
            if !is_rounded(problem, &problem.rows[row as usize], side, &to) {
                let text = format!("integers do not imply the side {value} of row {row}");
                return wrong(FaultKind::Step, text);
            }
            let row = &mut problem.rows[row as usize];
            match side {
                Side::Lower => row.lower = Some(to),
                Side::Upper => row.upper = Some(to),
            }
        }
    }
    Ok(())
}

/// The least (or with [`Side::Upper`] the largest) value of a row's terms, without those of one unknown.
pub(super) fn activity(
    row: &ExactRow,
    limits: &Limits,
    without: Option<usize>,
    side: Side,
) -> Option<Exact> {
    let mut sum = Exact::zero();
    for (j, a) in row.terms.iter().filter(|(j, _)| Some(*j) != without) {
        let is_positive = a.sign().is_gt();
        let end = match (side, is_positive) {
            (Side::Lower, true) | (Side::Upper, false) => limits.side(*j, Side::Lower),
            _ => limits.side(*j, Side::Upper),
        };
        sum = &sum + &(a * end.as_ref()?);
    }
    Some(sum)
}

/// Whether no point within the row and the limits has the unknown beyond `to`. An integer beyond it is at
/// least one beyond.
fn is_implied(
    problem: &ExactProblem,
    limits: &Limits,
    row: &ExactRow,
    unknown: usize,
    side: Side,
    to: &Exact,
) -> bool {
    let Some(a) = row.coefficient(unknown) else {
        return false;
    };
    let is_integer = problem.integer[unknown];
    if is_integer && !to.is_integer() {
        return false;
    }
    let one = Exact::of(1.0).unwrap_or_else(Exact::zero);
    let first_beyond = match (is_integer, side) {
        (false, _) => to.clone(),
        (true, Side::Lower) => to - &one,
        (true, Side::Upper) => to + &one,
    };
    let term = a * &first_beyond;
    // The term may only be as large as the upper side minus the least of the others, or as small as the lower
    // side minus the largest of the others.
    let of_upper = (side == Side::Upper) == a.sign().is_gt();
    let (held, others) = if of_upper {
        (
            &row.upper,
            activity(row, limits, Some(unknown), Side::Lower),
        )
    } else {
        (
            &row.lower,
            activity(row, limits, Some(unknown), Side::Upper),
        )
    };
    let (Some(held), Some(others)) = (held, others) else {
        return false;
    };
    let room = held - &others;
    match (of_upper, is_integer) {
        (true, true) => term > room,
        (true, false) => term >= room,
        (false, true) => term < room,
        (false, false) => term <= room,
    }
}

/// Whether all integers leave the row's value at `to` or further inside.
fn is_rounded(problem: &ExactProblem, row: &ExactRow, side: Side, to: &Exact) -> bool {
    let Some(held) = row.side(side) else {
        return false;
    };
    if row.terms.iter().any(|(j, _)| !problem.integer[*j]) {
        return false;
    }
    let divisor = row
        .terms
        .iter()
        .fold(Exact::zero(), |divisor, (_, a)| divisor.common_divisor(a));
    if divisor.is_zero() {
        return false;
    }
    match side {
        Side::Upper => *to >= held.floor_to_multiple(&divisor),
        Side::Lower => -to >= (-held).floor_to_multiple(&divisor),
    }
}

/// The row that a number of the proof stands for.
///
/// # Errors
/// [`FaultKind::Reference`].
pub(super) fn row_of(problem: &ExactProblem, row: u32) -> Result<&ExactRow, Wrong> {
    let found = problem.rows.get(row as usize);
    let count = problem.rows.len();
    found.ok_or_else(|| {
        let text = format!("there is no row {row} of {count}");
        (FaultKind::Reference, text)
    })
}
