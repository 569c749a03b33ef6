//! A bound without a tree: what is left of the objective in integers is a lattice, whose closest point is bounded by
//! enumeration or by splits.
//!
//! With the unknowns that equations give replaced, `D` a diagonal, R triangular and `y = W z` combinations of integers
//! with integers, `E - 1/2 z'Dz - w |R W z|^2` is convex. So every point `x` gives for all points `z` within the rows
//!
//! ```text
//! E(z) >= E(x) + E'(x)(z - x) + 1/2 (z - x)'D(z - x) + w |R W (z - x)|^2
//! ```
//!
//! At the minimiser where integers are real, the second term is a rounding error, which the third one makes harmless. The
//! last one is at least w times its least value over all integers y. Where R is the factor of the Schur complement of the
//! integers, this is all that there is, but for the part of R's square that w leaves out for rounding errors.

use super::convex::{self, Entries, GoesOn};
use super::enumeration::{Allowed, Ended, Form as Distance};
use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::{Certificate, Lattice, Number, Split, Terms};
use super::minorant::{Minorant, PartObjective};
use super::problem::{ExactProblem, ExactTerms, Limits, product};
use super::sparse_factor;
use super::splits;
use super::substitution::Substitution;

/// Entries of a lower triangle.
type Triangle = Vec<(usize, usize, Exact)>;

/// A form in exact numbers.
pub(super) struct ExactForm {
    /// `W'R'RW`.
    condensed: Triangle,
    /// The combinations of the point.
    t: Vec<Exact>,
    pub distance: Distance,
}

/// The bound that a lattice proves. Replaces unknowns in the objective.
///
/// # Errors
/// [`FaultKind::Lattice`], [`FaultKind::NotConvex`], [`FaultKind::Certificate`], [`FaultKind::Bound`],
/// [`FaultKind::Reference`], [`FaultKind::Parts`].
pub(super) fn bound(
    problem: &ExactProblem,
    limits: &Limits,
    part: &mut PartObjective,
    (lattice, curvature): (&Lattice, &[f64]),
) -> Checked<Exact> {
    let solved = Substitution::of(problem, limits, part, &lattice.solved)?;
    let constant = solved.apply(part);
    part.set_curvature(curvature)?;
    let point = exact(&lattice.point, part)?;
    let mut forms = Vec::with_capacity(lattice.forms.len());
    for form in &lattice.forms {
        let given = (&form.combinations[..], &form.rows[..], &form.diagonals[..]);
        forms.push(ExactForm::of(part, &solved, given, &point)?);
        if !are_below(&form.rows, &form.diagonals, &|| true) {
            let text = "a diagonal that is not shown to be below its block";
            return wrong(FaultKind::Lattice, text);
        }
    }
    let weights: Vec<f64> = lattice.forms.iter().map(|form| form.weight).collect();
    if !is_convex(part, &forms, &weights, &|| true)? {
        let text = "the objective is not shown to be as large as its lattice";
        return wrong(FaultKind::NotConvex, text);
    }
    for (form, of) in lattice.forms.iter().zip(&forms) {
        if !form.splits.is_empty() {
            let shown = of.by_splits(&form.rows, (&form.splits, form.level))?;
            if Exact::of(form.square).is_none_or(|square| square > shown) {
                let text = format!("splits show {} alone", shown.below());
                return wrong(FaultKind::Bound, text);
            }
            continue;
        }
        let allowed = Allowed {
            limit: of.distance.limit_of(form.square),
            reach: form.reach,
            nodes: form.nodes,
        };
        let (ended, _) = of.distance.enumerate(allowed, &|| true);
        if ended != Ended::Least(allowed.limit) {
            let text = format!(
                "integers may be nearer than the square root of {}",
                form.square
            );
            return wrong(FaultKind::Bound, text);
        }
    }
    Ok(&constant + &least(problem, limits, part, lattice)?)
}

/// `R'R`. Nothing for rows that are too short.
fn gram_of(rows: &[Vec<f64>]) -> Option<Entries> {
    let entry = |i: usize, at: usize| Exact::of(*rows.get(i)?.get(at - i)?);
    let mut gram = Entries::new();
    for i in 0..rows.len() {
        for j in 0..=i {
            let sum = (0..=j).try_fold(Exact::zero(), |sum, k| {
                Some(&sum + &(&entry(k, i)? * &entry(k, j)?))
            })?;
            gram.insert((i, j), sum);
        }
    }
    Some(gram)
}

/// Whether each diagonal is shown to be below the leading block of `R'R` of its size.
pub(super) fn are_below(rows: &[Vec<f64>], diagonals: &[Vec<f64>], goes_on: GoesOn) -> bool {
    if diagonals.is_empty() {
        return true;
    }
    let Some(gram) = gram_of(rows) else {
        return false;
    };
    (1..).zip(diagonals).all(|(k, diagonal)| {
        let block = gram.range(..(k, 0)).map(|(at, v)| (*at, v.clone()));
        let mut left: Entries = block.collect();
        for (at, d) in diagonal.iter().enumerate().take(k) {
            if let (Some(entry), Some(d)) = (left.get_mut(&(at, at)), Exact::of(*d)) {
                *entry = &*entry - &d;
            }
        }
        sparse_factor::has_factor(&left, k, goes_on)
    })
}

/// One value for each unknown, exactly.
///
/// # Errors
/// [`FaultKind::Certificate`].
pub(super) fn exact(point: &[f64], part: &PartObjective) -> Checked<Vec<Exact>> {
    let values: Option<Vec<Exact>> = point.iter().map(|&x| Exact::of(x)).collect();
    match values {
        Some(values) if values.len() == part.members.len() => Ok(values),
        _ => wrong(
            FaultKind::Certificate,
            "a point needs a finite value for each unknown",
        ),
    }
}

