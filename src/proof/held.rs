//! A certificate that bounds leaves: by its estimate where that is enough, else in exact numbers.

use std::cell::OnceCell;

use super::estimate::{Estimate, Floats};
use super::exact::Exact;
use super::fault::Checked;
use super::format::Certificate;
use super::minorant::{Minorant, PartObjective};
use super::problem::{ExactProblem, Limits};

/// A certificate with what is known of it.
pub(super) struct Held {
    pub certificate: Certificate,
    estimate: Option<Estimate>,
    /// The minorant in exact numbers, once it was needed.
    exact: OnceCell<Minorant>,
}

impl Held {
    pub fn of(
        problem: &ExactProblem,
        part: &PartObjective,
        floats: &Floats,
        certificate: Certificate,
    ) -> Self {
        Held {
            estimate: Estimate::of(problem, part, floats, &certificate),
            certificate,
            exact: OnceCell::new(),
        }
    }

    /// Whether the estimate shows that the minorant is at least the bound within the limits.
    pub fn reaches(
        &self,
        bound: &Exact,
        limits: &Limits,
        part: &PartObjective,
        floats: &Floats,
    ) -> bool {
        let estimate = self.estimate.as_ref();
        let least = estimate.map(|estimate| estimate.least(limits, part, floats));
        least
            .and_then(Exact::of)
            .is_some_and(|least| least >= *bound)
    }

    /// The minorant in exact numbers.
    ///
    /// # Errors
    /// Those of [`Minorant::of`].
    pub fn exact(
        &self,
        problem: &ExactProblem,
        limits: &Limits,
        part: &PartObjective,
    ) -> Checked<&Minorant> {
        if let Some(minorant) = self.exact.get() {
            return Ok(minorant);
        }
        let minorant = Minorant::of(problem, limits, part, &self.certificate)?;
        Ok(self.exact.get_or_init(|| minorant))
    }
}
