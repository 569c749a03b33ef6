//! Fixes unknowns one by one. The other unknowns follow exactly, and nothing is factored again.
//!
//! In `A = L D L'`, fixing unknown k clears column k of L and restores the Schur complement from before the
//! elimination of k. That is a rank-one *update* of the columns on the path from k to the root,
//! `L33 D33 L33' + d_k l_k l_k'` (`davis2005`, section 3). Row k of L stays unchanged: it says how the
//! unknowns before k follow k.
//!
//! The update (`gill1974`, method C1) also yields the new solution at no extra cost. When k moves by delta,
//! the change dx of the later unknowns satisfies `L33' dx = -delta * beta`, where `beta_j` are the
//! multipliers of the update. The reason is that the updated factor satisfies `(L33 D33 L33')^-1 l_k d_k =
//! L33^-T beta`.
//!
//! Zero pivots need no special case. The first update that reaches a zero pivot makes it positive and moves
//! the rest of the rank-one term into its column. From then on the unknown is free.

use super::Ldl;
use super::cholesky::PIVOT_TOLERANCE;
use super::ordering::NONE;
use crate::error::Result;

/// Changes below this, in units of the watched integers, are not passed on. Over 10,000 fixings they add up
/// to far less than 1e-9, the tolerance within which deviations count as equal.
const CARRIED: f64 = 1e-14;

/// A minimisation in which unknowns are being fixed.
///
/// Only the *watched* unknowns are current after each fixing. Another unknown is computed when a change
/// passes through it.
#[derive(Debug)]
pub struct FixedSolve<'a> {
    ldl: &'a mut Ldl,
    /// Scaled value at each position. It is current for watched unknowns.
    value: Vec<f64>,
    /// Change by the last fixing at each position where it was computed.
    change: Vec<f64>,
    update: Vec<f64>,
    on_path: Vec<bool>,
    /// Number of watched unknowns in the subtree of each position.
    watched: Vec<u32>,
    tolerance: f64,
}

