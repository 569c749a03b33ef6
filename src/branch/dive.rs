//! Dives for the first point: several integers are rounded at a time, and the relaxation of those that are left is
//! solved again, as in adaptive rounding (`bommes2012`, chapter 5).
//!
//! A round takes the integers that are closest to one, at first half of those that are left, and tightens the bounds of
//! the others each time. Where no point is left, it takes a quarter as many; where one alone leaves no point, that
//! value is excluded. A dive has some tens of relaxations, where the search itself would have one for each integer.
//!
//! The first dive fixes what is integral in a relaxation, too, so that each relaxation has fewer unknowns than the one
//! before. If it ends without a point, a second one leaves these integers as they are.

use super::form::Interval;
use super::tree::Tree;

/// The part of the integers that are left which a round takes.
const PART: f64 = 0.5;

/// What the part is multiplied by where a round leaves no point,
const LESS: f64 = 0.25;

/// and where it leaves one.
const MORE: f64 = 2.0;

/// The largest number of relaxations of a dive.
const RELAXATIONS: usize = 100;

/// A value this close to an integer is one.
const INTEGRAL: f64 = 1e-6;

impl Tree<'_, '_, '_> {
    /// Rounds the minimiser of this node's relaxation, and dives from it at the nodes 1, 10, 100 and so on without an
    /// incumbent.
    pub fn find_near(&mut self, point: &[f64]) {
        self.round(point);
        let is_due = self.nodes == 10u64.pow(self.nodes.ilog10());
        if self.best.is_some() || self.limits.inner || !is_due {
            return;
        }
        let found = self.dived(point, false);
        if let Some(found) = found.or_else(|| self.dived(point, true)) {
            self.offer(found);
        }
    }

    /// The point at the end of a dive. With `is_careful`, integers that are integral in a relaxation are not fixed.
    fn dived(&mut self, point: &[f64], is_careful: bool) -> Option<Vec<f64>> {
        let mut limits = self.boxes();
        let mut point = point.to_vec();
        let mut part = PART;
        for _ in 0..RELAXATIONS {
            if self.monitor.ends() {
                return None;
            }
            let mut left = self.closest(&limits, &point);
            if left.is_empty() {
                return Some(point);
            }
            let is_fractional = |j: &u32| {
                let x = point[*j as usize];
                (x - x.round()).abs() > INTEGRAL
            };
            if is_careful && left.iter().any(is_fractional) {
                left.retain(is_fractional);
            }
            let closest = left[0];
            left.truncate((part * left.len() as f64).ceil() as usize);
            let rounded = self.fixed(limits.clone(), &point, &left);
            let next = match self.with_point(rounded) {
                None if left.len() > 1 => {
                    part *= LESS;
                    continue;
                }
                None => {
                    let others = self.without_nearest(&limits, &point, closest);
                    self.with_point(others)
                }
                next => next,
            };
            (limits, point) = next?;
            part = (MORE * part).min(PART);
        }
        None
    }

    /// Limits with the minimiser of the relaxation within them, if there is one.
    fn with_point(&mut self, limits: Option<Vec<Interval>>) -> Option<(Vec<Interval>, Vec<f64>)> {
        let limits = limits?;
        let point = self.best_within(&limits)?;
        Some((limits, point))
    }

    /// Limits that exclude the value to which an integer would be rounded, if the rows allow that.
    fn without_nearest(
        &mut self,
        limits: &[Interval],
        point: &[f64],
        integer: u32,
    ) -> Option<Vec<Interval>> {
        let mut limits = limits.to_vec();
        let (own, x) = (&mut limits[integer as usize], point[integer as usize]);
        *own = own.without(own.nearest(x.round()), x);
        if own.is_empty() {
            return None;
        }
        let changed = [integer];
        let tightened = self.propagator.from(self.form, &mut limits, &changed, true);
        tightened.is_ok().then_some(limits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branch::form::Form;
    use crate::branch::interior;
    use crate::branch::relaxation::{Relaxed, regularization};
    use crate::branch::search_with_first;
    use crate::branch::shared::Shared;
    use crate::branch::tree::Limits;
    use crate::error::Conflicting;
    use crate::linalg::Sparse;
    use crate::monitor::{CancelToken, EventKind, Flow, Monitor};
    use crate::test_random::Random;

    /// Amounts from 0 to a capacity that binaries switch on at a cost. Five equations with any coefficients hold if all
    /// are on.
    fn switches(random: &mut Random, count: usize) -> Form {
        let within = |lower: f64, upper: f64| Interval { lower, upper };
        let capacity = |_| 1.0 + random.unit();
        let capacities: Vec<f64> = (0..count).map(capacity).collect();
        let mut entries = Vec::new();
        let mut row_limits = Vec::new();
        for k in 0..5 {
            let mut sum = 0.0;
            for (i, capacity) in capacities.iter().enumerate() {
                let a = random.unit();
                entries.push((k, i as u32, a));
                sum += 0.75 * a * capacity;
            }
            row_limits.push(Interval::point(sum));
        }
        for (i, capacity) in capacities.iter().enumerate() {
            let row = 5 + i as u32;
            entries.push((row, i as u32, 1.0));
            entries.push((row, (count + i) as u32, -capacity));
            row_limits.push(within(f64::NEG_INFINITY, 0.0));
        }
        let rows = row_limits.len();
        let amounts = capacities.iter().map(|&capacity| within(0.0, capacity));
        let binaries = std::iter::repeat_n(within(0.0, 1.0), count);
        let limits: Vec<Interval> = amounts.chain(binaries).collect();
        let squares = (0..count as u32).map(|i| (i, i, 0.01));
        Form {
            hessian: Sparse::from_triplets(2 * count, 2 * count, squares).unwrap(),
            gradient: (0..2 * count).map(|_| random.unit()).collect(),
            constant: 0.0,
            rows: Sparse::from_triplets(rows, 2 * count, entries.into_iter()).unwrap(),
            row_limits,
            origins: (0..rows).map(Conflicting::Inequality).collect(),
            boxes: limits.clone(),
            limits,
            integer: (0..2 * count).map(|j| j >= count).collect(),
        }
    }

    #[test]
    fn dives_end_at_points_where_rounding_finds_none() {
        let mut random = Random::new(7);
        let (mut by_rounding, mut by_dives) = (0, [0; 2]);
        for _ in 0..30 {
            let form = switches(&mut random, 12);
            let shared = Shared::new(&form, &regularization(&form)).unwrap();
            let mut monitor = Monitor::default();
            let mut tree = Tree::new(&form, &shared, Limits::inner(1), &mut monitor);
            let relaxed = tree.relaxation.solve(f64::INFINITY, &form.boxes);
            assert!(matches!(relaxed, Relaxed::Solved { .. }));
            let point = tree.relaxation.solver.point().to_vec();
            for (found, is_careful) in by_dives.iter_mut().zip([false, true]) {
                let Some(x) = tree.dived(&point, is_careful) else {
                    continue;
                };
                assert!(x[12..].iter().all(|z| *z == 0.0 || *z == 1.0), "{x:?}");
                tree.best = None;
                tree.offer(x);
                assert!(tree.best.is_some(), "the rows hold");
                *found += 1;
            }
            tree.best = None;
            tree.round(&point);
            by_rounding += usize::from(tree.best.is_some());
        }
        assert!(by_rounding < 20, "{by_rounding} {by_dives:?}");
        assert!(by_dives.iter().all(|found| *found > 27), "{by_dives:?}");
    }

    #[test]
    fn a_first_point_is_kept_where_the_call_ends_before_the_bound_is_raised() {
        let form = switches(&mut Random::new(7), 500);
        assert_eq!(interior::is_for(&form), cfg!(feature = "interior-point"));
        let token = CancelToken::new();
        let cancel = token.clone();
        let mut monitor = Monitor::default()
            .cancel_token(token)
            .on_event(move |event| {
                if event.kind == EventKind::Improved {
                    cancel.cancel();
                }
                Flow::Continue
            });
        let limits = Limits {
            inner: false,
            ..Limits::inner(u64::MAX)
        };
        let found = search_with_first(&form, None, limits, &mut monitor).unwrap();
        assert!(found.best.is_some() && !found.is_complete);
        assert!(monitor.ends());
    }
}
