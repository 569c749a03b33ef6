//! Sums of products whose terms cancel.

/// A running sum that carries its own rounding error (`neumaier1974`; products by fused
/// multiply-add as in `ogita2005`, algorithm Dot2): as if computed in twice the
/// working precision.
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

    /// Adds `a * b`, the rounding error of the product included.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(product);
        self.error += a.mul_add(b, -product);
    }

    /// The sum.
    pub fn value(&self) -> f64 {
        self.sum + self.error
    }
}

#[cfg(test)]
mod tests {
    use super::CompensatedSum;

    #[test]
    fn cancelling_terms_leave_the_small_one() {
        let mut sum = CompensatedSum::new(1e100);
        sum.add(1.0);
        sum.add_product(-1e50, 1e50);
        assert!((sum.value() - (1.0 + (1e100 - 1e50 * 1e50))).abs() < 1e86);
        let mut sum = CompensatedSum::new(1e16);
        sum.add(1.0);
        sum.add(-1e16);
        assert_eq!(sum.value(), 1.0);
    }
}