impl<'a> FixedSolve<'a> {
    /// Starts at `point`, the minimiser that belongs to `ldl`, and watches the unknowns `watch`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(ldl: &'a mut Ldl, point: &[f64], watch: &[u32]) -> Result<Self> {
        let n = ldl.dim();
        let mut value = vec![0.0; n];
        for (i, x) in point.iter().enumerate() {
            value[ldl.tree.position[i] as usize] = x / ldl.scale[i];
        }
        let mut watched = vec![0; n];
        let mut largest = f64::MIN_POSITIVE;
        for &i in watch {
            watched[ldl.tree.position[i as usize] as usize] = 1;
            largest = f64::max(largest, ldl.scale[i as usize]);
        }
        for j in 0..n {
            if ldl.tree.parent[j] != NONE {
                watched[ldl.tree.parent[j] as usize] += watched[j];
            }
        }
        Ok(FixedSolve {
            value,
            change: vec![0.0; n],
            update: vec![0.0; n],
            on_path: vec![false; n],
            watched,
            tolerance: CARRIED / largest,
            ldl,
        })
    }

    /// The value of a watched unknown.
    pub fn value(&self, unknown: u32) -> f64 {
        let i = unknown as usize;
        self.value[self.ldl.tree.position[i] as usize] * self.ldl.scale[i]
    }

    /// Fixes a watched unknown to `value` for good. The other watched unknowns follow.
    pub fn fix(&mut self, unknown: u32, value: f64) {
        let i = unknown as usize;
        let k = self.ldl.tree.position[i] as usize;
        let target = value / self.ldl.scale[i];
        let delta = target - self.value[k];
        self.unwatch(k);
        self.take_out(k, delta);
        self.carry_down();
        self.value[k] = target;
        self.leave_path(k);
    }

    fn unwatch(&mut self, k: usize) {
        let mut j = k as u32;
        while j != NONE {
            self.watched[j as usize] -= 1;
            self.on_path[j as usize] = true;
            self.change[j as usize] = 0.0;
            j = self.ldl.tree.parent[j as usize];
        }
    }

    fn leave_path(&mut self, k: usize) {
        let mut j = k as u32;
        while j != NONE {
            self.on_path[j as usize] = false;
            j = self.ldl.tree.parent[j as usize];
        }
    }

    /// The rank-one update along the path from `k`. It leaves the result of forward substitution in `change`
    /// on the path.
    fn take_out(&mut self, k: usize, delta: f64) {
        let ldl = &mut *self.ldl;
        let mut alpha = ldl.pivots[k];
        self.change[k] = delta;
        // The column is cleared but keeps its pattern, which bounds the unknowns that its subtree can reach.
        for p in ldl.offsets[k]..ldl.offsets[k + 1] {
            self.update[ldl.indices[p] as usize] = std::mem::take(&mut ldl.values[p]);
        }
        ldl.pivots[k] = f64::INFINITY;
        let mut j = ldl.tree.parent[k];
        while j != NONE {
            let at = j as usize;
            j = ldl.tree.parent[at];
            let p = std::mem::take(&mut self.update[at]);
            let old = ldl.pivots[at];
            let fixed = old == f64::INFINITY;
            let added = alpha * p * p;
            if fixed || p == 0.0 || alpha == 0.0 || (old == 0.0 && added <= PIVOT_TOLERANCE) {
                continue;
            }
            let new = old + added;
            let beta = alpha * p / new;
            alpha *= old / new;
            ldl.pivots[at] = new;
            self.change[at] = -delta * beta;
            let column = ldl.offsets[at]..ldl.offsets[at + 1];
            let rows = &ldl.indices[column.clone()];
            for (&i, l) in rows.iter().zip(&mut ldl.values[column]) {
                let w = &mut self.update[i as usize];
                *w -= p * *l;
                *l += beta * *w;
            }
        }
    }

    /// Back substitution from the roots down, into the subtrees that hold a watched unknown which still
    /// moves.
    fn carry_down(&mut self) {
        let ldl = &*self.ldl;
        let mut j = ldl.dim();
        while j > 0 {
            j -= 1;
            let first = ldl.tree.first[j] as usize;
            if self.watched[j] == 0 {
                j = first;
                continue;
            }
            let column = ldl.offsets[j]..ldl.offsets[j + 1];
            let rows = &ldl.indices[column.clone()];
            let (mut sum, mut largest) = (0.0, 0.0);
            for (&i, &l) in rows.iter().zip(&ldl.values[column]) {
                let change = self.change[i as usize];
                sum += l * change;
                largest = f64::max(largest, change.abs());
            }
            if self.on_path[j] {
                self.change[j] -= sum;
            } else if largest <= self.tolerance {
                j = first;
                continue;
            } else {
                self.change[j] = -sum;
            }
            self.value[j] += self.change[j];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cholesky, Sparse, minimise_bounded, minimum_degree};
    use super::*;

    /// A grid of springs. Every fifth unknown is also tied to the ground.
    fn grid(side: u32, grounded: bool) -> Sparse {
        let at = move |r: u32, c: u32| r * side + c;
        let springs = (0..side).flat_map(move |r| {
            (0..side).flat_map(move |c| {
                let right = (c + 1 < side).then(|| (at(r, c), at(r, c + 1)));
                let down = (r + 1 < side).then(|| (at(r, c), at(r + 1, c)));
                right.into_iter().chain(down)
            })
        });
        let entries = springs.flat_map(|(a, b)| {
            let k = 1.0 + f64::from(a % 7);
            [(a, a, k), (b, b, k), (b, a, -k)]
        });
        let n = side * side;
        let ground = (0..n).filter(move |i| grounded && i % 5 == 0);
        let ground = ground.map(|i| (i, i, 0.1));
        let n = n as usize;
        Sparse::from_triplets(n, n, entries.chain(ground)).unwrap()
    }

    /// The same minimisation from scratch, with fixed unknowns substituted.
    fn reference(a: &Sparse, gradient: &[f64], fixed: &[Option<f64>]) -> Vec<f64> {
        let n = a.rows();
        let mut g = gradient.to_vec();
        let mut entries = Vec::new();
        for (i, j, v) in a.entries() {
            let (iu, ju) = (i as usize, j as usize);
            match (fixed[iu], fixed[ju]) {
                (None, None) => entries.push((i, j, v)),
                (Some(x), None) => g[ju] += v * x,
                (None, Some(x)) => g[iu] += v * x,
                _ => {}
            }
        }
        for (i, f) in fixed.iter().enumerate() {
            if let Some(x) = f {
                entries.push((i as u32, i as u32, 1.0));
                g[i] = -x;
            }
        }
        let a = Sparse::from_triplets(n, n, entries.into_iter()).unwrap();
        let factor = Cholesky::new(&a).unwrap();
        minimise_bounded(&a, &g, &vec![0.0; n], &factor).unwrap()
    }

    fn follows_the_reference(grounded: bool) {
        let a = grid(12, grounded);
        let n = a.rows();
        let mut gradient: Vec<f64> = (0..n).map(|i| (i as f64 * 1.7).sin()).collect();
        let mean = gradient.iter().sum::<f64>() / n as f64;
        gradient.iter_mut().for_each(|g| *g -= mean);
        let mut ldl = Ldl::new(&a, &minimum_degree(&a).unwrap()).unwrap();
        let factor = Cholesky::new(&a).unwrap();
        let guess = vec![0.0; n];
        let point = minimise_bounded(&a, &gradient, &guess, &factor).unwrap();
        let watch: Vec<u32> = (0..n as u32).filter(|i| i % 2 == 0).collect();
        let mut solve = FixedSolve::new(&mut ldl, &point, &watch).unwrap();
        let mut fixed = vec![None; n];
        for step in 0..watch.len() {
            let i = watch[(step * 29) % watch.len()];
            fixed[i as usize] = Some((step as f64).cos());
            solve.fix(i, (step as f64).cos());
            let expected = reference(&a, &gradient, &fixed);
            for &w in watch.iter().filter(|&&w| fixed[w as usize].is_none()) {
                let error = (solve.value(w) - expected[w as usize]).abs();
                assert!(error < 1e-10, "step {step}, unknown {w}: off by {error:e}");
            }
        }
    }

    #[test]
    fn unknowns_follow_fixed_ones_exactly() {
        follows_the_reference(true);
    }

    #[test]
    fn a_semi_definite_problem_becomes_definite_as_unknowns_are_fixed() {
        follows_the_reference(false);
    }

    #[test]
    fn unknowns_that_nothing_decides_yet_are_freed_when_a_row_reaches_them() {
        // (x0 - x1 + x2)^2, where x2 is watched and can satisfy the row alone, so x0 and x1 are null
        // unknowns. Once x2 is fixed, they must follow each other.
        let row = [(0u32, 1.0), (1, -1.0), (2, 1.0)];
        let entries = row.iter().flat_map(|&(i, u)| {
            let lower = row.iter().filter(move |&&(j, _)| j <= i);
            lower.map(move |&(j, v)| (i, j, 2.0 * u * v))
        });
        let a = Sparse::from_triplets(3, 3, entries).unwrap();
        let mut ldl = Ldl::new(&a, &[2, 0, 1]).unwrap();
        let mut solve = FixedSolve::new(&mut ldl, &[0.0, 0.0, 0.0], &[0, 1, 2]).unwrap();
        solve.fix(2, 1.0);
        assert!((solve.value(0) - solve.value(1) + 1.0).abs() < 1e-14);
        solve.fix(0, 5.0);
        assert!((solve.value(1) - 6.0).abs() < 1e-14);
    }
}
