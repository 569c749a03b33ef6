//! Convex hulls of choices, written with copies of unknowns, become rows with large constants.
//!
//! A model that chooses one of several sets of rows may copy each unknown for each choice (`balas1985`):
//!
//! ```text
//! x = sum_k v_k,    0 <= v_k <= M_k b_k,    sum_k b_k = 1,    sum_i c_i v_ik + d b_k <= u
//! ```
//!
//! Integers leave `v_k = b_k x`, and so the copies may go: `sum_i c_i x_i + (m - u + d) b_k <= m` says the same,
//! with `m` the largest value of the sum within the bounds of the `x_i`. Its relaxation is weaker, and several times
//! smaller. A search through it takes more nodes and far less time.

use std::collections::{HashMap, HashSet};

use super::form::{Form, Interval, without_zeros};
use crate::error::Result;
use crate::linalg::Sparse;

/// A form without copies, and how its points become points of the form with them.
pub(super) struct Projected {
    pub form: Form,
    /// The unknowns that are left, by their numbers in the form with copies.
    pub kept: Vec<u32>,
    /// Copies, each with the unknown that it copies and the choice that it belongs to.
    copies: Vec<(u32, Copied)>,
}

/// What a copy is a copy of.
#[derive(Debug, Clone, Copy)]
struct Copied {
    of: u32,
    choice: u32,
    /// The copy is at most this where its choice is made.
    most: f64,
    /// The row that says so, and the row of the sum.
    rows: [u32; 2],
}

impl Projected {
    /// A point of the form with copies.
    pub fn with_copies(&self, point: &[f64]) -> Vec<f64> {
        let mut whole = vec![0.0; self.kept.len() + self.copies.len()];
        for (&j, x) in self.kept.iter().zip(point) {
            whole[j as usize] = *x;
        }
        for &(copy, Copied { of, choice, .. }) in &self.copies {
            if whole[choice as usize] > 0.5 {
                whole[copy as usize] = whole[of as usize];
            }
        }
        whole
    }

    /// The same numbers for the unknowns that are left, and zeros for the copies.
    pub fn scattered(&self, direction: &[f64]) -> Vec<f64> {
        let mut whole = vec![0.0; self.kept.len() + self.copies.len()];
        for (&j, d) in self.kept.iter().zip(direction) {
            whole[j as usize] = *d;
        }
        whole
    }
}

