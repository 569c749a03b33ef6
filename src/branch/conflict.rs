//! Why a problem has no solution: a small set of rows and bounds that contradict each other.
//!
//! Where no real point exists, the rows of the dual active-set method's certificate are such a set. Where
//! only integers are missing, rows and bounds are left out one after the other as long as there is still no
//! solution (the deletion filter of `chinneck1991`).

use super::form::{Form, Interval};
use super::translations;
use super::tree::{Limits, search};
use crate::error::{Conflicting, Error, Result};
use crate::linalg::Sparse;
use crate::monitor::Monitor;
use crate::problem::{Problem, limits_text, row_text};

/// The largest number of rows and bounds that the filter tries.
const TRIED: usize = 60;

/// The nodes and the multiplications of one try.
const NODES: u64 = 200;
const WORK: u64 = 5_000_000;

/// The largest number of rows and bounds that the text names.
const NAMED: usize = 6;

/// The rows and bounds of a certificate.
pub(super) fn of_certificate(
    form: &Form,
    members: &[u32],
    rows: &[(u32, f64)],
) -> Vec<Conflicting> {
    let largest = rows.iter().fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
    let of = |row: usize| match row.checked_sub(form.dim()) {
        None => Conflicting::Bounds(members[row] as usize),
        Some(row) => form.origins[row],
    };
    let rows = rows.iter().filter(|(_, v)| v.abs() > 1e-9 * largest);
    let mut elements: Vec<Conflicting> = rows.map(|&(row, _)| of(row as usize)).collect();
    elements.sort_unstable();
    elements.dedup();
    elements
}

/// A small set of rows and bounds of a form without a solution. Where no real point exists either, the set has none.
/// The set is larger where the monitor ends the call.
pub(super) fn of_form(whole: &Form, members: &[u32], monitor: &Monitor) -> Vec<Conflicting> {
    let mut form = whole.clone();
    form.integer.fill(false);
    if !has_none(&form, monitor) {
        form.integer.clone_from(&whole.integer);
    }
    let n = form.dim();
    let bounded = (0..n).filter(|&j| form.limits[j] != Interval::ALL);
    let all: Vec<usize> = bounded
        .chain((0..form.rows.rows()).map(|i| n + i))
        .collect();
    let mut kept = Vec::new();
    for &element in &all {
        let sides = match element.checked_sub(n) {
            None => &mut form.limits[element],
            Some(row) => &mut form.row_limits[row],
        };
        let before = std::mem::replace(sides, Interval::ALL);
        form.boxes.fill(Interval::ALL);
        if all.len() <= TRIED && has_none(&form, monitor) {
            continue;
        }
        match element.checked_sub(n) {
            None => form.limits[element] = before,
            Some(row) => form.row_limits[row] = before,
        }
        kept.push((element as u32, 1.0));
    }
    of_certificate(&form, members, &kept)
}

/// A small set of rows and bounds that contradict each other, whatever the objective is, if a small search
/// finds that there is no solution.
pub(super) fn of_limits(
    form: &Form,
    members: &[u32],
    monitor: &Monitor,
) -> Result<Option<Vec<Conflicting>>> {
    let form = without_objective(form)?;
    Ok(has_none(&form, monitor).then(|| of_form(&form, members, monitor)))
}

/// A certificate that the relaxation of a form has no point; empty if it has one, or if the monitor ends the call.
pub(super) fn of_root(form: &Form, monitor: &Monitor) -> Vec<(u32, f64)> {
    none_within(form, 1, u64::MAX, monitor).unwrap_or_default()
}

/// Whether a small search shows that the form has no solution.
fn has_none(form: &Form, monitor: &Monitor) -> bool {
    let held = without_objective(form).and_then(|form| translations::held(&form));
    let form = match &held {
        Ok(Some(held)) => &held.form,
        _ => form,
    };
    none_within(form, NODES, WORK, monitor).is_some()
}

fn without_objective(form: &Form) -> Result<Form> {
    let n = form.dim();
    Ok(Form {
        hessian: Sparse::from_triplets(n, n, std::iter::empty())?,
        gradient: vec![0.0; n],
        ..form.clone()
    })
}

/// The last certificate of a search of so many nodes and multiplications, if it shows that there is no solution.
/// Points that it finds are none of the problem: the caller is not told.
fn none_within(form: &Form, nodes: u64, work: u64, monitor: &Monitor) -> Option<Vec<(u32, f64)>> {
    if form.limits.iter().any(|limits| limits.is_empty()) {
        return Some(Vec::new());
    }
    let limits = Limits {
        work,
        first: true,
        ..Limits::inner(nodes)
    };
    let found = search(form, None, limits, &mut monitor.silent()).ok()?;
    (found.is_complete && found.best.is_none()).then_some(found.conflict)
}

/// The error that names the elements.
pub(super) fn error(problem: &Problem, elements: &[Conflicting]) -> Error {
    let named: Vec<String> = elements
        .iter()
        .take(NAMED)
        .map(|e| text(problem, *e))
        .collect();
    let more = elements.len().saturating_sub(NAMED);
    let rest = if more > 0 {
        format!(", and {more} more rows and bounds")
    } else {
        String::new()
    };
    let what = match named.len() {
        0 => "the constraints contradict each other".to_owned(),
        1 if more == 0 => format!("{} cannot hold", named[0]),
        _ => format!("{}{rest} contradict each other", named.join("; ")),
    };
    Error::Contradiction {
        what,
        index: elements.first().map(|element| match *element {
            Conflicting::Constraint(k) | Conflicting::Inequality(k) | Conflicting::Bounds(k) => k,
        }),
        elements: elements.to_vec(),
    }
}

fn text(problem: &Problem, element: Conflicting) -> String {
    match element {
        Conflicting::Constraint(k) => {
            let rows = problem.constraint_rows();
            format!("constraint {k}: {}", row_text(rows.row(k), rows.rhs()[k]))
        }
        Conflicting::Inequality(k) => {
            let rows = problem.inequality_rows();
            let text = limits_text(rows.row(k), rows.lower()[k], rows.upper()[k]);
            format!("inequality {k}: {text}")
        }
        Conflicting::Bounds(j) => {
            let (lower, upper) = problem.limits_of(j);
            let kind = if problem.integers()[j] {
                "integer "
            } else {
                ""
            };
            let text = match problem.pins()[j] {
                Some(value) => format!("x{j} pinned to {value}"),
                None => limits_text([(j, 1.0)].into_iter(), lower, upper),
            };
            format!("bounds of {kind}variable {j}: {text}")
        }
    }
}

#[cfg(test)]
#[path = "conflict_tests.rs"]
mod tests;
