//! Exchanges: one integer moves by one, or two move by one, as long as that lowers the energy.
//!
//! Rows of equal sides couple integers, so that none can move alone. Two that share such a row may.

use super::dual_active_set::FEASIBLE;
use super::form::{Form, Interval};
use crate::linalg::Sparse;
use crate::monitor::may_continue;

/// The largest number of passes over all integers.
const PASSES: usize = 30;

/// Larger rows are not searched for partners.
const LONGEST: usize = 1000;

/// The point after all exchanges that lower its energy. Real unknowns stay as they are.
pub(super) fn exchanged(form: &Form, limits: &[Interval], x: &[f64], work: &mut u64) -> Vec<f64> {
    let mut state = State::new(form, limits, x);
    for _ in 0..PASSES {
        let mut is_better = false;
        for j in (0..form.dim()).filter(|&j| form.integer[j]) {
            if may_continue().is_err() {
                return state.x;
            }
            while let Some(moves) = state.best_exchange(j, work) {
                state.apply(&moves);
                is_better = true;
            }
        }
        if !is_better {
            break;
        }
    }
    state.x
}

struct State<'a> {
    form: &'a Form,
    limits: &'a [Interval],
    hessian: Sparse,
    columns: Sparse,
    x: Vec<f64>,
    slopes: Vec<f64>,
    sums: Vec<f64>,
    /// The diagonal of Q.
    diagonal: Vec<f64>,
    /// A change of the energy below this is a rounding error.
    nothing: f64,
    /// The coupling of the unknown that is looked at with all others.
    coupling: Vec<f64>,
}

impl<'a> State<'a> {
    fn new(form: &'a Form, limits: &'a [Interval], x: &[f64]) -> Self {
        let slopes = form.hessian.mul_symmetric(x);
        let slopes: Vec<f64> = slopes
            .iter()
            .zip(&form.gradient)
            .map(|(c, q)| c + q)
            .collect();
        let mut diagonal = vec![0.0; form.dim()];
        for (i, _, v) in form.hessian.entries().filter(|(i, j, _)| i == j) {
            diagonal[i as usize] = v;
        }
        let largest = slopes
            .iter()
            .chain(&diagonal)
            .fold(0.0, |m: f64, s| m.max(s.abs()));
        State {
            nothing: 1e-10 * largest,
            diagonal,
            form,
            limits,
            hessian: form.hessian.transpose(),
            columns: form.rows.transpose(),
            x: x.to_vec(),
            slopes,
            sums: form.rows.mul(x),
            coupling: vec![0.0; form.dim()],
        }
    }

    /// The entries of Q in the row of an unknown.
    fn coupled(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let after = self.hessian.row(j).filter(move |&(k, _)| k != j);
        self.form.hessian.row(j).chain(after)
    }

    /// The energy that a move by one adds.
    fn cost(&self, j: usize, sign: f64) -> f64 {
        sign * self.slopes[j] + 0.5 * self.diagonal[j]
    }

    fn may_move(&self, j: usize, sign: f64) -> bool {
        let new = self.x[j] + sign;
        self.form.integer[j] && new >= self.limits[j].lower && new <= self.limits[j].upper
    }

    /// Whether the rows allow moves of one or two unknowns.
    fn rows_allow(&self, moves: &[(usize, f64)]) -> bool {
        moves.iter().all(|&(j, _)| {
            self.columns.row(j).all(|(i, _)| {
                let change: f64 = moves
                    .iter()
                    .map(|&(k, sign)| {
                        let entry = self.columns.row(k).find(|&(row, _)| row == i);
                        entry.map_or(0.0, |(_, a)| sign * a)
                    })
                    .sum();
                let (new, sides) = (self.sums[i] + change, self.form.row_limits[i]);
                let room = FEASIBLE * new.abs().max(1.0);
                change == 0.0 || (new >= sides.lower - room && new <= sides.upper + room)
            })
        })
    }

    /// The exchange of an unknown, alone or with another, that lowers the energy most.
    fn best_exchange(&mut self, j: usize, work: &mut u64) -> Option<Vec<(usize, f64)>> {
        let mut least = -self.nothing;
        let mut best = None;
        let coupled: Vec<(usize, f64)> = self.coupled(j).collect();
        for &(k, v) in &coupled {
            self.coupling[k] = v;
        }
        for sign in [-1.0, 1.0] {
            if !self.may_move(j, sign) {
                continue;
            }
            let own = self.cost(j, sign);
            if own < least && self.rows_allow(&[(j, sign)]) {
                (least, best) = (own, Some(vec![(j, sign)]));
            }
            for (i, _) in self.columns.row(j) {
                let row = self.form.rows.row(i);
                if !self.form.row_limits[i].is_point() || row.len() > LONGEST {
                    continue;
                }
                *work += row.len() as u64 * 4;
                for (k, _) in row.filter(|&(k, _)| k != j) {
                    for other in [-1.0, 1.0] {
                        let cost = own + self.cost(k, other) + sign * other * self.coupling[k];
                        let moves = [(j, sign), (k, other)];
                        if cost < least && self.may_move(k, other) && self.rows_allow(&moves) {
                            (least, best) = (cost, Some(moves.to_vec()));
                        }
                    }
                }
            }
        }
        for (k, _) in coupled {
            self.coupling[k] = 0.0;
        }
        best
    }

    fn apply(&mut self, moves: &[(usize, f64)]) {
        for &(j, sign) in moves {
            self.x[j] += sign;
            for (k, v) in self.coupled(j).collect::<Vec<_>>() {
                self.slopes[k] += sign * v;
            }
            for (i, a) in self.columns.row(j) {
                self.sums[i] += sign * a;
            }
        }
    }
}
