//! Cubic B-splines over uniform knots, fitted to points at equal distances of the parameter.
//!
//! `piegl1997`, sections 2.2 and 9.4. Ends are interpolated: first and last control points are the first and last
//! points. The others are the least-squares fit, with a small weight on second differences of control points, which
//! decides where there are fewer points than unknowns.

use crate::mesh::vector::{Vec3, add, scale, sub};

pub(super) const DEGREE: usize = 3;

/// The weight of second differences. They are in the same unit as distances of points.
const FAIRNESS: f64 = 1e-7;

/// The clamped knots of `spans` equal intervals in [0, 1].
pub(super) fn knots(spans: usize) -> Vec<f64> {
    let knot = |i: usize| i.saturating_sub(DEGREE).min(spans) as f64 / spans as f64;
    (0..spans + 2 * DEGREE + 1).map(knot).collect()
}

/// The four basis functions that are not zero at a parameter, and the number of the first.
pub(super) fn basis(spans: usize, t: f64) -> (usize, [f64; DEGREE + 1]) {
    let knots = knots(spans);
    let span = ((t * spans as f64) as usize).min(spans - 1);
    let at = span + DEGREE;
    let mut values = [1.0, 0.0, 0.0, 0.0];
    for degree in 1..=DEGREE {
        let mut carried = 0.0;
        for r in 0..degree {
            let (right, left) = (knots[at + r + 1], knots[at + 1 + r - degree]);
            let part = values[r] / (right - left);
            values[r] = carried + (right - t) * part;
            carried = (t - left) * part;
        }
        values[degree] = carried;
    }
    (span, values)
}

/// The fit of splines of so many spans to the ends of so many steps. It is linear in the points.
pub(super) struct Fit {
    steps: usize,
    spans: usize,
    /// Basis functions at every point.
    basis: Vec<(usize, [f64; DEGREE + 1])>,
    /// The inner control points, each as a combination of the points less what the ends contribute.
    inner: Vec<Vec<f64>>,
    /// The inner control points that fairness alone gives, as a combination of the two ends.
    of_ends: Vec<[f64; 2]>,
}

impl Fit {
    pub(super) fn new(steps: usize, spans: usize) -> Self {
        let basis: Vec<_> = (0..=steps)
            .map(|i| basis(spans, i as f64 / steps as f64))
            .collect();
        let count = spans + DEGREE - 2;
        let mut matrix = vec![vec![0.0; count]; count];
        // Right sides: one column for every point, then those of the two ends.
        let mut sides = vec![vec![0.0; steps + 3]; count];
        for (i, (first, values)) in basis.iter().enumerate() {
            for (j, &value) in inner_entries(*first, values, count) {
                sides[j][i] += value;
                for (k, &other) in inner_entries(*first, values, count) {
                    matrix[j][k] += value * other;
                }
            }
        }
        let weight = FAIRNESS * (steps + 1) as f64;
        for i in 0..count {
            // The second difference of control points i, i + 1 and i + 2 of all, whose inner ones begin at 1.
            for (a, x) in [1.0, -2.0, 1.0].into_iter().enumerate() {
                let Some(row) = (i + a).checked_sub(1).filter(|&row| row < count) else {
                    continue;
                };
                for (b, y) in [1.0, -2.0, 1.0].into_iter().enumerate() {
                    match i + b {
                        0 => sides[row][steps + 1] -= weight * x * y,
                        last if last == count + 1 => sides[row][steps + 2] -= weight * x * y,
                        column => matrix[row][column - 1] += weight * x * y,
                    }
                }
            }
        }
        solve(&mut matrix, &mut sides);
        let of_ends = sides
            .iter()
            .map(|row| [row[steps + 1], row[steps + 2]])
            .collect();
        sides.iter_mut().for_each(|row| row.truncate(steps + 1));
        Fit {
            steps,
            spans,
            basis,
            inner: sides,
            of_ends,
        }
    }

