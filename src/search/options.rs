//! The options of a solve, in one table.

use super::table::{options, word_option};
use super::{Strategy, WarmStart};
use crate::linalg::Ordering;

word_option!(Ordering);

options! {
    /// How to solve. Every member is also an entry of [`OPTIONS`], under the same name.
    pub struct Options,

    /// All options of a solve.
    OPTIONS {
        strategy: Strategy = Strategy::Auto, "auto" in Strategy::WORDS,
            "the strategy that decides the integers";
        time_limit: f64 = f64::INFINITY, "inf" in "[0, inf]",
            "the seconds after which the best solution so far is returned";
        /// The result does not depend on it.
        threads: usize = 0, "0" in "[0, 1024]",
            "the largest number of threads; 0: one for each core";
        rounding_threshold: f64 = 0.5, "0.5" in "[0, inf]",
            "adaptive, multiple: integers are rounded together while the sum of their deviations is at most this";
        exact_integers: usize = 1000, "1000" in "[0, 2147483647]",
            "adaptive: up to this many integers are decided exactly, one at a time";
        gauss_seidel_updates: usize = 100_000, "100000" in "[0, 2147483647]",
            "adaptive, multiple: the number of Gauss-Seidel updates in a pass before conjugate gradients take over";
        gauss_seidel_tolerance: f64 = 1e-3, "0.001" in "[0, inf]",
            "adaptive, multiple: Gauss-Seidel leaves an unknown that would move by less than this";
        cg_iterations: usize = 50, "50" in "[0, 2147483647]",
            "adaptive, multiple: the number of conjugate-gradient iterations in a pass before a factorization takes over";
        /// The estimate is the preconditioner's; the residual is that of `Q/2 x = -q/2`.
        cg_tolerance: f64 = 1e-3, "0.001" in "[0, inf]",
            "adaptive: conjugate gradients end when every unknown is estimated to be closer than this to the minimum; multiple: when the residual is shorter than this";
        exact_steps: bool = true, "1" in "[0, 1]",
            "adaptive, multiple: 1 if a pass may factor when conjugate gradients fail";
        /// They are those of the solver's last solution, or those that the initial guess rounds
        /// to where there is none.
        warm_start: WarmStart = WarmStart::Off, "off" in WarmStart::WORDS,
            "earlier integers: ignored, offered before the search begins, or kept as they are";
        ordering: Ordering = Ordering::FillReducing, "fill_reducing" in "fill_reducing|natural|largest_pivot",
            "the order of eliminations and factorizations; largest_pivot solves constraints for their largest coefficient (Bommes' thesis), natural keeps the given order, for comparison";
        dense_integers: usize = 1000, "1000" in "[0, 20000]",
            "lattice, exact, auto: up to this many integers are decided in a dense lattice";
        beam_width: usize = 256, "256" in "[1, 1000000]",
            "lattice, exact, auto: the number of partial solutions that the beam of nearest plane keeps";
        lattice_rounds: usize = 1, "1" in "[0, 2147483647]",
            "lattice, exact, auto: the number of perturbation rounds after the blocks";
        nodes: usize = 10_000_000_000, "10000000000" in "[0, 9007199254740992]",
            "exact, auto: the number of nodes that the proof may visit";
        gap: f64 = 0.0, "0" in "[0, inf]",
            "exact, auto: the relative gap that ends the proof";
    }
    and {}
    by {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::table::hold;

    #[test]
    fn every_option_of_the_table_starts_at_its_default_and_comes_back_as_set() {
        hold(OPTIONS, Options::set, Options::get);
    }
}
