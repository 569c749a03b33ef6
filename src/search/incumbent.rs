//! The best solution so far.

/// A solution in reduced unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Incumbent {
    pub point: Vec<f64>,
    pub energy: f64,
    /// A lower bound on the exact energy of every point with these integers.
    pub at_least: f64,
}
