//! The constants of the elimination, each with its reason.
//!
//! Every row is first multiplied by the power of two that brings its largest coefficient into
//! [1, 2). That costs no accuracy, and makes all that follows independent of the units in which
//! the caller wrote the row.

/// Coefficients below this, times the largest number that took part in their row, are noise. The
/// tolerance decides whether continuous unknowns, integers, or none remain in a row. Sums of a few
/// thousand terms in double precision carry noise of about 1e-13; data given in single precision, which
/// must not pass for noise, differ by 1e-7.
pub(super) const RANK: f64 = 1e-10;

/// A row without unknowns holds when its right side is below this times the largest number that
/// took part in it. It is ten times [`RANK`], since right sides gather a little more rounding errors
/// than coefficients.
pub(super) const CONSISTENT: f64 = 1e-9;

/// A continuous pivot is at least this times the largest continuous coefficient of its row: the
/// threshold of Markowitz pivoting (`duff1986`, section 5.4), low enough to leave a
/// choice among short columns. The usual 0.1 lets coefficients grow to 1e11 along random bands of
/// ten thousand rows, which costs the accuracy of the constraints; 0.3 keeps them below 1e3.
pub(super) const PIVOT: f64 = 0.3;

/// Coefficients at least this part of the largest count as the largest where only that may be
/// solved for: rounding must not separate coefficients that the caller gave as equal.
pub(super) const LARGEST_PIVOT: f64 = 1.0 - 1e-9;

/// Numbers this close to an integer count as that integer. Roundings use the same tolerance for ties.
pub(super) const INTEGRAL: f64 = 1e-9;

/// For large numbers the tolerance is this share of the number, where that exceeds [`INTEGRAL`].
pub(super) const INTEGRAL_RELATIVE: f64 = 1e-12;

/// A number further from an integer than this is not an integer, whatever its size.
pub(super) const INTEGRAL_LIMIT: f64 = 1e-3;

/// A computed coefficient below this that is an integer to the last bit is taken for an integer. There are
/// 2^23 doubles between neighbouring integers of this size, so it is hardly one by accident.
pub(super) const TELLING: f64 = 1_073_741_824.0;

/// The common denominator of a row's coefficient ratios is at most this. Any real is within
/// `RATIO` of such a fraction with a chance of one in a thousand, so accidents are rare.
pub(super) const DENOMINATOR: f64 = 1e4;

/// Two ratios are the same when they differ by this, relative to one plus their size.
pub(super) const RATIO: f64 = 1e-11;

/// Integers are kept below 2^53, where sums and products of doubles are exact.
pub(super) const LARGEST: f64 = 9_007_199_254_740_992.0;

/// A sum this small, relative to its terms, is set to zero at once, which keeps the pattern sparse. The
/// tolerance is that of rounding: a larger number, dropped while other coefficients of its row remain,
/// would be an error in the solution that later steps magnify.
pub(super) const NOISE: f64 = 64.0 * f64::EPSILON;

/// Rows with more entries than this wait until the short ones are gone. As a pivot, a row of `k`
/// entries couples `k` unknowns with each other: 64 of them cost what a few hundred mesh vertices
/// cost, thousands would fill the Hessian.
pub(super) const LONG: usize = 64;

/// `value` if it is an integer up to the noise of a computation with numbers up to `magnitude`.
pub(super) fn near_integer(value: f64, magnitude: f64) -> Option<f64> {
    let rounded = value.round();
    let tolerance = (INTEGRAL_RELATIVE * magnitude).clamp(INTEGRAL, INTEGRAL_LIMIT);
    ((value - rounded).abs() <= tolerance).then_some(rounded)
}
