//! Choices that may change places: of all orders of them, one is enough.
//!
//! Where rows `sum_k b_rk = 1` assign things to places that are alike, exchanging two places everywhere gives points
//! of the same energy. Each such exchange is an automorphism of the form. If all places may be exchanged, some thing
//! may be held in the first place, another one in the first two, and so on (`kaibel2008`, partitioning orbitopes).
//!
//! Exchanges are guessed by colours: an unknown gets a new colour from those of its rows and of the unknowns that Q
//! couples with it, until the colours no longer part (`mckay1981`). What was guessed is verified entry by entry.

use super::dominated::with_bounds;
use super::form::{Form, Interval};
use crate::linalg::Sparse;
use crate::monitor::may_continue;

/// Rounds of new colours.
const ROUNDS: usize = 50;

/// The largest number of choices that are looked at.
const MOST: usize = 30;

/// The largest sum of squared lengths of rows, for what looks at each two entries of a row. Problems of the field
/// have up to half a million (`QPLIB_3547`), so that this excludes only rows of thousands of choices.
const PAIRS: usize = 50_000_000;

/// The largest number of entries of the form, counted once for each exchange that is tried. The 43,000 of
/// `QPLIB_3547`, of which all five exchanges hold, take less than a tenth of a second; so this many take a few seconds.
const ENTRIES: usize = 3_000_000;

/// An exchange: where each unknown goes. Done twice, it leaves all in place.
type Exchange = Vec<u32>;

/// The form with one order of its choices, and the start in that order, if its choices may change places.
pub(super) fn ordered(form: &Form, start: Option<&[f64]>) -> Option<(Form, Option<Vec<f64>>)> {
    let rows = choice_rows(form);
    let lengths = (0..form.rows.rows()).map(|i| form.rows.row(i).len());
    let pairs = lengths.fold(0, |sum: usize, n| sum.saturating_add(n.saturating_mul(n)));
    if rows.len() < 2 || pairs > PAIRS {
        return None;
    }
    // Bounds without effect shall not tell choices apart.
    let mut form = with_bounds(form);
    let graph = Graph::of(&form);
    let plain = graph.colours(|_| 0);
    let groups = rows.iter().filter(|row| row.len() <= MOST);
    // The choices of a row that may be alike, in the first row that has any.
    let base = groups
        .map(|row| {
            let colour = |j: u32| plain[j as usize];
            let alike = |&j: &u32| row.iter().filter(|&&k| colour(k) == colour(j)).count();
            let most = row.iter().copied().rev().max_by_key(alike).map(colour);
            let alike = row.iter().copied().filter(|&j| Some(colour(j)) == most);
            alike.collect::<Vec<u32>>()
        })
        .find(|base| base.len() > 1)?;
    let first = graph.colours(|j| u64::from(j == base[0]));
    let entries = form.rows.entries().count() + form.hessian.entries().count();
    let others = base[1..].iter().take(ENTRIES / entries.max(1));
    let others = others.take_while(|_| may_continue().is_ok());
    let exchanges = others.filter_map(|&other| {
        let second = graph.colours(|j| u64::from(j == other));
        graph.exchange(&rows, &first, &second)
    });
    let exchanges: Vec<Exchange> = exchanges.collect();
    let mut places = places(&rows, &exchanges);
    if exchanges.is_empty() || places.is_empty() {
        return None;
    }
    let weight = |row: &Vec<u32>| graph.neighbours[row[0] as usize].len();
    places.sort_by_key(|row| std::cmp::Reverse(weight(row)));
    let mut start = start.map(<[f64]>::to_vec);
    for (at, row) in places.iter().take(exchanges.len()).enumerate() {
        for &j in &row[at + 1..] {
            form.limits[j as usize] = Interval::point(0.0);
            form.boxes[j as usize] = Interval::point(0.0);
        }
        if let Some(start) = &mut start {
            let value = |k: usize| start[row[k] as usize];
            let largest = (0..row.len())
                .rev()
                .max_by(|&a, &b| value(a).total_cmp(&value(b)));
            bring(start, &exchanges, largest.unwrap_or(0), at);
        }
    }
    Some((form, start))
}

