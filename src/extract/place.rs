//! Exact areas in the plane, and barycentric coordinates.

/// Twice the signed area of a triangle, exactly.
pub(super) fn doubled_area(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i128 {
    let d = |p: [i64; 2], axis: usize| i128::from(p[axis] - a[axis]);
    d(b, 0) * d(c, 1) - d(b, 1) * d(c, 0)
}

/// Barycentric coordinates of a point, clamped to the triangle; those of the centroid in a triangle
/// without area.
pub(super) fn barycentric(corners: [[i64; 2]; 3], p: [i64; 2]) -> [f64; 3] {
    /// A point closer to a corner or an edge than this counts as on it: the map is not more exact.
    const ON: f64 = 1e-7;
    let [a, b, c] = corners;
    let whole = doubled_area(a, b, c);
    if whole == 0 {
        return [1.0 / 3.0; 3];
    }
    let parts = [
        doubled_area(p, b, c),
        doubled_area(a, p, c),
        doubled_area(a, b, p),
    ];
    let parts = parts.map(|part| part as f64 / whole as f64);
    let parts = parts.map(|part| if part < ON { 0.0 } else { part });
    let sum: f64 = parts.iter().sum();
    parts.map(|part| part / sum)
}
