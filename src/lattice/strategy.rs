//! The strategies `lattice` (reduction, nearest plane, beam search and block improvement, without a proof)
//! and `exact` (the same, then enumeration until the optimum is proved or the budget is spent).
//!
//! Each improvement is offered to the search and each proved bound raises the search's bound as soon as it
//! is known. So both strategies can be stopped at any time. Budgets count nodes, not seconds.

use super::certificate::Certificate;
use super::prove::{FIRST, GROWTH, radius_for};
use super::{Blocks, Diagonals, Limits, Piece, Splits, assemble, beam, improve_blocks, pieces};
use crate::eliminate::ReducedModel;
use crate::error::{Error, Result};
use crate::monitor::{Phase, span};
use crate::round;
use crate::search::{Factors, Options, Search, StoppedBy, Strategy};

/// A proof is not tried if its predicted nodes exceed the budget by more than this factor.
const HOPELESS: f64 = 4.0;

/// Diagonals in m dimensions take `m^4` steps. This number of steps takes as long as one node.
const DIAGONALS_PER_NODE: u64 = 100;

/// The largest dimension with diagonals. In more dimensions no proof ends, with or without them.
const WIDEST: usize = 160;

/// Enumerations with more predicted nodes than this are not started.
const LAST: f64 = 1e30;

/// If no proof is tried, the node budget is divided by this and spent on the bound, which
/// rises with the logarithm of the nodes.
const BOUND_SHARE: u64 = 1_000;

/// From this number of predicted nodes on, a bound by splits takes less time than they do.
const SPLIT_FROM: f64 = 1e8;

/// The splits take at most this part of the node budget.
const SPLITS_SHARE: u64 = 4;

/// Without a time limit, the enumeration with splits takes at most this part of the node budget. Its nodes
/// cannot be predicted, and the splits have given most of the bound.
const SPLIT_TREE_SHARE: u64 = 50;

/// One of the `m^3` steps of the lattice methods takes about as long as an entry of the factor does in an offer. Up to
/// so many steps for each entry, the methods take less time than the offers that are left out.
const STEPS_PER_ENTRY: u64 = 4;

/// Finds good integers for `model` without a proof.
///
/// # Errors
/// For lack of memory, and for integers too large to be exact where roundings have them as well.
pub(crate) fn lattice(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let _span = span("lattice");
    let found = decode(model, options, factors, search);
    or_rounded(found.map(drop), model, options, factors, search)
}

/// Uses adaptive rounding instead if the lattice method fails because its integers are too large to be
/// exact, or because its basis vectors are too short to divide by.
///
/// An objective may be nearly flat along a direction that contains no integer point. Then larger and larger
/// integers come closer and closer to its minimum. Such integers are useless to the caller.
fn or_rounded(
    found: Result<()>,
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    match found {
        Err(Error::Overflow { .. } | Error::NotFinite { .. }) => {
            if search.best().is_none() {
                round::direct(model, factors, search)?;
            }
            round::adaptive(model, options, factors, search)
        }
        other => other,
    }
}

/// Finds good integers for `model` and proves that none are better, within the budgets of `options` and
/// `search`.
///
/// # Errors
/// As [`lattice`].
pub(crate) fn exact(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let proved = prove(model, options, factors, search);
    or_rounded(proved, model, options, factors, search)
}

