//! The least value of a quadratic form over all integers, by enumeration, with all rounding errors counted.
//!
//! The form is `|R (y - t)|^2` with R triangular. From the last coordinate to the first, each one takes all integers for
//! which the rows so far stay below the limit (`schnorr1994`, without their order). Every row's value is made smaller by
//! its largest rounding error before it counts, so that no integers are left out that are within the limit.

use super::exact::Exact;

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// How often it is asked whether to go on, in nodes.
const OFTEN: u64 = 1 << 14;

/// `|R (y - t)|^2` in integers y.
#[derive(Debug, Clone)]
pub(super) struct Form {
    /// The rows of R, each from its diagonal on.
    rows: Vec<Vec<f64>>,
    /// What is left of t beside its nearest integers.
    rest: Vec<f64>,
}

/// What an enumeration is allowed, and assumes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    /// Integers with a value below this are looked for.
    pub limit: f64,
    /// No coordinate is further from t than this. Larger ones end the enumeration.
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

impl Form {
    /// The form of these rows around t. Nothing for rows of other lengths, for numbers that are not finite, and for
    /// diagonals that are not positive.
    pub fn new(rows: &[Vec<f64>], t: &[Exact]) -> Option<Self> {
        let m = t.len();
        let is_row = |(k, row): (usize, &Vec<f64>)| {
            let is_long = row.len() == m - k;
            is_long && row[0] > 0.0 && row.iter().all(|v| v.abs() < 1e100)
        };
        let is_form = rows.len() == m && rows.iter().enumerate().all(is_row);
        let half = Exact::of(0.5)?;
        let rest = |t: &Exact| (t - &(t + &half).floor()).near();
        is_form.then(|| Form {
            rows: rows.to_vec(),
            rest: t.iter().map(rest).collect(),
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

    /// The largest rounding error of each row where all coordinates are within the reach.
    fn errors(&self, reach: f64) -> Vec<f64> {
        let operations = self.rows.len() as f64 + 8.0;
        let of_row = |row: &Vec<f64>| {
            let size: f64 = row.iter().map(|v| v.abs()).sum();
            2.0 * operations * UNIT * size * (reach + 1.0)
        };
        self.rows.iter().map(of_row).collect()
    }

    /// Enumerates all integers below the limit, which each one found lowers. Returns the number of nodes as well.
    pub fn enumerate(&self, allowed: Allowed, goes_on: &dyn Fn() -> bool) -> (Ended, u64) {
        let m = self.rows.len();
        let errors = self.errors(allowed.reach);
        let mut limit = allowed.limit;
        let mut nodes = 0;
        if m == 0 {
            return (Ended::Least(limit), nodes);
        }
        // By level: the coordinate, its distance from t, the sum of the squares above it, and whether it still grows.
        let mut z = vec![0.0; m];
        let mut distance = vec![0.0; m];
        let mut above = vec![0.0; m + 1];
        let mut grows = vec![true; m];
        let mut first = vec![0.0; m];
        let mut sums = Sums::new(m);
        let mut i = m - 1;
        let mut is_entered = true;
        loop {
            let row = &self.rows[i];
            if is_entered {
                sums.update(i, row, &distance);
                let centre = self.rest[i] - sums.of(i) / row[0];
                first[i] = centre.round();
                (z[i], grows[i], is_entered) = (first[i], true, false);
            }
            nodes += 1;
            if nodes > allowed.nodes || (nodes % OFTEN == 0 && !goes_on()) {
                return (Ended::Stopped, nodes);
            }
            let from_t = z[i] - self.rest[i];
            if from_t.abs() > allowed.reach {
                return (Ended::Beyond, nodes);
            }
            let value = row[0] * from_t + sums.of(i);
            let least = (value.abs() - errors[i]).max(0.0);
            let sum = above[i + 1] + least * least;
            if sum < limit {
                if i > 0 {
                    (distance[i], above[i]) = (from_t, sum);
                    sums.enter(i);
                    i -= 1;
                    is_entered = true;
                    continue;
                }
                limit = sum;
            } else if grows[i] && value > 0.0 {
                // All larger ones have a larger value.
                (z[i], grows[i]) = (first[i], false);
            } else if !grows[i] && value < 0.0 {
                i += 1;
                if i == m {
                    return (Ended::Least(limit), nodes);
                }
            }
            z[i] += if grows[i] { 1.0 } else { -1.0 };
        }
    }
}

/// For each row, the sums of its entries times the distances of the last coordinates, each up to some coordinate.
struct Sums {
    /// By row: entry j is the sum from coordinate j on.
    from: Vec<Vec<f64>>,
    /// By row: the coordinates from this one on are as they were when its sums were made.
    same_from: Vec<usize>,
    /// By row: what the row below has not been told of yet.
    untold: Vec<usize>,
}

impl Sums {
    fn new(m: usize) -> Self {
        Sums {
            from: (0..m).map(|_| vec![0.0; m + 1]).collect(),
            same_from: vec![m; m],
            untold: vec![m; m],
        }
    }

    /// Makes the sums of row i anew.
    fn update(&mut self, i: usize, row: &[f64], distance: &[f64]) {
        let same = self.same_from[i];
        let sums = &mut self.from[i];
        for j in (i + 1..same).rev() {
            sums[j] = sums[j + 1] + row[j - i] * distance[j];
        }
        self.untold[i] = self.untold[i].max(same);
        self.same_from[i] = i + 1;
    }

    /// The sum of row i from the coordinate after its own on.
    fn of(&self, i: usize) -> f64 {
        self.from[i][i + 1]
    }

    /// Coordinate i has another distance, and the row before it is next.
    fn enter(&mut self, i: usize) {
        let told = self.untold[i].max(i + 1);
        self.same_from[i - 1] = self.same_from[i - 1].max(told);
        self.untold[i] = 0;
    }
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
            let form = Form::new(&rows, &t).unwrap();
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
    fn small_forms_are_enumerated_to_the_last_digit() {
        // y = (0, 0) and (1, 0) are nearly as near.
        let rows = vec![vec![2.0, 0.5], vec![3.0]];
        let t = exact(&[0.5 - 1e-15, 0.1]);
        let form = Form::new(&rows, &t).unwrap();
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
            assert!(Form::new(&rows, &t).is_none());
        }
    }
}
