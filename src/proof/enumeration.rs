//! The least value of a quadratic form over all integers, by enumeration, with all rounding errors counted.
//!
//! The form is `|R (y - t)|^2` with R triangular. From the last coordinate to the first, each one takes all integers for
//! which the rows so far stay below the limit (`schnorr1994`, without their order). Where the first k coordinates are
//! undecided and c is their minimiser, their rows have at least the value `sum_j D_j |c_j - round(c_j)|^2`, for a
//! diagonal D below the leading block of `R'R` (`buchheim2015`, section 3).
//!
//! Minimisers are computed in floats. What their rows miss zero by is bounded before the enumeration, and each value is
//! made smaller by that before it counts, so that no integers are left out that are within the limit.

use super::exact::Exact;

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// How often it is asked whether to go on, in nodes.
const OFTEN: u64 = 1 << 14;

/// Rows are padded to whole vectors of this length.
const LANES: usize = 8;

/// Adding and subtracting it rounds to the nearest integer, up to this size.
const ROUND: f64 = 6_755_399_441_055_744.0;
const ROUNDED: f64 = 1e15;

/// `|R (y - t)|^2` in integers y.
#[derive(Debug, Clone)]
pub(super) struct Form {
    /// The rows of R, each from its diagonal on.
    rows: Vec<Vec<f64>>,
    /// What is left of t beside its nearest integers.
    rest: Vec<f64>,
    /// By coordinate: how the minimiser of those before it moves against it, padded.
    directions: Vec<Vec<f64>>,
    /// By the number of undecided coordinates: the diagonal below their block, padded.
    diagonals: Vec<Vec<f64>>,
}

/// What an enumeration is allowed, and assumes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    /// Integers with a value below this are looked for.
    pub limit: f64,
    /// No coordinate is further from its minimiser than this. One that is ends the enumeration.
    pub reach: f64,
    pub nodes: u64,
}

/// How an enumeration has ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ended {
    /// No integers have a value below this, which is the limit or less.
    Least(f64),
    /// A coordinate is beyond the reach.
    Beyond,
    /// It has spent its nodes, or was not to go on.
    Stopped,
}

/// Bounds of rounding errors for coordinates within a reach.
struct Errors {
    /// By coordinate: that of its row where it is decided.
    own: Vec<f64>,
    /// By coordinate: what the rows before it miss zero by at their minimiser, once it is decided.
    before: Vec<f64>,
    /// Whether all coordinates of minimisers can be rounded.
    is_small: bool,
}

impl Form {
    /// The form of these rows around t. `diagonals` are those of one undecided coordinate, of two, and so on; there may be
    /// none, and whether they are below their blocks is not checked here. Nothing for rows of other lengths, for numbers
    /// that are not finite, and for diagonal entries that are not positive.
    pub fn new(rows: &[Vec<f64>], t: &[Exact], diagonals: &[Vec<f64>]) -> Option<Self> {
        let m = t.len();
        let is_row = |(k, row): (usize, &Vec<f64>)| {
            let is_long = row.len() == m - k;
            is_long && row[0] > 0.0 && row.iter().all(|v| v.abs() < 1e100)
        };
        let is_diagonal = |(k, diagonal): (usize, &Vec<f64>)| {
            diagonal.len() == k + 1 && diagonal.iter().all(|d| (0.0..1e100).contains(d))
        };
        let is_form = rows.len() == m
            && rows.iter().enumerate().all(is_row)
            && (diagonals.is_empty() || diagonals.len() + 1 == m)
            && diagonals.iter().enumerate().all(is_diagonal);
        if !is_form {
            return None;
        }
        let half = Exact::of(0.5)?;
        let rest = |t: &Exact| (t - &(t + &half).floor()).near();
        let mut padded = vec![Vec::new(); m.max(1)];
        for (to, diagonal) in padded[1..].iter_mut().zip(diagonals) {
            *to = pad(diagonal.clone());
        }
        Some(Form {
            rows: rows.to_vec(),
            rest: t.iter().map(rest).collect(),
            directions: (0..m).map(|k| pad(direction(rows, k))).collect(),
            diagonals: padded,
        })
    }

    /// The limit below which a computed value is, if the value itself is below `square`.
    pub fn limit_of(&self, square: f64) -> f64 {
        square * (1.0 + self.relative())
    }

