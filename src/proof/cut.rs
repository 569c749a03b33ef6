//! Rows that all points with integers satisfy: split cuts.
//!
//! An integer `split . x` is at most `at` or at least `at + 1`. A row that follows from others and from the bounds in
//! both cases holds at all points with integers (`cook1990`). Mixed-integer rounding makes such rows (`nemhauser1990`).

use std::collections::BTreeMap;

use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::{Cut, Number, Terms};
use super::minorant::{Minorant, PartObjective};
use super::problem::{ExactProblem, ExactRow, ExactTerms, Limits};

/// Adds a cut to the rows, if it is one.
///
/// # Errors
/// [`FaultKind::Cut`], [`FaultKind::Reference`], [`FaultKind::Certificate`].
pub(super) fn add(problem: &mut ExactProblem, limits: &Limits, cut: &Cut) -> Checked<()> {
    let most = most(problem, limits, cut)?;
    let lower = Exact::of(cut.lower);
    let follows = match (&most, &lower) {
        (Some(most), Some(lower)) => lower <= most,
        _ => false,
    };
    if !follows {
        let text = format!("a cut with the side {} does not follow", cut.lower);
        return wrong(FaultKind::Cut, text);
    }
    let row = ExactRow {
        terms: exact(problem, &cut.terms)?,
        lower,
        upper: None,
    };
    problem.rows.push(row);
    Ok(())
}

/// The largest lower side of a cut that follows in both cases, if any does.
///
/// # Errors
/// Those of [`add`].
pub(super) fn most(problem: &ExactProblem, limits: &Limits, cut: &Cut) -> Checked<Option<Exact>> {
    let (terms, split) = (exact(problem, &cut.terms)?, exact(problem, &cut.split)?);
    let is_integer = |(j, a): &(usize, Exact)| problem.integer[*j] && a.is_integer();
    let ends = Exact::of(cut.at).zip(Exact::of(1.0));
    let Some((at, one)) = ends.filter(|(at, _)| at.is_integer() && split.iter().all(is_integer))
    else {
        return wrong(FaultKind::Cut, "a split that is no integer");
    };
    let [below, above] = [(&at, 1.0), (&(&at + &one), -1.0)];
    let mut most: Option<Exact> = None;
    for ((side, sign), case) in [below, above].into_iter().zip(&cut.cases) {
        // So `by (split . x - side)` is not above zero in this case.
        let by = Exact::of(sign * case.by).filter(|_| case.by >= 0.0);
        let Some(by) = by else {
            return wrong(FaultKind::Cut, "a multiple of a case that is not positive");
        };
        let multipliers = case.multipliers.iter();
        let multipliers = multipliers.map(|&(row, by)| (row, Number::Float(by)));
        let all = PartObjective::all(&problem.integer);
        let mut sum = Minorant::of_rows(problem, limits, &all, &multipliers.collect())?;
        sum.add(&split, side, &by);
        sum.add(&terms, &Exact::zero(), &one);
        let Ok(least) = sum.least(limits, &all) else {
            return Ok(None);
        };
        most = Some(most.map_or(least.clone(), |most| most.min(least)));
    }
    Ok(most)
}

/// Terms in exact numbers, summed.
fn exact(problem: &ExactProblem, terms: &Terms) -> Checked<ExactTerms> {
    let n = problem.integer.len();
    let mut sums: BTreeMap<usize, Exact> = BTreeMap::new();
    for &(j, a) in terms {
        let j = j as usize;
        if j >= n {
            return wrong(
                FaultKind::Reference,
                format!("there is no unknown {j} of {n}"),
            );
        }
        let Some(a) = Exact::of(a) else {
            return wrong(FaultKind::Cut, "a coefficient that is no number");
        };
        let sum = sums.entry(j).or_insert_with(Exact::zero);
        *sum = &*sum + &a;
    }
    sums.retain(|_, sum| !sum.is_zero());
    Ok(sums.into_iter().collect())
}
