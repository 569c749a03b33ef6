//! Rows with two sides and bounds on unknowns: branch and bound over a dual active-set method.
//!
//! ```text
//! Form --presolve--> parts --tree--> points and bounds
//!                     node: tighten bounds, relaxation (dual active set), safe bound, branch
//! ```
//!
//! | File | Step |
//! | --- | --- |
//! | `form` | the problem as the search reads it |
//! | `presolve`, `propagate` | what is decided before the search; bounds tightened through rows |
//! | `hull` | copies of unknowns that convex hulls of choices have, left out |
//! | `symmetry`, `dominated` | choices that may change places, in one order |
//! | `level`, `translations` | directions in which the energy is level; integers that may move for ever along them, held |
//! | `perspective` | squares that a binary switches on, with a larger bound |
//! | `implied_bounds` | rows for what choices imply of real unknowns |
//! | `mir`, `cuts` | cuts at the root by mixed-integer rounding |
//! | `inverse`, `shared`, `working_set` | the matrices of a strictly convex quadratic program |
//! | `dual_active_set`, `activation`, `refine` | its solution |
//! | `relaxation`, `proximal`, `interior` | the relaxation of a node, also where Q is singular, and where many rows are active |
//! | `safe_bound` | lower bounds that rounding errors cannot make false |
//! | `pseudo_costs`, `branching`, `node`, `tree` | the search |
//! | `rounds` | several nodes at the same time |
//! | `recorded`, `record` | a search for a proof; what the proof is made from |
//! | `primal`, `exchange`, `anneal` | points with integers: rounding, exchanges, annealing, smaller problems |
//! | `dive` | a first point where rounding finds none |
//! | `lazy` | rows that the caller adds during the search |
//! | `conflict` | why there is no solution |

mod activation;
mod anneal;
mod branching;
mod conflict;
mod cuts;
mod dive;
mod dominated;
mod dual_active_set;
mod exchange;
mod form;
mod hull;
mod implied_bounds;
mod interior;
mod inverse;
mod lazy;
mod level;
mod mir;
mod node;
mod perspective;
mod presolve;
mod primal;
mod propagate;
mod proximal;
mod pseudo_costs;
mod record;
mod recorded;
mod refine;
mod relaxation;
mod rounds;
mod safe_bound;
mod shared;
mod symmetry;
mod translations;
mod tree;
mod working_set;

use std::borrow::Cow;

use crate::error::{Conflicting, Error, Result};
use crate::linalg::sum_below;
use crate::monitor::{Monitor, Stop};
use crate::problem::{Model, Problem};
use crate::proof::{Derivation, Ending};
use crate::search::{LazyProblem, Options, StoppedBy, Strategy};
use form::Form;
use hull::Projected;
use lazy::LazyRows;
use presolve::{Contradiction, Part, Presolved};
use translations::Held;
use tree::Limits;

/// The multiplications after which `auto` ends with the best point so far, if it has one.
const AUTO: u64 = 20_000_000_000;

/// What a search has found.
#[derive(Debug, Clone)]
pub(crate) struct Found {
    pub values: Vec<f64>,
    pub energy: f64,
    pub lower_bound: f64,
    pub is_complete: bool,
    pub stopped_by: StoppedBy,
    pub work: u64,
    /// Unknowns and integers that the search had to decide.
    pub unknowns: usize,
    pub integers: usize,
}

