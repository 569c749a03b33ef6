//! Triangles to samples: edge functions over the bounding box (Pineda 1988).

use std::ops::Range;

/// A corner on the image: column, row, nearness.
pub(super) type Corner = [f64; 3];

/// Visits every sample centre of a triangle inside the given columns and rows with its
/// barycentric weights and its nearness. Both orientations are drawn.
pub(super) fn fill(
    corners: &[Corner; 3],
    columns: Range<usize>,
    rows: Range<usize>,
    mut visit: impl FnMut(usize, usize, [f64; 3], f64),
) {
    let [a, b, c] = corners;
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    let columns = covered(corners.map(|p| p[0]), columns);
    let rows = covered(corners.map(|p| p[1]), rows);
    // The weight of corner k is linear: value at the origin, slope along columns and along rows.
    let weight: [[f64; 3]; 3] = [0, 1, 2].map(|k| {
        let (p, q) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let slope = [(p[1] - q[1]) / area, (q[0] - p[0]) / area];
        [-(slope[0] * p[0] + slope[1] * p[1]), slope[0], slope[1]]
    });
    for y in rows {
        let row = weight.map(|w| w[0] + w[2] * (y as f64 + 0.5));
        for x in columns.clone() {
            let at = x as f64 + 0.5;
            let w: [f64; 3] = std::array::from_fn(|k| row[k] + weight[k][1] * at);
            if w.iter().all(|&w| w >= 0.0) {
                let nearness = w[0] * a[2] + w[1] * b[2] + w[2] * c[2];
                visit(x, y, w, nearness);
            }
        }
    }
}

/// The samples of `range` whose centres lie between the least and the largest of `values`.
fn covered(values: [f64; 3], range: Range<usize>) -> Range<usize> {
    let low = values.iter().fold(f64::INFINITY, |m, &v| m.min(v));
    let high = values.iter().fold(f64::NEG_INFINITY, |m, &v| m.max(v));
    let first = (low - 0.5).ceil().max(range.start as f64) as usize;
    let end = (high + 0.5).floor().clamp(0.0, range.end as f64) as usize;
    first..end.max(first)
}
