//! An unknown expressed by others.

/// The equation `x_pivot = constant + terms`. The terms contain unknowns that were free when it was made. The
/// constant depends on the right sides; `right_sides` computes it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Substitution {
    pub pivot: u32,
    /// The constraint it comes from; [`NO_CONSTRAINT`](Self::NO_CONSTRAINT) for a pin.
    pub constraint: u32,
    /// The largest coefficient among the terms.
    pub largest: f64,
    /// The magnitude of the row that it comes from; see `Row::magnitude`.
    pub magnitude: f64,
    /// A whole number that turns all coefficients of the terms into whole numbers, if one is known.
    pub denominator: Option<f64>,
}

impl Substitution {
    /// The `constraint` of a pinned unknown.
    pub const NO_CONSTRAINT: u32 = u32::MAX;
}
