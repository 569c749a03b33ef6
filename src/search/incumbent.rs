//! The best solution so far.

/// A solution in reduced unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Incumbent {
    pub point: Vec<f64>,
    pub energy: f64,
    /// An upper bound on the exact energy if rounding errors matter, otherwise the energy.
    pub(super) at_most: f64,
}
