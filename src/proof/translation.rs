//! Directions along which all points may move for ever at the same energy.
//!
//! Let `d` have whole numbers in integers, `Q d = 0`, `q'd = 0` and `a'd = 0` for all least-squares rows, and let it lead
//! to no finite bound and to no finite side of a row. With a point `x`, all `x + t d` for t = 0, 1, 2, ... are points of
//! the same energy, and from some t on, limits from which `d` leads away do not matter: they may be left out. Points
//! then may go forth and back, and an integer that `d` moves may be held within `|d_k|` values: each point has one with
//! such a value and the same energy.

use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::Translation;
use super::problem::{ExactProblem, ExactRow, ExactTerms, Limits, Side, product};

/// Leaves out what the direction of a translation leads away from, and holds its integer, if it is one.
///
/// # Errors
/// [`FaultKind::Reference`], [`FaultKind::Step`].
pub(super) fn hold(
    problem: &mut ExactProblem,
    limits: &mut Limits,
    translation: &Translation,
) -> Checked<()> {
    let n = problem.integer.len();
    let mut direction = vec![Exact::zero(); n];
    let named = translation.direction.iter().map(|(j, _)| *j);
    if let Some(j) = named.chain(translation.held).find(|&j| j as usize >= n) {
        let text = format!("there is no unknown {j} of {n}");
        return wrong(FaultKind::Reference, text);
    }
    for &(j, d) in &translation.direction {
        let own = &mut direction[j as usize];
        match Exact::of(d) {
            Some(d) if own.is_zero() && !d.is_zero() => *own = d,
            _ => return wrong(FaultKind::Step, format!("{d} is no step of x{j}")),
        }
    }
    let moved = || translation.direction.iter().map(|&(j, _)| j as usize);
    let is_held = |j: usize| problem.integer[j] && !direction[j].is_zero();
    if let Some(j) = translation.held.filter(|&j| !is_held(j as usize)) {
        let text = format!("x{j} is no integer that the direction moves");
        return wrong(FaultKind::Step, text);
    }
    if let Some(j) = moved().find(|&j| problem.integer[j] && !direction[j].is_integer()) {
        let text = format!("the direction moves the integer x{j} by a fraction");
        return wrong(FaultKind::Step, text);
    }
    if changes_energy(problem, &direction) {
        return wrong(FaultKind::Step, "the direction changes the energy");
    }
    let leads_to = |change: &Exact| match change.sign().is_gt() {
        true => Side::Upper,
        false => Side::Lower,
    };
    if let Some(j) = moved().find(|&j| limits.side(j, leads_to(&direction[j])).is_some()) {
        let text = format!("the direction leads to a bound of x{j}");
        return wrong(FaultKind::Step, text);
    }
    let change = |row: &ExactRow| Some(product(&row.terms, &direction)).filter(|c| !c.is_zero());
    let leaves = |row: &ExactRow| change(row).is_some_and(|c| row.side(leads_to(&c)).is_some());
    if let Some(i) = problem.rows.iter().position(leaves) {
        let text = format!("the direction leads to a side of row {i}");
        return wrong(FaultKind::Step, text);
    }
    for row in problem.rows.iter_mut().filter(|row| change(row).is_some()) {
        (row.lower, row.upper) = (None, None);
    }
    moved().for_each(|j| limits.release(j));
    if let Some(held) = translation.held.map(|j| j as usize) {
        let one = Exact::of(1.0).unwrap_or_else(Exact::zero);
        limits.tighten(problem, held, Side::Lower, Exact::zero());
        limits.tighten(problem, held, Side::Upper, &direction[held].abs() - &one);
    }
    Ok(())
}

/// Whether some term of the energy changes along a direction.
fn changes_energy(problem: &ExactProblem, direction: &[Exact]) -> bool {
    let mut curved = vec![Exact::zero(); direction.len()];
    for (i, j, v) in &problem.quadratic {
        curved[*i] = &curved[*i] + &(v * &direction[*j]);
        if i != j {
            curved[*j] = &curved[*j] + &(v * &direction[*i]);
        }
    }
    let linear: ExactTerms = problem.linear.iter().cloned().enumerate().collect();
    let mut squares = problem.squares.iter();
    curved.iter().any(|sum| !sum.is_zero())
        || !product(&linear, direction).is_zero()
        || squares.any(|square| !product(&square.terms, direction).is_zero())
}