/// Solves a problem with inequalities or bounds.
///
/// `relax` solves the relaxation, `exact` and `auto` search until the optimum is proved or a limit is
/// reached, and the other strategies end with the first point. `start` is a point whose nearest integers are
/// offered first. `lazy` is the problem with a caller who adds rows to it, and `record` receives what a proof is made
/// from.
///
/// # Errors
/// [`Error::Contradiction`], [`Error::Unbounded`], [`Error::NotConvex`], [`Error::OutOfMemory`], and
/// [`Error::Cancelled`], [`Error::TimeLimit`] or [`Error::SearchLimit`] before a first point.
pub(crate) fn solve<'e>(
    problem: &Problem,
    model: &Model,
    options: &Options,
    start: Option<&[f64]>,
    mut lazy: Option<&mut LazyProblem<'e>>,
    mut record: Option<&mut Derivation>,
    monitor: &mut Monitor<'e>,
) -> Result<Found> {
    let problem = &*match &lazy {
        Some(lazy) => Cow::Owned(lazy.problem().clone()),
        None => Cow::Borrowed(problem),
    };
    let mut form = Form::of(problem, model)?;
    if options.strategy == Strategy::Relax {
        form.integer.fill(false);
    }
    let given = form.clone();
    let mut steps = record.is_some().then(Vec::new);
    if let Some(record) = record.as_deref_mut() {
        record.is_begun = true;
    }
    let presolved = presolve::presolve(form, lazy.is_some(), &mut steps)?;
    if let (Some(record), Some(steps)) = (record.as_deref_mut(), steps) {
        record.steps = steps;
        if let Err(Contradiction::Row(row)) = presolved {
            record.contradiction = Some(Ending::Missed(row as u32));
        }
    }
    let presolved = match presolved {
        Ok(presolved) => presolved,
        Err(contradiction) => return Err(no_point(problem, &given, contradiction, monitor)),
    };
    let Presolved {
        mut values,
        mut parts,
        constant,
    } = presolved;
    let mut found = Found {
        values: Vec::new(),
        energy: constant,
        lower_bound: constant,
        is_complete: true,
        stopped_by: StoppedBy::Nothing,
        work: 0,
        unknowns: 0,
        integers: 0,
    };
    let count = parts.len();
    let first = !matches!(
        options.strategy,
        Strategy::Exact | Strategy::Auto | Strategy::Relax
    );
    // What a part leaves of its share is for the others.
    let (most, mut spent) = match options.strategy {
        Strategy::Auto => (AUTO, 0),
        _ => (u64::MAX, 0),
    };
    let limits = Limits {
        nodes: options.nodes as u64,
        work: most / count.max(1) as u64,
        gap: options.gap / count.max(1) as f64,
        elsewhere: 0.0,
        first,
        inner: false,
        recorded: false,
    };
    // A limit of time that ends the search of one part must find a point in each.
    parts.sort_by_key(|part| (part.integers(), part.members.len()));
    let several = parts.iter().filter(|part| part.integers() > 0).count() > 1;
    let mut starts = Vec::with_capacity(count);
    for part in &parts {
        let own = |start: &[f64]| part.members.iter().map(|&j| start[j as usize]).collect();
        let mut start = start.map(own);
        // Without a point in some part, the record would end here.
        if several && !first && record.is_none() {
            monitor.elsewhere(f64::INFINITY, f64::NEG_INFINITY);
            let limits = Limits {
                first: true,
                ..limits
            };
            let own = search_part(problem, &parts, part, start, limits, None, monitor)?;
            found.work += own.work;
            start = own.best.map(|(point, _)| point);
        }
        starts.push(start);
    }
    for (done, (part, start)) in parts.iter().zip(starts).enumerate() {
        let known = if done + 1 == count {
            found.energy
        } else {
            f64::INFINITY
        };
        monitor.elsewhere(known, found.lower_bound);
        let left = (count - done) as u64;
        let limits = Limits {
            work: most.saturating_sub(spent) / left,
            elsewhere: found.energy,
            recorded: record.is_some(),
            ..limits
        };
        let own = match &mut lazy {
            None => {
                let record = record.as_deref_mut();
                search_part(problem, &parts, part, start, limits, record, monitor)?
            }
            Some(lazy) => {
                let whole = (&values[..], constant);
                search_with_rows(lazy, part, whole, start, limits, monitor)?
            }
        };
        if let Some((point, energy)) = own.best {
            for (&j, x) in part.members.iter().zip(&point) {
                values[j as usize] = *x;
            }
            found.energy += energy;
        }
        found.lower_bound = sum_below(&[found.lower_bound, own.bound]);
        found.is_complete &= own.is_complete;
        found.work += own.work;
        spent += own.work;
        found.unknowns += part.members.len();
        found.integers += part.integers();
        if found.stopped_by == StoppedBy::Nothing {
            found.stopped_by = match monitor.stopped() {
                _ if own.is_complete => StoppedBy::Nothing,
                Some(Stop::Cancelled) => StoppedBy::Cancel,
                Some(Stop::TimeLimit) => StoppedBy::Time,
                Some(Stop::OutOfMemory) => StoppedBy::Memory,
                None => own.stopped_by,
            };
        }
    }
    monitor.elsewhere(0.0, 0.0);
    found.values = values;
    Ok(found)
}

/// Searches around a point, without presolve, as long as both limits allow. Returns the best point, if there
/// is one, and the work.
///
/// # Errors
/// Those of [`solve`] other than [`Error::Contradiction`] and the end of the call.
pub(crate) fn around(
    problem: &Problem,
    start: Vec<f64>,
    nodes: u64,
    work: u64,
    monitor: &mut Monitor,
) -> Result<(Option<Vec<f64>>, u64)> {
    let form = Form::of(problem, &Model::new(problem)?)?;
    let limits = Limits {
        work,
        ..Limits::inner(nodes)
    };
    let found = tree::search(&form, Some(start), limits, monitor)?;
    Ok((found.best.map(|(point, _)| point), found.work))
}

