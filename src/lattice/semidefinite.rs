//! The semi-definite programs behind the split bounds, and an interior-point method for them.
//!
//! A term is a vector v with a multiplier `d > 0`. Each `d v v'` is subtracted from a matrix E or added to it,
//! and what remains, the slack S, must stay positive semi-definite. The program maximises a linear function of
//! the multipliers. Its dual has a matrix X with `+-v'X v - x = gain` and `x >= 0` for each term. The method
//! is that of `helmberg1996`, section 4: Newton steps towards `X S = share I` and `d x = share`, with a smaller
//! share in each step. The vectors are sparse, so the matrix of a step costs little: its entries are
//! `(v_i'X v_j) (v_i'S^-1 v_j)`.

use faer::linalg::solvers::Llt;
use faer::prelude::Solve;
use faer::{Mat, Scale, Side};

use crate::linalg::with_wide_registers;

/// A step ends at most at this part of the way to the boundary.
const INSIDE: f64 = 0.95;

/// The ratio of two step lengths that are tried.
const SHORTER: f64 = 0.8;

/// The share becomes this part of itself in the next step, after a short step and after a long one.
const REDUCTIONS: (f64, f64) = (0.5, 0.15);

/// A step from this length on is long.
const LONG: f64 = 0.8;

/// One term of the sum.
#[derive(Debug, Clone)]
pub(super) struct Term {
    /// The nonzero entries of v.
    pub vector: Vec<(usize, f64)>,
    /// The derivative of the objective with respect to the multiplier.
    pub gain: f64,
    /// Whether the term is added to E instead of subtracted.
    pub added: bool,
    /// The multiplier d.
    pub multiplier: f64,
    /// The slack x of its inequality in the dual program.
    pub price: f64,
}

impl Term {
    fn sign(&self) -> f64 {
        if self.added { -1.0 } else { 1.0 }
    }

    /// What `+-v'X v` has beyond the gain. The inequality of the term is violated if this is negative.
    pub fn surplus(&self, dual: &Mat<f64>) -> f64 {
        let row = |&(i, a): &(usize, f64)| {
            let entry = |&(j, b): &(usize, f64)| b * dual[(i, j)];
            a * self.vector.iter().map(entry).sum::<f64>()
        };
        self.sign() * self.vector.iter().map(row).sum::<f64>() - self.gain
    }

    /// Sets `image` to `matrix v`.
    fn image(&self, matrix: &Mat<f64>, image: &mut [f64]) {
        image.fill(0.0);
        for &(i, a) in &self.vector {
            for (x, m) in image.iter_mut().zip(matrix.col(i).iter()) {
                *x += a * m;
            }
        }
    }

    fn product(&self, image: &[f64]) -> f64 {
        self.vector.iter().map(|&(i, a)| a * image[i]).sum()
    }
}

/// The program at its current point. Both matrices are positive definite, and so is the slack.
pub(super) struct Program {
    /// E, whose lower triangle is read.
    pub matrix: Mat<f64>,
    pub terms: Vec<Term>,
    /// X.
    pub dual: Mat<f64>,
}

impl Program {
    /// The objective.
    pub fn objective(&self) -> f64 {
        self.terms.iter().map(|t| t.gain * t.multiplier).sum()
    }

    /// The multiplications of one step.
    pub fn work(&self) -> u64 {
        let (n, k) = (self.matrix.nrows() as u64, self.terms.len() as u64);
        6 * n * n * n + k * k * k / 6 + 8 * n * k + 8 * k * k
    }

    /// Steps until the objective is within the part `end` of the optimum, at most `most` of them. Returns false
    /// if `stop` ended it, which gets the multiplications of each step before it, or if rounding errors
    /// prevent a step.
    pub fn improve(&mut self, end: f64, most: usize, stop: &mut dyn FnMut(u64) -> bool) -> bool {
        let mut length = 0.0;
        for _ in 0..most {
            let reduction = if length < LONG {
                REDUCTIONS.0
            } else {
                REDUCTIONS.1
            };
            if stop(self.work()) {
                return false;
            }
            let Some((share, next)) = self.step(reduction) else {
                return false;
            };
            length = next;
            let size = self.matrix.nrows() + self.terms.len();
            if share * size as f64 <= end * self.objective().abs() {
                break;
            }
        }
        true
    }

    /// Whether the slack is positive definite after `margin` is subtracted from its diagonal.
    pub fn is_feasible(&self, margin: f64) -> bool {
        let mut slack = self.slack(|j| self.terms[j].multiplier);
        for i in 0..slack.nrows() {
            slack[(i, i)] -= margin;
        }
        factor(&slack).is_some()
    }

    /// The slack for these multipliers. Only its lower triangle is valid.
    pub fn slack(&self, multiplier: impl Fn(usize) -> f64) -> Mat<f64> {
        let mut slack = self.matrix.clone();
        for (k, term) in self.terms.iter().enumerate() {
            let d = term.sign() * multiplier(k);
            for &(i, a) in &term.vector {
                for &(j, b) in term.vector.iter().filter(|e| e.0 <= i) {
                    slack[(i, j)] -= d * a * b;
                }
            }
        }
        slack
    }

