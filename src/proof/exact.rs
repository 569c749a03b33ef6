//! Exact numbers: `m 2^e / d` with integers m and d, d odd and positive.
//!
//! Sums and products of floats have `d = 1`, so that none of them needs a greatest common divisor. Other
//! denominators come from fractions in a proof alone.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use num_bigint::{BigInt, Sign};

/// An exact number.
#[derive(Debug, Clone)]
pub(super) struct Exact {
    mantissa: BigInt,
    exponent: i64,
    /// Nothing stands for 1.
    denominator: Option<BigInt>,
}

impl Exact {
    pub fn zero() -> Self {
        Exact::whole(BigInt::ZERO, 0)
    }

    /// `mantissa 2^exponent`.
    fn whole(mantissa: BigInt, exponent: i64) -> Self {
        Exact {
            mantissa,
            exponent,
            denominator: None,
        }
    }

    /// The number that a float stands for. A float that is not finite stands for none.
    pub fn of(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.to_bits();
        let (raw, fraction) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
        let (mantissa, exponent) = match raw {
            0 => (fraction, -1074),
            _ => (fraction | (1 << 52), raw as i64 - 1075),
        };
        if mantissa == 0 {
            return Some(Exact::zero());
        }
        let zeros = mantissa.trailing_zeros();
        let odd = BigInt::from(mantissa >> zeros);
        let signed = if x < 0.0 { -odd } else { odd };
        Some(Exact::whole(signed, exponent + i64::from(zeros)))
    }

    /// `numerator / denominator`. A denominator that is not positive gives no number.
    pub fn fraction(numerator: BigInt, denominator: BigInt) -> Option<Self> {
        if denominator.sign() != Sign::Plus {
            return None;
        }
        let zeros = denominator.trailing_zeros().unwrap_or(0);
        let odd = denominator >> zeros;
        Some(Exact {
            mantissa: numerator,
            exponent: -(zeros as i64),
            denominator: (odd != BigInt::from(1)).then_some(odd),
        })
    }

