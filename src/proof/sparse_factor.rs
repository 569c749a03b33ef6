//! Whether a sparse matrix is positive semi-definite, by a factor in floats and its rest.
//!
//! A factor L of the matrix minus a small diagonal leaves a rest `A - LL'`. If each entry on the rest's diagonal is at
//! least the sum of the others in its row, with all rounding errors, the matrix is positive semi-definite
//! (`rump2006`). What is taken off the diagonal is known at each pivot: the rest of the row so far, and what its column
//! will be rounded by. Sums are held in twice the working precision, so that the rest is known to its last digits.

use super::convex::{Entries, GoesOn};
use super::exact::Exact;

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// Below this no product may be: its rounding error would be larger than relative.
const TINY: f64 = 1e-200;

/// A number as the sum of two floats, the second one a rounding error of the first.
#[derive(Debug, Clone, Copy)]
struct Twofold {
    high: f64,
    low: f64,
}

impl Twofold {
    const ZERO: Self = Twofold {
        high: 0.0,
        low: 0.0,
    };

    fn of(exact: &Exact) -> Self {
        let high = exact.near();
        let rest = Exact::of(high).map_or(0.0, |near| (exact - &near).near());
        Twofold { high, low: rest }
    }

    fn scaled(self, by: f64) -> Self {
        Twofold {
            high: self.high * by,
            low: self.low * by,
        }
    }

    /// Subtracts a product, whose own rounding error is exact (`ogita2005`, algorithms 2.1 and 3.3).
    fn subtract_product(&mut self, a: f64, b: f64) {
        let product = -a * b;
        let split = |x: f64| {
            let far = 134_217_729.0 * x;
            let high = far - (far - x);
            (high, x - high)
        };
        let ((a1, a2), (b1, b2)) = (split(-a), split(b));
        let of_product = a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2);
        let sum = self.high + product;
        let part = sum - self.high;
        let of_sum = (self.high - (sum - part)) + (product - part);
        self.high = sum;
        self.low += of_sum + of_product;
    }

    fn value(self) -> f64 {
        self.high + self.low
    }
}

/// Entries of a column of the matrix, scaled, by row.
type Given = Vec<(usize, Twofold)>;

const NONE: usize = usize::MAX;

/// The factor so far, by columns, each of which waits at its next row.
struct Factor {
    /// Below the diagonal: rows, increasing, and values.
    columns: Vec<(Vec<u32>, Vec<f64>)>,
    next: Vec<usize>,
    /// The first column that waits at each row, and the next one there after each column.
    first_at: Vec<usize>,
    after: Vec<usize>,
    /// By row: what is left of its entry in the current column, and the last column that has one.
    left: Vec<Twofold>,
    met: Vec<usize>,
    /// By row: how many entries it has so far, the sum of their squares, and that of the rest's absolute values.
    counts: Vec<u32>,
    squares: Vec<f64>,
    rests: Vec<f64>,
}

impl Factor {
    fn new(n: usize) -> Self {
        Factor {
            columns: Vec::with_capacity(n),
            next: vec![0; n],
            first_at: vec![NONE; n],
            after: vec![NONE; n],
            left: vec![Twofold::ZERO; n],
            met: vec![NONE; n],
            counts: vec![0; n],
            squares: vec![0.0; n],
            rests: vec![0.0; n],
        }
    }

    /// Lets a column wait at its next row.
    fn wait(&mut self, k: usize) {
        if let Some(&row) = self.columns[k].0.get(self.next[k]) {
            let row = row as usize;
            self.after[k] = self.first_at[row];
            self.first_at[row] = k;
        }
    }

    /// Column j of the matrix minus the products of the columns before it. Returns its rows, increasing.
    fn gather(&mut self, j: usize, given: &Given) -> Vec<u32> {
        let mut rows = vec![j as u32];
        (self.met[j], self.left[j]) = (j, Twofold::ZERO);
        for &(i, v) in given {
            if self.met[i] != j {
                self.met[i] = j;
                rows.push(i as u32);
            }
            self.left[i] = v;
        }
        let mut k = std::mem::replace(&mut self.first_at[j], NONE);
        while k != NONE {
            let (at, values) = &self.columns[k];
            let from = self.next[k];
            for (&row, &l) in at[from..].iter().zip(&values[from..]) {
                let i = row as usize;
                if self.met[i] != j {
                    (self.met[i], self.left[i]) = (j, Twofold::ZERO);
                    rows.push(row);
                }
                self.left[i].subtract_product(values[from], l);
            }
            let waiting = self.after[k];
            self.next[k] += 1;
            self.wait(k);
            k = waiting;
        }
        rows.sort_unstable();
        rows
    }

