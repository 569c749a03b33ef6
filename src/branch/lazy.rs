//! Rows that the caller adds during the search of a part.
//!
//! The search asks for rows at the minimiser of each relaxation and for each point that could become the
//! incumbent. A row that cuts the point off ends the run of the tree; the row joins the form, and the tree goes on
//! with the nodes that wait, whose bounds stay true.

use std::collections::BinaryHeap;

use super::conflict;
use super::form::{Form, Interval, without_zeros};
use super::node::Node;
use super::presolve::round_rows;
use super::pseudo_costs::PseudoCosts;
use super::relaxation::regularization;
use super::shared::Shared;
use super::tree::{Found, Limits, Tree};
use crate::error::{Conflicting, Error, Result};
use crate::linalg::Sparse;
use crate::monitor::Monitor;
use crate::search::LazyProblem;

/// The caller's rows as the search of a part sees them.
pub(super) struct LazyRows<'m, 'e> {
    problem: &'m mut LazyProblem<'e>,
    /// The unknowns of the part.
    members: &'m [u32],
    /// All unknowns. Those of the part are written for each candidate.
    values: Vec<f64>,
    /// The energy of the unknowns outside the part.
    constant: f64,
    /// The problem's rows that the form has.
    taken: usize,
    /// Whether a candidate was cut off since the last rows were taken.
    pub cut: bool,
}

impl<'m, 'e> LazyRows<'m, 'e> {
    /// For the part `members`. The other unknowns have their `values` and the energy `constant`.
    pub fn new(
        problem: &'m mut LazyProblem<'e>,
        members: &'m [u32],
        values: Vec<f64>,
        constant: f64,
    ) -> Self {
        LazyRows {
            taken: problem.problem().inequalities(),
            problem,
            members,
            values,
            constant,
            cut: false,
        }
    }

    fn write(&mut self, point: &[f64]) {
        for (&j, x) in self.members.iter().zip(point) {
            self.values[j as usize] = *x;
        }
    }

    /// Whether the caller's rows cut off a point of the part.
    pub fn cuts_off(&mut self, point: &[f64], energy: f64, monitor: &mut Monitor) -> bool {
        self.write(point);
        let known = self.problem.first_violated(&self.values, self.taken);
        let energy = self.constant + energy;
        let is_cut = known.is_some() || self.problem.cuts_off(&self.values, energy, monitor);
        self.cut |= is_cut;
        is_cut
    }

    /// Adds the rows since the last call to the form. `incumbent` is the best point, which no row may cut off.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a row that cuts off the incumbent, [`Error::Contradiction`] for a row that no
    /// point satisfies, [`Error::OutOfMemory`].
    pub fn extend(&mut self, form: &mut Form, incumbent: Option<&[f64]>) -> Result<()> {
        if let Some(incumbent) = incumbent {
            self.write(incumbent);
            if let Some(row) = self.problem.first_violated(&self.values, self.taken) {
                return Err(Error::InvalidArgument {
                    what: format!(
                        "lazy row: inequality {row} cuts off a solution that was accepted before"
                    ),
                    index: Some(row),
                });
            }
        }
        let mut place = vec![u32::MAX; self.values.len()];
        for (k, &j) in self.members.iter().enumerate() {
            place[j as usize] = k as u32;
        }
        let rows = self.problem.problem().inequality_rows();
        let first = form.rows.rows();
        let mut entries: Vec<(u32, u32, f64)> = form.rows.entries().collect();
        for i in self.taken..rows.len() {
            let mut fixed = 0.0;
            for (j, a) in rows.row(i) {
                match place[j] {
                    u32::MAX => fixed += a * self.values[j],
                    member => entries.push((form.row_limits.len() as u32, member, a)),
                }
            }
            form.row_limits.push(Interval {
                lower: rows.lower()[i] - fixed,
                upper: rows.upper()[i] - fixed,
            });
            form.origins.push(Conflicting::Inequality(i));
        }
        self.taken = rows.len();
        self.cut = false;
        let (rows, unknowns) = (form.row_limits.len(), form.dim());
        form.rows = without_zeros(&Sparse::from_triplets(rows, unknowns, entries.into_iter())?)?;
        round_rows(form, first, &mut None);
        let is_impossible = |&i: &usize| {
            let sides = form.row_limits[i];
            let holds_nothing =
                form.rows.row(i).len() == 0 && (sides.lower > 0.0 || sides.upper < 0.0);
            sides.is_empty() || holds_nothing
        };
        match (first..rows).find(is_impossible) {
            Some(i) => Err(conflict::error(self.problem.problem(), &[form.origins[i]])),
            None => Ok(()),
        }
    }
}

/// Searches a form to which the caller adds rows. Returns the form with these rows as well.
///
/// # Errors
/// Those of [`search`](super::tree::search) and of [`LazyRows::extend`].
pub(super) fn search_with_rows<'m, 'e>(
    mut form: Form,
    start: Option<Vec<f64>>,
    limits: Limits,
    lazy: LazyRows<'m, 'e>,
    monitor: &'m mut Monitor<'e>,
) -> Result<(Found, Form)> {
    let mut shared = Shared::new(&form, &regularization(&form))?;
    let _watch = monitor.watch_search();
    let mut tree = Tree::new(&form, &shared, limits, monitor);
    tree.lazy = Some(lazy);
    tree.stack.push(Node::root());
    if let Some(start) = start {
        tree.round(&start);
    }
    loop {
        if !tree.is_cut() {
            tree.run();
        }
        if !tree.is_cut() || tree.is_ended() {
            let found = tree.result();
            return Ok((found, form));
        }
        let mut paused = Paused::of(tree);
        let incumbent = paused.best.as_ref().map(|(x, _)| &x[..]);
        if let Some(lazy) = &mut paused.lazy {
            lazy.extend(&mut form, incumbent)?;
        }
        shared.extend(&form);
        tree = paused.resume(&form, &shared, limits);
    }
}

/// A tree without its form.
struct Paused<'m, 'e> {
    costs: PseudoCosts,
    waiting: BinaryHeap<Node>,
    stack: Vec<Node>,
    best: Option<(Vec<f64>, f64)>,
    done: f64,
    created: u64,
    dives: u64,
    nodes: u64,
    next_part: u64,
    next_run: u64,
    rounding: f64,
    work: u64,
    lazy: Option<LazyRows<'m, 'e>>,
    monitor: &'m mut Monitor<'e>,
}

impl<'m, 'e> Paused<'m, 'e> {
    fn of(tree: Tree<'_, 'm, 'e>) -> Self {
        Paused {
            costs: tree.costs,
            waiting: tree.waiting,
            stack: tree.stack,
            best: tree.best,
            done: tree.done,
            created: tree.created,
            dives: tree.dives,
            nodes: tree.nodes,
            next_part: tree.next_part,
            next_run: tree.next_run,
            rounding: tree.rounding,
            work: tree.relaxation.solver.work,
            lazy: tree.lazy,
            monitor: tree.monitor,
        }
    }

    /// The tree of a form that has more rows.
    fn resume<'a>(self, form: &'a Form, shared: &'a Shared, limits: Limits) -> Tree<'a, 'm, 'e> {
        let mut tree = Tree {
            costs: self.costs,
            waiting: self.waiting,
            stack: self.stack,
            best: self.best,
            done: self.done,
            created: self.created,
            dives: self.dives,
            nodes: self.nodes,
            next_part: self.next_part,
            next_run: self.next_run,
            rounding: self.rounding,
            lazy: self.lazy,
            ..Tree::new(form, shared, limits, self.monitor)
        };
        tree.relaxation.solver.work = self.work;
        tree
    }
}
