//! A lower bound on the squared distance of all lattice points from split disjunctions.
//!
//! For an integer vector a and an integer k, no integer point z has a'z strictly between k and k + 1, so `(a'z -
//! k) (a'z - k - 1) >= 0`. With multipliers `d >= 0`, the squared distance of z is
//!
//! `(z - c)'G (z - c) = Q(z) + sum_j d_j (a_j'z - k_j) (a_j'z - k_j - 1)`,
//!
//! which defines Q. It is at least the minimum of Q over all real z, if Q is convex. The greatest such minimum
//! is a semi-definite program: the dual of the relaxation of `buchheim2013`, where the a are unit vectors.
//! Other a give the split inequalities of `burer2014`. Those a are added that violate theirs most at the dual
//! matrix, among the sums and differences of a vector in use and a unit vector.
//!
//! With `y = z - c` and `s = k + 1/2 - a'c`, a product is `(a'y - s)^2 - 1/4`. So a bound is `sum_j d_j / 4 - t`
//! if `diag(G, t) - sum_j d_j v_j v_j'` is positive semi-definite for `v_j = (a_j, -s_j)`. This is verified as
//! in [`super::diagonal`] (`rump2006`, theorem 2.3).

use std::collections::HashSet;

use faer::Mat;

use super::diagonal::{inverse, leading_gram};
use super::semidefinite::{Program, Term};
use super::{Basis, Target};

/// The largest number of times that vectors are added.
const ROUNDS: usize = 40;

/// Vectors are added as long as this closes the distance from the bound to the best point by this part.
const WORTH: f64 = 0.04;

/// The accuracy of the objective between two additions, and at the end.
const ACCURACY: (f64, f64) = (0.05, 1e-3);

/// The largest number of steps between two additions.
const STEPS: usize = 40;

/// The largest number of times that the multipliers of new vectors are halved.
const HALVINGS: usize = 60;

/// A vector leaves if its multiplier is below this part of the largest.
const WEAK: f64 = 1e-4;

/// An inequality is added if it is violated by more than this.
const VIOLATED: f64 = 2e-3;

/// The number of enumerations up to the distance of the best point.
const STAGES: f64 = 4.0;

/// An integer vector by its nonzero entries.
type Sparse = Vec<(usize, i32)>;

/// One split: the vector a, the integer k and the multiplier d.
#[derive(Debug, Clone)]
pub struct Split {
    pub vector: Sparse,
    pub floor: f64,
    pub multiplier: f64,
}

/// A set of splits, and the bound that it proves.
#[derive(Debug, Clone)]
pub struct Splits {
    pub splits: Vec<Split>,
    /// `diag(G, t) - sum_j d_j v_j v_j'` by columns, of which the lower triangle is valid.
    pub slack: Mat<f64>,
    /// The diagonal of G, and that of its inverse.
    pub diagonal: Vec<f64>,
    pub inverse: Vec<f64>,
    /// The sum of `d / 4`, minus t.
    pub constant: f64,
    /// The squared distance of every lattice point is at least this.
    pub bound: f64,
}

impl Splits {
    /// Splits for the points near `target`, of which the best known has the squared distance `value`. If
    /// `stop` ends the computation, which gets the multiplications of each step before it, the bound is
    /// lower. None if rounding errors prevent a bound.
    pub fn new(
        basis: &Basis,
        target: &Target,
        value: f64,
        stop: &mut dyn FnMut(u64) -> bool,
    ) -> Option<Self> {
        let n = basis.rank();
        let gram = leading_gram(basis);
        let own = inverse(gram.clone(), n)?;
        let own: Vec<f64> = (0..n).map(|i| own[i * n + i]).collect();
        let mut search = Search::new(n, &gram, &own, &target.rest);
        search.run(value, stop);
        search.certified(own)
    }
}

impl Splits {
    /// The squared radius of enumeration `stage`, counted from 0: each goes further from the bound to
    /// `largest`, until the last reaches it.
    pub fn radius_for(&self, stage: f64, largest: f64) -> f64 {
        let part = ((stage + 1.0) / STAGES).min(1.0);
        if part < 1.0 {
            largest.min(self.bound + part * (largest - self.bound).max(0.0))
        } else {
            largest
        }
    }
}

/// The program with the vectors of its terms. The first term is t.
struct Search<'a> {
    centre: &'a [f64],
    vectors: Vec<Sparse>,
    program: Program,
}