    /// What sums in twice the working precision may be off by, in row i of column j (`ogita2005`, proposition 5.5, with
    /// the sum of the terms' sizes by Cauchy's inequality).
    fn off(&self, i: usize, j: usize, given: &Given) -> f64 {
        let at = given.binary_search_by_key(&i, |&(row, _)| row);
        let entry = at.map_or(0.0, |at| given[at].1.high.abs());
        let count = f64::from(self.counts[j]) + 4.0;
        let size = entry + (self.squares[i] * self.squares[j]).sqrt() * (1.0 + 1e-9) + 1.0;
        16.0 * count * count * UNIT * UNIT * size + TINY
    }

    /// The next column from what is left of that of the matrix. Nothing if what its rounding leaves is more than the
    /// diagonal can bear.
    fn close(&mut self, j: usize, rows: &[u32], given: &Given) -> Option<()> {
        let diagonal = self.left[j].value();
        let (mut sizes, mut off) = (0.0, self.off(j, j, given));
        for &row in &rows[1..] {
            sizes += self.left[row as usize].value().abs();
            off += self.off(row as usize, j, given);
        }
        // Half as much again as the rest of the row so far, and what this column will be rounded by.
        let rounded = self.rests[j] + 2.0 * UNIT * sizes + 2.0 * off;
        let taken_off = 1.5 * rounded + 4.0 * UNIT * diagonal.abs();
        // Comparisons with what is no number are false.
        let has_pivot = diagonal > 4.0 * taken_off;
        has_pivot.then_some(())?;
        let pivot = (diagonal - taken_off).sqrt();
        let mut values = Vec::with_capacity(rows.len() - 1);
        for &row in &rows[1..] {
            let i = row as usize;
            let l = self.left[i].value() / pivot;
            self.left[i].subtract_product(l, pivot);
            let rest = self.left[i].value().abs() * (1.0 + 1e-9) + self.off(i, j, given);
            self.rests[i] += rest;
            self.rests[j] += rest;
            self.squares[i] += l * l;
            self.counts[i] += 1;
            values.push(l);
        }
        self.left[j].subtract_product(pivot, pivot);
        let rest = self.left[j].value() * (1.0 - 1e-9) - self.off(j, j, given);
        // Sums of positive floats are off by less than this part.
        let dominates = rest >= self.rests[j] * (1.0 + 1e-6);
        dominates.then_some(())?;
        self.columns.push((rows[1..].to_vec(), values));
        self.wait(j);
        Some(())
    }
}

/// Whether the matrix with these entries of its lower triangle is shown to be positive semi-definite. The factor is
/// computed in the order of the unknowns, as long as it may go on.
pub(super) fn has_factor(entries: &Entries, n: usize, goes_on: GoesOn) -> bool {
    let Some(given) = scaled(entries, n) else {
        return false;
    };
    let mut factor = Factor::new(n);
    given.iter().enumerate().all(|(j, given)| {
        let rows = factor.gather(j, given);
        goes_on() && factor.close(j, &rows, given).is_some()
    })
}