/// The form without the copies of its convex hulls, if it has any.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn project(form: &Form) -> Result<Option<Projected>> {
    let columns = form.rows.transpose();
    let mut copies = copies(form, &columns);
    while !copies.is_empty() && drop_unguarded(form, &columns, &mut copies) {}
    if copies.is_empty() {
        return Ok(None);
    }
    let n = form.dim();
    let kept: Vec<u32> = (0..n as u32).filter(|j| !copies.contains_key(j)).collect();
    let mut place = vec![u32::MAX; n];
    for (at, &j) in kept.iter().enumerate() {
        place[j as usize] = at as u32;
    }
    let mut boxes = form.limits.clone();
    for (limits, implied) in boxes.iter_mut().zip(&form.boxes) {
        *limits = limits.and(*implied);
    }
    let mut rows = Rows::default();
    let mut sums: HashMap<u32, Vec<(u32, f64)>> = HashMap::new();
    let mut ordered: Vec<(u32, Copied)> = copies.iter().map(|(&j, &copied)| (j, copied)).collect();
    ordered.sort_unstable_by_key(|(j, _)| *j);
    for (_, copied) in &ordered {
        let terms = sums.entry(copied.rows[1]).or_default();
        terms.push((copied.choice, copied.most));
    }
    let mut limits = form.limits.clone();
    for (_, copied) in &ordered {
        let Some(terms) = sums.remove(&copied.rows[1]) else {
            continue;
        };
        let of = copied.of as usize;
        let most = terms.iter().fold(0.0, |m: f64, (_, most)| m.max(*most));
        let within = Interval {
            lower: 0.0,
            upper: most,
        };
        boxes[of] = boxes[of].and(within);
        limits[of] = limits[of].and(within);
        if limits[of].is_empty() {
            return Ok(None);
        }
        if terms.iter().any(|(_, most)| *most < boxes[of].upper) {
            let terms = terms.iter().map(|&(choice, most)| (choice, -most));
            let terms = terms.chain([(copied.of, 1.0)]).collect();
            let sides = Interval {
                lower: f64::NEG_INFINITY,
                upper: 0.0,
            };
            rows.push(terms, sides, copied.rows[1]);
        }
    }
    let mut is_dropped = vec![false; form.rows.rows()];
    for row in ordered.iter().flat_map(|(_, copied)| copied.rows) {
        is_dropped[row as usize] = true;
    }
    for i in (0..form.rows.rows() as u32).filter(|&i| !is_dropped[i as usize]) {
        let row = form.rows.row(i as usize).map(|(j, a)| (j as u32, a));
        let row: Vec<(u32, f64)> = row.collect();
        let sides = form.row_limits[i as usize];
        match row.iter().find_map(|(j, _)| copies.get(j)) {
            None => rows.push(row, sides, i),
            Some(copied) => rows.push_guarded(&row, sides, i, copied.choice, &copies, &boxes),
        }
    }
    let Rows {
        entries,
        row_limits,
        from,
    } = rows;
    let entries = entries
        .into_iter()
        .map(|(i, j, a)| (i, place[j as usize], a));
    let matrix = Sparse::from_triplets(row_limits.len(), kept.len(), entries)?;
    let at = |j: u32| place[j as usize];
    let entries = form.hessian.entries().map(|(i, j, v)| (at(i), at(j), v));
    let pick = |of: &[Interval]| kept.iter().map(|&j| of[j as usize]).collect();
    Ok(Some(Projected {
        form: Form {
            hessian: Sparse::from_triplets(kept.len(), kept.len(), entries)?,
            gradient: kept.iter().map(|&j| form.gradient[j as usize]).collect(),
            constant: form.constant,
            rows: without_zeros(&matrix)?,
            row_limits,
            origins: from.iter().map(|&i| form.origins[i as usize]).collect(),
            limits: pick(&limits),
            boxes: pick(&boxes),
            integer: kept.iter().map(|&j| form.integer[j as usize]).collect(),
        },
        kept,
        copies: ordered,
    }))
}

/// The rows of the form without copies, in the unknowns of the form with them.
#[derive(Default)]
struct Rows {
    entries: Vec<(u32, u32, f64)>,
    row_limits: Vec<Interval>,
    /// The row that each comes from.
    from: Vec<u32>,
}

impl Rows {
    fn push(&mut self, row: Vec<(u32, f64)>, sides: Interval, from: u32) {
        let i = self.row_limits.len() as u32;
        self.entries.extend(row.into_iter().map(|(j, a)| (i, j, a)));
        self.row_limits.push(sides);
        self.from.push(from);
    }

    /// A row of copies of one choice, as a row of what they copy for each of its sides that may limit.
    fn push_guarded(
        &mut self,
        row: &[(u32, f64)],
        sides: Interval,
        from: u32,
        choice: u32,
        copies: &HashMap<u32, Copied>,
        boxes: &[Interval],
    ) {
        let own: f64 = row
            .iter()
            .filter(|(j, _)| *j == choice)
            .map(|(_, a)| a)
            .sum();
        let terms: Vec<(u32, f64)> = row
            .iter()
            .filter_map(|(j, a)| Some((copies.get(j)?.of, *a)))
            .collect();
        for sign in [1.0, -1.0] {
            let side = if sign > 0.0 {
                sides.upper
            } else {
                -sides.lower
            };
            let largest = terms.iter().map(|&(j, a)| {
                let limits = boxes[j as usize];
                sign * a * limits.side(sign * a)
            });
            let largest: f64 = largest.sum();
            let by = largest - side + sign * own;
            if by > 0.0 {
                let signed = terms.iter().map(|&(j, a)| (j, sign * a));
                let sides = Interval {
                    lower: f64::NEG_INFINITY,
                    upper: largest,
                };
                self.push(signed.chain([(choice, by)]).collect(), sides, from);
            }
        }
    }
}

