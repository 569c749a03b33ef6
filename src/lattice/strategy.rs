//! The strategies `lattice` (reduce, nearest plane, beam, blocks; no proof) and `exact` (the same,
//! then enumeration until the optimum is proved or the budget ends).
//!
//! Every improvement is offered to the search as soon as it is known, and every proved bound
//! raised, so that both can be stopped at any time. Budgets count nodes, never seconds.

use super::prove::{FIRST, GROWTH, predicted_nodes, radius_for};
use super::{Certificate, Limits, Piece, assemble, beam, enumerate, improve_blocks, pieces};
use crate::Result;
use crate::eliminate::ReducedModel;
use crate::round;
use crate::solve::{Factors, Options, Phase, Search};

/// A proof that is predicted to need more than so many budgets is not tried.
const HOPELESS: f64 = 4.0;

/// Of the budget, what is spent on the bound where a proof is not tried.
const BOUND_SHARE: u64 = 16;

/// Decides the integers of `model` as well as it can be done without a proof.
///
/// # Errors
/// For lack of memory, and for integers too large to be exact.
pub(crate) fn lattice(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    decode(model, options, factors, search)?;
    Ok(())
}

/// Decides the integers of `model` and proves that nothing is better, with at most `nodes` nodes.
///
/// # Errors
/// As [`lattice`].
pub(crate) fn exact(
    model: &ReducedModel,
    options: &Options,
    nodes: u64,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<()> {
    let mut pieces = decode(model, options, factors, search)?;
    if search.monitor.check().is_err() {
        return Ok(());
    }
    let relaxation = search.lower_bound();
    let relaxed = search.relaxed().to_vec();
    let certificate = Certificate::measure(model, factors, &pieces, &relaxed, relaxation)?;
    let mut left = nodes;
    let tried: f64 = pieces
        .iter()
        .map(|p| predicted_nodes(&p.basis, p.value))
        .sum();
    if tried > HOPELESS * nodes as f64 {
        left /= BOUND_SHARE;
    }
    let mut goal = FIRST;
    while pieces.iter().any(|p| !p.is_proved()) && left > 0 {
        for at in 0..pieces.len() {
            if pieces[at].is_proved() {
                continue;
            }
            let wanted = certificate.square_for(search.wanted_bound(options.gap));
            let others: f64 = pieces.iter().map(|p| p.value).sum::<f64>() - pieces[at].value;
            let piece = &mut pieces[at];
            let largest = piece.value.min((wanted - others).max(0.0)) * (1.0 + super::NEARER);
            let limits = Limits {
                radius: radius_for(&piece.basis, goal, largest),
                nodes: left,
            };
            let (basis, target) = (&piece.basis, &piece.target);
            let mut stop = |nodes: u64| {
                let done = nodes as f64 / limits.nodes as f64;
                search.monitor.progress(Phase::Round, done).is_err()
            };
            let found = enumerate(basis, target, limits, &mut stop);
            left -= found.nodes;
            let complete = found.complete;
            piece.bound = piece.bound.max(found.bound);
            let better = found.best.is_some_and(|(z, _)| piece.take(z));
            piece.bound = piece.bound.min(piece.value);
            if better {
                search.offer(factors, &assemble(&pieces, model.integers().len())?)?;
            }
            let proved = pieces.iter().map(|p| p.bound).sum();
            search.raise_bound(certificate.energy_bound(proved));
            if !complete || search.is_within(options.gap) {
                return Ok(());
            }
        }
        goal *= GROWTH;
    }
    Ok(())
}

/// Direct rounding, nearest plane, beam and blocks, each offered; then perturbation rounds.
fn decode(
    model: &ReducedModel,
    options: &Options,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<Vec<Piece>> {
    round::direct(model, factors, search)?;
    let m = model.integers().len();
    let relaxed: Vec<f64> = {
        let at = |&i: &u32| search.relaxed()[i as usize];
        model.integers().iter().map(at).collect()
    };
    let (r, full) = factors.schur(model)?;
    let mut pieces = pieces(m, r, full, &relaxed)?;
    search.offer(factors, &assemble(&pieces, m)?)?;
    for at in 0..pieces.len() {
        let mut better = false;
        let piece = &mut pieces[at];
        let mut stop = || search.monitor.check().is_err();
        if let Some(z) = beam(&piece.basis, &piece.target, options.beam_width, &mut stop) {
            better |= piece.take(z);
        }
        better |= improve(piece, piece.z.clone(), &mut stop)?;
        if better {
            search.offer(factors, &assemble(&pieces, m)?)?;
        }
    }
    let mut shaken = 0;
    for _ in 0..options.lattice_rounds {
        for at in 0..pieces.len() {
            let piece = &mut pieces[at];
            let mut stop = || search.monitor.check().is_err();
            let start = perturbed(piece, &mut shaken);
            if improve(piece, start, &mut stop)? {
                search.offer(factors, &assemble(&pieces, m)?)?;
            }
        }
    }
    Ok(pieces)
}

/// Block improvement from `z`; whether it ended better than the best point.
fn improve(piece: &mut Piece, mut z: Vec<i64>, stop: &mut dyn FnMut() -> bool) -> Result<bool> {
    let value = piece.target.distance(&piece.basis, &z);
    improve_blocks(&piece.basis, &piece.target, &mut z, value, stop)?;
    Ok(piece.take(z))
}

/// The best point with every eighth coordinate or so moved by one: by Weyl's sequence, which
/// `shaken` counts.
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
