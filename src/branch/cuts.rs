//! Rounds of cuts at the root: rows that cut off the minimiser of the relaxation, made from its rows, until the bound
//! rises no more.

use super::dual_active_set::Active;
use super::form::Form;
use super::mir::{Cut, Rounding};
use super::relaxation::{Relaxation, Relaxed, regularization};
use super::shared::Shared;
use crate::error::Result;
use crate::monitor::{Monitor, is_wanted};

/// The largest number of rounds.
const ROUNDS: usize = 50;

/// Rounds end when the bound rises by less than this part of its rise so far.
const LITTLE: f64 = 0.002;

/// Cuts are kept if the bound rises by this part of it.
const WORTH: f64 = 1e-4;

/// A round adds at most this many cuts, and a part of the number of unknowns.
const ADDED: usize = 20;
const PART: f64 = 0.2;

/// Two cuts of a round whose normals have a larger cosine are one.
const PARALLEL: f64 = 0.9;

/// The multiplications of a round that look for cuts.
const WORK: u64 = 50_000_000;

/// A form with cuts as its last rows.
pub(super) struct Strengthened {
    pub form: Form,
    /// The cuts that these rows are, and before each of them those that it was made from. Rows of splits are those of
    /// the form without cuts, and then these.
    pub cuts: Vec<Cut>,
    /// For each of the last rows, its cut.
    pub rows: Vec<usize>,
}

/// A form with cuts, if they raise its bound.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::NotConvex`](crate::Error::NotConvex).
pub(super) fn strengthened(form: &Form, monitor: &mut Monitor) -> Result<Option<Strengthened>> {
    let is_open = |j: usize| form.integer[j] && !form.limits[j].is_point();
    if !(0..form.dim()).any(is_open) {
        return Ok(None);
    }
    let _watch = monitor.watch_search();
    let Some(first) = relaxed(form, &[])? else {
        return Ok(None);
    };
    let start = first.bound;
    let mut best = (start, Vec::new());
    // All cuts, those that are rows, and those that stay rows.
    let mut all: Vec<Cut> = Vec::new();
    let (mut rows, mut cuts): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    let (mut next, mut last) = (form.clone(), first);
    for _ in 0..ROUNDS {
        if monitor.ends() {
            break;
        }
        let added = separated(&next, &last.point);
        if added.is_empty() {
            break;
        }
        let (own, before) = (form.rows.rows(), all.len());
        for mut cut in added {
            for (row, _) in &mut cut.split.rows {
                if let Some(k) = (*row as usize).checked_sub(own) {
                    *row = (own + rows[k]) as u32;
                }
            }
            all.push(cut);
        }
        cuts.extend(before..all.len());
        next = with_cuts(form, &all, &cuts)?;
        rows.clone_from(&cuts);
        let (_, of_form) = last.split(form);
        let Some(solved) = relaxed(&next, &of_form)? else {
            break;
        };
        // Cuts that hold nothing go.
        let (held, _) = solved.split(form);
        cuts = held.iter().map(|&k| cuts[k]).collect();
        let rise = solved.bound - best.0;
        if rise > 0.0 {
            best = (solved.bound, cuts.clone());
        }
        if rise <= LITTLE * (solved.bound - start) {
            break;
        }
        last = solved;
    }
    let (bound, best) = best;
    if bound <= start + WORTH * start.abs() {
        return Ok(None);
    }
    let (cuts, rows) = needed(all, &best, form.rows.rows());
    Ok(Some(Strengthened {
        form: with_cuts(form, &cuts, &rows)?,
        cuts,
        rows,
    }))
}

