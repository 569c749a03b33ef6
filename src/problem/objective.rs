//! The caller's objective in twice the working precision.
//!
//! On real problems the constant of the objective is a million times the result, and with integers near 1e8
//! it is 1e16 times the result. So every product is a sum of two floats, and every sum is compensated
//! (`ogita2005`). The terms are the caller's own: duplicates are not summed first, and least-squares rows
//! are not squared into Q, because both lose digits.

use super::Problem;
use crate::error::Result;
use crate::linalg::{CompensatedSum, TwoFold};
use crate::monitor::{
    collect_in_parts, in_blocks, in_parts, joined, may_continue, may_continue_at,
};

/// The objective of a problem as the caller gave it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Objective<'a>(pub &'a Problem);

/// An energy with a bound on its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Energy {
    pub value: TwoFold,
    /// A bound on the error of `value`.
    pub error: f64,
}

/// The sum of terms of the energy, the sum of their absolute values, and their number.
#[derive(Default)]
struct Terms {
    sum: CompensatedSum,
    size: f64,
    count: usize,
}

/// The least number of rows or unknowns that are worth a thread.
const LEAST: usize = 1 << 13;

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

impl Objective<'_> {
    /// The energy of the point `x`.
    pub fn energy(&self, x: impl Fn(usize) -> TwoFold + Sync) -> Energy {
        let problem = self.0;
        let mut sum = Terms {
            sum: CompensatedSum::new(problem.constant),
            size: problem.constant.abs(),
            count: 1,
        };
        let linear = in_blocks(problem.linear.len(), |block| {
            let mut sum = Terms::default();
            for (i, q) in block.map(|i| (i, problem.linear[i])) {
                if q != 0.0 {
                    let x = x(i);
                    sum.sum.add_multiple(q, x);
                    sum.size += (q * x.high).abs();
                    sum.count += 1;
                }
            }
            sum
        });
        let quadratic = in_blocks(problem.quadratic.len(), |block| {
            let mut sum = Terms::default();
            for &(i, j, v) in &problem.quadratic[block] {
                let v = if i == j { 0.5 * v } else { v };
                let (x, y) = (x(i as usize), x(j as usize));
                sum.sum.add_product_of_three(v, x.high, y.high);
                sum.sum.add_product(v * x.high, y.low);
                sum.sum.add_product(v * x.low, y.high);
                sum.size += (v * x.high * y.high).abs();
                sum.count += 3;
            }
            sum
        });
        let least_squares = in_blocks(problem.weights.len(), |block| {
            let mut sum = Terms::default();
            for k in block {
                let w = problem.weights[k];
                let (r, row) = self.residual(k, &x);
                sum.sum.add_product_of_three(w, r.high, r.high);
                sum.sum.add_product(2.0 * w * r.high, r.low);
                sum.size += 2.0 * w * r.high.abs() * row + w * r.high * r.high;
                sum.count += 2 + problem.least_squares.row(k).len();
            }
            sum
        });
        for block in linear.iter().chain(&quadratic).chain(&least_squares) {
            sum.sum.add_sum(&block.sum);
            sum.size += block.size;
            sum.count += block.count;
        }
        // `ogita2005`, proposition 5.5, with a unit more in each factor for the products.
        let gamma = (sum.count as f64 + 4.0) * UNIT;
        Energy {
            value: sum.sum.two_fold(),
            error: 2.0 * gamma * gamma * sum.size + UNIT * UNIT * sum.sum.value().abs(),
        }
    }

    /// The gradient at the point `x`. The error of each entry is about one rounding of the entry itself.
    ///
    /// # Errors
    /// The end of the call.
    pub fn gradient(&self, x: impl Fn(usize) -> TwoFold + Sync) -> Result<Vec<TwoFold>> {
        let problem = self.0;
        let rows = problem.weights.len();
        let residuals = collect_in_parts(rows, LEAST, |k| self.residual(k, &x).0);
        may_continue()?;
        // Each part looks at all terms and adds those of its own unknowns.
        let parts = in_parts(problem.variables, LEAST, |part| {
            let linear = problem.linear[part.clone()].iter();
            let mut sums: Vec<CompensatedSum> = linear.map(|&q| CompensatedSum::new(q)).collect();
            let place = |i: usize| i.wrapping_sub(part.start);
            for (at, &(i, j, v)) in problem.quadratic.iter().enumerate() {
                may_continue_at(at)?;
                let (i, j) = (i as usize, j as usize);
                if let Some(sum) = sums.get_mut(place(i)) {
                    sum.add_multiple(v, x(j));
                }
                if let (true, Some(sum)) = (i != j, sums.get_mut(place(j))) {
                    sum.add_multiple(v, x(i));
                }
            }
            for ((k, w), r) in problem.weights.iter().enumerate().zip(&residuals) {
                may_continue_at(k)?;
                for (i, a) in problem.least_squares.row(k) {
                    if let Some(sum) = sums.get_mut(place(i)) {
                        sum.add_product_of_three(2.0 * w, a, r.high);
                        sum.add_product(2.0 * w * a, r.low);
                    }
                }
            }
            Ok(sums.iter().map(CompensatedSum::two_fold).collect())
        });
        Ok(joined(parts.into_iter().collect::<Result<_>>()?))
    }

    /// Half the second derivative along `direction`, and the size of its terms, where each entry of the
    /// direction counts with its `magnitude`.
    pub fn curvature(&self, direction: &[TwoFold], magnitude: &[f64]) -> (f64, f64) {
        let problem = self.0;
        let (mut sum, mut size) = (CompensatedSum::new(0.0), 0.0);
        for &(i, j, v) in problem.quadratic() {
            let v = if i == j { 0.5 * v } else { v };
            let (x, y) = (direction[i as usize], direction[j as usize]);
            sum.add_product_of_three(v, x.high, y.high);
            sum.add_product(v * x.high, y.low);
            sum.add_product(v * x.low, y.high);
            size += v.abs() * magnitude[i as usize] * magnitude[j as usize];
        }
        for (k, w) in problem.weights.iter().enumerate() {
            let (mut product, mut terms) = (CompensatedSum::new(0.0), 0.0);
            for (j, a) in problem.least_squares.row(k) {
                product.add_multiple(a, direction[j]);
                terms += a.abs() * magnitude[j];
            }
            let product = product.value();
            sum.add_product_of_three(*w, product, product);
            size += w * terms * terms;
        }
        (sum.value(), size)
    }

    /// The residual of a least-squares row, and the sum of the absolute values of its terms.
    fn residual(&self, k: usize, x: impl Fn(usize) -> TwoFold) -> (TwoFold, f64) {
        let rows = &self.0.least_squares;
        let mut sum = CompensatedSum::new(-rows.rhs()[k]);
        let mut size = rows.rhs()[k].abs();
        for (j, a) in rows.row(k) {
            let x = x(j);
            sum.add_multiple(a, x);
            size += (a * x.high).abs();
        }
        (sum.two_fold(), size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{spawned, with_threads};
    use crate::problem::Triangle;

    /// `(x0 + x1 - 2e8 - 0.5)^2 + 3/2 x1^2 - 3e8 x1 + 1.5e16`: at (1e8, 1e8) it is 0.25, although its terms
    /// are 1e16 and larger.
    fn far_from_zero() -> Problem {
        let mut problem = Problem::new(2).unwrap();
        problem
            .add_least_squares(&[0, 1], &[1.0, 1.0], 2e8 + 0.5, 1.0)
            .unwrap();
        problem
            .add_quadratic_triplets(Triangle::Lower, &[1], &[1], &[3.0])
            .unwrap();
        problem.add_linear(&[0.0, -3e8]).unwrap();
        problem.add_constant(1.5e16).unwrap();
        problem
    }

    #[test]
    fn energies_far_from_zero_have_all_their_digits() {
        let problem = far_from_zero();
        let objective = Objective(&problem);
        let energy = objective.energy(|_| TwoFold::from(1e8));
        assert_eq!(energy.value, TwoFold::from(0.25));
        assert!(energy.error < 1e-12);
        // A step of 2^-40 in the lower part of x1: 0.25 - 2^-40 + 2^-80 (1 + 3/2).
        let step = 2f64.powi(-40);
        let low = [0.0, step];
        let energy = objective.energy(|i| TwoFold {
            high: 1e8,
            low: low[i],
        });
        let difference = (energy.value.high - 0.25 + step) + energy.value.low;
        assert!((difference - 2.5 * step * step).abs() <= energy.error);
    }

    #[test]
    fn the_gradient_is_the_derivative_of_the_energy() {
        let problem = far_from_zero();
        let gradient = Objective(&problem).gradient(|_| TwoFold::from(1e8));
        let gradient = gradient.unwrap();
        assert_eq!(gradient, [TwoFold::from(-1.0), TwoFold::from(-1.0)]);
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits() {
        let n = 3 * LEAST;
        let mut problem = Problem::new(n).unwrap();
        for i in 1..n {
            let row = [i - 1, i, (7 * i) % n];
            problem
                .add_least_squares(&row, &[1.0, -0.3, 0.1], (i % 13) as f64, 1.0 / i as f64)
                .unwrap();
        }
        let (rows, cols): (Vec<_>, Vec<_>) = (1..n).map(|i| (i, i - i % 3)).unzip();
        problem
            .add_quadratic_triplets(Triangle::Lower, &rows, &cols, &vec![0.7; n - 1])
            .unwrap();
        problem.add_linear(&vec![0.1; n]).unwrap();
        let objective = Objective(&problem);
        let x = |i: usize| TwoFold::from(1.0 / (1 + i) as f64);
        let of = |threads| {
            with_threads(threads, || {
                (objective.energy(x), objective.gradient(x).unwrap())
            })
        };
        let one = of(1);
        assert!(spawned(|| assert_eq!(of(3), one)) > 2);
        // The gradient is that of differences of the energy.
        let at = |step: f64| {
            let moved = |i: usize| x(i).high + if i == n - 1 { step } else { 0.0 };
            objective.energy(|i| moved(i).into()).value.high
        };
        let slope = (at(0.5) - at(-0.5)) / 1.0;
        assert!((slope - one.1[n - 1].high).abs() < 1e-9);
    }
}
