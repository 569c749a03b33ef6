//! The strategies for angle-difference systems.
//!
//! Both strategies start from nearest plane, which costs one triangular solve. Then they improve blocks.
//! The budget of multiplications is proportional to the entries of the factor of A. `auto` also improves
//! the result of adaptive greedy rounding, which is the better start where many angles are known, at the same
//! time as that of nearest plane.

use super::block::Growth;
use super::detect::AngleSystem;
use super::hint::hinted_cycles;
use super::improve::{Effort, Improvement};
use super::patches::{Proof, prove};
use super::space::CycleSpace;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::monitor::{Monitor, allowed_threads, may_continue, span};
use crate::problem::Model;
use crate::round;
use crate::search::{Factors, Options, Search, StoppedBy, Strategy};

/// Multiplications of `lattice`, for each entry of the factor.
const QUICK_WORK: usize = 1_000;

/// Multiplications of `auto` from each of its two starts, for each entry of the factor.
const THOROUGH_WORK: usize = 10_000;

/// Multiplications that the budget grants in any case, besides these.
const LEAST_WORK: usize = 500_000;

/// The least number of entries of the factor for which nearest plane gets a thread of its own: what it starts
/// takes about a millisecond.
const WORTH_A_THREAD: usize = 5_000;

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
    let work = work(&space, QUICK_WORK).min(search.work.left() as usize);
    let found = improved(&space, start, &QUICK, work, search.monitor)?;
    offer(&space, found, factors, search)?;
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

/// Adaptive rounding and improvement from there and, on another thread, improvement from nearest plane.
///
/// Each has half of the work, so that neither has to wait for the other.
fn find(
    reduced: &ReducedModel,
    space: &CycleSpace,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let work = work(space, THOROUGH_WORK).min(search.work.left() as usize / 2);
    let second =
        |monitor: &mut Monitor| improved(space, space.nearest_plane(), &THOROUGH, work, monitor);
    if allowed_threads() == 1 || space.factor.len() < WORTH_A_THREAD {
        from_adaptive(reduced, space, options, work, factors, search)?;
        let found = second(search.monitor)?;
        return offer(space, found, factors, search);
    }
    let worker = search.monitor.worker();
    std::thread::scope(|scope| {
        let beside = worker.start(scope, 1, second);
        from_adaptive(reduced, space, options, work, factors, search)?;
        let found = beside.wait(search.monitor)?;
        offer(space, found, factors, search)
    })
}

/// Adaptive rounding, and improvement from there by this many multiplications.
fn from_adaptive(
    reduced: &ReducedModel,
    space: &CycleSpace,
    options: &Options,
    work: usize,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    round::adaptive(reduced, options, factors, search)?;
    let start = search.incumbent_integers().map(|z| space.charges(&z));
    if let Some(start) = start
        && !search.ends(0)
    {
        let found = improved(space, start, &THOROUGH, work, search.monitor)?;
        offer(space, found, factors, search)?;
    }
    Ok(())
}

fn space(model: &Model, reduced: &ReducedModel, search: &Search) -> Result<Option<CycleSpace>> {
    let _watch = search.monitor.watch();
    let Some(system) = AngleSystem::detect(reduced) else {
        return Ok(None);
    };
    may_continue()?;
    let relaxed = search.relaxed();
    let integers = reduced.integers().iter();
    let relaxed: Vec<f64> = integers.map(|&i| relaxed[i as usize]).collect();
    let hinted = hinted_cycles(model, reduced, &system);
    CycleSpace::new(system, &relaxed, hinted).map(Some)
}

/// The multiplications that an improvement may take, `of_entry` for each entry of the factor.
fn work(space: &CycleSpace, of_entry: usize) -> usize {
    LEAST_WORK.saturating_add(of_entry.saturating_mul(space.factor.len()))
}

/// Charges that were improved, and the multiplications that it took.
struct Improved {
    charges: Vec<f64>,
    work: usize,
}

/// Improves `start` until this many multiplications are spent.
fn improved(
    space: &CycleSpace,
    start: Vec<f64>,
    efforts: &[Effort],
    work: usize,
    monitor: &mut Monitor,
) -> Result<Improved> {
    let _span = span("improve");
    let mut improvement = Improvement::new(space, start)?;
    for &effort in efforts {
        improvement.run(effort, work, monitor)?;
    }
    Ok(Improved {
        work: improvement.work(),
        charges: improvement.charges,
    })
}

/// Counts the work of an improvement and offers its result.
fn offer(
    space: &CycleSpace,
    improved: Improved,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    search.work.spend(improved.work as u64);
    if let Some(integers) = space.integers(&improved.charges) {
        search.offer(factors, &integers)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::field::{FieldProblem, curvature_constraints};
    use crate::mesh::jitter;
    use crate::mesh::shape::by_name;
    use crate::monitor::{spawned, traced};
    use crate::search::{Options, Strategy};
    use crate::solve::solve;

    #[test]
    fn starts_trees_and_lists_of_a_proof_have_threads_and_change_no_bit() {
        let mesh = jitter(&by_name("genus-2", 1_500).unwrap(), 1e-3, 3).unwrap();
        let constraints = curvature_constraints(&mesh, 0.05).unwrap();
        let field = FieldProblem::new(&mesh, &constraints).unwrap();
        let solved = |strategy: Strategy, nodes: usize, threads: usize| {
            let options = Options {
                strategy,
                threads,
                nodes,
                ..Options::default()
            };
            let mut bits = [0; 2];
            let started = spawned(|| {
                let solution = solve(field.problem(), &options).unwrap();
                let bound = solution.lower_bound().unwrap();
                bits = [solution.energy(), bound].map(f64::to_bits);
            });
            (started, bits)
        };
        let all = Options::default().nodes;
        for (strategy, nodes) in [(Strategy::Auto, all), (Strategy::Exact, 10_000_000)] {
            let alone = solved(strategy, nodes, 1);
            assert_eq!(alone.0, 0);
            for threads in [2, 5] {
                let together = solved(strategy, nodes, threads);
                assert!(together.0 > 1, "{}", together.0);
                assert_eq!(together.1, alone.1);
            }
        }
        let (_, trace) = traced(false, || solved(Strategy::Auto, all, 2));
        let mut leaves = trace.spans.iter().filter(|span| span.name == "leaf");
        assert!(leaves.any(|leaf| leaf.thread > 0), "lists grow one by one");
    }
}