/// The columns of the matrix, scaled by powers of two, which bring the diagonal near one and change nothing else. Nothing
/// for a diagonal that is not positive, and for numbers of sizes for which the errors here are not bounded.
fn scaled(entries: &Entries, n: usize) -> Option<Vec<Given>> {
    let mut scale = vec![0.0; n];
    for (k, scale) in scale.iter_mut().enumerate() {
        let entry = entries.get(&(k, k))?.near();
        if !(entry > 1e-100 && entry < 1e100) {
            return None;
        }
        *scale = 2f64.powi(-(entry.log2() / 2.0).round() as i32);
    }
    let mut columns: Vec<Given> = vec![Vec::new(); n];
    for (&(i, j), v) in entries {
        let v = Twofold::of(v).scaled(scale[i]).scaled(scale[j]);
        if v.high != 0.0 && v.high.abs() < TINY {
            return None;
        }
        columns[j].push((i, v));
    }
    Some(columns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_random::Random;

    /// The lower triangle of a matrix, row by row.
    fn entries(rows: &[Vec<f64>]) -> Entries {
        let mut entries = Entries::new();
        for (i, row) in rows.iter().enumerate() {
            for (j, &v) in row[..=i].iter().enumerate() {
                if v != 0.0 || i == j {
                    entries.insert((i, j), Exact::of(v).unwrap());
                }
            }
        }
        entries
    }

    fn shows(rows: &[Vec<f64>]) -> bool {
        has_factor(&entries(rows), rows.len(), &|| true)
    }

    /// The Laplacian of a path whose ends are held by so much, with numbers of all sizes on both sides.
    fn path(n: usize, held: f64, random: &mut Random) -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; n]; n];
        for i in 0..n {
            let size = |k: usize| 2f64.powi((5 * k % 23) as i32 - 11);
            let weight = 1.0 + random.unit();
            for (a, b, v) in [(i, i, weight), (i, i.saturating_sub(1), -weight)] {
                rows[a][b] += v * size(a) * size(b);
            }
            if i == 0 {
                rows[0][0] = held;
            } else {
                rows[i - 1][i - 1] += weight * size(i - 1) * size(i - 1);
            }
        }
        rows
    }

    #[test]
    fn what_is_hardly_definite_is_shown_and_what_is_not_never_is() {
        // 1 + excess on the diagonal and ones beside it: the least eigenvalue is the excess.
        for (n, excess, expected) in [
            (30, 1e-12, true),
            (30, 0.0, false),
            (30, -1e-15, false),
            (3, 1e-14, true),
        ] {
            let row = |i: usize| (0..n).map(move |j| if i == j { 1.0 + excess } else { 1.0 });
            let rows: Vec<Vec<f64>> = (0..n).map(|i| row(i).collect()).collect();
            assert_eq!(shows(&rows), expected, "{n} {excess}");
        }
        let random = &mut Random::new(3);
        for n in [2, 10, 200] {
            assert!(shows(&path(n, 1e-6, random)));
            assert!(!shows(&path(n, -1e-12, random)));
        }
    }

    #[test]
    fn a_singular_matrix_minus_anything_is_never_shown() {
        // Squares of few terms in many unknowns leave directions without curvature, from which a little is taken.
        let random = &mut Random::new(4);
        for _ in 0..300 {
            let n = 2 + random.below(9);
            let mut sums = vec![vec![Exact::zero(); n]; n];
            for _ in 0..n - 1 {
                let terms: Vec<Exact> = (0..n)
                    .map(|_| Exact::of((9.0 * random.next()).round()).unwrap())
                    .collect();
                for i in 0..n {
                    for j in 0..=i {
                        sums[i][j] = &sums[i][j] + &(&terms[i] * &terms[j]);
                    }
                }
            }
            let mut entries = Entries::new();
            for (i, row) in sums.into_iter().enumerate() {
                for (j, v) in row.into_iter().enumerate().take(i + 1) {
                    entries.insert((i, j), v);
                }
            }
            for k in 0..n {
                let entry = entries.get_mut(&(k, k)).unwrap();
                *entry = &*entry - &Exact::of(2f64.powi(-40)).unwrap();
            }
            assert!(!has_factor(&entries, n, &|| true));
        }
    }

    #[test]
    fn numbers_that_overflow_show_nothing() {
        for far in [1e90, 1e150, 1e200, 1e308] {
            for n in [2, 3] {
                let row = |i: usize| (0..n).map(move |j| if i == j { 1.0 } else { far });
                let rows: Vec<Vec<f64>> = (0..n).map(|i| row(i).collect()).collect();
                assert!(!shows(&rows), "{far} {n}");
            }
        }
    }

    #[test]
    fn it_ends_when_it_is_told_to() {
        let rows = path(5, 1.0, &mut Random::new(3));
        assert!(!has_factor(&entries(&rows), 5, &|| false));
    }
}