/// Exchanges the place `from` with the place `to`, if it comes after that.
fn bring(point: &mut Vec<f64>, exchanges: &[Exchange], from: usize, to: usize) {
    if from <= to {
        return;
    }
    let mut exchange = |k: usize| {
        if k > 0 {
            *point = exchanges[k - 1]
                .iter()
                .map(|&j| point[j as usize])
                .collect();
        }
    };
    exchange(to);
    exchange(from);
    exchange(to);
}

/// The rows of which exactly one binary is 1.
fn choice_rows(form: &Form) -> Vec<Vec<u32>> {
    let is_choice = |i: &usize| {
        let sides = form.row_limits[*i];
        let mut row = form.rows.row(*i);
        let is_long = row.len() > 1;
        is_long && sides == Interval::point(1.0) && row.all(|(j, a)| a == 1.0 && form.is_binary(j))
    };
    let rows = (0..form.rows.rows()).filter(is_choice);
    rows.map(|i| form.rows.row(i).map(|(j, _)| j as u32).collect())
        .collect()
}

/// The rows that all exchanges permute in the same way: for each the binary of the first place, and those that the
/// exchanges put there.
fn places(rows: &[Vec<u32>], exchanges: &[Exchange]) -> Vec<Vec<u32>> {
    let of = |row: &Vec<u32>| {
        let is_first = |j: &&u32| exchanges.iter().all(|to| to[**j as usize] != **j);
        let &first = row.iter().find(is_first)?;
        let others: Vec<u32> = exchanges.iter().map(|to| to[first as usize]).collect();
        let mut different = others.clone();
        different.sort_unstable();
        different.dedup();
        if different.len() < others.len() {
            return None;
        }
        // Each exchange moves the first place and one other.
        let moves = |(k, to): (usize, &Exchange)| {
            row.iter()
                .all(|&j| j == first || j == others[k] || to[j as usize] == j)
                && row.contains(&others[k])
        };
        exchanges.iter().enumerate().all(moves).then(|| {
            let mut all = vec![first];
            all.extend(others);
            all
        })
    };
    rows.iter().filter_map(of).collect()
}

/// The form as a graph of unknowns and rows. Its edges have the entries of the matrices.
struct Graph<'a> {
    form: &'a Form,
    /// The rows of each unknown, after the unknowns, and the unknowns that Q couples with it.
    neighbours: Vec<Vec<(u32, u64)>>,
}

impl<'a> Graph<'a> {
    fn of(form: &'a Form) -> Self {
        let n = form.dim();
        let mut neighbours = vec![Vec::new(); n + form.rows.rows()];
        for (i, j, a) in form.rows.entries() {
            let i = i + n as u32;
            neighbours[i as usize].push((j, a.to_bits()));
            neighbours[j as usize].push((i, a.to_bits()));
        }
        for (i, j, v) in form.hessian.entries() {
            neighbours[i as usize].push((j, v.to_bits()));
            if i != j {
                neighbours[j as usize].push((i, v.to_bits()));
            }
        }
        Graph { form, neighbours }
    }

    /// The colours of unknowns and rows, where `label` tells unknowns apart from the beginning.
    fn colours(&self, label: impl Fn(u32) -> u64) -> Vec<u64> {
        let form = self.form;
        let sides = |limits: &Interval| mixed(limits.lower.to_bits(), limits.upper.to_bits());
        let unknowns = (0..form.dim()).map(|j| {
            let kind = mixed(form.gradient[j].to_bits(), u64::from(form.integer[j]));
            mixed(mixed(sides(&form.limits[j]), kind), label(j as u32))
        });
        let rows = form.row_limits.iter().map(|limits| !sides(limits));
        let mut colours: Vec<u64> = unknowns.chain(rows).collect();
        let mut count = distinct(&colours);
        for _ in 0..ROUNDS {
            let next = self
                .neighbours
                .iter()
                .zip(&colours)
                .map(|(neighbours, &own)| {
                    let terms = neighbours.iter();
                    let terms = terms.map(|&(other, edge)| mixed(edge, colours[other as usize]));
                    mixed(own, terms.fold(0, u64::wrapping_add))
                });
            colours = next.collect();
            let new = distinct(&colours);
            if new == count {
                break;
            }
            count = new;
        }
        colours
    }

