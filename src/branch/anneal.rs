//! Simulated annealing over chains of moves, for problems all of whose unknowns are integers.
//!
//! A chain begins with a move of a random integer by one. As long as some row is violated, another integer of that
//! row moves by one against it. A chain that ends within all rows is taken if it lowers the energy, and otherwise
//! with a probability that falls with its rise and with the temperature (`kirkpatrick1983`).

use super::dual_active_set::FEASIBLE;
use super::form::{Form, Interval};
use crate::linalg::{Random, Sparse};
use crate::monitor::may_continue;

/// The largest number of moves of a chain.
const LONGEST: usize = 4;

/// The chains that show how much the energy changes.
const SAMPLED: usize = 2000;

/// The first temperature and the last one, as parts of the mean change.
const HOT: f64 = 0.3;
const COLD: f64 = 0.003;

/// The chains after which the temperature changes.
const ROUND: usize = 1000;

/// The largest number of unknowns for which Q is written out.
pub(super) const MOST: usize = 2000;

/// The best point of a run of so many chains from `x`, whose unknowns are all integers within all limits.
pub(super) fn annealed(
    form: &Form,
    limits: &[Interval],
    x: &[f64],
    chains: usize,
    seed: u64,
    work: &mut u64,
) -> Vec<f64> {
    if chains == 0 {
        return x.to_vec();
    }
    let mut state = State::new(form, limits, x, seed);
    let mut best = (0.0, x.to_vec());
    let mut energy = 0.0;
    let changes: Vec<f64> = (0..SAMPLED)
        .filter_map(|_| {
            let rise = state.propose();
            state.refuse();
            rise.map(f64::abs)
        })
        .collect();
    if changes.is_empty() {
        return best.1;
    }
    let mean = changes.iter().sum::<f64>() / changes.len() as f64;
    for done in 0..chains {
        if done % ROUND == 0 {
            let part = done as f64 / chains as f64;
            state.temperature = mean * HOT * (COLD / HOT).powf(part);
            if may_continue().is_err() {
                break;
            }
        }
        match state.propose() {
            Some(rise) if state.is_taken(rise) => {
                state.accept();
                energy += rise;
                if energy < best.0 - 1e-12 * mean {
                    best = (energy, state.x.clone());
                }
            }
            _ => state.refuse(),
        }
    }
    *work += state.work;
    best.1
}

struct State<'a> {
    form: &'a Form,
    limits: &'a [Interval],
    /// Q, row by row.
    hessian: Vec<f64>,
    columns: Sparse,
    x: Vec<f64>,
    slopes: Vec<f64>,
    sums: Vec<f64>,
    /// The chain that is looked at.
    chain: Vec<(usize, f64)>,
    temperature: f64,
    random: Random,
    work: u64,
}

impl<'a> State<'a> {
    fn new(form: &'a Form, limits: &'a [Interval], x: &[f64], seed: u64) -> Self {
        let n = form.dim();
        let mut hessian = vec![0.0; n * n];
        for (i, j, v) in form.hessian.entries() {
            let (i, j) = (i as usize, j as usize);
            hessian[i * n + j] = v;
            hessian[j * n + i] = v;
        }
        let slopes = form.hessian.mul_symmetric(x);
        let slopes = slopes.iter().zip(&form.gradient).map(|(c, q)| c + q);
        State {
            slopes: slopes.collect(),
            hessian,
            columns: form.rows.transpose(),
            sums: form.rows.mul(x),
            x: x.to_vec(),
            form,
            limits,
            chain: Vec::new(),
            temperature: 0.0,
            random: Random::new(seed),
            work: (n * n) as u64,
        }
    }

    fn below(&mut self, count: usize) -> usize {
        (self.random.next() % count as u64) as usize
    }

    fn may_move(&self, j: usize, sign: f64) -> bool {
        let new = self.x[j] + sign;
        new >= self.limits[j].lower && new <= self.limits[j].upper
    }

    fn add(&mut self, j: usize, sign: f64) {
        self.chain.push((j, sign));
        for (i, a) in self.columns.row(j) {
            self.sums[i] += sign * a;
        }
    }

    /// A row of the chain that is violated, and the sign of the change that it needs.
    fn violated(&self) -> Option<(usize, f64)> {
        self.chain.iter().find_map(|&(j, _)| {
            self.columns.row(j).find_map(|(i, _)| {
                let (sum, sides) = (self.sums[i], self.form.row_limits[i]);
                let room = FEASIBLE * sum.abs().max(1.0);
                if sum > sides.upper + room {
                    Some((i, -1.0))
                } else if sum < sides.lower - room {
                    Some((i, 1.0))
                } else {
                    None
                }
            })
        })
    }

