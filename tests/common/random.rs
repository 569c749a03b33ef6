//! Numbers that look random and are the same in every run, for all tests: those of this folder, and by
//! `#[path]` those inside of the library.

/// A deterministic sequence of numbers in [-1, 1) (xorshift, Marsaglia 2003, "Xorshift RNGs", the triple
/// 13, 7, 17). Seeds are spread by the golden ratio, as small ones would begin alike.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// A number in [-1, 1).
    pub fn next(&mut self) -> f64 {
        self.bits() as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.bits() as f64 / (1u64 << 53) as f64
    }

    /// A whole number below `limit`.
    pub fn below(&mut self, limit: usize) -> usize {
        (self.bits() % limit as u64) as usize
    }

    /// The upper 53 bits of the next number.
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 >> 11
    }
}
