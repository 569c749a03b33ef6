//! Points with integers: rounding, exchanges, and smaller problems around the incumbent.

use super::anneal::{MOST, annealed};
use super::dual_active_set::FEASIBLE;
use super::exchange::exchanged;
use super::form::Interval;
use super::interior::CLOSE;
use super::presolve;
use super::relaxation::{Relaxation, Relaxed, regularization};
use super::shared::Shared;
use super::tree::{Limits, Tree};

/// The nodes of a smaller problem.
const PART_NODES: u64 = 200;

/// The largest number of chains of a run of simulated annealing, for each unknown.
const CHAINS: u64 = 10_000;

/// The multiplications of the search for each chain.
const CHAIN: u64 = 1000;

/// A smaller problem fixes at least this part of the integers.
const FIXED: f64 = 0.3;

impl Tree<'_, '_, '_> {
    /// Offers integers near a point, with the real unknowns that are best for them.
    ///
    /// The integers are fixed one after the other, the closest to an integer first, and the bounds of the others
    /// are tightened each time (`berthold2014`, fix and propagate).
    pub fn round(&mut self, point: &[f64]) {
        let limits = self.boxes();
        let order = self.closest(&limits, point);
        let Some(limits) = self.fixed(limits, point, &order) else {
            return;
        };
        if self.integers.len() == self.form.dim() {
            self.offer(limits.iter().map(|l| l.lower).collect());
            return;
        }
        if limits.iter().any(|l| l.width() < -1e-6) {
            return;
        }
        if self.relaxation.interior.is_some() {
            if let Some(x) = self.best_within(&limits) {
                self.offer(x);
            }
            return;
        }
        let solver = &mut self.relaxation.solver;
        let state = solver.state();
        let before = solver.limits().to_vec();
        for &j in &self.integers {
            solver.set_limits(j as usize, limits[j as usize]);
        }
        let cutoff = self.cutoff();
        let found = self.relaxation.solve(cutoff, &limits);
        let solver = &mut self.relaxation.solver;
        let offered = matches!(found, Relaxed::Solved { .. }).then(|| {
            let mut x = solver.point().to_vec();
            for &j in &self.integers {
                x[j as usize] = limits[j as usize].lower;
            }
            x
        });
        for &j in &self.integers {
            solver.set_limits(j as usize, before[j as usize]);
        }
        solver.go_back(&state);
        if let Some(x) = offered {
            self.offer(x);
        }
    }

    /// The minimiser of the relaxation within these limits of integers, from a form without the unknowns that they
    /// fix. Where all integers are fixed and the form is large, most real unknowns are, too.
    pub fn best_within(&mut self, limits: &[Interval]) -> Option<Vec<f64>> {
        let form = self.form;
        let is_fixed = |j: usize| limits[j].width() <= CLOSE;
        let value = |j: usize| match is_fixed(j) {
            true => self.root[j].nearest(limits[j].lower),
            false => 0.0,
        };
        let mut x: Vec<f64> = (0..form.dim()).map(value).collect();
        let members = (0..form.dim() as u32).filter(|&j| !is_fixed(j as usize));
        let members: Vec<u32> = members.collect();
        let is_left = |&i: &u32| form.rows.row(i as usize).any(|(j, _)| !is_fixed(j));
        let rows = (0..form.rows.rows() as u32).filter(is_left).collect();
        let curved = form.hessian.mul_symmetric(&x);
        let slopes = form.gradient.iter().zip(&curved).map(|(q, c)| q + c);
        let slopes: Vec<f64> = slopes.collect();
        let mut part = presolve::part(form, &x, &slopes, members, rows).ok()?;
        for (own, &j) in part.form.limits.iter_mut().zip(&part.members) {
            if form.integer[j as usize] {
                *own = limits[j as usize];
            }
        }
        let shared = Shared::new(&part.form, &regularization(&part.form)).ok()?;
        let mut relaxation = Relaxation::new(&part.form, &shared);
        let found = relaxation.solve(f64::INFINITY, &part.form.boxes);
        self.relaxation.solver.work += relaxation.solver.work;
        let Relaxed::Solved { .. } = found else {
            return None;
        };
        for (&j, value) in part.members.iter().zip(relaxation.solver.point()) {
            x[j as usize] = *value;
        }
        Some(x)
    }

    /// Tightens bounds on all unknowns: fixes these integers near a point, one after the other. Nothing where that
    /// contradicts the rows.
    pub fn fixed(
        &mut self,
        mut limits: Vec<Interval>,
        point: &[f64],
        order: &[u32],
    ) -> Option<Vec<Interval>> {
        for &j in order {
            let (v, x) = (j as usize, point[j as usize]);
            if limits[v].is_point() {
                continue;
            }
            let before = limits.clone();
            let value = limits[v].nearest(x.round());
            limits[v] = Interval::point(value);
            if self
                .propagator
                .from(self.form, &mut limits, &[j], true)
                .is_ok()
            {
                continue;
            }
            limits = before;
            limits[v] = limits[v].without(value, x);
            let value = limits[v].nearest(x.round());
            limits[v] = Interval::point(value);
            self.propagator
                .from(self.form, &mut limits, &[j], true)
                .ok()?;
        }
        Some(limits)
    }

    /// The integers that these limits do not fix, those first whose values are closest to one.
    pub fn closest(&self, limits: &[Interval], point: &[f64]) -> Vec<u32> {
        let error = |j: u32| (point[j as usize] - point[j as usize].round()).abs();
        let is_left = |j: &u32| !limits[*j as usize].is_point();
        let mut order: Vec<u32> = self.integers.iter().copied().filter(is_left).collect();
        order.sort_by(|&a, &b| error(a).total_cmp(&error(b)).then(a.cmp(&b)));
        order
    }

    /// Makes a point the incumbent if it is within all limits and better, after exchanges that lower its energy.
    pub fn offer(&mut self, mut x: Vec<f64>) {
        for (x, limits) in x.iter_mut().zip(&self.root) {
            *x = limits.nearest(*x);
        }
        if self.is_better(&x).is_none() {
            return;
        }
        let better = exchanged(self.form, &self.root, &x, &mut self.relaxation.solver.work);
        for x in [x, better] {
            if let Some(energy) = self.is_better(&x)
                && !self.cuts_off(&x, energy)
            {
                self.rounding = self.form.rounding(&x);
                self.best = Some((x, energy));
                self.monitor.improved(energy);
            }
        }
    }

    /// The energy of a point that is within all limits and better than the incumbent.
    fn is_better(&self, x: &[f64]) -> Option<f64> {
        let outside = |i: usize| {
            let (value, size) = self
                .form
                .rows
                .row(i)
                .map(|(j, a)| a * x[j])
                .fold((0.0, 1.0), |(s, m): (f64, f64), t| (s + t, m + t.abs()));
            let sides = self.form.row_limits[i];
            (sides.lower - value).max(value - sides.upper) > 10.0 * FEASIBLE * size
        };
        if (0..self.form.rows.rows()).any(outside) {
            return None;
        }
        let energy = self.form.energy(x);
        self.best
            .as_ref()
            .is_none_or(|(_, best)| energy < *best)
            .then_some(energy)
    }

    /// Offers the best point of a run of simulated annealing from the incumbent, where all unknowns are integers.
    pub fn anneal(&mut self) {
        let seed = self.next_run;
        self.next_run *= 2;
        let n = self.form.dim();
        let Some((best, _)) = self.best.as_ref().filter(|_| self.integers.len() == n) else {
            return;
        };
        if n > MOST || self.limits.inner {
            return;
        }
        let work = &mut self.relaxation.solver.work;
        let chains = CHAINS.min(*work / CHAIN / n as u64) as usize * n;
        let x = annealed(self.form, &self.root, best, chains, seed, work);
        self.offer(x);
    }

    /// Searches the smaller problem in which the integers that incumbent and relaxation agree on are fixed
    /// (`danna2005`, RINS).
    pub fn search_part(&mut self, point: &[f64]) {
        self.next_part *= 2;
        let Some((best, _)) = self.best.clone() else {
            return;
        };
        if self.limits.inner {
            return;
        }
        let mut form = self.form.clone();
        let mut fixed = 0;
        for &j in &self.integers {
            let j = j as usize;
            if (point[j] - best[j]).abs() <= 1e-6 {
                form.limits[j] = Interval::point(best[j]);
                fixed += 1;
            }
        }
        if (fixed as f64) < FIXED * self.integers.len() as f64 {
            return;
        }
        let limits = Limits {
            nodes: PART_NODES,
            first: false,
            inner: true,
            recorded: false,
            ..self.limits
        };
        let mut tree = Tree::new(&form, self.shared, limits, &mut *self.monitor);
        tree.best = self.best.clone();
        tree.rounding = self.rounding;
        let found = tree.found();
        self.relaxation.solver.work += found.work;
        if let Some((x, _)) = found.best {
            self.offer(x);
        }
    }
}