    /// Makes a random chain. Returns how much the energy rises by it, if it ends within all rows.
    fn propose(&mut self) -> Option<f64> {
        let n = self.form.dim();
        let j = self.below(n);
        let sign = if self.below(2) == 0 { 1.0 } else { -1.0 };
        let sign = if self.may_move(j, sign) { sign } else { -sign };
        if !self.may_move(j, sign) {
            return None;
        }
        self.add(j, sign);
        while let Some((row, wanted)) = self.violated() {
            if self.chain.len() == LONGEST {
                return None;
            }
            let (j, sign) = self.partner(row, wanted)?;
            self.add(j, sign);
        }
        self.work += (self.chain.len() * self.chain.len()) as u64;
        let mut rise = 0.0;
        for (k, &(j, sign)) in self.chain.iter().enumerate() {
            let row = &self.hessian[j * n..(j + 1) * n];
            let before = self.chain[..k].iter();
            let coupled: f64 = before.map(|&(i, other)| other * row[i]).sum();
            rise += sign * (self.slopes[j] + coupled) + 0.5 * row[j];
        }
        Some(rise)
    }

    /// The first integer of a row, from a random place on, that is not in the chain and moves the row as wanted.
    fn partner(&mut self, row: usize, wanted: f64) -> Option<(usize, f64)> {
        let entries = self.form.rows.offsets()[row]..self.form.rows.offsets()[row + 1];
        let start = self.below(entries.len());
        let places = (start..entries.len()).chain(0..start);
        for place in places {
            self.work += 1;
            let at = entries.start + place;
            let j = self.form.rows.indices()[at] as usize;
            let sign = wanted * self.form.rows.values()[at].signum();
            if self.may_move(j, sign) && self.chain.iter().all(|&(k, _)| k != j) {
                return Some((j, sign));
            }
        }
        None
    }

    fn is_taken(&mut self, rise: f64) -> bool {
        let uniform = 0.5 + 0.5 * self.random.symmetric();
        rise <= 0.0 || uniform < (-rise / self.temperature).exp()
    }

    fn accept(&mut self) {
        let n = self.form.dim();
        for (j, sign) in std::mem::take(&mut self.chain) {
            self.x[j] += sign;
            let row = &self.hessian[j * n..(j + 1) * n];
            for (slope, v) in self.slopes.iter_mut().zip(row) {
                *slope += sign * v;
            }
            self.work += n as u64;
        }
    }

    fn refuse(&mut self) {
        for (j, sign) in std::mem::take(&mut self.chain) {
            for (i, a) in self.columns.row(j) {
                self.sums[i] -= sign * a;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Conflicting;

    /// Five groups of which one binary each is 1, and a row that holds the sum of the first ones and the last ones
    /// together, with a random objective.
    fn groups(random: &mut Random) -> Form {
        let n = 15;
        let mut entries: Vec<(u32, u32, f64)> = (0..n as u32).map(|j| (j / 3, j, 1.0)).collect();
        entries.extend((0..5).flat_map(|g| [(5, 3 * g, 1.0), (5, 3 * g + 2, -1.0)]));
        let limits = vec![
            Interval {
                lower: 0.0,
                upper: 1.0,
            };
            n
        ];
        let pairs = (0..n as u32).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let hessian: Vec<_> = pairs.map(|(i, j)| (i, j, random.symmetric())).collect();
        let sides = [1.0, 1.0, 1.0, 1.0, 1.0, 0.0].map(Interval::point);
        Form {
            hessian: Sparse::from_triplets(n, n, hessian.into_iter()).unwrap(),
            gradient: (0..n).map(|_| random.symmetric()).collect(),
            constant: 0.0,
            rows: Sparse::from_triplets(6, n, entries.into_iter()).unwrap(),
            row_limits: sides.to_vec(),
            origins: (0..6).map(Conflicting::Constraint).collect(),
            boxes: limits.clone(),
            limits,
            integer: vec![true; n],
        }
    }

    #[test]
    fn annealing_finds_the_least_energy_of_small_problems() {
        let mut random = Random::new(5);
        for seed in 0..20 {
            let form = groups(&mut random);
            let point = |code: usize| -> Vec<f64> {
                let chosen = |j: usize| code / 3usize.pow(j as u32 / 3) % 3 == j % 3;
                (0..15).map(|j| f64::from(u8::from(chosen(j)))).collect()
            };
            let points = (0..3usize.pow(5)).map(point);
            let points = points.filter(|x| form.rows.mul(x)[5] == 0.0);
            let least = points
                .map(|x| form.energy(&x))
                .fold(f64::INFINITY, f64::min);
            // The middle of each group.
            let start = point(1 + 3 + 9 + 27 + 81);
            let mut work = 0;
            let found = annealed(&form, &form.limits, &start, 20_000, seed, &mut work);
            assert_eq!(form.rows.mul(&found)[5], 0.0);
            let energy = form.energy(&found);
            assert!((energy - least).abs() < 1e-9, "{energy} {least}");
        }
    }

    #[test]
    fn no_chains_take_no_work() {
        let form = groups(&mut Random::new(5));
        let start = vec![0.0; 15];
        let mut work = 0;
        assert_eq!(
            annealed(&form, &form.limits, &start, 0, 1, &mut work),
            start
        );
        assert_eq!(work, 0);
    }
}