fn prove(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let mut pieces = decode(model, options, factors, search)?;
    // If the vectors generate no lattice, distances prove nothing.
    if search.ends(0) || pieces.iter().any(|p| !p.basis.is_discrete()) {
        return Ok(());
    }
    let certificate = Certificate::measure(model, factors, &pieces, search)?;
    if !certificate.is_valid() {
        return Ok(());
    }
    let widest = pieces.iter().map(|p| p.basis.rank()).max().unwrap_or(0);
    let per_node = widest as u64 / 2 + 1;
    let affordable = search.work.left() / per_node;
    let nodes = (options.nodes as u64).min(affordable);
    let by_caller = options.nodes != Options::default().nodes && options.nodes as u64 <= affordable;
    let limit = match by_caller {
        true => StoppedBy::Nodes,
        false => StoppedBy::Budget,
    };
    let mut left = nodes;
    for piece in &mut pieces {
        let mut stop = || search.monitor.ends();
        let price = bound_undecided(piece, left, &mut stop);
        left -= price;
        search.work.spend(price * per_node);
    }
    if options.strategy == Strategy::Exact {
        for piece in &mut pieces {
            left -= split(piece, left, per_node, search);
        }
        raise(&pieces, &certificate, search);
    }
    let all: f64 = pieces.iter().map(Piece::predicted_nodes).sum();
    if pieces.iter().any(|p| p.splits.is_some()) {
        if options.time_limit == f64::INFINITY {
            left /= SPLIT_TREE_SHARE;
        }
    } else if all > HOPELESS * nodes as f64 {
        left /= BOUND_SHARE;
    }
    let mut goal = FIRST;
    while left > 0
        && goal <= LAST
        && !search.is_within(options.gap)
        && pieces.iter().any(|p| !p.proved)
    {
        for at in 0..pieces.len() {
            if pieces[at].proved {
                continue;
            }
            let (ball, whole) = ball(&pieces, at, goal, &certificate, search, options.gap);
            let limits = Limits {
                nodes: left,
                ..ball
            };
            let found = pieces[at].search(limits, &mut |nodes| {
                let done = nodes as f64 / limits.nodes as f64;
                search.monitor.ends_at(Phase::Round, done)
            });
            left -= found.nodes;
            search.work.spend(found.nodes * per_node);
            for (z, distance) in found.near {
                try_point(model, factors, search, &mut pieces, at, z, distance)?;
            }
            pieces[at].bound = pieces[at].bound.max(found.bound);
            if !found.complete {
                search.stop_by(limit);
                raise(&pieces, &certificate, search);
                return Ok(());
            }
            pieces[at].proved = whole;
        }
        raise(&pieces, &certificate, search);
        goal *= GROWTH;
    }
    if !search.is_within(options.gap) && pieces.iter().any(|p| !p.proved) {
        search.stop_by(limit);
    }
    Ok(())
}

/// Makes the diagonals of `piece` if they are worth their price for its proof. Returns the price in nodes,
/// of which at most `left` may be spent.
fn bound_undecided(piece: &mut Piece, left: u64, stop: &mut dyn FnMut() -> bool) -> u64 {
    let m = piece.basis.rank();
    let price = (m as u64).pow(4) / DIAGONALS_PER_NODE;
    if m > WIDEST || price > left / 2 || piece.predicted_nodes() < price as f64 {
        return 0;
    }
    piece.diagonals = Diagonals::new(&piece.basis, stop);
    price
}

/// Makes the splits of `piece` if its proof needs very many nodes. Returns the price in nodes, of which at most
/// `left` may be spent.
fn split(piece: &mut Piece, left: u64, per_node: u64, search: &mut Search) -> u64 {
    if piece.predicted_nodes() < SPLIT_FROM {
        return 0;
    }
    let limit = left / SPLITS_SHARE;
    let mut price = 0;
    let mut stop = |work: u64| {
        price += work / per_node;
        price > limit || search.ends(work)
    };
    piece.splits = Splits::new(&piece.basis, &piece.target, piece.value, &mut stop);
    if let Some(splits) = &piece.splits {
        piece.bound = piece.bound.max(splits.bound);
    }
    price.min(left)
}

/// The next ball to search for piece `at`, and whether it completes the proof.
///
/// The proof needs the ball of the best point, enlarged by the largest error of distances. Every solution
/// that could have less energy lies in this ball and is evaluated by the search itself.
fn ball(
    pieces: &[Piece],
    at: usize,
    goal: f64,
    certificate: &Certificate,
    search: &Search,
    gap: f64,
) -> (Limits, bool) {
    let total: f64 = pieces.iter().map(|p| p.value).sum();
    let needed = certificate.square_for(search.wanted_bound(0.0));
    let margin = (needed - total).max(0.0) + 4.0 * super::NEARER * total;
    let piece = &pieces[at];
    let others = total - piece.value;
    let full = piece.value + margin;
    let largest = if gap > 0.0 {
        let enough = certificate.square_for(search.wanted_bound(gap)) * (1.0 + 1e-9) - others;
        enough.clamp(0.0, full)
    } else {
        full
    };
    let radius = match &piece.splits {
        Some(splits) => splits.radius_for((goal / FIRST).log(GROWTH).round(), largest),
        None => radius_for(&piece.basis, piece.diagonals.as_ref(), goal, largest),
    };
    let limits = Limits {
        radius,
        margin,
        nodes: 0,
    };
    (limits, radius >= full)
}

/// Offers the solution with `z` in piece `at`, and keeps `z` if the energy is the least so far.
fn try_point(
    model: &ReducedModel,
    factors: &mut Factors,
    search: &mut Search,
    pieces: &mut [Piece],
    at: usize,
    z: Vec<i64>,
    distance: f64,
) -> Result<()> {
    if z == pieces[at].z {
        return Ok(());
    }
    let former = std::mem::replace(&mut pieces[at].z, z);
    let integers = assemble(pieces, model.integers().len())?;
    if search.offer(factors, &integers)? {
        pieces[at].value = distance;
    } else {
        pieces[at].z = former;
    }
    Ok(())
}

