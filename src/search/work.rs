//! Work, counted in multiplications: a budget that does not depend on the speed of the machine.
//!
//! Loops that may run long count their multiplications, to the leading order. Rounding strategies (direct,
//! greedy, adaptive) do not count theirs, since no budget limits them.

use crate::eliminate::ReducedModel;
use crate::monitor::Monitor;

/// `auto`: the multiplications of its budget on every problem, about a tenth of a second.
pub(crate) const ALWAYS: u64 = 200_000_000;

/// `auto`: the rest of its budget, in relaxations.
const RELAXATIONS: u64 = 1_000;

/// The multiplications spent, and their limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Work {
    spent: u64,
    limit: u64,
    /// The part of the limit of `auto` that does not depend on the size of the problem.
    pub always: u64,
}

impl Work {
    /// No work spent, and no limit.
    pub fn unlimited() -> Self {
        Work {
            spent: 0,
            limit: u64::MAX,
            always: ALWAYS,
        }
    }

    /// Sets the limit to the budget of `auto`, roundings not included, and returns it.
    pub fn limit_to_auto(&mut self, relaxation: u64) -> u64 {
        self.limit = relaxation
            .saturating_mul(RELAXATIONS)
            .saturating_add(self.always);
        self.limit
    }

    /// Counts this many multiplications.
    pub fn spend(&mut self, multiplications: u64) {
        self.spent = self.spent.saturating_add(multiplications);
    }

    /// Multiplications so far.
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Multiplications that are left.
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.spent)
    }

    /// Counts this many multiplications. Returns whether to end, because of the limit or because of the
    /// monitor.
    pub fn ends(&mut self, multiplications: u64, monitor: &mut Monitor) -> bool {
        self.spend(multiplications);
        self.left() == 0 || monitor.ends()
    }
}

/// A relaxation counts as this many multiplications for each entry of the reduced Hessian. On mesh problems
/// the real number is larger for every order of elimination.
const PER_ENTRY: u64 = 50;

/// The work of a relaxation.
pub(crate) fn of_relaxation(model: &ReducedModel) -> u64 {
    PER_ENTRY * model.hessian().len() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_spent_is_left_no_more() {
        let mut work = Work::unlimited();
        assert!(!work.ends(1 << 60, &mut Monitor::default()));
        work.limit = (1 << 60) + 10;
        assert_eq!((work.spent(), work.left()), (1 << 60, 10));
        assert!(!work.ends(9, &mut Monitor::default()));
        assert!(work.ends(1, &mut Monitor::default()));
        work.spend(u64::MAX);
        assert_eq!(work.left(), 0);
    }
}
