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

/// A column of the factor below its diagonal: rows, increasing, and values.
type Column = (Vec<u32>, Vec<f64>);

/// The factor by columns, each of which waits at its next row.
struct Factor {
    columns: Vec<Column>,
    next: Vec<usize>,
    /// The first column that waits at each row, and the next one there after each column.
    first_at: Vec<usize>,
    after: Vec<usize>,
}

const NONE: usize = usize::MAX;

impl Factor {
    fn new(n: usize) -> Self {
        Factor {
            columns: Vec::with_capacity(n),
            next: vec![0; n],
            first_at: vec![NONE; n],
            after: vec![NONE; n],
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
}

/// Whether the matrix with these entries of its lower triangle is shown to be positive semi-definite. The factor is
/// computed in the order of the unknowns.
pub(super) fn has_factor(entries: &Entries, n: usize, goes_on: GoesOn) -> bool {
    factored(entries, n, goes_on).is_some()
}

/// Nothing if there is no factor with a rest that is small enough, or it was not to go on.
fn factored(entries: &Entries, n: usize, goes_on: GoesOn) -> Option<()> {
    // Powers of two bring the diagonal near one, and change nothing else.
    let mut scale = vec![0.0; n];
    for (k, scale) in scale.iter_mut().enumerate() {
        let entry = entries.get(&(k, k))?.near();
        if !(entry > 1e-100 && entry < 1e100) {
            return None;
        }
        *scale = 2f64.powi(-(entry.log2() / 2.0).round() as i32);
    }
    let mut given: Vec<Vec<(usize, Twofold)>> = vec![Vec::new(); n];
    for (&(i, j), v) in entries {
        let v = Twofold::of(v).scaled(scale[i]).scaled(scale[j]);
        // An entry that is not a sum of two floats with a small second one has no place here.
        if v.high != 0.0 && v.high.abs() < TINY {
            return None;
        }
        given[j].push((i, v));
    }
    let mut factor = Factor::new(n);
    let mut sums = vec![Twofold::ZERO; n];
    let mut is_met = vec![NONE; n];
    // By row: the sum of the squares so far, how many they are, and the sum of the rest's absolute values.
    let mut squares = vec![0.0; n];
    let mut counts = vec![0u32; n];
    let mut rests = vec![0.0; n];
    for j in 0..n {
        goes_on().then_some(())?;
        let mut rows: Vec<u32> = Vec::new();
        let mut meet = |i: usize, is_met: &mut [usize], sums: &mut [Twofold]| {
            if is_met[i] != j {
                (is_met[i], sums[i]) = (j, Twofold::ZERO);
                rows.push(i as u32);
            }
        };
        meet(j, &mut is_met, &mut sums);
        for &(i, v) in &given[j] {
            meet(i, &mut is_met, &mut sums);
            sums[i] = v;
        }
        let mut size_of_entries = std::mem::take(&mut given[j]);
        let mut k = std::mem::replace(&mut factor.first_at[j], NONE);
        while k != NONE {
            let waiting = factor.after[k];
            let (at, values) = (&factor.columns[k].0, &factor.columns[k].1);
            let from = factor.next[k];
            let own = values[from];
            for (&i, &l) in at[from..].iter().zip(&values[from..]) {
                meet(i as usize, &mut is_met, &mut sums);
                sums[i as usize].subtract_product(own, l);
            }
            factor.next[k] += 1;
            factor.wait(k);
            k = waiting;
        }
        rows.sort_unstable();
        // The part of the entry's size that sums in twice the precision may be off by.
        let count = f64::from(counts[j]) + 4.0;
        let off = 16.0 * count * count * UNIT * UNIT;
        let near = |i: usize, squares: &[f64], entry: f64| {
            off * (entry.abs() + (squares[i] * squares[j]).sqrt() * (1.0 + 1e-9) + 1.0) + TINY
        };
        size_of_entries.sort_unstable_by_key(|&(i, _)| i);
        let entry = |i: usize| {
            let at = size_of_entries.binary_search_by_key(&i, |&(i, _)| i);
            at.map_or(0.0, |at| size_of_entries[at].1.high)
        };
        let below: f64 = rows[1..]
            .iter()
            .map(|&i| sums[i as usize].value().abs())
            .sum();
        let errors: f64 = rows
            .iter()
            .map(|&i| near(i as usize, &squares, entry(i as usize)))
            .sum();
        // Half as much again as the rest of the row so far and what this column will be rounded by.
        let diagonal = sums[j].value();
        let rounded = rests[j] + 2.0 * UNIT * below + 2.0 * errors;
        let taken_off = 1.5 * rounded + 4.0 * UNIT * diagonal.abs();
        if diagonal.is_nan() || diagonal <= 4.0 * taken_off {
            return None;
        }
        let pivot = (diagonal - taken_off).sqrt();
        let mut column = (
            Vec::with_capacity(rows.len() - 1),
            Vec::with_capacity(rows.len() - 1),
        );
        for &row in &rows[1..] {
            let i = row as usize;
            let l = sums[i].value() / pivot;
            let mut rest = sums[i];
            rest.subtract_product(l, pivot);
            let rest = rest.value().abs() * (1.0 + 1e-9) + near(i, &squares, entry(i));
            rests[i] += rest;
            rests[j] += rest;
            squares[i] += l * l;
            counts[i] += 1;
            column.0.push(row);
            column.1.push(l);
        }
        let mut rest = sums[j];
        rest.subtract_product(pivot, pivot);
        let left = rest.value() * (1.0 - 1e-9) - near(j, &squares, entry(j));
        // Sums of positive floats are off by less than this part.
        if left.is_nan() || left < rests[j] * (1.0 + 1e-6) {
            return None;
        }
        squares[j] += pivot * pivot;
        factor.columns.push(column);
        factor.wait(j);
    }
    Some(())
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
    fn it_ends_when_it_is_told_to() {
        let rows = path(5, 1.0, &mut Random::new(3));
        assert!(!has_factor(&entries(&rows), 5, &|| false));
    }
}