    /// Less, equal or greater than zero.
    pub fn sign(&self) -> Ordering {
        match self.mantissa.sign() {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }

    pub fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    pub fn abs(&self) -> Self {
        if self.sign() == Ordering::Less {
            -self
        } else {
            self.clone()
        }
    }

    /// One divided by the number, if that is a power of two or the negative of one.
    pub fn inverse_of_power(&self) -> Option<Self> {
        let zeros = self.mantissa.trailing_zeros()?;
        let is_power = self.denominator.is_none() && self.mantissa.bits() == zeros + 1;
        let one = BigInt::from(if self.sign().is_lt() { -1 } else { 1 });
        is_power.then(|| Exact::whole(one, -self.exponent - zeros as i64))
    }

    /// The number times `2^by`.
    pub fn shifted(&self, by: i64) -> Self {
        Exact {
            exponent: self.exponent + by,
            ..self.clone()
        }
    }

    /// The largest integer that is not above the number.
    pub fn floor(&self) -> Self {
        let one = BigInt::from(1);
        let divisor = self.denominator.as_ref().unwrap_or(&one);
        let (above, below) = if self.exponent >= 0 {
            (self.mantissa.clone() << self.exponent, divisor.clone())
        } else {
            (self.mantissa.clone(), divisor << -self.exponent)
        };
        Exact::whole(floor_of_quotient(&above, &below), 0)
    }

    /// The least integer that is not below the number.
    pub fn ceil(&self) -> Self {
        -&(-self).floor()
    }

    pub fn is_integer(&self) -> bool {
        &self.floor() == self
    }

    /// `floor(self / by)` for a positive `by` without a denominator.
    pub fn floor_of_quotient(&self, by: &Exact) -> Self {
        let inverse = Exact::fraction(BigInt::from(1), by.mantissa.clone());
        let quotient = inverse.map(|inverse| (self * &inverse).shifted(-by.exponent));
        quotient.map_or_else(Exact::zero, |quotient| quotient.floor())
    }

    /// `floor(self / by) by` for a positive `by` without a denominator.
    pub fn floor_to_multiple(&self, by: &Exact) -> Self {
        &self.floor_of_quotient(by) * by
    }

    /// The largest number of which both are integer multiples, zero if both are zero. Neither has a
    /// denominator.
    pub fn common_divisor(&self, other: &Exact) -> Self {
        let exponent = self.exponent.min(other.exponent);
        let mut a = self.mantissa.clone() << (self.exponent - exponent);
        let mut b = other.mantissa.clone() << (other.exponent - exponent);
        while b.sign() != Sign::NoSign {
            (a, b) = (b.clone(), a % b);
        }
        Exact::whole(a, exponent).abs()
    }

    /// `self / by`, where both have no denominator and the odd part of `by` divides that of `self`.
    pub fn quotient(&self, by: &Exact) -> Self {
        let zeros = by.mantissa.trailing_zeros().unwrap_or(0);
        let odd = &by.mantissa >> zeros;
        let exponent = self.exponent - by.exponent - zeros as i64;
        Exact::whole(&self.mantissa / odd, exponent)
    }

    /// `self / by` as two integers, the second one positive, where both have no denominator and `by` is not zero.
    pub fn ratio(&self, by: &Exact) -> (BigInt, BigInt) {
        let exponent = self.exponent.min(by.exponent);
        let above = self.mantissa.clone() << (self.exponent - exponent);
        let below = by.mantissa.clone() << (by.exponent - exponent);
        match below.sign() {
            Sign::Minus => (-above, -below),
            _ => (above, below),
        }
    }

    /// The largest float that is not above the number.
    pub fn below(&self) -> f64 {
        let mut x = self.near();
        while Exact::of(x).map_or(x > 0.0, |x| x > *self) {
            x = x.next_down();
        }
        while Exact::of(x.next_up()).is_some_and(|next| next <= *self) {
            x = x.next_up();
        }
        x
    }

    /// The least float that is not below the number.
    pub fn above(&self) -> f64 {
        -(-self).below()
    }

    /// A float near the number.
    pub fn near(&self) -> f64 {
        let one = BigInt::from(1);
        let divisor = self.denominator.as_ref().unwrap_or(&one);
        let shift = 66 + divisor.bits() as i64 - self.mantissa.bits() as i64;
        let scaled = if shift >= 0 {
            self.mantissa.clone() << shift
        } else {
            self.mantissa.clone() >> -shift
        };
        let quotient = scaled / divisor;
        let digits = quotient.magnitude().iter_u64_digits();
        let size = digits
            .rev()
            .fold(0.0, |x, digit| x * 2f64.powi(64) + digit as f64);
        let mut left = self.exponent - shift;
        let mut x = if quotient.sign() == Sign::Minus {
            -size
        } else {
            size
        };
        while left != 0 && x != 0.0 && x.is_finite() {
            let step = left.clamp(-900, 900);
            x *= 2f64.powi(step as i32);
            left -= step;
        }
        x
    }
}

fn floor_of_quotient(above: &BigInt, below: &BigInt) -> BigInt {
    let (quotient, rest) = (above / below, above % below);
    if rest.sign() == Sign::Minus {
        quotient - 1
    } else {
        quotient
    }
}

/// The product of two denominators.
fn product(a: &Option<BigInt>, b: &Option<BigInt>) -> Option<BigInt> {
    match (a, b) {
        (None, None) => None,
        (Some(d), None) | (None, Some(d)) => Some(d.clone()),
        (Some(a), Some(b)) => Some(a * b),
    }
}

impl Add for &Exact {
    type Output = Exact;
    fn add(self, other: &Exact) -> Exact {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let exponent = self.exponent.min(other.exponent);
        let aligned = |x: &Exact| match x.exponent - exponent {
            0 => x.mantissa.clone(),
            shift => x.mantissa.clone() << shift,
        };
        let (mut a, mut b) = (aligned(self), aligned(other));
        if self.denominator == other.denominator {
            return Exact {
                mantissa: a + b,
                exponent,
                denominator: self.denominator.clone(),
            };
        }
        if let (Some(d), Some(e)) = (&self.denominator, &other.denominator) {
            // Powers of one denominator are common, and their products need not grow.
            let (factor, of_self) = match whole_quotient(d, e) {
                Some(factor) => (Some(factor), false),
                None => (whole_quotient(e, d), true),
            };
            if let Some(factor) = factor {
                let larger = if of_self { other } else { self };
                if of_self {
                    a *= factor;
                } else {
                    b *= factor;
                }
                return Exact {
                    mantissa: a + b,
                    exponent,
                    denominator: larger.denominator.clone(),
                };
            }
        }
        if let Some(d) = &other.denominator {
            a *= d;
        }
        if let Some(d) = &self.denominator {
            b *= d;
        }
        Exact {
            mantissa: a + b,
            exponent,
            denominator: product(&self.denominator, &other.denominator),
        }
    }
}

/// `a / b` if b divides a.
fn whole_quotient(a: &BigInt, b: &BigInt) -> Option<BigInt> {
    let (quotient, rest) = (a / b, a % b);
    (rest.sign() == Sign::NoSign).then_some(quotient)
}

impl Neg for &Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        Exact {
            mantissa: -self.mantissa.clone(),
            exponent: self.exponent,
            denominator: self.denominator.clone(),
        }
    }
}