    /// A number of which the [limit](Self::limit_of) is at most this.
    pub fn square_of(&self, limit: f64) -> f64 {
        limit * (1.0 - 2.0 * self.relative())
    }

    /// The relative rounding error of the sum of the rows' squares.
    fn relative(&self) -> f64 {
        8.0 * (self.rows.len() as f64 + 32.0) * UNIT
    }

    /// The rounding errors where no coordinate is further from its minimiser than the reach.
    ///
    /// Row i misses zero by `e_i` at the minimiser. A coordinate k that is decided at a distance adds
    /// `R_ik - sum_j R_ij d_j` times that, for the direction d, and the roundings of the new minimiser. All numbers here
    /// are made larger by half, which is far more than their own rounding errors.
    fn errors(&self, reach: f64) -> Errors {
        let m = self.rows.len();
        let entry = |i: usize, j: usize| self.rows[i][j - i].abs();
        let mut size = vec![1.0; m];
        for k in (0..m).rev() {
            for (size, d) in size.iter_mut().zip(&self.directions[k][..k]) {
                *size += d.abs() * reach;
            }
        }
        let missed_at_first = |i: usize| (i..m).map(|j| entry(i, j)).sum::<f64>() * 2.0 * UNIT;
        let mut missed: Vec<f64> = (0..m).map(missed_at_first).collect();
        let mut errors = Errors {
            own: vec![0.0; m],
            before: vec![0.0; m],
            is_small: size.iter().all(|&size| size < ROUNDED),
        };
        for k in (0..m).rev() {
            errors.own[k] = 1.5 * (missed[k] + 4.0 * UNIT * entry(k, k) * reach);
            let direction = &self.directions[k][..k];
            let mut squares = 0.0;
            for i in 0..k {
                let row = &self.rows[i];
                let along: f64 = (i..k).map(|j| row[j - i] * direction[j]).sum();
                let terms: f64 = (i..k).map(|j| entry(i, j) * direction[j].abs()).sum();
                let left = (row[k - i] - along).abs();
                let summed = (terms + entry(i, k)) * (m as f64 + 4.0) * UNIT;
                let rounded: f64 = (i..k).map(|j| entry(i, j) * size[j]).sum();
                missed[i] += 1.5 * ((left + summed) * reach + 4.0 * UNIT * rounded);
                squares += missed[i] * missed[i];
            }
            errors.before[k] = 1.5 * squares.sqrt();
        }
        errors
    }

    /// Enumerates all integers below the limit, which each one found lowers. Returns the number of nodes as well.
    pub fn enumerate(&self, allowed: Allowed, goes_on: &dyn Fn() -> bool) -> (Ended, u64) {
        let m = self.rows.len();
        let mut limit = allowed.limit;
        let mut nodes = 0;
        if m == 0 {
            return (Ended::Least(limit), nodes);
        }
        let errors = self.errors(allowed.reach);
        if !errors.is_small {
            return (Ended::Beyond, nodes);
        }
        // By coordinate: its integer, the first one, whether it still grows, the sum of the squares from it on, and the
        // minimiser of it and those before it where those after it are decided.
        let mut y = vec![0.0; m];
        let mut first = vec![0.0; m];
        let mut grows = vec![true; m];
        let mut sums = vec![0.0; m + 1];
        let mut minimisers = vec![vec![0.0; m.div_ceil(LANES) * LANES]; m];
        minimisers[m - 1][..m].copy_from_slice(&self.rest);
        let mut i = m - 1;
        let mut is_entered = true;
        loop {
            if is_entered {
                first[i] = rounded(minimisers[i][i]);
                (y[i], grows[i], is_entered) = (first[i], true, false);
            }
            nodes += 1;
            if nodes > allowed.nodes || (nodes % OFTEN == 0 && !goes_on()) {
                return (Ended::Stopped, nodes);
            }
            let off = y[i] - minimisers[i][i];
            if off.abs() > allowed.reach {
                return (Ended::Beyond, nodes);
            }
            let value = self.rows[i][0] * off;
            let least = (value.abs() - errors.own[i]).max(0.0);
            let sum = sums[i + 1] + least * least;
            if sum < limit {
                if i == 0 {
                    limit = sum;
                } else if sum + self.decide(i, off, &mut minimisers, &errors) < limit {
                    sums[i] = sum;
                    i -= 1;
                    is_entered = true;
                    continue;
                }
            } else if grows[i] && value > 0.0 {
                // All larger ones have a larger value.
                (y[i], grows[i]) = (first[i], false);
            } else if !grows[i] && value < 0.0 {
                i += 1;
                if i == m {
                    return (Ended::Least(limit), nodes);
                }
            }
            y[i] += if grows[i] { 1.0 } else { -1.0 };
        }
    }