/// Raises the bound to the one that the searched balls prove. The search is complete if every solution that
/// was not evaluated has at least the energy of the best one.
fn raise(pieces: &[Piece], certificate: &Certificate, search: &mut Search) {
    let least = |p: &Piece| {
        if p.proved {
            p.value
        } else {
            p.bound.min(p.value)
        }
    };
    let all = pieces.iter().all(|p| p.proved);
    let square = if all {
        // A solution that was not evaluated lies outside the ball of some piece.
        let values: f64 = pieces.iter().map(|p| p.value).sum();
        let beyond = pieces
            .iter()
            .map(|p| values - p.value + p.bound.max(p.value));
        beyond.fold(f64::INFINITY, f64::min)
    } else {
        pieces.iter().map(least).sum()
    };
    let beyond = certificate.energy_bound(square);
    if let Some((energy, at_least)) = search.best().map(|best| (best.energy, best.at_least)) {
        if all && certificate.is_valid() && beyond >= energy {
            search.complete();
        }
        search.raise_bound(beyond.min(at_least));
    }
}

/// Whether offers take most of the time of [`decode`]. Then only its last result is offered, unless a time limit may
/// come before.
fn offers_once(m: usize, factors: &Factors, options: &Options) -> bool {
    let entries = factors.entries() as u64;
    options.time_limit == f64::INFINITY && (m as u64).pow(3) <= STEPS_PER_ENTRY * entries
}