impl Sub for &Exact {
    type Output = Exact;
    fn sub(self, other: &Exact) -> Exact {
        self + &-other
    }
}

impl Mul for &Exact {
    type Output = Exact;
    fn mul(self, other: &Exact) -> Exact {
        if self.is_zero() || other.is_zero() {
            return Exact::zero();
        }
        Exact {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
            denominator: product(&self.denominator, &other.denominator),
        }
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Exact) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Exact {}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Exact) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Exact {
    fn cmp(&self, other: &Exact) -> Ordering {
        let signs = self.sign().cmp(&other.sign());
        if signs != Ordering::Equal {
            return signs;
        }
        (self - other).sign()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(x: f64) -> Exact {
        Exact::of(x).unwrap()
    }

    #[test]
    fn floats_are_read_and_written_to_the_last_bit() {
        for x in [0.0, 1.0, -0.1, 1e300, 5e-324, -1.7e308, 3.5, f64::MAX] {
            assert_eq!((exact(x).below(), exact(x).above()), (x, x));
        }
        assert!(Exact::of(f64::NAN).is_none() && Exact::of(f64::INFINITY).is_none());
    }

    #[test]
    fn sums_and_products_lose_nothing() {
        let sum = &exact(1e300) + &exact(1e-300);
        assert_eq!(&sum - &exact(1e300), exact(1e-300));
        assert_eq!((sum.below(), sum.above()), (1e300, 1e300_f64.next_up()));
        assert_eq!(&exact(0.5) * &exact(-6.0), exact(-3.0));
        assert!(&exact(0.1) + &exact(0.2) > exact(0.3));
    }

    #[test]
    fn fractions_are_rounded_outwards() {
        let third = Exact::fraction(BigInt::from(-1), BigInt::from(12)).unwrap();
        assert!(exact(third.below()) < third && third < exact(third.above()));
        assert_eq!(third.below().next_up(), third.above());
        let sum = (0..12).fold(exact(1.0), |sum, _| &sum + &third);
        assert!(sum.is_zero());
        assert!(Exact::fraction(BigInt::from(1), BigInt::ZERO).is_none());
    }

    #[test]
    fn powers_of_two_alone_have_an_inverse() {
        for (x, inverse) in [(1.0, 1.0), (-0.25, -4.0), (2f64.powi(70), 2f64.powi(-70))] {
            assert_eq!(exact(x).inverse_of_power(), Some(exact(inverse)));
        }
        let sum = &exact(3.0) + &exact(5.0);
        assert_eq!(sum.inverse_of_power(), Some(exact(0.125)));
        let third = Exact::fraction(BigInt::from(1), BigInt::from(3)).unwrap();
        for x in [exact(0.0), exact(3.0), third] {
            assert_eq!(x.inverse_of_power(), None);
        }
    }

    #[test]
    fn integers_and_multiples_are_rounded_downwards() {
        assert_eq!(exact(-2.5).floor(), exact(-3.0));
        assert_eq!(exact(-2.5).ceil(), exact(-2.0));
        assert!(exact(-2.0).is_integer() && !exact(0.75).is_integer());
        assert_eq!(exact(7.5).floor_to_multiple(&exact(1.5)), exact(7.5));
        assert_eq!(exact(-7.0).floor_to_multiple(&exact(3.0)), exact(-9.0));
        assert_eq!(exact(1.5).common_divisor(&exact(-2.5)), exact(0.5));
    }
}
