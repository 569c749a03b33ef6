//! The search of a part for a proof.

use super::form::Form;
use super::presolve::Part;
use super::record::{self, Added};
use super::tree::{self, Limits};
use super::{cuts, hull, interior, perspective, search_alone, symmetry};
use crate::error::{Error, Result};
use crate::monitor::Monitor;
use crate::problem::Problem;
use crate::proof::Derivation;
use crate::search::StoppedBy;

/// The most numbers that the bounds of all nodes are made from, in a tree that repeats a search: the proof computes with
/// them exactly.
const NUMBERS: usize = 50_000_000;

/// Searches a part for a proof. It is in the rows and unknowns of the problem, and knows no symmetry: where a search with
/// all of that may be faster, it comes first, and the tree of the proof is that of another one, from the point that was
/// found.
pub(super) fn search(
    problem: &Problem,
    part: &Part,
    start: Option<Vec<f64>>,
    limits: Limits,
    record: &mut Derivation,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    let perspective = perspective::strengthened(&part.form, monitor)?;
    let form = perspective.as_ref().map_or(&part.form, |of| &of.form);
    let switches = perspective.as_ref().map_or(&[][..], |of| &of.switches);
    let cut = cuts::strengthened(form, monitor)?;
    let form = cut.as_ref().map_or(form, |of| &of.form);
    let (mut start, mut limits, mut first) = (start, limits, None);
    if has_shortcut(&part.form)? {
        let all = Limits {
            recorded: false,
            ..limits
        };
        let found = monitor
            .in_half_of_the_time(|monitor| search_alone(&part.form, start.clone(), all, monitor));
        first = match found {
            Err(Error::TimeLimit) => None,
            found => Some(found?),
        };
        let numbers = form.dim() + form.hessian.len() + form.rows.len();
        limits.nodes = limits.nodes.min((NUMBERS / numbers) as u64);
        let best = first.as_ref().and_then(|found| found.best.as_ref());
        start = best.map(|(point, _)| point.clone()).or(start);
    }
    let mut found = tree::search(form, start, limits, monitor)?;
    let nodes = std::mem::take(&mut found.visited);
    let added = Added {
        constraints: problem.constraints(),
        inequalities: problem.inequalities(),
        switches,
        cuts: cut.as_ref().map_or(&[], |of| &of.cuts),
        rows: cut.as_ref().map_or(&[], |of| &of.rows),
    };
    let searched = record::of_whole(form, &part.members, added, nodes);
    record.parts.push(searched);
    Ok(match first {
        Some(first) => of_both(first, found),
        None => found,
    })
}

/// Whether a search may use what a proof cannot tell.
fn has_shortcut(form: &Form) -> Result<bool> {
    let is_simpler = interior::is_for(form) || hull::project(form)?.is_some();
    Ok(is_simpler || symmetry::ordered(form, None).is_some())
}

/// What two searches of the same form have found.
fn of_both(first: tree::Found, second: tree::Found) -> tree::Found {
    let energy = |found: &tree::Found| found.best.as_ref().map_or(f64::INFINITY, |best| best.1);
    let is_complete = first.is_complete || second.is_complete;
    tree::Found {
        bound: first.bound.max(second.bound),
        is_complete,
        nodes: first.nodes + second.nodes,
        work: first.work + second.work,
        stopped_by: match is_complete {
            true => StoppedBy::Nothing,
            false => first.stopped_by,
        },
        best: match energy(&second) < energy(&first) {
            true => second.best,
            false => first.best,
        },
        ..second
    }
}
