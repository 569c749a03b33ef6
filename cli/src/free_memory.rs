//! Memory that is free, given back to the operating system before each phase of a large run.
//!
//! The allocator keeps what the steps before have freed, and the large blocks of a factor may not fit there. A
//! factorization needs more memory at once than any other step, and extraction follows one whose factor is kept.

use std::cell::Cell;

use roundel::monitor::Phase;

/// Runs that never had so many bytes keep what they have.
const LARGE: u64 = 1 << 29;

/// When memory is given back.
#[derive(Debug, Default)]
pub struct FreeMemory {
    /// The phase of the last event.
    phase: Cell<Option<Phase>>,
}

impl FreeMemory {
    /// Gives memory back if a run enters a phase, or a part of a factorization, and is large.
    pub fn enter(&self, phase: Phase) {
        if self.is_due(phase, roundel::peak_memory()) {
            roundel::release_free_memory();
        }
    }

    fn is_due(&self, phase: Phase, peak: Option<u64>) -> bool {
        let is_next = self.phase.replace(Some(phase)) != Some(phase);
        (is_next || phase == Phase::Factor) && peak > Some(LARGE)
    }

    /// The phase that the run has entered last.
    #[cfg(test)]
    pub fn entered(&self) -> Option<Phase> {
        self.phase.get()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_given_back_at_a_new_phase_and_at_each_part_of_a_factorization() {
        let memory = FreeMemory::default();
        let large = Some(LARGE + 1);
        let phases = [
            (Phase::Eliminate, true),
            (Phase::Eliminate, false),
            (Phase::Factor, true),
            (Phase::Factor, true),
            (Phase::Round, true),
            (Phase::Round, false),
        ];
        for (phase, is_due) in phases {
            assert_eq!(memory.is_due(phase, large), is_due, "{phase:?}");
        }
        for (phase, peak) in [(Phase::Quads, Some(LARGE)), (Phase::Factor, None)] {
            assert!(!memory.is_due(phase, peak));
        }
    }
}
