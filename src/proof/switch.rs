//! Unknowns that a binary switches on: the perspective reformulation of the objective.
//!
//! Where a binary `z` that is zero leaves no other `x` than zero, all points with integers have `x - x z = 0` and
//! `z^2 - z = 0`. Any multiples of both may be added to the objective, which may then have a larger bound
//! (`frangioni2006`, `gunluk2010`). Whether the sum is convex is checked as for any other objective.

use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::Switch;
use super::minorant::PartObjective;
use super::problem::{ExactProblem, Limits, Side};
use super::tree::take_in_tree;

/// Adds the terms of a switch to the objective of a part, if it is one.
///
/// # Errors
/// [`FaultKind::Reference`], [`FaultKind::Parts`], [`FaultKind::Switch`], and those of its steps.
pub(super) fn add(
    problem: &mut ExactProblem,
    limits: &mut Limits,
    part: &mut PartObjective,
    switch: &Switch,
) -> Checked<()> {
    let (x, z) = (switch.unknown as usize, switch.binary as usize);
    let n = problem.integer.len();
    if x.max(z) >= n {
        let text = format!("there is no unknown {} of {n}", x.max(z));
        return wrong(FaultKind::Reference, text);
    }
    let (Some(at_x), Some(at_z)) = (part.place_of(x), part.place_of(z)) else {
        let text = format!("x{x} and its switch x{z} are not both in the part");
        return wrong(FaultKind::Parts, text);
    };
    if x == z || !is_binary(problem, limits, z) {
        return wrong(FaultKind::Switch, format!("x{z} is no binary"));
    }
    let mark = limits.mark();
    limits.tighten(problem, z, Side::Upper, Exact::zero());
    let mut steps = switch.steps.iter();
    let taken = steps.try_for_each(|&step| take_in_tree(problem, limits, step));
    let is_zero = limits.fixed(x).is_some_and(Exact::is_zero);
    limits.go_back(mark);
    taken?;
    if !is_zero {
        let text = format!("x{x} may be other than zero where x{z} is zero");
        return wrong(FaultKind::Switch, text);
    }
    let factors = Exact::of(switch.product).zip(Exact::of(switch.square));
    let Some((product, square)) = factors else {
        return wrong(FaultKind::Switch, "a factor that is no number");
    };
    part.linear[at_x] = &part.linear[at_x] + &product;
    part.linear[at_z] = &part.linear[at_z] - &square;
    let entries = [
        (at_x.max(at_z), at_x.min(at_z), -&product),
        (at_z, at_z, square.shifted(1)),
    ];
    part.quadratic.extend(entries);
    Ok(())
}

/// Whether an unknown that is not fixed is an integer between 0 and 1.
fn is_binary(problem: &ExactProblem, limits: &Limits, z: usize) -> bool {
    let one = Exact::of(1.0);
    let is_at_least_zero = |side: &Exact| side.sign().is_ge();
    let is_at_most_one = |side: &Exact| one.as_ref().is_some_and(|one| side <= one);
    let [lower, upper] = [Side::Lower, Side::Upper].map(|side| limits.side(z, side).as_ref());
    problem.integer[z] && lower.is_some_and(is_at_least_zero) && upper.is_some_and(is_at_most_one)
}