impl<'a> Search<'a> {
    /// Starts with the unit vectors. Each `e_i e_i' / inverse(G)_ii` is below G.
    fn new(n: usize, gram: &[f64], inverse: &[f64], centre: &'a [f64]) -> Self {
        let matrix = Mat::from_fn(n + 1, n + 1, |i, j| match i.max(j) < n {
            true => gram[i * n + j],
            false => 0.0,
        });
        let mut search = Search {
            centre,
            vectors: Vec::new(),
            program: Program {
                matrix,
                terms: Vec::new(),
                dual: Mat::from_fn(n + 1, n + 1, |i, j| if i == j { 0.5 } else { 0.0 }),
            },
        };
        let unit = |i: usize| search.term(&[(i, 1)], 0.25 / (n as f64 * inverse[i]));
        let mut terms: Vec<Term> = (0..n).map(unit).collect();
        let last = |t: &Term| t.multiplier * t.vector[1].1.powi(2);
        let t = 2.0 * terms.iter().map(last).sum::<f64>() + 0.1 * gram[0];
        terms.insert(
            0,
            Term {
                vector: vec![(n, 1.0)],
                gain: -1.0,
                added: true,
                multiplier: t,
                price: 0.0,
            },
        );
        search.program.terms = terms;
        search.vectors = (0..n).map(|i| vec![(i, 1)]).collect();
        search.set_prices(0.0);
        search
    }

    fn term(&self, a: &[(usize, i32)], multiplier: f64) -> Term {
        let entry = |&(i, e): &(usize, i32)| (i, f64::from(e));
        let mut vector: Vec<(usize, f64)> = a.iter().map(entry).collect();
        let at = dot(a, self.centre);
        vector.push((self.centre.len(), at - at.floor() - 0.5));
        Term {
            vector,
            gain: 0.25,
            added: false,
            multiplier,
            price: 0.0,
        }
    }

    /// Prices that fit the dual matrix, or `least` where its inequality is violated.
    fn set_prices(&mut self, least: f64) {
        for term in &mut self.program.terms {
            term.price = term.surplus(&self.program.dual).max(least);
        }
    }

    /// Solves the program and adds vectors, in turns.
    fn run(&mut self, value: f64, stop: &mut dyn FnMut(u64) -> bool) {
        let mut former = f64::INFINITY;
        for _ in 0..ROUNDS {
            if !self.program.improve(ACCURACY.0, STEPS, stop) {
                return;
            }
            let left = value - self.program.objective();
            if left > (1.0 - WORTH) * former {
                break;
            }
            former = left;
            self.remove_weak();
            let new = self.violated();
            if new.is_empty() || !self.add(new) {
                break;
            }
        }
        self.program.improve(ACCURACY.1, STEPS, stop);
    }

    fn remove_weak(&mut self) {
        let splits = &self.program.terms[1..];
        let largest = splits.iter().map(|t| t.multiplier).fold(0.0, f64::max);
        let keep: Vec<bool> = splits
            .iter()
            .map(|t| t.multiplier > WEAK * largest)
            .collect();
        let mut at = keep.iter();
        self.vectors.retain(|_| at.next() == Some(&true));
        let mut at = std::iter::once(&true).chain(&keep);
        self.program.terms.retain(|_| at.next() == Some(&true));
    }

    /// Adds terms for `vectors` and steps back from the boundary, where progress would be slow. Returns false if
    /// rounding errors prevent it.
    fn add(&mut self, vectors: Vec<Sparse>) -> bool {
        let program = &mut self.program;
        program.terms[1..]
            .iter_mut()
            .for_each(|t| t.multiplier *= 0.9);
        for i in 0..self.centre.len() {
            program.dual[(i, i)] += 0.02;
        }
        let first = program.terms.len();
        let typical = program.objective().abs() / first as f64;
        for a in vectors {
            let term = self.term(&a, typical);
            self.program.terms.push(term);
            self.vectors.push(a);
        }
        self.set_prices(0.01);
        for _ in 0..HALVINGS {
            if self.program.is_feasible(0.0) {
                return true;
            }
            let new = &mut self.program.terms[first..];
            new.iter_mut().for_each(|t| t.multiplier *= 0.5);
        }
        self.program.terms.truncate(first);
        self.vectors.truncate(first - 1);
        false
    }