impl ExactForm {
    /// The form of combinations, rows and diagonals around a point.
    ///
    /// # Errors
    /// [`FaultKind::Lattice`].
    pub fn of(
        part: &PartObjective,
        solved: &Substitution,
        (combinations, rows, diagonals): (&[Terms], &[Vec<f64>], &[Vec<f64>]),
        point: &[Exact],
    ) -> Checked<Self> {
        let mut t = Vec::with_capacity(combinations.len());
        let mut w = Vec::with_capacity(combinations.len());
        for terms in combinations {
            let (terms, offset) = solved.replaced(&integer(part, terms)?);
            t.push(&product(&terms, point) + &offset);
            w.push(terms);
        }
        let Some(distance) = Distance::new(rows, &t, diagonals) else {
            return wrong(FaultKind::Lattice, "a form that is not triangular");
        };
        Ok(ExactForm {
            condensed: condensed(rows, &w),
            t,
            distance,
        })
    }

    /// The least value that splits show.
    ///
    /// # Errors
    /// [`FaultKind::Lattice`].
    pub fn by_splits(&self, rows: &[Vec<f64>], given: (&[Split], f64)) -> Checked<Exact> {
        match gram_of(rows) {
            Some(gram) => splits::square(&gram, &self.t, given),
            None => wrong(FaultKind::Lattice, "a form that is not triangular"),
        }
    }
}

/// A combination of integers, by places in the part.
fn integer(part: &PartObjective, terms: &Terms) -> Checked<ExactTerms> {
    let mut all: ExactTerms = Vec::with_capacity(terms.len());
    for &(unknown, a) in terms {
        let place = part.place_of(unknown as usize);
        let a = Exact::of(a).filter(Exact::is_integer);
        match (place.filter(|&place| part.integer[place]), a) {
            (Some(place), Some(a)) => all.push((place, a)),
            _ => {
                let text = format!("a combination with x{unknown} that is no integer of the part");
                return wrong(FaultKind::Lattice, text);
            }
        }
    }
    Ok(all)
}

/// `W'R'RW`.
fn condensed(rows: &[Vec<f64>], w: &[ExactTerms]) -> Triangle {
    let mut places: Vec<usize> = w.iter().flatten().map(|(place, _)| *place).collect();
    places.sort_unstable();
    places.dedup();
    let n = places.len();
    let mut sums = vec![Exact::zero(); n * n];
    for (k, row) in rows.iter().enumerate() {
        let mut own = vec![Exact::zero(); n];
        for (a, terms) in row.iter().zip(&w[k..]) {
            let Some(a) = Exact::of(*a).filter(|a| !a.is_zero()) else {
                continue;
            };
            for (place, by) in terms {
                if let Ok(at) = places.binary_search(place) {
                    own[at] = &own[at] + &(&a * by);
                }
            }
        }
        for i in (0..n).filter(|&i| !own[i].is_zero()) {
            for j in (0..=i).filter(|&j| !own[j].is_zero()) {
                let sum = &mut sums[i * n + j];
                *sum = &*sum + &(&own[i] * &own[j]);
            }
        }
    }
    let mut all = Vec::new();
    for (i, &p) in places.iter().enumerate() {
        for (j, &q) in places[..=i].iter().enumerate() {
            let sum = std::mem::replace(&mut sums[i * n + j], Exact::zero());
            if !sum.is_zero() {
                all.push((p, q, sum));
            }
        }
    }
    all
}

/// Whether the objective minus its curvature and the forms with their weights is shown to be convex.
///
/// # Errors
/// [`FaultKind::Lattice`].
pub(super) fn is_convex(
    part: &mut PartObjective,
    forms: &[ExactForm],
    weights: &[f64],
    goes_on: GoesOn,
) -> Checked<bool> {
    let given = part.quadratic.len();
    for (form, &weight) in forms.iter().zip(weights) {
        let Some(weight) = Exact::of(weight).filter(|weight| weight.sign().is_ge()) else {
            return wrong(FaultKind::Lattice, "a weight that is negative or no number");
        };
        let twice = -&weight.shifted(1);
        let taken_off = form.condensed.iter().map(|(i, j, v)| (*i, *j, &twice * v));
        part.quadratic.extend(taken_off);
    }
    let blocks = convex::blocks(part);
    part.quadratic.truncate(given);
    Ok(blocks.iter().all(|block| {
        let own = block.members.iter().map(|&k| part.curvature[k].clone());
        block.has_curvature_in_order(&own.collect::<Vec<_>>(), goes_on)
    }))
}

/// The least value of all but the constant that the substitution has left.
///
/// # Errors
/// [`FaultKind::Lattice`], [`FaultKind::Bound`], [`FaultKind::Certificate`].
pub(super) fn least(
    problem: &ExactProblem,
    limits: &Limits,
    part: &PartObjective,
    lattice: &Lattice,
) -> Checked<Exact> {
    let certificate = Certificate {
        point: lattice.point.iter().map(|&x| Number::Float(x)).collect(),
        multipliers: Vec::new(),
    };
    let minorant = Minorant::of(problem, limits, part, &certificate)?;
    let Ok(mut sum) = minorant.least(limits, part) else {
        return wrong(FaultKind::Bound, "a bound that falls for ever");
    };
    for form in &lattice.forms {
        let (weight, square) = (Exact::of(form.weight), Exact::of(form.square));
        let Some((weight, square)) = weight.zip(square) else {
            return wrong(
                FaultKind::Lattice,
                "a form with a number that is not finite",
            );
        };
        sum = &sum + &(&weight * &square);
    }
    Ok(sum)
}
