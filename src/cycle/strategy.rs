//! The strategies for angle-difference systems.
//!
//! Both strategies start from nearest plane, which costs one triangular solve. Then they improve blocks.
//! The budget of multiplications is proportional to the entries of the factor of A. `auto` also improves
//! the result of adaptive greedy rounding, which is the better start where many angles are known.

use super::block::Growth;
use super::detect::AngleSystem;
use super::hint::hinted_cycles;
use super::improve::{Effort, Improvement};
use super::patches::{Proof, prove};
use super::space::CycleSpace;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::problem::Model;
use crate::round;
use crate::search::{Factors, Options, Search, StoppedBy, Strategy};

/// Multiplications of `lattice`, for each entry of the factor.
const QUICK_WORK: usize = 1_000;

/// Multiplications of `auto` from each of its two starts, for each entry of the factor.
const THOROUGH_WORK: usize = 10_000;

/// Multiplications that the budget grants in any case, besides these.
const LEAST_WORK: usize = 500_000;

const fn effort(growth: Growth, size: usize, residual: f64) -> Effort {
    Effort {
        growth,
        size,
        residual,
    }
}

/// Around the irregular vertices of a field, residuals are a sixth to a quarter of the step. Smaller
/// residuals lead to fewer and fewer improvements.
const QUICK: [Effort; 2] = [
    effort(Growth::Near, 16, 0.1),
    effort(Growth::Near, 24, 0.05),
];

const THOROUGH: [Effort; 4] = [
    effort(Growth::Near, 16, 0.1),
    effort(Growth::Steep, 16, 0.08),
    effort(Growth::Near, 24, 0.04),
    effort(Growth::Near, 32, 0.04),
];

/// Nearest plane and block improvement. Returns false, and does nothing, if `reduced` is not an
/// angle-difference system.
///
/// # Errors
/// For lack of memory, and those of the evaluation of its offers.
pub(crate) fn lattice(
    model: &Model,
    reduced: &ReducedModel,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<bool> {
    let Some(space) = space(model, reduced, search)? else {
        return Ok(false);
    };
    search.prepare(factors)?;
    let start = space.nearest_plane();
    improve(&space, start, &QUICK, QUICK_WORK, 1, factors, search)?;
    Ok(true)
}

/// The same with a larger budget, and once more from the result of adaptive greedy rounding. Then a bound,
/// within a budget of its own.
///
/// # Errors
/// For lack of memory, and those of the evaluation of its offers.
pub(crate) fn auto(
    model: &Model,
    reduced: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<bool> {
    let Some(space) = space(model, reduced, search)? else {
        return Ok(false);
    };
    let relaxation = search.lower_bound();
    find(reduced, &space, options, factors, search)?;
    let proof = Proof::brief(&space);
    conclude(
        reduced, &space, relaxation, &proof, options, factors, search,
    )?;
    Ok(true)
}

/// As [`auto`], with a proof that goes on as long as nodes and memory last.
///
/// # Errors
/// As [`auto`].
pub(crate) fn exact(
    model: &Model,
    reduced: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<bool> {
    let Some(space) = space(model, reduced, search)? else {
        return Ok(false);
    };
    let relaxation = search.lower_bound();
    find(reduced, &space, options, factors, search)?;
    let proof = Proof::thorough(options.nodes);
    conclude(
        reduced, &space, relaxation, &proof, options, factors, search,
    )?;
    Ok(true)
}

/// Proves what it can about the incumbent. `relaxation` is the bound of the relaxation.
fn conclude(
    reduced: &ReducedModel,
    space: &CycleSpace,
    relaxation: f64,
    proof: &Proof,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let complete = !search.monitor.ends()
        && prove(
            reduced,
            space,
            relaxation,
            proof,
            options.gap,
            factors,
            search,
        )?;
    match search.best().map(|best| best.at_least) {
        Some(at_least) if complete => {
            search.complete();
            search.raise_bound(at_least);
        }
        _ if search.is_within(options.gap) => {}
        _ if options.strategy == Strategy::Exact && options.nodes != Options::default().nodes => {
            search.stop_by(StoppedBy::Nodes);
        }
        _ => search.stop_by(StoppedBy::Budget),
    }
    Ok(())
}

/// Adaptive rounding, and improvement from there and from nearest plane.
fn find(
    reduced: &ReducedModel,
    space: &CycleSpace,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    round::adaptive(reduced, options, factors, search)?;
    let mut starts = Vec::from_iter(search.incumbent_integers().map(|z| space.charges(&z)));
    starts.push(space.nearest_plane());
    let count = starts.len();
    for (done, start) in starts.into_iter().enumerate() {
        if !search.ends(0) {
            let share = count - done;
            improve(
                space,
                start,
                &THOROUGH,
                THOROUGH_WORK,
                share,
                factors,
                search,
            )?;
        }
    }
    Ok(())
}

fn space(model: &Model, reduced: &ReducedModel, search: &Search) -> Result<Option<CycleSpace>> {
    let Some(system) = AngleSystem::detect(reduced) else {
        return Ok(None);
    };
    let relaxed = search.relaxed();
    let integers = reduced.integers().iter();
    let relaxed: Vec<f64> = integers.map(|&i| relaxed[i as usize]).collect();
    let hinted = hinted_cycles(model, reduced, &system);
    CycleSpace::new(system, &relaxed, hinted).map(Some)
}

/// Improves `start` and offers the result. It spends at most one `share`-th of the remaining work.
fn improve(
    space: &CycleSpace,
    start: Vec<f64>,
    efforts: &[Effort],
    work: usize,
    share: usize,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let work = LEAST_WORK.saturating_add(work.saturating_mul(space.factor.len()));
    let work = work.min(search.work.left() as usize / share);
    let mut improvement = Improvement::new(space, start)?;
    for &effort in efforts {
        improvement.run(effort, work, search.monitor)?;
    }
    search.work.spend(improvement.work() as u64);
    if let Some(integers) = space.integers(&improvement.charges) {
        search.offer(factors, &integers)?;
    }
    Ok(())
}
