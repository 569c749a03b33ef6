//! The least value of a quadratic form over all integers, from split disjunctions.
//!
//! For an integer vector a and an integer k, `(a . y - k) (a . y - k - 1)` is not negative at integers y. With `x = y - t`
//! and `s = k + 1/2 - a . t` it is `(a . x - s)^2 - 1/4`. So if `diag(G, u) - sum d vv'` is positive semi-definite, with
//! multipliers `d >= 0` and `v = (a, -s)`, then `x'Gx + u - sum d (a . x - s)^2 >= 0`, and all integers have
//! `x'Gx >= sum d / 4 - u` (`burer2014`, `buchheim2013`).

use std::collections::BTreeMap;

use super::convex::Entries;
use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::Split;
use super::sparse_factor;

/// The least value that splits show for a form with this Gram matrix around t. `level` is u.
///
/// # Errors
/// [`FaultKind::Lattice`].
pub(super) fn square(
    gram: &Entries,
    t: &[Exact],
    (splits, level): (&[Split], f64),
) -> Checked<Exact> {
    let m = t.len();
    let mut left = gram.clone();
    let numbers = Exact::of(level).zip(Exact::of(0.5));
    let Some((level, half)) = numbers.filter(|(level, _)| level.sign().is_ge()) else {
        return wrong(FaultKind::Lattice, "a level that is negative or no number");
    };
    left.insert((m, m), level.clone());
    let mut sum = -&level;
    for split in splits {
        let at = Exact::of(split.at).filter(Exact::is_integer);
        let by = Exact::of(split.by).filter(|by| by.sign().is_ge());
        let is_there = split.vector.iter().all(|&(k, _)| (k as usize) < m);
        let Some((at, by)) = at.zip(by).filter(|_| is_there) else {
            let text = "a split of a coordinate that is not there, at no integer, or with a negative multiplier";
            return wrong(FaultKind::Lattice, text);
        };
        let mut v: BTreeMap<usize, Exact> = BTreeMap::new();
        let mut last = -&(&at + &half);
        for &(k, entry) in &split.vector {
            let entry = Exact::of(f64::from(entry)).unwrap_or_else(Exact::zero);
            last = &last + &(&entry * &t[k as usize]);
            let sum = v.entry(k as usize).or_insert_with(Exact::zero);
            *sum = &*sum + &entry;
        }
        v.insert(m, last);
        for (&i, a) in &v {
            let factor = &by * a;
            for (&j, b) in v.range(..=i) {
                let entry = left.entry((i, j)).or_insert_with(Exact::zero);
                *entry = &*entry - &(&factor * b);
            }
        }
        sum = &sum + &by.shifted(-2);
    }
    match sparse_factor::has_factor(&left, m + 1, &|| true) {
        true => Ok(sum),
        false => wrong(
            FaultKind::Lattice,
            "splits that are not shown to be below their form",
        ),
    }
}
