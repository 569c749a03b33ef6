//! The search for integers, one independent component after the other.
//!
//! A method's thresholds and budgets then refer to what has to be decided together, and not to the size of the
//! whole problem. The components with few integers come first, so that the large ones inherit what they leave
//! of the budget.

use super::dispatch;
use super::eliminated::EliminatedProblem;
use super::relax::Relaxation;
use crate::eliminate::{Centre, Component, ReducedModel};
use crate::error::{Error, Result};
use crate::linalg::{TwoFold, places, sum_below};
use crate::monitor::{Monitor, may_continue, relative_gap};
use crate::problem::{Model, Objective};
use crate::round;
use crate::search::{
    ALWAYS, Factors, GAP_TOLERANCE, Options, Search, SolveStatus, StoppedBy, WarmStart,
};

/// The best point of a search, in the unknowns of the model around the centre.
pub(super) struct Found {
    pub point: Vec<f64>,
    pub energy: f64,
    pub lower_bound: f64,
    pub status: SolveStatus,
    pub complete: bool,
    pub stopped_by: StoppedBy,
    /// Multiplications, without those of the relaxation.
    pub work: u64,
}

/// Searches for integers around `centre`. `start` has one integer for each integer unknown.
///
/// # Errors
/// Those of the methods.
pub(super) fn by_components(
    of: &mut EliminatedProblem,
    centre: &Centre,
    relaxation: Relaxation,
    options: &Options,
    start: Option<Vec<f64>>,
    monitor: &mut Monitor,
) -> Result<Found> {
    let exact = Exact {
        objective: Objective(of.problem),
        centre,
    };
    let whole = centre.model();
    let watch = monitor.watch();
    may_continue()?;
    let parts = of.factors.split(whole)?;
    drop(watch);
    if parts.is_empty() {
        let search = Search::new(whole, relaxation.point, relaxation.lower_bound, monitor)
            .judged_by(|step| Ok(whole.constant() + exact.difference(step)?));
        return run(of.model, whole, options, start, of.factors, search, false);
    }
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by_key(|&k| parts[k].model.integers().len());
    let relaxed: Vec<Relaxed> = parts
        .iter()
        .map(|part| {
            may_continue()?;
            Ok(Relaxed::of(part, &relaxation))
        })
        .collect::<Result<_>>()?;

    let mut always = ALWAYS;
    let mut pending: f64 = relaxed.iter().map(|r| r.energy).sum();
    let mut found = Found {
        point: relaxation.point,
        energy: whole.constant(),
        lower_bound: relaxation.lower_bound,
        status: SolveStatus::Optimal,
        complete: true,
        stopped_by: StoppedBy::Nothing,
        work: 0,
    };
    let place = places(whole.dim(), whole.integers());
    let size = |part: &Component| part.model.hessian().len();
    let mut left: usize = parts.iter().map(size).sum();
    for (done, &k) in order.iter().enumerate() {
        let (part, of_part) = (&parts[k], &relaxed[k]);
        let ends_soon = left <= SOON;
        left -= size(part);
        pending -= of_part.energy;
        let last = done + 1 == order.len();
        let known = if last { found.energy } else { f64::INFINITY };
        monitor.elsewhere(known, found.lower_bound - of_part.highest);
        let start = start.as_ref().map(|start| {
            let integers = part.model.integers().iter();
            let place = |&i: &u32| place[part.members[i as usize] as usize];
            integers.map(|i| start[place(i) as usize]).collect()
        });
        let share = always / (order.len() - done) as u64;
        let point = pick(&part.members, &found.point);
        let search = Search::new(&part.model, point, of_part.lower_bound, monitor)
            .of_component(parts.len(), found.energy + pending, share)
            .judged_by(|step| exact.difference_of(&part.members, step));
        let factors = of.factors.of_component(k);
        let own = run(
            of.model,
            &part.model,
            options,
            start,
            factors,
            search,
            ends_soon,
        )?;
        for (&i, x) in part.members.iter().zip(&own.point) {
            found.point[i as usize] = *x;
        }
        always = always.saturating_sub(own.work);
        found.energy += own.energy;
        let terms = [found.lower_bound, own.lower_bound, -of_part.highest];
        found.lower_bound = sum_below(&terms);
        found.work += own.work;
        found.status = worse(found.status, own.status);
        found.complete &= own.complete;
        if found.stopped_by == StoppedBy::Nothing {
            found.stopped_by = own.stopped_by;
        }
    }
    monitor.elsewhere(0.0, 0.0);
    // The gap of the whole may be closed where that of a part is not, as with a part's energy of zero.
    if relative_gap(found.energy, found.lower_bound) <= GAP_TOLERANCE {
        found.status = SolveStatus::Optimal;
        found.stopped_by = StoppedBy::Nothing;
    }
    Ok(found)
}

