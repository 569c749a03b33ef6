//! Whether the objective of a part is convex, and has the curvature that the proof says.
//!
//! The Hessian is divided into blocks of unknowns that it couples. A block is positive semi-definite
//!
//! 1. if it has squares alone and no curvature is claimed;
//! 2. if its diagonal dominates, decided exactly;
//! 3. if a factor L in floats leaves a rest `H - LL'` that its diagonal dominates, all rounding errors counted
//!    (`rump2006`);
//! 4. as before, with a sparse factor in the order in which the unknowns stand (`sparse_factor`); for lattices;
//! 5. if elimination in exact integers (`bareiss1968`) has no negative pivot; for small blocks.

use std::collections::BTreeMap;

use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::minorant::PartObjective;
use super::sparse_factor;

/// The largest block that is eliminated exactly.
const SMALL: usize = 40;

/// The largest block with a dense factor.
const LARGEST: usize = 3000;

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// Whether to go on, asked in every long loop. What is ended this way shows nothing.
pub(super) type GoesOn<'a> = &'a dyn Fn() -> bool;

/// Entries of a lower triangle.
pub(super) type Entries = BTreeMap<(usize, usize), Exact>;

/// A block: its unknowns, and the entries of its lower triangle by places in it.
pub(super) struct Block {
    pub members: Vec<usize>,
    entries: Entries,
    has_quadratic: bool,
}

/// The blocks of a part's Hessian, without curvature taken off.
pub(super) fn blocks(part: &PartObjective) -> Vec<Block> {
    let n = part.members.len();
    let mut root: Vec<usize> = (0..n).collect();
    fn find(root: &mut [usize], mut i: usize) -> usize {
        while root[i] != i {
            root[i] = root[root[i]];
            i = root[i];
        }
        i
    }
    let mut join = |i: usize, j: usize| {
        let (a, b) = (find(&mut root, i), find(&mut root, j));
        root[a.max(b)] = a.min(b);
    };
    for (i, j, _) in &part.quadratic {
        join(*i, *j);
    }
    for square in &part.squares {
        for pair in square.terms.windows(2) {
            join(pair[0].0, pair[1].0);
        }
    }
    let mut place = vec![(0, 0); n];
    let mut blocks: Vec<Block> = Vec::new();
    for i in 0..n {
        let first = find(&mut root, i);
        if first == i {
            place[i].0 = blocks.len();
            blocks.push(Block {
                members: Vec::new(),
                entries: BTreeMap::new(),
                has_quadratic: false,
            });
        }
        let number = place[first].0;
        place[i] = (number, blocks[number].members.len());
        blocks[number].members.push(i);
    }
    let mut add = |i: usize, j: usize, v: &Exact, is_quadratic: bool| {
        let block = &mut blocks[place[i].0];
        let at = (place[i].1.max(place[j].1), place[i].1.min(place[j].1));
        let sum = block.entries.entry(at).or_insert_with(Exact::zero);
        *sum = &*sum + v;
        block.has_quadratic |= is_quadratic;
    };
    for (i, j, v) in &part.quadratic {
        add(*i, *j, v, true);
    }
    for square in &part.squares {
        for (k, (i, a)) in square.terms.iter().enumerate() {
            for (j, b) in &square.terms[..=k] {
                add(*i, *j, &(&square.weight * &(a * b)).shifted(1), false);
            }
        }
    }
    blocks
}

/// Holds the curvature of a part against its objective, as long as it may go on.
///
/// # Errors
/// [`FaultKind::NotConvex`].
pub(super) fn check(part: &PartObjective, goes_on: GoesOn) -> Checked<()> {
    for block in blocks(part) {
        let curvature: Vec<Exact> = block
            .members
            .iter()
            .map(|&k| part.curvature[k].clone())
            .collect();
        if !block.has_curvature(&curvature, goes_on) {
            let first = part.members[block.members[0]];
            let text = format!(
                "the objective of x{first} and the {} unknowns that it is coupled with is not shown to have \
                 this curvature",
                block.members.len() - 1
            );
            return wrong(FaultKind::NotConvex, text);
        }
    }
    Ok(())
}

impl Block {
    /// The diagonal, in floats.
    pub fn diagonal(&self) -> Vec<f64> {
        let entry = |k: usize| self.entries.get(&(k, k)).map_or(0.0, Exact::near);
        (0..self.members.len()).map(entry).collect()
    }

