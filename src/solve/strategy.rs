//! The strategies by which integers are decided.

/// How integers are decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Strategy {
    /// Not at all: integers stay real. Gives a lower bound.
    Relax,
    /// All at once, each to the nearest integer of the relaxation.
    Direct,
    /// One after the other, the one closest to an integer first, re-optimising exactly each time.
    Greedy,
    /// Several at a time, re-optimising only as far as needed; exactly where that is cheap.
    Adaptive,
}

impl Strategy {
    /// All strategies.
    pub const ALL: [Strategy; 4] = [
        Strategy::Relax,
        Strategy::Direct,
        Strategy::Greedy,
        Strategy::Adaptive,
    ];

    /// The name by which options choose it.
    pub fn name(self) -> &'static str {
        match self {
            Strategy::Relax => "relax",
            Strategy::Direct => "direct",
            Strategy::Greedy => "greedy",
            Strategy::Adaptive => "adaptive",
        }
    }
}