    /// One step, towards the point with `reduction` times the present share. Returns the new share and the
    /// length of the step.
    fn step(&mut self, reduction: f64) -> Option<(f64, f64)> {
        let k = self.terms.len();
        let slack = self.slack(|j| self.terms[j].multiplier);
        let inverse = inverse(&factor(&slack)?, slack.nrows());
        let share = reduction * self.share(&slack);
        let change = self.direction(&inverse, share)?;
        let price = |t: &Term, s: f64| (share - t.price * s) / t.multiplier - t.price;
        let steps = self.terms.iter().zip(&change);
        let prices: Vec<f64> = steps.map(|(t, s)| price(t, *s)).collect();
        let dual_change = self.dual_direction(&inverse, share, &change);
        let largest = within(self.terms.iter().map(|t| t.multiplier), &change);
        let forward = longest(largest, |length| {
            self.slack(|j| self.terms[j].multiplier + length * change[j])
        })?;
        let largest = within(self.terms.iter().map(|t| t.price), &prices);
        let back = longest(largest, |length| &self.dual + &dual_change * Scale(length))?;
        for j in 0..k {
            self.terms[j].multiplier += forward * change[j];
            self.terms[j].price += back * prices[j];
        }
        self.dual += dual_change * Scale(back);
        let slack = self.slack(|j| self.terms[j].multiplier);
        Some((self.share(&slack), forward.min(back)))
    }

    /// The Newton direction of the multipliers.
    fn direction(&self, inverse: &Mat<f64>, share: f64) -> Option<Vec<f64>> {
        let (n, k) = (self.matrix.nrows(), self.terms.len());
        let mut system = Mat::<f64>::zeros(k, k);
        let mut right = Mat::<f64>::zeros(k, 1);
        let (mut by_dual, mut by_inverse) = (vec![0.0; n], vec![0.0; n]);
        for (j, term) in self.terms.iter().enumerate() {
            term.image(&self.dual, &mut by_dual);
            term.image(inverse, &mut by_inverse);
            for (i, other) in self.terms.iter().enumerate().skip(j) {
                let product = other.product(&by_dual) * other.product(&by_inverse);
                system[(i, j)] = term.sign() * other.sign() * product;
            }
            system[(j, j)] += term.price / term.multiplier;
            let own = term.sign() * term.product(&by_inverse);
            right[(j, 0)] = term.gain - share * (own - 1.0 / term.multiplier);
        }
        let factor = factor(&system)?;
        let change = with_wide_registers(|| factor.solve(&right));
        Some((0..k).map(|j| change[(j, 0)]).collect())
    }

    /// The direction of X: `share S^-1 - X - X dS S^-1`, made symmetric, where dS is the change of the slack.
    fn dual_direction(&self, inverse: &Mat<f64>, share: f64, change: &[f64]) -> Mat<f64> {
        let n = self.matrix.nrows();
        let mut lowered = Mat::<f64>::zeros(n, n);
        for (term, s) in self.terms.iter().zip(change) {
            for &(i, a) in &term.vector {
                for &(j, b) in &term.vector {
                    lowered[(i, j)] += term.sign() * s * a * b;
                }
            }
        }
        let product = with_wide_registers(|| &self.dual * lowered * inverse);
        Mat::from_fn(n, n, |i, j| {
            let mean = 0.5 * (product[(i, j)] + product[(j, i)]);
            share * inverse[(i, j)] - self.dual[(i, j)] + mean
        })
    }

    /// The mean of the products of all multipliers, and all eigenvalues of the slack, with their duals.
    fn share(&self, slack: &Mat<f64>) -> f64 {
        let n = slack.nrows();
        let mut sum: f64 = self.terms.iter().map(|t| t.multiplier * t.price).sum();
        for j in 0..n {
            let below = (j + 1..n).map(|i| slack[(i, j)] * self.dual[(i, j)]);
            sum += slack[(j, j)] * self.dual[(j, j)] + 2.0 * below.sum::<f64>();
        }
        sum / (n + self.terms.len()) as f64
    }
}

/// The Cholesky factor of a matrix whose lower triangle is valid. None if it is not positive definite.
fn factor(matrix: &Mat<f64>) -> Option<Llt<f64>> {
    with_wide_registers(|| matrix.llt(Side::Lower)).ok()
}

fn inverse(factor: &Llt<f64>, n: usize) -> Mat<f64> {
    with_wide_registers(|| factor.solve(Mat::<f64>::identity(n, n)))
}

/// The longest step, before [`INSIDE`], that keeps all values positive and ends at a full step.
fn within(values: impl Iterator<Item = f64>, change: &[f64]) -> f64 {
    let rates = values.zip(change).map(|(v, s)| -s / v);
    let fastest = rates.fold(0.0, f64::max);
    (1.0 / fastest).min(1.0 / INSIDE)
}

/// The part [`INSIDE`] of a step of at most `largest` that keeps the matrix positive definite.
fn longest(largest: f64, matrix: impl Fn(f64) -> Mat<f64>) -> Option<f64> {
    let mut length = largest;
    for _ in 0..60 {
        if factor(&matrix(length)).is_some() {
            return Some(INSIDE * length);
        }
        length *= SHORTER;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagonal_below_two_rows_has_the_known_trace() {
        // (a - d) (c - e) >= b^2 allows d + e up to a + c - 2 |b|.
        for (a, b, c) in [(2.0, 1.0, 2.0), (5.0, -1.5, 3.0), (1.0, 0.3, 4.0)] {
            let entry = |i: usize, j: usize| [[a, b], [b, c]][i][j];
            let unit = |i: usize| Term {
                vector: vec![(i, 1.0)],
                gain: 1.0,
                added: false,
                multiplier: 0.01,
                price: 1.0,
            };
            let mut program = Program {
                matrix: Mat::from_fn(2, 2, entry),
                terms: vec![unit(0), unit(1)],
                dual: Mat::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 0.0 }),
            };
            assert!(program.improve(1e-9, 60, &mut |_| false));
            assert!(program.is_feasible(0.0));
            let expected = a + c - 2.0 * f64::abs(b);
            let objective = program.objective();
            assert!(
                (objective - expected).abs() < 1e-6,
                "{objective} {expected}"
            );
        }
    }
}