    /// The minimiser of the coordinates before i, which is decided at this distance from its own, and a number that is not
    /// above the value of their rows.
    fn decide(&self, i: usize, off: f64, minimisers: &mut [Vec<f64>], errors: &Errors) -> f64 {
        let (before, here) = minimisers.split_at_mut(i);
        let width = i.div_ceil(LANES) * LANES;
        let (to, here) = (&mut before[i - 1][..width], &here[0][..width]);
        let direction = &self.directions[i][..width];
        let diagonal = &self.diagonals[i];
        if diagonal.is_empty() {
            for ((to, at), d) in to.iter_mut().zip(here).zip(direction) {
                *to = at - d * off;
            }
            return 0.0;
        }
        let mut sums = [0.0; LANES];
        let rows = to.chunks_exact_mut(LANES).zip(here.chunks_exact(LANES));
        let given = direction
            .chunks_exact(LANES)
            .zip(diagonal.chunks_exact(LANES));
        for ((to, at), (direction, diagonal)) in rows.zip(given) {
            for l in 0..LANES {
                to[l] = at[l] - direction[l] * off;
                // The difference has no rounding error.
                let distance = to[l] - rounded(to[l]);
                sums[l] += diagonal[l] * (distance * distance);
            }
        }
        let sum: f64 = sums.iter().sum();
        // (a - e)^2 >= a^2 (1 - e) - e.
        let missed = errors.before[i];
        (sum * (1.0 - missed - self.relative()) - missed).max(0.0)
    }
}

#[inline(always)]
fn rounded(x: f64) -> f64 {
    (x + ROUND) - ROUND
}

/// How the minimiser of the coordinates before k moves against it: `R_k^-1` times column k.
fn direction(rows: &[Vec<f64>], k: usize) -> Vec<f64> {
    let mut direction = vec![0.0; k];
    for i in (0..k).rev() {
        let sum: f64 = (i + 1..k).map(|j| rows[i][j - i] * direction[j]).sum();
        direction[i] = (rows[i][k - i] - sum) / rows[i][0];
    }
    direction
}