/// Searches a part. What is returned has a point.
fn search_part(
    problem: &Problem,
    parts: &[Part],
    part: &Part,
    start: Option<Vec<f64>>,
    limits: Limits,
    record: Option<&mut Derivation>,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    let found = match translations::held(&part.form)? {
        Some(held) => search_held(problem, part, held, start, limits, record, monitor),
        None => search_unheld(problem, part, start, limits, record, monitor),
    };
    with_point(problem, parts, part, found, monitor)
}

/// Searches a part in which integers are held that may move for ever. What is returned is within all limits.
fn search_held(
    problem: &Problem,
    part: &Part,
    held: Held,
    start: Option<Vec<f64>>,
    limits: Limits,
    mut record: Option<&mut Derivation>,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    if let Some(record) = record.as_deref_mut() {
        record.translations.extend(held.of_whole(&part.members));
    }
    let start = start.map(|start| held.moved(start));
    let (form, members) = (held.form.clone(), part.members.clone());
    let own = Part { form, members };
    let mut found = search_unheld(problem, &own, start, limits, record, monitor)?;
    let best = found.best.take();
    found.best = best.map(|(point, energy)| (held.moved_back(point), energy));
    found.ray = found.ray.map(|ray| held.ray_moved_back(ray));
    // The caller does not know the bounds of what is held.
    found.conflict.clear();
    Ok(found)
}

/// Searches a part as it is.
fn search_unheld(
    problem: &Problem,
    part: &Part,
    start: Option<Vec<f64>>,
    limits: Limits,
    record: Option<&mut Derivation>,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    match record {
        Some(record) => recorded::search(problem, part, start, limits, record, monitor),
        None => search_alone(&part.form, start, limits, monitor),
    }
}

/// Searches the form of a part.
fn search_alone(
    form: &Form,
    start: Option<Vec<f64>>,
    limits: Limits,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    match hull::project(form)? {
        Some(projected) => search_projected(&projected, start, limits, monitor),
        None => search_ordered(form, start, limits, monitor),
    }
}

/// Searches a form in one order of the choices that may change places.
fn search_ordered(
    form: &Form,
    start: Option<Vec<f64>>,
    limits: Limits,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    let ordered = {
        let _watch = monitor.watch_search();
        symmetry::ordered(form, start.as_deref())
    };
    let Some((ordered, start)) = ordered else {
        return search_with_first(form, start, limits, monitor);
    };
    let mut found = search_with_first(&ordered, start, limits, monitor)?;
    // Bounds of the order are none of the whole.
    found.conflict.clear();
    Ok(found)
}

/// Searches a form. Where relaxations take their time, there is a point before the bound is raised.
fn search_with_first(
    form: &Form,
    start: Option<Vec<f64>>,
    limits: Limits,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    if start.is_some() || !interior::is_for(form) {
        return search_strengthened(form, start, limits, monitor);
    }
    let first = tree::search(form, None, Limits { nodes: 1, ..limits }, monitor)?;
    let is_enough = limits.first && first.best.is_some();
    if is_enough || first.is_complete || first.ray.is_some() {
        return Ok(first);
    }
    let start = first.best.as_ref().map(|(point, _)| point.clone());
    match search_strengthened(form, start, limits, monitor) {
        Ok(found) if found.best.is_none() && !found.is_complete => Ok(tree::Found {
            best: first.best,
            bound: found.bound.max(first.bound),
            ..found
        }),
        Err(Error::Cancelled | Error::TimeLimit) if first.best.is_some() => {
            monitor.ends();
            Ok(first)
        }
        found => found,
    }
}

/// Searches a form after the perspective reformulation, with rows that choices imply, and with cuts, as far as these
/// raise its bound.
fn search_strengthened(
    form: &Form,
    start: Option<Vec<f64>>,
    limits: Limits,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    let perspective = perspective::strengthened(form, monitor)?;
    let form = perspective.as_ref().map_or(form, |of| &of.form);
    let implied = implied_bounds::strengthened(form, monitor)?;
    let cut = match limits.first {
        true => None,
        false => cuts::strengthened(implied.as_ref().unwrap_or(form), monitor)?,
    };
    let Some(form) = cut.map(|cut| cut.form).or(implied) else {
        return tree::search(form, start, limits, monitor);
    };
    let mut found = tree::search(&form, start, limits, monitor)?;
    // The caller does not know these rows.
    found.conflict.clear();
    Ok(found)
}

