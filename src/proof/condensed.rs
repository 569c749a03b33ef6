//! The lattice that a proof is written with: what is known of a part in floats, made true in exact numbers.

use super::convex::{self, GoesOn};
use super::derivation::{Condensed, Distances};
use super::enumeration::{Allowed, Ended, Form as Distance};
use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::{Form, Lattice, Split};
use super::lattice::{ExactForm, are_below, exact, is_convex, least};
use super::minorant::PartObjective;
use super::problem::{ExactProblem, Limits};
use super::substitution::Substitution;

/// The parts of R's square that are left out, of which the first one that is enough is taken, as powers of two.
const LEFT_OUT: [i32; 7] = [-40, -36, -32, -28, -24, -20, -14];

/// The curvature, as a part of the diagonal and of what is left out, as a power of two.
const CURVATURE: i32 = -24;

/// The digits of the numbers of a diagonal that are left out, in bits.
const DIGITS: u32 = 38;

/// How far the enumeration may go from the point, in turn.
const REACHES: [f64; 4] = [8.0, 64.0, 4096.0, 1e6];

/// The parts of the multipliers of splits, of which the first one that is shown is taken.
const SMALLER: [f64; 4] = [1.0, 1.0 - 1e-7, 1.0 - 1e-3, 0.9];

/// The most nodes of an enumeration.
const NODES: u64 = 2_000_000_000;

/// The lattice that proves the most, its curvature and its bound. Replaces unknowns in the objective.
///
/// # Errors
/// Those of [`bound`](super::lattice::bound); [`FaultKind::Bound`] if it was not to go on.
pub(super) fn strongest(
    problem: &ExactProblem,
    limits: &Limits,
    part: &mut PartObjective,
    condensed: &Condensed,
    goes_on: GoesOn,
) -> Checked<(Lattice, Vec<f64>, Exact)> {
    let solved = Substitution::of(problem, limits, part, &condensed.solved)?;
    let constant = solved.apply(part);
    let point = exact(&condensed.point, part)?;
    let mut forms = Vec::with_capacity(condensed.forms.len());
    let mut found = Vec::with_capacity(condensed.forms.len());
    for given in &condensed.forms {
        let diagonals: Vec<Vec<f64>> = given.diagonals.iter().map(|d| shortened(d)).collect();
        let diagonals = match are_below(&given.rows, &diagonals, goes_on) {
            true => diagonals,
            false => Vec::new(),
        };
        let of = (&given.combinations[..], &given.rows[..], &diagonals[..]);
        let form = ExactForm::of(part, &solved, of, &point)?;
        found.push(match split(&form, given) {
            Some(split) => split,
            None => enumerated(&form.distance, given, diagonals, goes_on)?,
        });
        forms.push(form);
    }
    let diagonal = diagonal(part);
    for power in LEFT_OUT {
        let weight = 0.5 * (1.0 - 2f64.powi(power));
        let curvature: Vec<f64> = diagonal
            .iter()
            .map(|&d| power_below(d) * 2f64.powi(power + CURVATURE))
            .collect();
        part.set_curvature(&curvature)?;
        if is_convex(part, &forms, &vec![weight; forms.len()], goes_on)? {
            found.iter_mut().for_each(|form| form.weight = weight);
            let lattice = Lattice {
                solved: condensed.solved.clone(),
                point: condensed.point.clone(),
                forms: found,
            };
            let bound = &constant + &least(problem, limits, part, &lattice)?;
            return Ok((lattice, curvature, bound));
        }
    }
    let text = "the objective is not shown to be as large as its lattice";
    wrong(FaultKind::NotConvex, text)
}

/// The largest power of two that is not above a number, or zero.
fn power_below(x: f64) -> f64 {
    match (1e-150..1e150).contains(&x) {
        true => 2f64.powi(x.log2().floor() as i32),
        false => 0.0,
    }
}

/// The diagonal of the part's Hessian.
fn diagonal(part: &PartObjective) -> Vec<f64> {
    let mut all = vec![0.0; part.members.len()];
    for block in convex::blocks(part) {
        for (&k, d) in block.members.iter().zip(block.diagonal()) {
            all[k] = d;
        }
    }
    all
}

/// Numbers near those of a diagonal and below them, of few digits.
fn shortened(diagonal: &[f64]) -> Vec<f64> {
    let short = |d: &f64| f64::from_bits(d.max(0.0).to_bits() >> DIGITS << DIGITS);
    diagonal.iter().map(short).collect()
}

/// The form with the least value that an enumeration finds, or with all that it was to look for.
fn enumerated(
    distance: &Distance,
    given: &Distances,
    diagonals: Vec<Vec<f64>>,
    goes_on: GoesOn,
) -> Checked<Form> {
    for reach in REACHES {
        let allowed = Allowed {
            limit: given.square,
            reach,
            nodes: NODES,
        };
        match distance.enumerate(allowed, goes_on) {
            (Ended::Least(limit), nodes) => {
                return Ok(Form {
                    combinations: given.combinations.clone(),
                    rows: given.rows.clone(),
                    diagonals,
                    weight: 0.0,
                    splits: Vec::new(),
                    level: 0.0,
                    square: distance.square_of(limit),
                    reach,
                    nodes,
                });
            }
            (Ended::Beyond, _) => {}
            (Ended::Stopped, _) => return wrong(FaultKind::Bound, "the enumeration was stopped"),
        }
    }
    wrong(FaultKind::Bound, "integers are too far away")
}

/// The form with what its splits show, if there are some and they show anything.
fn split(form: &ExactForm, given: &Distances) -> Option<Form> {
    if given.splits.is_empty() {
        return None;
    }
    SMALLER.into_iter().find_map(|by| {
        let smaller = given.splits.iter().map(|split| Split {
            by: split.by * by,
            ..split.clone()
        });
        let splits: Vec<Split> = smaller.collect();
        let shown = form.by_splits(&given.rows, (&splits, given.level));
        let square = shown.ok().filter(|square| square.sign().is_gt())?;
        Some(Form {
            combinations: given.combinations.clone(),
            rows: given.rows.clone(),
            diagonals: Vec::new(),
            weight: 0.0,
            splits,
            level: given.level,
            square: square.below(),
            reach: 0.0,
            nodes: 0,
        })
    })
}
