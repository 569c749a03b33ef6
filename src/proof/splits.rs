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

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(x: f64) -> Exact {
        Exact::of(x).unwrap()
    }

    fn split(vector: &[(u32, i32)], at: f64, by: f64) -> Split {
        Split {
            vector: vector.to_vec(),
            at,
            by,
        }
    }

    /// `3 y0^2 + 2 y0 y1 + 3 y1^2` around a point.
    fn gram() -> Entries {
        [((0, 0), 3.0), ((1, 0), 1.0), ((1, 1), 3.0)]
            .map(|(at, v)| (at, exact(v)))
            .into_iter()
            .collect()
    }

    fn value(t: [f64; 2], y: [i32; 2]) -> f64 {
        let [a, b] = [0, 1].map(|k| f64::from(y[k]) - t[k]);
        3.0 * a * a + 2.0 * a * b + 3.0 * b * b
    }

    #[test]
    fn what_splits_show_is_below_all_integers() {
        let mut best: f64 = 0.0;
        for (x, y) in [
            (0.5, 0.5),
            (0.5, -0.5),
            (0.25, 7.75),
            (-3.0, 2.5),
            (0.125, 0.25),
        ] {
            let t = [exact(x), exact(y)];
            let near = |of: f64| (of.floor() as i32 - 2)..(of.floor() as i32 + 4);
            let all = near(x).flat_map(|a| near(y).map(move |b| value([x, y], [a, b])));
            let least = all.fold(f64::INFINITY, f64::min);
            for level in [0.0001, 0.25, 0.5, 1.0] {
                for by in [[1.9, 1.9, 0.0], [1.0, 1.0, 0.9], [0.5, 1.5, 0.0]] {
                    let splits = [
                        split(&[(0, 1)], x.floor(), by[0]),
                        split(&[(1, 1)], y.floor(), by[1]),
                        split(&[(0, 1), (1, 1)], (x + y).floor(), by[2]),
                    ];
                    if let Ok(shown) = square(&gram(), &t, (&splits, level)) {
                        assert!(shown <= exact(least), "{shown:?} {least}");
                        best = best.max(shown.near() / least);
                    }
                }
            }
        }
        assert!(best > 0.9, "{best}");
    }

    #[test]
    fn lies_about_splits_are_refused() {
        let t = [exact(0.5), exact(0.5)];
        let all = |by: f64| [split(&[(0, 1)], 0.0, by), split(&[(1, 1)], 0.0, by)];
        let of = |splits: &[Split], level: f64| square(&gram(), &t, (splits, level));
        assert!(of(&all(1.9), 1e-3).is_ok());
        // No split at t, more than the form, no such coordinate, no integer, negative numbers.
        let lies = [
            (all(1.9).map(|of| split(&of.vector, 3.0, of.by)), 1e-3),
            (all(2.1), 1e-3),
            (all(1.9).map(|of| split(&[(2, 1)], of.at, of.by)), 1e-3),
            (all(1.9).map(|of| split(&of.vector, 0.25, of.by)), 1e-3),
            (all(1.9).map(|of| split(&of.vector, of.at, f64::NAN)), 1e-3),
            (all(-1.9), 1e-3),
            (all(1.9), -1e-3),
        ];
        for (splits, level) in lies {
            let refused = of(&splits, level).map_err(|(kind, _)| kind);
            assert_eq!(refused.unwrap_err(), FaultKind::Lattice, "{splits:?}");
        }
    }
}
