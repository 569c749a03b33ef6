//! Triangles to samples: edge functions over the bounding box (`pineda1988`).

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

#[cfg(test)]
mod tests {
    use super::*;

    /// The samples of a triangle, and the sums of weights off one.
    fn samples(corners: [Corner; 3]) -> Vec<(usize, usize)> {
        let mut found = Vec::new();
        fill(&corners, 0..16, 0..16, |x, y, w, _| {
            assert!((w.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            found.push((x, y));
        });
        found
    }

    #[test]
    fn two_triangles_of_a_rectangle_cover_its_samples() {
        let (a, b, c, d) = (
            [2.2, 3.2, 1.0],
            [9.7, 3.2, 1.0],
            [9.7, 7.9, 1.0],
            [2.2, 7.9, 1.0],
        );
        let mut found = samples([a, b, c]);
        found.extend(samples([a, d, c]));
        found.sort_unstable();
        found.dedup();
        let all = (2..10).flat_map(|x| (3..8).map(move |y| (x, y)));
        let inside = all.filter(|&(x, _)| x < 10 && x as f64 + 0.5 <= 9.7);
        assert_eq!(found, inside.collect::<Vec<_>>());
    }

    #[test]
    fn what_lies_outside_of_the_image_or_has_no_area_has_no_samples() {
        let far = [[-9.0, -9.0, 1.0], [-3.0, -9.0, 1.0], [-3.0, -2.0, 1.0]];
        let behind = [[90.0, 9.0, 1.0], [93.0, 9.0, 1.0], [93.0, 12.0, 1.0]];
        let line = [[1.0, 1.0, 1.0], [5.0, 5.0, 1.0], [9.0, 9.0, 1.0]];
        for corners in [far, behind, line] {
            assert!(samples(corners).is_empty(), "{corners:?}");
        }
    }

    #[test]
    fn nearness_is_that_of_the_plane() {
        let plane = |x: f64, y: f64| 0.3 * x - 0.1 * y + 2.0;
        let corner = |x: f64, y: f64| [x, y, plane(x, y)];
        let corners = [corner(0.5, 1.0), corner(13.0, 3.0), corner(4.0, 15.0)];
        fill(&corners, 0..16, 0..16, |x, y, _, nearness| {
            let expected = plane(x as f64 + 0.5, y as f64 + 0.5);
            assert!((nearness - expected).abs() < 1e-12);
        });
    }
}
