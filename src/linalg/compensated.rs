//! Sums of products whose terms cancel (`neumaier1974`, `ogita2005`).

/// A running sum that carries its own rounding error (`neumaier1974`). Products use fused multiply-add as in
/// algorithm Dot2 of `ogita2005`. The result is as accurate as if computed in twice the working precision.
#[derive(Debug, Clone, Copy, Default)]
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

    /// Adds `a * b * c`, with an error of the order of the square of the rounding unit.
    pub fn add_product_of_three(&mut self, a: f64, b: f64, c: f64) {
        let product = a * b;
        self.add_product(product, c);
        self.error += a.mul_add(b, -product) * c;
    }

    /// Adds `a * (x.high + x.low)`.
    pub fn add_multiple(&mut self, a: f64, x: TwoFold) {
        self.add_product(a, x.high);
        self.error += a * x.low;
    }

    /// Adds another sum together with its rounding error.
    pub fn add_sum(&mut self, other: &CompensatedSum) {
        self.add(other.sum);
        self.error += other.error;
    }

    /// The sum.
    pub fn value(&self) -> f64 {
        self.sum + self.error
    }

    /// The sum with its rounding error.
    pub fn two_fold(&self) -> TwoFold {
        let high = self.sum + self.error;
        let low = if self.sum.abs() >= self.error.abs() {
            (self.sum - high) + self.error
        } else {
            (self.error - high) + self.sum
        };
        TwoFold { high, low }
    }
}

/// A float that is not above the exact sum of `terms`: the nearest float, or the one below it.
pub fn sum_below(terms: &[f64]) -> f64 {
    let mut sum = CompensatedSum::new(0.0);
    terms.iter().for_each(|&term| sum.add(term));
    if sum.error == 0.0 || !sum.error.is_finite() {
        return terms.iter().sum();
    }
    let size: f64 = terms.iter().map(|t| t.abs()).sum();
    // The errors were summed up in the working precision.
    let unknown = terms.len() as f64 * f64::EPSILON * f64::EPSILON * size;
    let TwoFold { high, low } = sum.two_fold();
    match low > unknown {
        true => high,
        false => high.next_down(),
    }
}

/// A number of twice the working precision: the unevaluated sum of two floats (`dekker1971`). The lower one
/// is at most half a unit in the last place of the higher one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TwoFold {
    /// The nearest float.
    pub high: f64,
    /// The rest.
    pub low: f64,
}

impl From<f64> for TwoFold {
    fn from(high: f64) -> Self {
        TwoFold { high, low: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::{CompensatedSum, TwoFold, sum_below};

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
    fn a_sum_from_below_is_never_above_the_exact_one() {
        let ulp = 2f64.powi(-52);
        for (terms, below) in [
            (vec![1.0, 2.0, -0.5], 2.5),
            (vec![1.0, 0.25 * ulp], 1.0),
            (vec![1.0, 0.75 * ulp], 1.0),
            (vec![1.0, -0.1 * ulp], 1.0 - 0.5 * ulp),
            (vec![1e16, 1.0, -1e16], 1f64.next_down()),
            (vec![0.0, f64::NEG_INFINITY], f64::NEG_INFINITY),
        ] {
            assert_eq!(sum_below(&terms), below, "{terms:?}");
        }
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

    #[test]
    fn a_sum_of_sums_keeps_the_errors_of_both() {
        let mut sum = CompensatedSum::new(1e100);
        sum.add(1.0);
        let mut other = CompensatedSum::new(1.0);
        other.add(-1e100);
        sum.add_sum(&other);
        assert_eq!(sum.value(), 2.0);
    }

    #[test]
    fn a_product_of_three_factors_is_exact_to_twice_the_precision() {
        // (2^27 + 1)^3 has 82 bits; its lowest bit is lost in a float.
        let factor = f64::from((1 << 27) + 1);
        let mut sum = CompensatedSum::new(0.0);
        sum.add_product_of_three(factor, factor, factor);
        sum.add(-2f64.powi(81));
        sum.add(-3.0 * 2f64.powi(54));
        sum.add(-3.0 * 2f64.powi(27));
        assert_eq!(sum.value(), 1.0);
    }

    #[test]
    fn the_rest_of_a_sum_is_kept() {
        let mut sum = CompensatedSum::new(2f64.powi(60));
        sum.add(0.5);
        let (high, low) = (2f64.powi(60), 0.5);
        assert_eq!(sum.two_fold(), TwoFold { high, low });
        let mut twice = CompensatedSum::new(-2f64.powi(61));
        twice.add_multiple(2.0, sum.two_fold());
        assert_eq!(twice.value(), 1.0);
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