    /// The control points of the spline that fits these points, between given ends.
    pub(super) fn control(&self, points: &[Vec3], ends: [Vec3; 2]) -> Vec<Vec3> {
        let last = self.spans + DEGREE - 1;
        let rest: Vec<Vec3> = (0..=self.steps)
            .map(|i| {
                let (first, values) = &self.basis[i];
                (0..=DEGREE).fold(points[i], |rest, k| match first + k {
                    0 => sub(rest, scale(ends[0], values[k])),
                    j if j == last => sub(rest, scale(ends[1], values[k])),
                    _ => rest,
                })
            })
            .collect();
        let inner = self.inner.iter().zip(&self.of_ends).map(|(row, of_ends)| {
            let fair = add(scale(ends[0], of_ends[0]), scale(ends[1], of_ends[1]));
            let terms = row.iter().zip(&rest);
            terms.fold(fair, |sum, (&factor, &point)| {
                add(sum, scale(point, factor))
            })
        });
        let mut control = vec![ends[0]];
        control.extend(inner);
        control.push(ends[1]);
        control
    }

    /// The point of a spline at the end of a step.
    pub(super) fn point(&self, control: &[Vec3], step: usize) -> Vec3 {
        let (first, values) = &self.basis[step];
        (0..=DEGREE).fold([0.0; 3], |sum, k| {
            add(sum, scale(control[first + k], values[k]))
        })
    }
}

/// The basis functions of inner control points, counted from the first inner one.
fn inner_entries(
    first: usize,
    values: &[f64; DEGREE + 1],
    count: usize,
) -> impl Iterator<Item = (usize, &f64)> {
    let numbered = values.iter().enumerate();
    numbered.filter_map(move |(k, value)| {
        let inner = (first + k).checked_sub(1)?;
        (inner < count).then_some((inner, value))
    })
}

/// Solves with a small positive definite matrix, in place, by elimination.
fn solve(matrix: &mut [Vec<f64>], sides: &mut [Vec<f64>]) {
    let count = matrix.len();
    for pivot in 0..count {
        for row in pivot + 1..count {
            let factor = matrix[row][pivot] / matrix[pivot][pivot];
            if factor == 0.0 {
                continue;
            }
            let (above, below) = matrix.split_at_mut(row);
            let entries = below[0].iter_mut().zip(&above[pivot]);
            entries.skip(pivot).for_each(|(x, y)| *x -= factor * y);
            let (above, below) = sides.split_at_mut(row);
            below[0]
                .iter_mut()
                .zip(&above[pivot])
                .for_each(|(x, y)| *x -= factor * y);
        }
    }
    for row in (0..count).rev() {
        for column in row + 1..count {
            let factor = matrix[row][column];
            let (above, below) = sides.split_at_mut(column);
            above[row]
                .iter_mut()
                .zip(&below[0])
                .for_each(|(x, y)| *x -= factor * y);
        }
        let diagonal = matrix[row][row];
        sides[row].iter_mut().for_each(|x| *x /= diagonal);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::vector::norm;

    fn fitted(steps: usize, spans: usize, curve: impl Fn(f64) -> Vec3) -> f64 {
        let points: Vec<Vec3> = (0..=steps)
            .map(|i| curve(i as f64 / steps as f64))
            .collect();
        let fit = Fit::new(steps, spans);
        let control = fit.control(&points, [points[0], points[steps]]);
        assert_eq!(control.len(), spans + DEGREE);
        let off = (0..=steps).map(|i| norm(sub(fit.point(&control, i), points[i])));
        off.fold(0.0, f64::max)
    }

    #[test]
    fn basis_functions_sum_to_one_and_are_not_negative() {
        for spans in 1..6 {
            for i in 0..=40 {
                let (first, values) = basis(spans, f64::from(i) / 40.0);
                assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                assert!(values.iter().all(|&x| x >= -1e-15) && first + DEGREE < spans + DEGREE);
            }
        }
    }

    #[test]
    fn cubics_are_met() {
        let cubic = |t: f64| [t, t * t - 0.5 * t, 2.0 * t * t * t - t];
        for (steps, spans) in [(3, 1), (8, 1), (8, 2), (20, 5)] {
            assert!(fitted(steps, spans, cubic) < 1e-4, "{steps} {spans}");
        }
    }

    #[test]
    fn more_spans_fit_a_circle_better_and_few_points_are_enough() {
        let circle = |t: f64| [t.sin(), t.cos(), 0.0];
        let arc = |t: f64| circle(3.0 * t);
        assert!(fitted(30, 8, arc) < 0.02 * fitted(30, 1, arc));
        for (steps, spans) in [(1, 1), (2, 1), (2, 4), (4, 8)] {
            assert!(fitted(steps, spans, arc) < 1e-4, "{steps} {spans}");
        }
    }
}