/// Direct rounding, nearest plane, beam search and block improvement, then perturbation rounds. Each result
/// is offered, or the last one alone if [offers take long](offers_once).
///
/// With dependent vectors the reduction depends on tolerances, so adaptive rounding is offered as well.
/// Pieces whose vectors generate no lattice are not improved further. There are no pieces if the search was
/// stopped before they are made.
fn decode(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<Vec<Piece>> {
    search.prepare(factors)?;
    let m = model.integers().len();
    let rounded = round::nearest_integers(model, search.relaxed());
    let mut once = offers_once(m, factors, options);
    if !once || search.monitor.ends() {
        search.offer(factors, &rounded)?;
    }
    if search.monitor.ends() {
        return Ok(Vec::new());
    }
    let relaxed: Vec<f64> = {
        let at = |&i: &u32| search.relaxed()[i as usize];
        model.integers().iter().map(at).collect()
    };
    let (r, full) = factors.schur_block(model)?;
    search.work.spend(4 * (m as u64).pow(3));
    let mut stop = |work| search.ends(work);
    let mut pieces = pieces(m, r, full, &relaxed, &mut stop)?;
    let is_regular = pieces.iter().all(Piece::is_regular);
    if once && is_regular {
        start_from(&mut pieces, &rounded)?;
    } else if once {
        search.offer(factors, &rounded)?;
        once = false;
    }
    if !once {
        search.offer(factors, &assemble(&pieces, m)?)?;
    }
    if !is_regular {
        round::adaptive(model, options, factors, search)?;
    }
    if let Some(best) = search.incumbent_integers() {
        start_from(&mut pieces, &best)?;
    }
    // If the vectors generate no lattice, larger and larger integers reduce the distance, in the end by
    // rounding errors alone.
    let discrete: Vec<usize> = (0..pieces.len())
        .filter(|&at| pieces[at].basis.is_discrete())
        .collect();
    let mut blocks: Vec<Blocks> = discrete.iter().map(|_| Blocks::default()).collect();
    for (&at, blocks) in discrete.iter().zip(&mut blocks) {
        let mut better = false;
        let piece = &mut pieces[at];
        let mut stop = |work| search.ends(work);
        if let Some(z) = beam(&piece.basis, &piece.target, options.beam_width, &mut stop) {
            better |= piece.take(z);
        }
        better |= improve(piece, blocks, piece.z.clone(), &mut stop)?;
        if better && !once {
            search.offer(factors, &assemble(&pieces, m)?)?;
        }
    }
    let mut shaken = 0;
    for _ in 0..options.lattice_rounds {
        for (&at, blocks) in discrete.iter().zip(&mut blocks) {
            let piece = &mut pieces[at];
            let mut stop = |work| search.ends(work);
            let start = perturbed(piece, &mut shaken);
            if improve(piece, blocks, start, &mut stop)? && !once {
                search.offer(factors, &assemble(&pieces, m)?)?;
            }
        }
    }
    if once {
        search.offer(factors, &assemble(&pieces, m)?)?;
    }
    Ok(pieces)
}

/// Takes the known integers of the pieces where they are better.
fn start_from(pieces: &mut [Piece], integers: &[f64]) -> Result<()> {
    for piece in pieces {
        let own: Vec<i64> = piece.places.iter().map(|&i| integers[i] as i64).collect();
        let steps = piece.target.steps(&piece.basis, &own)?;
        piece.take(steps);
    }
    Ok(())
}

/// Block improvement from `z`. Returns whether the result is better than the best point.
fn improve(
    piece: &mut Piece,
    blocks: &mut Blocks,
    mut z: Vec<i64>,
    stop: &mut dyn FnMut(u64) -> bool,
) -> Result<bool> {
    let value = piece.target.distance(&piece.basis, &z);
    improve_blocks(&piece.basis, &piece.target, blocks, &mut z, value, stop)?;
    Ok(piece.take(z))
}

/// The best point with about every eighth coordinate moved by one. Weyl's sequence, at the position
/// `shaken`, selects the coordinates.
fn perturbed(piece: &Piece, shaken: &mut u64) -> Vec<i64> {
    let mut step = |z: &i64| {
        *shaken += 1;
        match shaken.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 60 {
            0 => z + 1,
            1 => z - 1,
            _ => *z,
        }
    };
    piece.z.iter().map(&mut step).collect()
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::eliminate::eliminate;
    use crate::linalg::Ordering;
    use crate::monitor::{Event, EventKind, Flow, Monitor};
    use crate::problem::{Model, Problem};
    use crate::solve::{Solution, solve_with};
    use crate::test_random::Random;

    /// A path of real unknowns, on which each of `m` integers has a place and a wish.
    fn path(m: usize, each: usize, random: &mut Random) -> Problem {
        let n = m * each;
        let mut problem = Problem::new(n + m).unwrap();
        for i in 1..n {
            let indices = [i - 1, i];
            problem
                .add_least_squares(&indices, &[1.0, -1.0], random.next(), 1.0)
                .unwrap();
        }
        for k in 0..m {
            let indices = [k * each, n + k];
            problem.set_integers(&[n + k]).unwrap();
            problem
                .add_least_squares(&indices, &[1.0, -0.8], 3.0 * random.next(), 0.1)
                .unwrap();
            problem
                .add_least_squares(&indices[1..], &[1.0], 9.0 * random.next(), 0.01)
                .unwrap();
        }
        problem
    }

    /// The solution, and how often a better one was found on the way.
    fn solved(problem: &Problem, time_limit: f64) -> (Solution, usize) {
        let options = Options {
            strategy: Strategy::Lattice,
            time_limit,
            ..Options::default()
        };
        let improved = Cell::new(0);
        let monitor = Monitor::default().on_event(|event: &Event| {
            improved.set(improved.get() + usize::from(event.kind == EventKind::Improved));
            Flow::Continue
        });
        let solution = solve_with(problem, &options, monitor).unwrap();
        (solution, improved.get())
    }

    #[test]
    fn where_offers_take_long_the_last_result_alone_is_offered() {
        let mut random = Random::new(17);
        let mut most = 0;
        for _ in 0..10 {
            let problem = path(8, 60, &mut random);
            let (alone, once) = solved(&problem, f64::INFINITY);
            let (last, times) = solved(&problem, 1e6);
            assert_eq!(once, 1);
            assert_eq!(alone.values(), last.values());
            most = most.max(times);
        }
        assert!(most > 1, "nothing was improved");
    }

    #[test]
    fn after_a_failure_integers_are_rounded_also_if_nothing_was_offered() {
        let problem = path(4, 20, &mut Random::new(19));
        let mut monitor = Monitor::default();
        let reduced = eliminate(&Model::new(&problem).unwrap(), &mut monitor).unwrap();
        let point = vec![0.3; reduced.dim()];
        let mut search = Search::new(&reduced, point, f64::NEG_INFINITY, &mut monitor);
        let mut factors = Factors::new(Ordering::FillReducing);
        let failed = Err(Error::Overflow {
            what: "an integer of a lattice".into(),
            index: None,
        });
        let options = Options::default();
        or_rounded(failed, &reduced, &options, &mut factors, &mut search).unwrap();
        assert!(search.best().is_some());
    }

    #[test]
    fn many_integers_of_few_real_unknowns_are_offered_as_they_get_better() {
        let mut random = Random::new(18);
        let times = |_| solved(&path(30, 2, &mut random), f64::INFINITY).1;
        assert!((0..5).map(times).max() > Some(1));
    }
}