/// All unknowns that may be copies, by rows that define them.
fn copies(form: &Form, columns: &Sparse) -> HashMap<u32, Copied> {
    let mut is_curved = vec![false; form.dim()];
    for (i, j, _) in form.hessian.entries() {
        is_curved[i as usize] = true;
        is_curved[j as usize] = true;
    }
    // The rows of which exactly one binary is 1, by these binaries.
    let rows = 0..form.rows.rows();
    let is_choice = |i: &usize| {
        let sides = form.row_limits[*i];
        let mut row = form.rows.row(*i);
        sides.is_point()
            && sides.lower != 0.0
            && row.all(|(j, a)| form.is_binary(j) && a == sides.lower)
    };
    let choices: HashSet<Vec<usize>> = rows
        .clone()
        .filter(is_choice)
        .map(|i| form.rows.row(i).map(|(j, _)| j).collect())
        .collect();
    // The binary that a copy is zero without, the largest value, and the row.
    let bound = |v: usize| {
        let is_plain = !form.integer[v] && !is_curved[v] && form.gradient[v] == 0.0;
        if !is_plain || form.limits[v].lower != 0.0 {
            return None;
        }
        columns.row(v).find_map(|(i, a)| {
            let (binary, c) = form.rows.row(i).find(|&(j, _)| j != v)?;
            let sides = form.row_limits[i];
            let is_upper = sides.upper == 0.0 && sides.lower == f64::NEG_INFINITY && a > 0.0;
            let is_lower = sides.lower == 0.0 && sides.upper == f64::INFINITY && a < 0.0;
            let most = (-c / a).min(form.limits[v].upper);
            let fits = form.rows.row(i).len() == 2 && form.is_binary(binary) && most > 0.0;
            (fits && (is_upper || is_lower)).then_some((binary, most, i))
        })
    };
    let mut copies = HashMap::new();
    for i in rows {
        let sides = form.row_limits[i];
        if !sides.is_point() || sides.lower != 0.0 || form.rows.row(i).len() < 3 {
            continue;
        }
        let (own, others): (Vec<_>, Vec<_>) =
            form.rows.row(i).partition(|&(j, _)| bound(j).is_none());
        let [(of, a)] = own[..] else {
            continue;
        };
        if form.integer[of] {
            continue;
        }
        let bounds = others.iter().filter(|(_, b)| *b == -a);
        let bounds: Vec<_> = bounds.filter_map(|&(v, _)| Some((v, bound(v)?))).collect();
        let mut binaries: Vec<usize> = bounds.iter().map(|(_, (binary, ..))| *binary).collect();
        binaries.sort_unstable();
        if bounds.len() != others.len() || !choices.contains(&binaries) {
            continue;
        }
        for (v, (choice, most, row)) in bounds {
            let copied = Copied {
                of: of as u32,
                choice: choice as u32,
                most,
                rows: [row as u32, i as u32],
            };
            copies.insert(v as u32, copied);
        }
    }
    copies
}

/// Drops the sums of copies that stand in a row which does not belong to one choice alone. Returns whether there
/// were any.
fn drop_unguarded(form: &Form, columns: &Sparse, copies: &mut HashMap<u32, Copied>) -> bool {
    let is_guarded = |i: u32, choice: u32| {
        let sides = form.row_limits[i as usize];
        let own = |j: u32| copies.get(&j).is_some_and(|copied| copied.choice == choice);
        let mut row = form.rows.row(i as usize);
        sides.lower <= 0.0
            && sides.upper >= 0.0
            && row.all(|(j, _)| j as u32 == choice || own(j as u32))
    };
    let is_wrong = |(&v, copied): (&u32, &Copied)| {
        let sum = copied.rows[1];
        let mut rows = columns.row(v as usize).map(|(i, _)| i as u32);
        let is_only_copied = |j: u32| copies.get(&j).is_some_and(|other| other.rows[1] == sum);
        let mut others = form.rows.row(sum as usize).map(|(j, _)| j as u32);
        let fits = rows.all(|i| copied.rows.contains(&i) || is_guarded(i, copied.choice))
            && others.all(|j| j == copied.of || is_only_copied(j))
            && !copies.contains_key(&copied.of);
        (!fits).then_some(sum)
    };
    let wrong: HashSet<u32> = copies.iter().filter_map(is_wrong).collect();
    copies.retain(|_, copied| !wrong.contains(&copied.rows[1]));
    !wrong.is_empty()
}

#[cfg(test)]
#[path = "hull_tests.rs"]
mod tests;