/// Searches a part without the copies of its unknowns. What is returned has them.
fn search_projected(
    projected: &Projected,
    start: Option<Vec<f64>>,
    limits: Limits,
    monitor: &mut Monitor,
) -> Result<tree::Found> {
    let kept = |start: Vec<f64>| projected.kept.iter().map(|&j| start[j as usize]).collect();
    let mut found = match search_ordered(&projected.form, start.map(kept), limits, monitor) {
        Err(Error::NotConvex {
            variable,
            direction,
        }) => {
            return Err(Error::NotConvex {
                variable: projected.kept[variable] as usize,
                direction: projected.scattered(&direction),
            });
        }
        found => found?,
    };
    let best = found.best.take();
    found.best = best.map(|(point, energy)| (projected.with_copies(&point), energy));
    found.ray = found.ray.map(|ray| projected.scattered(&ray));
    // Rows of the smaller problem name none of the whole.
    found.conflict.clear();
    Ok(found)
}

/// Searches the only part of a problem to which the caller adds rows. `whole` are the values of the other
/// unknowns and their energy. What is returned has a point.
fn search_with_rows<'e>(
    lazy: &mut LazyProblem<'e>,
    part: &Part,
    whole: (&[f64], f64),
    start: Option<Vec<f64>>,
    limits: Limits,
    monitor: &mut Monitor<'e>,
) -> Result<tree::Found> {
    let (values, constant) = whole;
    let rows = LazyRows::new(lazy, &part.members, values.to_vec(), constant);
    let searched = self::lazy::search_with_rows(part.form.clone(), start, limits, rows, monitor);
    let (found, form) = match searched {
        Ok((found, form)) => (Ok(found), form),
        Err(error) => (Err(error), part.form.clone()),
    };
    let members = part.members.clone();
    let parts = [Part { form, members }];
    with_point(lazy.problem(), &parts, &parts[0], found, monitor)
}

/// What a search has found if it has a point, and why it has none otherwise.
fn with_point(
    problem: &Problem,
    parts: &[Part],
    part: &Part,
    found: Result<tree::Found>,
    monitor: &Monitor,
) -> Result<tree::Found> {
    let found = match found {
        Err(Error::NotConvex { direction, .. }) => {
            let (variable, direction) = of_all(problem.variables(), &part.members, &direction);
            return Err(Error::NotConvex {
                variable,
                direction,
            });
        }
        found => found?,
    };
    if let Some(ray) = found.ray {
        // Where there is no point, nothing falls.
        for part in parts {
            if let Some(elements) = conflict::of_limits(&part.form, &part.members, monitor)? {
                return Err(conflict::error(problem, &elements));
            }
        }
        let (variable, direction) = of_all(problem.variables(), &part.members, &ray);
        return Err(Error::Unbounded {
            variable,
            direction,
        });
    }
    if found.best.is_some() {
        return Ok(found);
    }
    if !found.is_complete {
        return Err(match (monitor.stopped(), found.stopped_by) {
            (Some(stop), _) => stop.into(),
            (None, StoppedBy::Nodes) => Error::SearchLimit { what: "nodes" },
            (None, StoppedBy::Budget) => Error::SearchLimit { what: "work" },
            (None, StoppedBy::Nothing) => Error::SearchLimit { what: "precision" },
            (None, _) => Error::Cancelled,
        });
    }
    let rows = match found.nodes {
        // A search of fewer unknowns or bounds has no certificate in rows of the part.
        _ if found.conflict.is_empty() => conflict::of_root(&part.form, monitor),
        0 | 1 => found.conflict,
        _ => Vec::new(),
    };
    let mut elements = conflict::of_certificate(&part.form, &part.members, &rows);
    // No more rows than unknowns and one are needed (Helly); a certificate with more has some in it by
    // rounding errors.
    let is_small = !elements.is_empty() && elements.len() <= part.members.len() + 1;
    if !is_small {
        elements = conflict::of_form(&part.form, &part.members, monitor);
    }
    Err(conflict::error(problem, &elements))
}

/// The error for a contradiction that presolve found, with a small set of rows and bounds at fault.
fn no_point(
    problem: &Problem,
    form: &Form,
    contradiction: Contradiction,
    monitor: &Monitor,
) -> Error {
    let own = match contradiction {
        Contradiction::Row(row) => form.origins[row],
        Contradiction::Unknown(variable) => Conflicting::Bounds(variable),
    };
    let members: Vec<u32> = (0..form.dim() as u32).collect();
    let mut elements = conflict::of_form(form, &members, monitor);
    if elements.is_empty() {
        elements.push(own);
    }
    conflict::error(problem, &elements)
}

/// A direction of a part as one of all unknowns, and the unknown that it moves most.
fn of_all(variables: usize, members: &[u32], part: &[f64]) -> (usize, Vec<f64>) {
    let mut direction = vec![0.0; variables];
    for (&j, d) in members.iter().zip(part) {
        direction[j as usize] = *d;
    }
    let largest = |a: &usize, b: &usize| direction[*a].abs().total_cmp(&direction[*b].abs());
    let variable = (0..variables).max_by(largest).unwrap_or(0);
    (variable, direction)
}
