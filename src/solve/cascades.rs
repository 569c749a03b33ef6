//! Integers near a point under rows that hold where they can: descent by single integers and by cascades.
//!
//! ```text
//! minimise    1/2 (z - z*)' G (z - z*) + 1/2 sum_k w_k max(0, l_k - a_k . z)^2,   z integer
//! ```
//!
//! An integer moves by one wherever that makes the sum less. Where rows push each other, as in a row of cones that
//! lie too near each other, no single integer can move. There a missed row starts a cascade: one of its integers moves
//! by one, an integer of the row that this makes worse moves along, and so on. Of all begins of the cascade the best is
//! taken, if it makes the sum less. The weights of rows that are still missed then grow, so that others give way.

use super::soft_rows::SoftRow;
use crate::monitor::Monitor;

/// The most integers that move together.
const LONGEST: usize = 80;

/// How often the weights of missed rows grow, and by what factor.
const GROWTHS: usize = 8;
const GROWTH: f64 = 4.0;

/// Smaller decreases are rounding errors.
const LEAST_DECREASE: f64 = 1e-9;

/// The most multiplications.
const WORK: u64 = 2_000_000_000;

/// Integers at which the sum is small, and the work. The descent starts at `from`; `gram` is `G`, and `wanted` is `z*`.
pub(super) fn descend(
    rows: &[SoftRow],
    gram: &[f64],
    wanted: &[f64],
    from: Vec<f64>,
    monitor: &mut Monitor,
) -> (Vec<f64>, u64) {
    let mut cascades = Cascades::new(rows, gram, wanted, from);
    cascades.descend(monitor);
    let mut least = cascades.sum(wanted);
    let mut best = cascades.z.clone();
    for _ in 0..GROWTHS {
        if !cascades.weigh_missed() || cascades.ends(monitor) {
            break;
        }
        cascades.descend(monitor);
        let sum = cascades.sum(wanted);
        if sum < least {
            (least, best) = (sum, cascades.z.clone());
        }
    }
    (best, cascades.work)
}

/// The integers, and what follows from them.
struct Cascades<'a> {
    rows: &'a [SoftRow],
    /// `G` by columns.
    gram: &'a [f64],
    /// The rows of each integer, and its coefficients there.
    of: Vec<Vec<(usize, f64)>>,
    /// The current weights of the rows.
    weights: Vec<f64>,
    z: Vec<f64>,
    /// `G (z - z*)`.
    slope: Vec<f64>,
    /// `a_k . z`.
    values: Vec<f64>,
    /// The multiplications so far.
    work: u64,
}

/// What a row with this weight costs at a value.
fn cost(row: &SoftRow, weight: f64, value: f64) -> f64 {
    0.5 * weight * (row.least - value).max(0.0).powi(2)
}

/// Integers that move by one together, and by how much that changes the sum.
struct Step {
    moves: Vec<(usize, f64)>,
    change: f64,
}

impl<'a> Cascades<'a> {
    fn new(rows: &'a [SoftRow], gram: &'a [f64], wanted: &[f64], z: Vec<f64>) -> Self {
        let m = z.len();
        let mut of = vec![Vec::new(); m];
        for (k, row) in rows.iter().enumerate() {
            row.terms.iter().for_each(|&(j, c)| of[j].push((k, c)));
        }
        let mut slope = vec![0.0; m];
        for (j, column) in gram.chunks_exact(m).enumerate() {
            let from = z[j] - wanted[j];
            slope
                .iter_mut()
                .zip(column)
                .for_each(|(s, g)| *s += g * from);
        }
        Cascades {
            values: rows.iter().map(|row| row.value(&z)).collect(),
            weights: rows.iter().map(|row| row.weight).collect(),
            work: (m * m) as u64,
            rows,
            gram,
            of,
            z,
            slope,
        }
    }

    /// The sum with the weights that rows had at first.
    fn sum(&self, wanted: &[f64]) -> f64 {
        let steps = self.z.iter().zip(wanted).zip(&self.slope);
        let distance: f64 = steps.map(|((z, wanted), slope)| (z - wanted) * slope).sum();
        let rows = self.rows.iter().zip(&self.values);
        let missed: f64 = rows.map(|(row, &value)| cost(row, row.weight, value)).sum();
        0.5 * distance + missed
    }

    /// Makes the weights of missed rows larger. Says whether there are any.
    fn weigh_missed(&mut self) -> bool {
        let mut any = false;
        for k in 0..self.rows.len() {
            if self.is_missed(k) {
                self.weights[k] *= GROWTH;
                any = true;
            }
        }
        any
    }

    fn is_missed(&self, k: usize) -> bool {
        self.rows[k].least - self.values[k] > 0.5
    }

    /// The current cost of a row at a value.
    fn cost(&self, k: usize, value: f64) -> f64 {
        cost(&self.rows[k], self.weights[k], value)
    }

