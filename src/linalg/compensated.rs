//! Sums of products whose terms cancel (`neumaier1974`, `ogita2005`).

/// A running sum that carries its own rounding error (`neumaier1974`). Products use fused multiply-add as in
/// algorithm Dot2 of `ogita2005`. The result is as accurate as if computed in twice the working precision.
#[derive(Debug, Clone, Copy)]
pub struct CompensatedSum {
    sum: f64,
    error: f64,
}

impl CompensatedSum {
    /// A sum that starts at `value`.
    pub fn new(value: f64) -> Self {
        CompensatedSum {
            sum: value,
            error: 0.0,
        }
    }

    /// Adds `value`.
    pub fn add(&mut self, value: f64) {
        let total = self.sum + value;
        self.error += if self.sum.abs() >= value.abs() {
            (self.sum - total) + value
        } else {
            (value - total) + self.sum
        };
        self.sum = total;
    }

    /// Adds `a * b` together with the rounding error of the product.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(product);
        self.error += a.mul_add(b, -product);
    }

    /// The sum.
    pub fn value(&self) -> f64 {
        self.sum + self.error
    }

    /// The sum as two numbers: its value, and what the rounding of the value leaves.
    pub fn parts(&self) -> (f64, f64) {
        let value = self.value();
        let of_error = value - self.sum;
        let of_sum = value - of_error;
        (value, (self.sum - of_sum) + (self.error - of_error))
    }
}

#[cfg(test)]
mod tests {
    use super::CompensatedSum;

    fn sum(terms: &[f64]) -> f64 {
        let mut sum = CompensatedSum::new(0.0);
        terms.iter().for_each(|&term| sum.add(term));
        sum.value()
    }

    #[test]
    fn cancelling_terms_leave_the_small_ones() {
        // Plain summation gives 0 for all of them, Kahan's summation for the last two.
        assert_eq!(sum(&[1e16, 1.0, -1e16]), 1.0);
        assert_eq!(sum(&[1.0, 1e100, -1e100]), 1.0);
        assert_eq!(sum(&[1.0, 1e100, 1.0, -1e100]), 2.0);
    }

    #[test]
    fn the_second_part_is_what_the_value_lacks() {
        let mut sum = CompensatedSum::new(1.0);
        sum.add(1e-20);
        assert_eq!(sum.parts(), (1.0, 1e-20));
        sum.add(-1.0);
        assert_eq!(sum.parts(), (1e-20, 0.0));
    }

    #[test]
    fn what_a_product_is_rounded_by_is_kept() {
        // (1 + 2^-30)^2 = 1 + 2^-29 + 2^-60. A double holds only the first two terms.
        let factor = 1.0 + 2f64.powi(-30);
        let mut sum = CompensatedSum::new(-1.0);
        sum.add_product(factor, factor);
        sum.add(-2f64.powi(-29));
        assert_eq!(sum.value(), 2f64.powi(-60));
    }

    /// The sums satisfy the error bound of algorithm Dot2 (`ogita2005`, proposition 5.5). The oracle is
    /// integer sums in 128 bits, which nearly cancel.
    #[test]
    fn scalar_products_are_those_of_twice_the_working_precision() {
        for round in 0..50i128 {
            let factor = |k: i128| (k * 2_654_435_769 + round * 40_503) % (1 << 32) - (1 << 31);
            let mut sum = CompensatedSum::new(0.0);
            let (mut exact, mut size) = (0, 0.0);
            let mut add = |a: i128, b: i128| {
                sum.add_product(a as f64, b as f64);
                exact += a * b;
                size += (a * b).abs() as f64;
            };
            // Products of up to 84 bits, then the same products with opposite sign and one factor changed by
            // one.
            for k in 0..100 {
                let (a, b) = (factor(3 * k) << 20, factor(3 * k + 1) * 2 + 1);
                add(a, b);
                add(-a + 1, b);
            }
            let unit = f64::EPSILON / 2.0;
            let bound =
                unit * (exact as f64).abs() + (200.0 * unit / (1.0 - 200.0 * unit)).powi(2) * size;
            let error = (sum.value() - exact as f64).abs();
            assert!(error <= bound, "round {round}: {error:e} above {bound:e}");
        }
    }
}
