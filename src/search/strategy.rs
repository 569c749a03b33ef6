//! The strategies by which integers are decided.

use super::table::words;

words! {
    /// How integers are decided.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Strategy {
        Relax = "relax": "Not at all: integers stay real, which gives a lower bound.",
        Direct = "direct": "All at once, each to the nearest integer of the relaxation.",
        Greedy = "greedy": "One after the other, the one closest to an integer first, re-optimised exactly each time.",
        Adaptive = "adaptive": "Several at a time, re-optimised only as far as needed, and exactly where that is cheap.",
        Multiple = "multiple": "Several at a time, re-optimised by the published iterations, as earlier programs do.",
        Lattice = "lattice": "By lattice reduction, nearest plane and exact decision of blocks, without a proof.",
        Exact = "exact": "As lattice, then enumeration until the optimum is proved or the budget ends.",
        Auto = "auto": "As exact where integers are few; else adaptive, improved in cycle space where angles differ. Its budget is counted in work, not in seconds ([`Solution::work`](crate::solve::Solution::work)).",
    }
}