    /// The exchange of the two places that the colours single out, if it is an automorphism.
    fn exchange(&self, rows: &[Vec<u32>], first: &[u64], second: &[u64]) -> Option<Exchange> {
        let n = self.form.dim();
        let mut to: Exchange = (0..n as u32).collect();
        for row in rows {
            for &j in row {
                let mut same = row
                    .iter()
                    .filter(|&&k| second[k as usize] == first[j as usize]);
                if let (Some(&k), None) = (same.next(), same.next())
                    && k != j
                    && [j, k].iter().all(|&u| to[u as usize] == u)
                {
                    to[j as usize] = k;
                    to[k as usize] = j;
                }
            }
        }
        // All others follow from the binaries of these rows.
        let mut label = vec![0; n];
        for &j in rows.iter().flatten() {
            label[j as usize] = u64::from(j) + 1;
        }
        let before = self.colours(|j| label[j as usize]);
        let after = self.colours(|j| label[to[j as usize] as usize]);
        let all = matched(&before, &after)?;
        let (unknowns, rows) = all.split_at(n);
        let is_involution = unknowns
            .iter()
            .zip(0..)
            .all(|(&k, j)| unknowns[k as usize] == j);
        let rows: Vec<u32> = rows.iter().map(|i| i - n as u32).collect();
        (is_involution && self.is_automorphism(unknowns, &rows)).then(|| unknowns.to_vec())
    }

    /// Whether the form stays the same where each unknown and each row goes to another one.
    fn is_automorphism(&self, unknowns: &[u32], rows: &[u32]) -> bool {
        let form = self.form;
        let is_same = |(j, &k): (usize, &u32)| {
            let k = k as usize;
            form.limits[j] == form.limits[k]
                && form.integer[j] == form.integer[k]
                && form.gradient[j] == form.gradient[k]
        };
        let same_sides = |(i, &k): (usize, &u32)| form.row_limits[i] == form.row_limits[k as usize];
        unknowns.iter().enumerate().all(is_same)
            && rows.iter().enumerate().all(same_sides)
            && is_permuted(&form.rows, rows, unknowns, false)
            && is_permuted(&form.hessian, unknowns, unknowns, true)
    }
}

/// Whether a matrix has the same entries after its rows and columns go elsewhere. A symmetric one is given by its
/// lower triangle.
fn is_permuted(matrix: &Sparse, rows: &[u32], columns: &[u32], symmetric: bool) -> bool {
    let bits = |(i, j, v): (u32, u32, f64)| (i, j, v.to_bits());
    let moved = matrix.entries().map(|(i, j, v)| {
        let (i, j) = (rows[i as usize], columns[j as usize]);
        if symmetric && i < j {
            (j, i, v)
        } else {
            (i, j, v)
        }
    });
    let mut moved: Vec<_> = moved.map(bits).collect();
    moved.sort_unstable();
    moved.into_iter().eq(matrix.entries().map(bits))
}

/// For each vertex the one of the same colour on the other side; those of one colour in their order.
fn matched(before: &[u64], after: &[u64]) -> Option<Vec<u32>> {
    let sorted = |colours: &[u64]| {
        let mut order: Vec<(u64, u32)> = colours.iter().copied().zip(0..).collect();
        order.sort_unstable();
        order
    };
    let mut all = vec![0; before.len()];
    for ((own, i), (other, k)) in sorted(before).into_iter().zip(sorted(after)) {
        if own != other {
            return None;
        }
        all[i as usize] = k;
    }
    Some(all)
}

fn distinct(colours: &[u64]) -> usize {
    let mut sorted = colours.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    sorted.len()
}

/// One number from two (the finalizer of `steele2014`).
fn mixed(a: u64, b: u64) -> u64 {
    let mut z = a.rotate_left(32) ^ b.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
#[path = "symmetry_tests.rs"]
mod tests;