    fn column(&self, j: usize) -> &'a [f64] {
        let m = self.z.len();
        &self.gram[j * m..][..m]
    }

    /// Moves single integers and cascades until none makes the sum less.
    fn descend(&mut self, monitor: &mut Monitor) {
        let mut moved = true;
        while std::mem::replace(&mut moved, false) {
            moved |= self.move_singles(monitor);
            for k in 0..self.rows.len() {
                if !self.is_missed(k) {
                    continue;
                }
                if self.ends(monitor) {
                    return;
                }
                if let Some(step) = self.cascade_of(k) {
                    step.moves.iter().for_each(|&(j, by)| self.step(j, by));
                    moved = true;
                }
            }
        }
    }

    fn ends(&self, monitor: &mut Monitor) -> bool {
        self.work > WORK || monitor.ends()
    }

    /// Moves single integers until none makes the sum less. Says whether any moved.
    fn move_singles(&mut self, monitor: &mut Monitor) -> bool {
        let mut any = false;
        let mut moved = true;
        while std::mem::replace(&mut moved, false) && !self.ends(monitor) {
            for j in 0..self.z.len() {
                self.work += 4 * self.of[j].len() as u64;
                for by in [1.0, -1.0] {
                    if self.change(j, by, self.slope[j], &self.values) < -LEAST_DECREASE {
                        self.step(j, by);
                        (moved, any) = (true, true);
                        break;
                    }
                }
            }
        }
        any
    }

    /// By how much the sum changes where an integer moves, with this slope and these values of rows.
    fn change(&self, j: usize, by: f64, slope: f64, values: &[f64]) -> f64 {
        let rows = self.of[j].iter().map(|&(k, c)| {
            let value = values[k];
            self.cost(k, value + by * c) - self.cost(k, value)
        });
        by * slope + 0.5 * self.column(j)[j] + rows.sum::<f64>()
    }

    fn step(&mut self, j: usize, by: f64) {
        self.z[j] += by;
        let column = self.column(j);
        self.slope
            .iter_mut()
            .zip(column)
            .for_each(|(s, g)| *s += by * g);
        self.of[j]
            .iter()
            .for_each(|&(k, c)| self.values[k] += by * c);
        self.work += column.len() as u64;
    }

    /// The best cascade that starts with an integer of a missed row.
    fn cascade_of(&mut self, k: usize) -> Option<Step> {
        let rows = self.rows;
        let mut best: Option<Step> = None;
        for &(j, c) in &rows[k].terms {
            let found = self.cascade(j, c.signum());
            let least = best.as_ref().map_or(-LEAST_DECREASE, |best| best.change);
            if found.change < least {
                best = Some(found);
            }
        }
        best
    }

    /// The best begin of the cascade that starts with this move.
    fn cascade(&mut self, first: usize, by: f64) -> Step {
        let mut values = std::mem::take(&mut self.values);
        let mut touched: Vec<(usize, f64)> = Vec::new();
        let mut step = Step {
            change: 0.0,
            moves: Vec::new(),
        };
        let (mut least, mut count) = (f64::INFINITY, 0);
        let mut next = Some((
            first,
            by,
            self.change(first, by, self.slope[first], &values),
        ));
        while let Some((j, by, change)) = next {
            step.change += change;
            step.moves.push((j, by));
            if step.change < least {
                (least, count) = (step.change, step.moves.len());
            }
            for &(k, c) in &self.of[j] {
                if touched.iter().all(|&(row, _)| row != k) {
                    touched.push((k, values[k]));
                }
                values[k] += by * c;
            }
            self.work += (touched.len() * (1 + self.of[j].len())) as u64;
            if step.moves.len() == LONGEST {
                break;
            }
            next = self.follower(&step.moves, &touched, &values);
        }
        touched.iter().for_each(|&(k, before)| values[k] = before);
        self.values = values;
        step.moves.truncate(count);
        step.change = least;
        step
    }

    /// The cheapest move that is not made yet in the row that the moves make worst.
    fn follower(
        &mut self,
        moves: &[(usize, f64)],
        touched: &[(usize, f64)],
        values: &[f64],
    ) -> Option<(usize, f64, f64)> {
        let worse = |&(k, before): &(usize, f64)| {
            let least = self.rows[k].least;
            let more = (least - values[k]).max(0.0) - (least - before).max(0.0);
            (more > 0.5).then_some((self.weights[k] * more, k))
        };
        let worst = touched.iter().filter_map(worse);
        let (_, k) = worst.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))?;
        let mut best: Option<(usize, f64, f64)> = None;
        for &(j, c) in &self.rows[k].terms {
            if moves.iter().any(|&(i, _)| i == j) {
                continue;
            }
            let column = self.column(j);
            let along: f64 = moves.iter().map(|&(i, by)| by * column[i]).sum();
            let by = c.signum();
            let change = self.change(j, by, self.slope[j] + along, values);
            self.work += (moves.len() + 4 * self.of[j].len()) as u64;
            if best.is_none_or(|best| change < best.2) {
                best = Some((j, by, change));
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Random;

    /// `by . z >= least`, with a weight of 1000.
    fn row(by: &[(usize, f64)], least: f64) -> SoftRow {
        SoftRow {
            terms: by.to_vec(),
            least,
            weight: 1e3,
        }
    }

    fn sum(rows: &[SoftRow], gram: &[f64], wanted: &[f64], z: &[f64]) -> f64 {
        let m = z.len();
        let by: Vec<f64> = z.iter().zip(wanted).map(|(z, w)| z - w).collect();
        let product = |i: usize| (0..m).map(|j| gram[j * m + i] * by[j]).sum::<f64>();
        let distance: f64 = (0..m).map(|i| by[i] * product(i)).sum();
        let missed = rows.iter().map(|row| cost(row, row.weight, row.value(z)));
        0.5 * distance + missed.sum::<f64>()
    }

    fn identity(m: usize) -> Vec<f64> {
        (0..m * m)
            .map(|k| f64::from(u8::from(k % (m + 1) == 0)))
            .collect()
    }

    #[test]
    fn integers_in_a_row_push_each_other_apart() {
        let m = 30;
        let rows: Vec<SoftRow> = (1..m)
            .map(|i| row(&[(i, 1.0), (i - 1, -1.0)], 1.0))
            .collect();
        let gram = identity(m);
        // The first is a second away from its place, and all others have theirs.
        let mut wanted: Vec<f64> = (0..m).map(|i| i as f64).collect();
        wanted[0] = 1.0;
        let (z, work) = descend(
            &rows,
            &gram,
            &wanted,
            wanted.clone(),
            &mut Monitor::default(),
        );
        assert!(rows.iter().all(|row| row.value(&z) >= row.least), "{z:?}");
        assert_eq!(sum(&rows, &gram, &wanted, &z), 0.5);
        assert!(work > 0);
        // All want the same place: the nearest points that keep the rows are around it.
        let together = vec![0.0; m];
        let (z, _) = descend(
            &rows,
            &gram,
            &together,
            together.clone(),
            &mut Monitor::default(),
        );
        assert!(rows.iter().all(|row| row.value(&z) >= row.least), "{z:?}");
        let least: f64 = (0..m).map(|i| (i as f64 - 14.0).powi(2)).sum::<f64>() / 2.0;
        assert!(sum(&rows, &gram, &together, &z) < 1.1 * least, "{z:?}");
    }

    #[test]
    fn the_sum_becomes_no_larger_and_is_mostly_the_least_of_near_integers() {
        let mut random = Random::new(5);
        let mut least_found = 0;
        for _ in 0..200 {
            let m = 4;
            let r: Vec<f64> = (0..m * m)
                .map(|_| (0.5 + 0.5 * random.symmetric()) - 0.5)
                .collect();
            let at = |i: usize, j: usize| (0..m).map(|k| r[i * m + k] * r[j * m + k]).sum::<f64>();
            let gram: Vec<f64> = (0..m * m)
                .map(|k| at(k / m, k % m) + f64::from(u8::from(k % (m + 1) == 0)))
                .collect();
            let wanted: Vec<f64> = (0..m)
                .map(|_| 3.0 * (0.5 + 0.5 * random.symmetric()))
                .collect();
            let rows: Vec<SoftRow> = (1..m)
                .map(|i| {
                    row(
                        &[(i, 1.0), (0, -1.0)],
                        (4.0 * (0.5 + 0.5 * random.symmetric())).floor() - 1.0,
                    )
                })
                .collect();
            let start: Vec<f64> = wanted.iter().map(|x| x.round()).collect();
            let before = sum(&rows, &gram, &wanted, &start);
            let (z, _) = descend(
                &rows,
                &gram,
                &wanted,
                start.clone(),
                &mut Monitor::default(),
            );
            let after = sum(&rows, &gram, &wanted, &z);
            assert!(after <= before + 1e-9, "{before} {after}");
            let near = (0..7i32.pow(m as u32)).map(|n| {
                let digit = |i: usize| f64::from(n / 7i32.pow(i as u32) % 7 - 3);
                let z: Vec<f64> = (0..m).map(|i| start[i] + digit(i)).collect();
                sum(&rows, &gram, &wanted, &z)
            });
            let least = near.fold(f64::INFINITY, f64::min);
            least_found += usize::from(after <= least + 1e-9);
        }
        assert!(least_found >= 150, "{least_found} of 200");
    }

    #[test]
    fn rows_that_contradict_each_other_share_what_is_missed() {
        let rows = [
            row(&[(1, 1.0), (0, -1.0)], 2.0),
            row(&[(0, 1.0), (1, -1.0)], 2.0),
        ];
        let from = vec![0.0, 3.0];
        let wanted = [0.2, 0.1];
        let (z, _) = descend(&rows, &identity(2), &wanted, from, &mut Monitor::default());
        assert_eq!(z, [0.0, 0.0]);
    }
}
