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
    /// Several at a time, re-optimised by the published iterations: what earlier programs decide.
    Multiple,
    /// By lattice reduction, nearest plane and exact re-decision of blocks, without a proof.
    Lattice,
    /// As lattice, then enumeration until the optimum is proved or the budget ends.
    Exact,
    /// As exact where integers are few; where they are many, adaptive, improved in cycle space if
    /// angles differ. Beyond roundings it spends at most the work of 1,000 relaxations and 2e8
    /// multiplications, by count ([`Solution::work`](crate::solve::Solution::work)).
    Auto,
}

impl Strategy {
    /// All strategies.
    pub const ALL: [Strategy; 8] = [
        Strategy::Relax,
        Strategy::Direct,
        Strategy::Greedy,
        Strategy::Adaptive,
        Strategy::Multiple,
        Strategy::Lattice,
        Strategy::Exact,
        Strategy::Auto,
    ];

    /// The name by which options choose it.
    pub fn name(self) -> &'static str {
        match self {
            Strategy::Relax => "relax",
            Strategy::Direct => "direct",
            Strategy::Greedy => "greedy",
            Strategy::Adaptive => "adaptive",
            Strategy::Multiple => "multiple",
            Strategy::Lattice => "lattice",
            Strategy::Exact => "exact",
            Strategy::Auto => "auto",
        }
    }
}