    /// The vectors of the most violated inequalities: as many as there are coordinates.
    fn violated(&self) -> Vec<Sparse> {
        let n = self.centre.len();
        let dual = &self.program.dual;
        let mut known: HashSet<Sparse> = self.vectors.iter().cloned().collect();
        let mut found: Vec<(f64, Sparse)> = Vec::new();
        for a in &self.vectors {
            let at = dot(a, self.centre);
            let image: Vec<f64> = (0..=n)
                .map(|l| a.iter().map(|&(i, e)| f64::from(e) * dual[(l, i)]).sum())
                .collect();
            let own = dot(a, &image);
            // A pair of coordinates arises from the first of them.
            let from = if a.len() == 1 { a[0].0 } else { 0 };
            for (k, e) in (from..n).flat_map(|k| [(k, 1), (k, -1)]) {
                let sign = f64::from(e);
                let at = at + sign * self.centre[k];
                let last = at - at.floor() - 0.5;
                let square = own
                    + 2.0 * sign * image[k]
                    + dual[(k, k)]
                    + 2.0 * last * (image[n] + sign * dual[(n, k)])
                    + last * last * dual[(n, n)];
                if square < 0.25 - VIOLATED {
                    let sum = plus(a, k, e);
                    if !sum.is_empty() && known.insert(sum.clone()) {
                        found.push((square, sum));
                    }
                }
            }
        }
        found.sort_by(|x, y| x.0.total_cmp(&y.0));
        found.truncate(n);
        found.into_iter().map(|f| f.1).collect()
    }

    /// The bound, with multipliers that are proved to be feasible.
    fn certified(mut self, inverse: Vec<f64>) -> Option<Splits> {
        let n = self.centre.len();
        let terms = self.program.terms.len();
        let diagonal: Vec<f64> = (0..n).map(|i| self.program.matrix[(i, i)]).collect();
        let t = self.program.terms[0].multiplier;
        // Rump's bound for a matrix with twice the diagonal, as the sums of the terms are below G, and the
        // rounding of those sums and of the entries of v.
        let largest = diagonal.iter().fold(t, |m, &g| m.max(g));
        let unit = 8.0 * (n + terms + 4) as f64 * f64::EPSILON;
        let margin = unit * (2.0 * largest * (n + 1) as f64 + self.size_of_terms());
        for _ in 0..8 {
            if self.program.is_feasible(margin) {
                let quarters = self.program.objective() + t;
                let constant = quarters - t;
                return Some(Splits {
                    splits: self.splits(),
                    slack: self.program.slack(|j| self.program.terms[j].multiplier),
                    diagonal,
                    inverse,
                    constant,
                    bound: (constant - unit * (quarters + t)).max(0.0),
                });
            }
            let splits = &mut self.program.terms[1..];
            splits.iter_mut().for_each(|t| t.multiplier *= 0.95);
        }
        None
    }

    /// A bound on the sum of the squares of all v, weighted, with the size of the numbers that their last
    /// entries are differences of.
    fn size_of_terms(&self) -> f64 {
        let terms = self.vectors.iter().zip(&self.program.terms[1..]);
        let size = |(a, t): (&Sparse, &Term)| {
            let entries =
                |&(i, e): &(usize, i32)| f64::from(e).abs() * (1.0 + self.centre[i].abs());
            t.multiplier * (1.0 + a.iter().map(entries).sum::<f64>()).powi(2)
        };
        terms.map(size).sum()
    }

    fn splits(&self) -> Vec<Split> {
        let terms = self.vectors.iter().zip(&self.program.terms[1..]);
        let split = |(a, t): (&Sparse, &Term)| Split {
            vector: a.clone(),
            floor: dot(a, self.centre).floor(),
            multiplier: t.multiplier,
        };
        terms.map(split).collect()
    }
}

fn dot(a: &[(usize, i32)], x: &[f64]) -> f64 {
    a.iter().map(|&(i, e)| f64::from(e) * x[i]).sum()
}

/// `a` plus `e` times the unit vector of `k`, with the sign that makes the first entry positive.
fn plus(a: &[(usize, i32)], k: usize, e: i32) -> Sparse {
    let mut sum = a.to_vec();
    match sum.binary_search_by_key(&k, |x| x.0) {
        Ok(at) => sum[at].1 += e,
        Err(at) => sum.insert(at, (k, e)),
    }
    sum.retain(|x| x.1 != 0);
    if sum.first().is_some_and(|x| x.1 < 0) {
        sum.iter_mut().for_each(|x| x.1 = -x.1);
    }
    sum
}