/// The cuts that are rows, those that they were made from, and no others. The form without cuts has `own` rows.
fn needed(all: Vec<Cut>, rows: &[usize], own: usize) -> (Vec<Cut>, Vec<usize>) {
    let mut is_needed = vec![false; all.len()];
    rows.iter().for_each(|&k| is_needed[k] = true);
    for k in (0..all.len()).rev() {
        if !is_needed[k] {
            continue;
        }
        let of_cuts = all[k].split.rows.iter();
        let of_cuts = of_cuts.filter_map(|(row, _)| (*row as usize).checked_sub(own));
        of_cuts.for_each(|earlier| is_needed[earlier] = true);
    }
    let mut place = Vec::with_capacity(all.len());
    let mut cuts: Vec<Cut> = Vec::new();
    for (mut cut, is_needed) in all.into_iter().zip(is_needed) {
        place.push(cuts.len());
        if !is_needed {
            continue;
        }
        for (row, _) in &mut cut.split.rows {
            if let Some(earlier) = (*row as usize).checked_sub(own) {
                *row = (own + place[earlier]) as u32;
            }
        }
        cuts.push(cut);
    }
    let rows = rows.iter().map(|&k| place[k]).collect();
    (cuts, rows)
}

/// The minimiser of a relaxation.
struct Minimiser {
    bound: f64,
    point: Vec<f64>,
    active: Vec<Active>,
}

impl Minimiser {
    /// The numbers of the cuts that hold it, and what holds it of the form without them.
    fn split(&self, form: &Form) -> (Vec<usize>, Vec<Active>) {
        let own = form.dim() + form.rows.rows();
        let (cuts, others): (Vec<Active>, Vec<Active>) = self
            .active
            .iter()
            .partition(|held| held.row as usize >= own);
        let cuts = cuts.iter().filter(|held| held.multiplier != 0.0);
        let mut cuts: Vec<usize> = cuts.map(|held| held.row as usize - own).collect();
        cuts.sort_unstable();
        (cuts, others)
    }
}

/// The minimiser of the relaxation, if there is one. The search for it begins at the active rows of another one.
fn relaxed(form: &Form, warm: &[Active]) -> Result<Option<Minimiser>> {
    let shared = Shared::new(form, &regularization(form))?;
    let mut relaxation = Relaxation::new(form, &shared);
    relaxation.start_from(warm);
    let Relaxed::Solved { bound } = relaxation.solve(f64::INFINITY, &form.boxes) else {
        return Ok(None);
    };
    Ok(Some(Minimiser {
        bound,
        point: relaxation.solver.point().to_vec(),
        active: relaxation.active().to_vec(),
    }))
}

/// Cuts from the rows of a form, the most distant from its minimiser first.
fn separated(form: &Form, point: &[f64]) -> Vec<Cut> {
    let mut rounding = Rounding::new(form, point);
    let mut found = Vec::new();
    for row in 0..form.rows.rows() {
        if rounding.work > WORK || is_wanted().is_err() {
            break;
        }
        rounding.separate(row, &mut found);
    }
    found.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    let most = ADDED + (PART * form.dim() as f64) as usize;
    let mut chosen: Vec<Cut> = Vec::new();
    for cut in found {
        if chosen.len() >= most {
            break;
        }
        if chosen.iter().all(|other| cosine(&cut, other) <= PARALLEL) {
            chosen.push(cut);
        }
    }
    chosen
}

/// The cosine of the normals of two cuts.
fn cosine(a: &Cut, b: &Cut) -> f64 {
    let square = |cut: &Cut| cut.row.iter().map(|(_, v)| v * v).sum::<f64>();
    let mut others = b.row.iter().peekable();
    let mut product = 0.0;
    for &(j, v) in &a.row {
        while others.next_if(|(other, _)| *other < j).is_some() {}
        if let Some((_, w)) = others.next_if(|(other, _)| *other == j) {
            product += v * w;
        }
    }
    product / (square(a) * square(b)).sqrt()
}

/// The form with some of the cuts as its last rows.
fn with_cuts(form: &Form, all: &[Cut], rows: &[usize]) -> Result<Form> {
    let rows = rows.iter().map(|&k| {
        let cut = &all[k];
        let negated = cut.row.iter().map(|&(j, a)| (j, -a)).collect();
        (negated, -cut.side)
    });
    form.with_rows(&rows.collect::<Vec<_>>())
}

#[cfg(test)]
#[path = "cuts_tests.rs"]
mod tests;