    /// The positive curvature of a block of one unknown, if it is a float.
    pub fn whole_curvature(&self) -> Option<f64> {
        let entry = self.entries.get(&(0, 0))?;
        let near = entry.near();
        let is_exact = Exact::of(near).is_some_and(|near| near == *entry);
        (self.members.len() == 1 && is_exact && near > 0.0).then_some(near)
    }

    /// Whether the block minus a diagonal is positive semi-definite. No means that it could not be shown.
    pub fn has_curvature(&self, curvature: &[Exact], goes_on: GoesOn) -> bool {
        if !self.has_quadratic && curvature.iter().all(Exact::is_zero) {
            return true;
        }
        if !goes_on() {
            return false;
        }
        let entries = self.minus(curvature);
        let n = self.members.len();
        self.is_shown(&entries, goes_on)
            || (n <= SMALL && has_no_negative_pivot(&entries, n, goes_on))
    }

    /// As [`has_curvature`](Self::has_curvature), by what takes little time.
    pub fn has_curvature_at_once(&self, curvature: &[Exact], goes_on: GoesOn) -> bool {
        goes_on() && self.is_shown(&self.minus(curvature), goes_on)
    }

    /// As [`has_curvature`](Self::has_curvature), by a sparse factor in the order of the unknowns.
    pub fn has_curvature_in_order(&self, curvature: &[Exact], goes_on: GoesOn) -> bool {
        let entries = self.minus(curvature);
        let n = self.members.len();
        dominates(&entries, n) || sparse_factor::has_factor(&entries, n, goes_on)
    }

    fn is_shown(&self, entries: &Entries, goes_on: GoesOn) -> bool {
        let n = self.members.len();
        dominates(entries, n) || (n <= LARGEST && goes_on() && has_factor(entries, n, goes_on))
    }

    fn minus(&self, curvature: &[Exact]) -> Entries {
        let mut entries = self.entries.clone();
        for (k, d) in curvature.iter().enumerate() {
            let sum = entries.entry((k, k)).or_insert_with(Exact::zero);
            *sum = &*sum - d;
        }
        entries
    }
}

/// Whether each diagonal entry is at least the sum of the absolute values of the others in its row.
fn dominates(entries: &Entries, n: usize) -> bool {
    let mut left = vec![Exact::zero(); n];
    for ((i, j), v) in entries {
        if i == j {
            left[*i] = &left[*i] + v;
        } else {
            left[*i] = &left[*i] - &v.abs();
            left[*j] = &left[*j] - &v.abs();
        }
    }
    left.iter().all(|left| left.sign().is_ge())
}

/// Whether a Cholesky factor in floats leaves a rest that its diagonal dominates.
fn has_factor(entries: &Entries, n: usize, goes_on: GoesOn) -> bool {
    rest_of_factor(entries, n, goes_on) == Some(true)
}

/// Nothing if there is no factor, or it was not to go on.
fn rest_of_factor(entries: &Entries, n: usize, goes_on: GoesOn) -> Option<bool> {
    // Powers of two bring the diagonal near one, and change nothing else.
    let mut scale = vec![0.0; n];
    for (k, scale) in scale.iter_mut().enumerate() {
        let entry = entries.get(&(k, k))?.near();
        if !(entry > 1e-200 && entry < 1e200) {
            return None;
        }
        *scale = 2f64.powi(-(entry.log2() / 2.0).round() as i32);
    }
    let mut matrix = vec![0.0; n * n];
    for (&(i, j), v) in entries {
        matrix[i * n + j] = v.near() * scale[i] * scale[j];
    }
    let size = n as f64 + 10.0;
    let taken_off = 8.0 * size * size * UNIT;
    let mut factor = vec![0.0; n * n];
    let mut lengths = vec![0.0; n];
    for i in 0..n {
        goes_on().then_some(())?;
        for j in 0..=i {
            let (row, other) = (&factor[i * n..i * n + j], &factor[j * n..j * n + j]);
            let products: f64 = row.iter().zip(other).map(|(a, b)| a * b).sum();
            let rest = matrix[i * n + j] - products;
            factor[i * n + j] = if i > j {
                rest / factor[j * n + j]
            } else if rest > 2.0 * taken_off {
                (rest - taken_off).sqrt()
            } else {
                return None;
            };
        }
        let row = &factor[i * n..=i * n + i];
        lengths[i] = row.iter().map(|l| l * l).sum::<f64>().sqrt() * (1.0 + 1e-9);
    }
    let mut left = vec![0.0; n];
    for i in 0..n {
        goes_on().then_some(())?;
        for j in 0..=i {
            let (row, other) = (&factor[i * n..=i * n + j], &factor[j * n..=j * n + j]);
            let products: f64 = row.iter().zip(other).map(|(a, b)| a * b).sum();
            let entry = matrix[i * n + j];
            let error = 2.0 * size * UNIT * (entry.abs() + lengths[i] * lengths[j]) + 1e-250;
            let rest = entry - products;
            if i == j {
                left[i] += rest - error;
            } else {
                left[i] -= rest.abs() + error;
                left[j] -= rest.abs() + error;
            }
        }
    }
    // What these sums round is far below the part of `taken_off` that is kept here.
    Some(left.iter().all(|&left| left >= 0.125 * taken_off))
}