/// The relaxation of a component.
struct Relaxed {
    energy: f64,
    /// No point has less energy.
    lower_bound: f64,
    /// The minimum is not above this.
    highest: f64,
}

impl Relaxed {
    fn of(part: &Component, whole: &Relaxation) -> Self {
        let (energy, error) = part.model.energy(&pick(&part.members, &whole.point));
        Relaxed {
            energy,
            lower_bound: match whole.lower_bound {
                f64::NEG_INFINITY => f64::NEG_INFINITY,
                _ => sum_below(&[energy, -2.0 * whole.excess, -error]),
            },
            highest: -sum_below(&[-energy, -error]),
        }
    }
}

/// After the search was stopped, components without a solution get the nearest integers if all of them together have
/// at most this many entries in their Hessians, which takes a few hundredths of a second. Larger ones would keep the
/// caller waiting.
const SOON: usize = 200_000;

/// Runs the strategy. If there is no solution when the search is stopped, but one `ends_soon`, the nearest integers
/// are taken.
fn run(
    given: &Model,
    model: &ReducedModel,
    options: &Options,
    start: Option<Vec<f64>>,
    factors: &mut Factors,
    mut search: Search,
    ends_soon: bool,
) -> Result<Found> {
    if let Some(integers) = start {
        search.offer(factors, &integers)?;
    }
    // An optimal solution cannot be improved.
    let done = search.status() == SolveStatus::Optimal || options.warm_start == WarmStart::Keep;
    if !done {
        match dispatch::search(given, model, options, factors, &mut search) {
            // If the search was stopped, the best solution so far is kept.
            Err(Error::Cancelled) if search.best().is_some() => search.stop_by(StoppedBy::Cancel),
            Err(Error::TimeLimit) if search.best().is_some() => search.stop_by(StoppedBy::Time),
            Err(Error::OutOfMemory { .. }) if search.best().is_some() => {
                search.stop_by(StoppedBy::Memory);
            }
            Err(Error::Cancelled | Error::TimeLimit) if ends_soon => {
                let nearest = round::nearest_integers(model, search.relaxed());
                search.offer_in_any_case(factors, &nearest)?;
            }
            other => other?,
        }
    }
    let (lower_bound, status) = (search.lower_bound(), search.status());
    let (complete, stopped_by) = (search.is_complete(), search.stopped_by());
    let work = search.work.spent();
    let best = search.into_best()?;
    Ok(Found {
        point: best.point,
        energy: best.energy,
        lower_bound,
        status,
        complete,
        stopped_by,
        work,
    })
}

/// The status of a whole from those of two parts.
fn worse(a: SolveStatus, b: SolveStatus) -> SolveStatus {
    let rank = |status| match status {
        SolveStatus::Optimal => 0,
        SolveStatus::Feasible => 1,
        SolveStatus::Limit => 2,
        SolveStatus::Cancelled => 3,
        SolveStatus::Relaxed => 4,
    };
    if rank(a) >= rank(b) { a } else { b }
}

fn pick(members: &[u32], v: &[f64]) -> Vec<f64> {
    members.iter().map(|&i| v[i as usize]).collect()
}

/// A point whose energy rises by more than this part of it where its unknowns are rounded to numbers of 64 bits, as
/// real unknowns near 1e15 do, is judged by what the caller gets.
const SPOILED: f64 = 1e-6;

/// Energies from the caller's numbers, relative to the one at the centre.
struct Exact<'a> {
    objective: Objective<'a>,
    centre: &'a Centre,
}

impl Exact<'_> {
    /// The energy at the step `y` from the centre, minus the energy at the centre.
    fn difference(&self, y: &[f64]) -> Result<f64> {
        let x = self.centre.expand(y);
        may_continue()?;
        let before = self.centre.energy();
        let there = self.objective.energy(|i| x[i]).value;
        may_continue()?;
        let returned = self.objective.energy(|i| TwoFold::from(x[i].high)).value;
        may_continue()?;
        let spoiled = returned.high - there.high > SPOILED * there.high.abs();
        let energy = if spoiled { returned } else { there };
        Ok((energy.high - before.high) + (energy.low - before.low))
    }

    /// The same for the step `y` in the unknowns `members` alone.
    fn difference_of(&self, members: &[u32], y: &[f64]) -> Result<f64> {
        let mut whole = vec![0.0; self.centre.model().dim()];
        for (&i, y) in members.iter().zip(y) {
            whole[i as usize] = *y;
        }
        self.difference(&whole)
    }
}
