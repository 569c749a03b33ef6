//! The record of a search, from which a proof is made.
//!
//! Rows and unknowns are those of the form until the search ends; [`of_whole`] names those of the whole problem.

use super::form::Form;
use super::mir::Cut;
use super::perspective::Switched;
use super::relaxation::Kept;
use crate::error::Conflicting;
use crate::proof::{self, Case, Ending, Searched, Step, Switch, Visited};

/// The nodes of a tree.
#[derive(Debug)]
pub(super) struct Record(Vec<Visited>);

impl Default for Record {
    /// The root alone.
    fn default() -> Self {
        Record(vec![Visited::default()])
    }
}

impl Record {
    pub fn into_nodes(self) -> Vec<Visited> {
        self.0
    }

    /// Bounds were tightened, until the row `missed` left no point.
    pub fn tightened(&mut self, node: usize, steps: Vec<Step>, missed: Option<usize>) {
        let node = &mut self.0[node];
        node.steps = steps;
        if let Some(row) = missed {
            node.ending = Ending::Missed(row as u32);
        }
    }

    /// A relaxation was solved. Its bound is of use where it is above that of the parent.
    pub fn solved(&mut self, node: usize, parent: f64, kept: Kept, unknowns: usize) {
        let is_root = parent == f64::NEG_INFINITY;
        let own = &mut self.0[node];
        own.steps.extend(kept.steps);
        if !kept.certificate.point.is_empty() && (kept.bound > parent || is_root) {
            own.certificate = Some(kept.certificate);
        }
        if let Some(row) = kept.missed {
            own.ending = Ending::Missed(row as u32);
        }
        self.contradiction(node, &kept.contradiction, unknowns);
    }

    /// Rows with these multipliers, if there are any, contradict each other. They are numbered after the unknowns.
    pub fn contradiction(&mut self, node: usize, rows: &[(u32, f64)], unknowns: usize) {
        if rows.is_empty() {
            return;
        }
        let rows = rows.iter();
        let rows = rows.filter_map(|&(row, by)| Some((row.checked_sub(unknowns as u32)?, by)));
        self.0[node].ending = Ending::Contradiction(rows.collect());
    }

    /// The node was branched on. Returns its children.
    pub fn branched(&mut self, node: usize, unknown: u32, at: f64) -> [usize; 2] {
        let first = self.0.len();
        self.0.extend([Visited::default(), Visited::default()]);
        let children = [first, first + 1];
        self.0[node].ending = Ending::Branched {
            unknown,
            at,
            children,
        };
        children
    }
}

/// What was added to the form of a part, and where its rows are in the whole.
#[derive(Clone, Copy)]
pub(super) struct Added<'a> {
    /// The numbers of equality constraints and of inequalities of the whole. Cuts come after both.
    pub constraints: usize,
    pub inequalities: usize,
    pub switches: &'a [Switched],
    pub cuts: &'a [Cut],
    /// The cuts that the last rows of the form are.
    pub rows: &'a [usize],
}

/// The search of a part in the rows and unknowns of the whole.
pub(super) fn of_whole(
    form: &Form,
    members: &[u32],
    added: Added,
    mut nodes: Vec<Visited>,
) -> Searched {
    let own = form.rows.rows() - added.rows.len();
    let cut_of = |cut: usize| (added.constraints + added.inequalities + cut) as u32;
    let row_of = |row: u32| match (row as usize).checked_sub(own) {
        Some(k) => cut_of(added.rows[k]),
        None => row_of_whole(form, added.constraints, row),
    };
    let unknown_of = |unknown: u32| members[unknown as usize];
    for node in &mut nodes {
        for step in &mut node.steps {
            *step = match *step {
                Step::Lower(row, unknown, to) => Step::Lower(row_of(row), unknown_of(unknown), to),
                Step::Upper(row, unknown, to) => Step::Upper(row_of(row), unknown_of(unknown), to),
                Step::RowLower(row, to) => Step::RowLower(row_of(row), to),
                Step::RowUpper(row, to) => Step::RowUpper(row_of(row), to),
            };
        }
        if let Some(certificate) = &mut node.certificate {
            for (row, _) in &mut certificate.multipliers {
                *row = row_of(*row);
            }
        }
        match &mut node.ending {
            Ending::Bounded => {}
            Ending::Branched { unknown, .. } => *unknown = unknown_of(*unknown),
            Ending::Contradiction(rows) => rows.iter_mut().for_each(|(row, _)| *row = row_of(*row)),
            Ending::Missed(row) => *row = row_of(*row),
        }
    }
    let switches = added.switches.iter().map(|switched| {
        let unknown = unknown_of(switched.unknown);
        let [below, above] = switched.rows.map(|row| row.map(row_of));
        let below = below.map(|row| Step::Lower(row, unknown, 0.0));
        let above = above.map(|row| Step::Upper(row, unknown, 0.0));
        Switch {
            unknown,
            binary: unknown_of(switched.binary),
            steps: below.into_iter().chain(above).collect(),
            product: switched.product,
            square: switched.square,
        }
    });
    let terms = |terms: &[(u32, f64)], sign: f64| -> Vec<(u32, f64)> {
        let of_whole = terms.iter().map(|&(j, a)| (unknown_of(j), sign * a));
        of_whole.collect()
    };
    let cuts = added.cuts.iter().map(|cut| {
        let split = &cut.split;
        let case = |which: usize| {
            let rows = split.rows.iter().map(|&(row, by)| {
                let row = match (row as usize).checked_sub(own) {
                    Some(cut) => cut_of(cut),
                    None => row_of(row),
                };
                (row, by[which])
            });
            Case {
                by: split.by[which],
                multipliers: rows.filter(|(_, by)| *by != 0.0).collect(),
            }
        };
        proof::Cut {
            terms: terms(&cut.row, -1.0),
            lower: -cut.side,
            split: terms(&split.terms, 1.0),
            at: split.at,
            cases: [case(0), case(1)],
        }
    });
    Searched {
        cuts: cuts.collect(),
        switches: switches.collect(),
        unknowns: members.to_vec(),
        nodes,
        condensed: None,
    }
}

/// The number of a row of the form in the whole.
fn row_of_whole(form: &Form, constraints: usize, row: u32) -> u32 {
    match form.origins[row as usize] {
        Conflicting::Constraint(k) => k as u32,
        Conflicting::Inequality(k) => (constraints + k) as u32,
        // No row of a form comes from bounds.
        Conflicting::Bounds(_) => u32::MAX,
    }
}