/// Whether elimination with integers meets no negative pivot, and no zero pivot whose row is not zero.
fn has_no_negative_pivot(entries: &Entries, n: usize, goes_on: GoesOn) -> bool {
    let mut rows: Vec<Vec<Exact>> = vec![vec![Exact::zero(); n]; n];
    for ((i, j), v) in entries {
        rows[*i][*j] = v.clone();
        rows[*j][*i] = v.clone();
    }
    let mut before: Option<Exact> = None;
    for k in 0..n {
        let pivot = rows[k][k].clone();
        if pivot.is_zero() {
            if (k..n).any(|j| !rows[k][j].is_zero()) {
                return false;
            }
            continue;
        }
        if pivot.sign().is_lt() || !goes_on() {
            return false;
        }
        for i in k + 1..n {
            for j in k + 1..=i {
                let cross = &rows[i][k] * &rows[j][k];
                let minor = &(&pivot * &rows[i][j]) - &cross;
                let entry = match &before {
                    None => minor,
                    Some(divisor) => minor.quotient(divisor),
                };
                rows[i][j] = entry.clone();
                rows[j][i] = entry;
            }
        }
        before = Some(pivot);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block with this lower triangle, row by row.
    fn block(rows: &[&[f64]]) -> Block {
        let mut entries = BTreeMap::new();
        for (i, row) in rows.iter().enumerate() {
            for (j, &v) in row.iter().enumerate() {
                entries.insert((i, j), Exact::of(v).unwrap());
            }
        }
        Block {
            members: (0..rows.len()).collect(),
            entries,
            has_quadratic: true,
        }
    }

    fn has(rows: &[&[f64]], curvature: f64) -> bool {
        let curvature = vec![Exact::of(curvature).unwrap(); rows.len()];
        block(rows).has_curvature(&curvature, &|| true)
    }

    #[test]
    fn curvature_is_shown_up_to_the_least_eigenvalue() {
        // Eigenvalues 1 and 3; the second matrix has 0 and 2.
        assert!(has(&[&[2.0], &[1.0, 2.0]], 1.0));
        assert!(!has(&[&[2.0], &[1.0, 2.0]], 1.0_f64.next_up()));
        assert!(has(&[&[1.0], &[-1.0, 1.0]], 0.0));
        assert!(!has(&[&[1.0], &[-1.0_f64.next_up(), 1.0]], 0.0));
    }

    #[test]
    fn singular_blocks_are_decided_exactly() {
        // (x + 2 y + 3 z)^2, whose diagonal does not dominate.
        let square: [&[f64]; 3] = [&[2.0], &[4.0, 8.0], &[6.0, 12.0, 18.0]];
        assert!(has(&square, 0.0));
        assert!(!has(&square, 2f64.powi(-60)));
        let less: [&[f64]; 3] = [&[2.0], &[4.0, 8.0], &[6.0, 12.0, 18.0_f64.next_down()]];
        assert!(!has(&less, 0.0));
        assert!(!has(&[&[0.0], &[1.0, 9.0]], 0.0));
    }

    #[test]
    fn a_factor_in_floats_never_shows_too_much() {
        // 1 + n eps on the diagonal and ones beside it: the least eigenvalue is n eps.
        let n = 30;
        for (excess, is_shown) in [(1e-6, true), (0.0, false), (-1e-12, false)] {
            let mut entries = BTreeMap::new();
            for i in 0..n {
                for j in 0..=i {
                    let v = if i == j { 1.0 + excess } else { 1.0 };
                    entries.insert((i, j), Exact::of(v).unwrap());
                }
            }
            assert_eq!(has_factor(&entries, n, &|| true), is_shown, "{excess}");
            assert_eq!(
                has_no_negative_pivot(&entries, n, &|| true),
                excess >= 0.0,
                "{excess}"
            );
        }
    }
}
