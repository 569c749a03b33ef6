//! The constants of the elimination and their reasons.
//!
//! Every row is first multiplied by the power of two that brings its largest coefficient into [1, 2). This
//! has no rounding error and makes all tolerances independent of the caller's units.

/// A coefficient is noise if it is below this times the largest number used to compute its row. The tolerance
/// decides whether continuous unknowns, integers, or none remain in a row. Sums of a few thousand terms in
/// double precision carry noise of about 1e-13. Data in single precision differ by 1e-7 and must not count as
/// noise.
pub(super) const RANK: f64 = 1e-10;

/// A row without unknowns is satisfied if its right side is below this times the largest number used to
/// compute it. It is ten times [`RANK`], since right sides collect a little more rounding error than
/// coefficients.
pub(super) const CONSISTENT: f64 = 1e-9;

/// A continuous pivot is at least this times the largest continuous coefficient of its row: the threshold of
/// Markowitz pivoting (`duff1986`, section 5.4). It is low enough to leave a choice of short columns. The
/// usual 0.1 lets coefficients grow to 1e11 along random bands of ten thousand rows, which makes the
/// constraints inaccurate; 0.3 keeps them below 1e3.
pub(super) const PIVOT: f64 = 0.3;

/// If only the largest coefficient may be the pivot, coefficients of at least this share of it count as equal
/// to it. Rounding errors must not separate coefficients that the caller gave as equal.
pub(super) const LARGEST_PIVOT: f64 = 1.0 - 1e-9;

/// Numbers this close to an integer count as that integer. Rounding uses the same tolerance for ties.
pub(super) const INTEGRAL: f64 = 1e-9;

/// For large numbers the tolerance is this share of the number, where that exceeds [`INTEGRAL`].
pub(super) const INTEGRAL_RELATIVE: f64 = 1e-12;

/// A number further from an integer than this is not an integer, whatever its size.
pub(super) const INTEGRAL_LIMIT: f64 = 1e-3;

/// A computed coefficient below this counts as an integer if it is exactly one. There are 2^23 doubles
/// between neighbouring integers of this size, so an accident is unlikely.
pub(super) const TELLING: f64 = 1_073_741_824.0;

/// The largest common denominator of the ratios of a row's coefficients. A random real is within `RATIO` of
/// such a fraction with a probability of one in a thousand, so accidents are rare.
pub(super) const DENOMINATOR: f64 = 1e4;

/// Two ratios count as equal if they differ by at most this, relative to one plus their size.
pub(super) const RATIO: f64 = 1e-11;

/// A computed coefficient that must be a whole number is the nearest one if the numbers that it was computed
/// from are below this: their rounding errors are then below a hundredth.
pub(super) const WHOLE: f64 = 1e13;

/// Integers are kept below 2^53, where sums and products of doubles are exact.
pub(super) const LARGEST: f64 = 9_007_199_254_740_992.0;

/// A sum this small, relative to its terms, is set to zero at once, which keeps the pattern sparse. The
/// tolerance is that of rounding errors. If a larger number were dropped while other coefficients of its row
/// remain, later steps would magnify the error in the solution.
pub(super) const NOISE: f64 = 64.0 * f64::EPSILON;

/// Rows with more entries than this wait until no short row is left. A pivot row of `k` entries couples `k`
/// unknowns with each other. For 64 entries this costs as much as a few hundred mesh vertices; thousands of
/// entries would fill the Hessian.
pub(super) const LONG: usize = 64;

/// Returns the integer nearest to `value` if they differ by no more than the noise of numbers up to
/// `magnitude`.
pub(super) fn near_integer(value: f64, magnitude: f64) -> Option<f64> {
    let rounded = value.round();
    let tolerance = (INTEGRAL_RELATIVE * magnitude).clamp(INTEGRAL, INTEGRAL_LIMIT);
    ((value - rounded).abs() <= tolerance).then_some(rounded)
}