fn pad(mut row: Vec<f64>) -> Vec<f64> {
    row.resize(row.len().div_ceil(LANES) * LANES, 0.0);
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_random::Random;

    /// A form of this dimension, and its numbers.
    fn form(random: &mut Random, m: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
        let row = |random: &mut Random, k: usize| {
            let entry = |random: &mut Random, j: usize| match j {
                0 => 0.6 + random.unit(),
                _ => random.next(),
            };
            (0..m - k).map(|j| entry(random, j)).collect()
        };
        let rows = (0..m).map(|k| row(random, k)).collect();
        let t = (0..m).map(|_| 9.0 * random.next()).collect();
        (rows, t)
    }

    fn exact(numbers: &[f64]) -> Vec<Exact> {
        numbers.iter().map(|&t| Exact::of(t).unwrap()).collect()
    }

    /// The value at integers, exactly.
    fn value(rows: &[Vec<f64>], t: &[Exact], y: &[i64]) -> Exact {
        let mut sum = Exact::zero();
        for (k, row) in rows.iter().enumerate() {
            let terms = row.iter().zip(k..).map(|(&a, j)| {
                let distance = &Exact::of(y[j] as f64).unwrap() - &t[j];
                &Exact::of(a).unwrap() * &distance
            });
            let own = terms.fold(Exact::zero(), |sum, term| &sum + &term);
            sum = &sum + &(&own * &own);
        }
        sum
    }

    #[test]
    fn the_least_value_is_that_of_all_integers_near() {
        let random = &mut Random::new(5);
        for _ in 0..200 {
            let m = 1 + random.below(4);
            let (rows, t) = form(random, m);
            let t = exact(&t);
            let form = Form::new(&rows, &t, &[]).unwrap();
            let allowed = Allowed {
                limit: 1e3,
                reach: 1e6,
                nodes: 1 << 30,
            };
            let (ended, nodes) = form.enumerate(allowed, &|| true);
            let Ended::Least(least) = ended else {
                panic!("{ended:?}");
            };
            // The least value over a box around the nearest integers of t; far ones are worse or as good.
            let width = 8i64;
            let mut best: Option<Exact> = None;
            for k in 0..width.pow(m as u32) {
                let step = |j: usize| k / width.pow(j as u32) % width - width / 2;
                let y: Vec<i64> = (0..m)
                    .map(|j| t[j].near().round() as i64 + step(j))
                    .collect();
                let there = value(&rows, &t, &y);
                best = Some(best.map_or(there.clone(), |best| best.min(there)));
            }
            let best = best.unwrap();
            let square = form.square_of(least);
            assert!(form.limit_of(square) <= least);
            assert!(Exact::of(square).unwrap() <= best);
            assert!(nodes >= m as u64);
            let (again, fewer) = form.enumerate(
                Allowed {
                    limit: form.limit_of(square),
                    nodes,
                    ..allowed
                },
                &|| true,
            );
            assert_eq!(again, Ended::Least(form.limit_of(square)));
            assert!(fewer <= nodes);
        }
    }

    #[test]
    fn diagonals_leave_out_no_integers() {
        let random = &mut Random::new(6);
        let mut saved = 0;
        for _ in 0..200 {
            let m = 2 + random.below(5);
            let (mut rows, t) = form(random, m);
            // Nearly orthogonal, so that half of the squares of the diagonal is below.
            for row in &mut rows {
                row[1..].iter_mut().for_each(|v| *v *= 0.05);
            }
            let diagonal = |k: usize| (0..k).map(|i| 0.5 * rows[i][0] * rows[i][0]).collect();
            let diagonals: Vec<Vec<f64>> = (1..m).map(diagonal).collect();
            let t = exact(&t);
            let allowed = Allowed {
                limit: 1e3,
                reach: 1e4,
                nodes: 1 << 30,
            };
            let of = |diagonals: &[Vec<f64>]| {
                let form = Form::new(&rows, &t, diagonals).unwrap();
                let (ended, nodes) = form.enumerate(allowed, &|| true);
                let Ended::Least(least) = ended else {
                    panic!("{ended:?}");
                };
                (least, nodes)
            };
            let (plain, bounded) = (of(&[]), of(&diagonals));
            assert_eq!(plain.0, bounded.0);
            assert!(bounded.1 <= plain.1);
            saved += plain.1 - bounded.1;
        }
        assert!(saved > 300, "{saved}");
    }

    #[test]
    fn small_forms_are_enumerated_to_the_last_digit() {
        // y = (0, 0) and (1, 0) are nearly as near.
        let rows = vec![vec![2.0, 0.5], vec![3.0]];
        let t = exact(&[0.5 - 1e-15, 0.1]);
        let form = Form::new(&rows, &t, &[]).unwrap();
        let allowed = Allowed {
            limit: 100.0,
            reach: 50.0,
            nodes: 1000,
        };
        let (ended, _) = form.enumerate(allowed, &|| true);
        let Ended::Least(least) = ended else {
            panic!("{ended:?}");
        };
        let exactly = value(&rows, &t, &[1, 0]).min(value(&rows, &t, &[0, 0]));
        let square = form.square_of(least);
        assert!(Exact::of(square).unwrap() <= exactly);
        assert!(exactly.near() - square < 1e-11);
        let few = Allowed {
            nodes: 3,
            ..allowed
        };
        assert_eq!(form.enumerate(few, &|| true).0, Ended::Stopped);
        let near = Allowed {
            reach: 0.1,
            ..allowed
        };
        assert_eq!(form.enumerate(near, &|| true).0, Ended::Beyond);
    }

    #[test]
    fn what_is_no_triangular_form_is_none() {
        let t = exact(&[0.5, 0.1]);
        for rows in [
            vec![vec![1.0, 0.0], vec![0.0]],
            vec![vec![1.0], vec![1.0]],
            vec![vec![1.0, f64::NAN], vec![1.0]],
            vec![vec![1.0, 0.0]],
        ] {
            assert!(Form::new(&rows, &t, &[]).is_none());
        }
        let rows = vec![vec![1.0, 0.0], vec![1.0]];
        for diagonals in [vec![vec![0.5, 0.5]], vec![vec![-0.5]], vec![vec![0.5]; 2]] {
            assert!(Form::new(&rows, &t, &diagonals).is_none());
        }
        assert!(Form::new(&rows, &t, &[vec![0.5]]).is_some());
    }
}
