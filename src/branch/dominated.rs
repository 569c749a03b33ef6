//! Bounds that some best point satisfies, though not all points do.
//!
//! Where a real unknown costs nothing on its way up, or gains, each point stays a point, and no worse, when the
//! unknown rises to the first limit in its way. So the least of what these limits may be bounds it from below; the
//! same holds downwards (`achterberg2020`, dual fixing and its kin).

use super::form::{Form, Interval};
use crate::linalg::Sparse;

/// The form with such bounds.
pub(super) fn with_bounds(form: &Form) -> Form {
    let columns = form.rows.transpose();
    let mut is_curved = vec![false; form.dim()];
    for (i, j, _) in form.hessian.entries() {
        is_curved[i as usize] = true;
        is_curved[j as usize] = true;
    }
    let mut form = form.clone();
    for j in (0..form.dim()).filter(|&j| !form.integer[j] && !is_curved[j]) {
        for sign in [1.0, -1.0] {
            let reached = reach(&form, &columns, &is_curved, j, sign);
            let Some(reached) = reached.filter(|r| r.is_finite()) else {
                continue;
            };
            let implied = if sign > 0.0 {
                Interval {
                    lower: reached,
                    ..Interval::ALL
                }
            } else {
                Interval {
                    upper: -reached,
                    ..Interval::ALL
                }
            };
            let new = form.limits[j].and(implied);
            if !new.is_empty() {
                form.limits[j] = new;
                form.boxes[j] = form.boxes[j].and(new);
            }
        }
    }
    form
}

/// How far `sign` times an unknown rises at least, if no point gets worse by that.
fn reach(form: &Form, columns: &Sparse, is_curved: &[bool], j: usize, sign: f64) -> Option<f64> {
    let mut cost = sign * form.gradient[j];
    let end = |j: usize, sign: f64| sign * form.limits[j].side(sign);
    let mut reached = end(j, sign);
    for (i, a) in columns.row(j) {
        let sides = form.row_limits[i];
        let is_slack = |k: usize| {
            let is_free = form.limits[k] == Interval::ALL && !form.integer[k] && !is_curved[k];
            k != j && is_free && columns.row(k).len() == 1
        };
        if let Some((k, b)) = form.rows.row(i).find(|&(k, _)| is_slack(k)) {
            // The slack moves against the unknown.
            if !sides.is_point() {
                return None;
            }
            cost -= sign * a / b * form.gradient[k];
            continue;
        }
        // The row as an upper side of what rises.
        let up = sign * a.signum();
        let side = up * sides.side(up);
        if side.is_finite() {
            let others = form.rows.row(i).filter(|&(k, _)| k != j);
            let most: f64 = others.map(|(k, b)| b.abs() * end(k, up * b.signum())).sum();
            reached = reached.min((side - most) / a.abs());
        }
    }
    (cost <= 0.0).then_some(reached)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Conflicting;

    #[test]
    fn an_unknown_that_gains_rises_to_its_rows() {
        // Maximise t = x0 with x0 <= 2 x1, x1 in [1, 3] and t free: some best point has x0 >= 2.
        let entries = [(0, 0, 1.0), (0, 1, -2.0), (1, 0, 1.0), (1, 2, -1.0)];
        let limits = vec![
            Interval::ALL,
            Interval {
                lower: 1.0,
                upper: 3.0,
            },
            Interval::ALL,
        ];
        let mut form = Form {
            hessian: Sparse::from_triplets(3, 3, std::iter::empty()).unwrap(),
            gradient: vec![0.0, 0.0, -1.0],
            constant: 0.0,
            rows: Sparse::from_triplets(2, 3, entries.into_iter()).unwrap(),
            row_limits: vec![
                Interval {
                    lower: f64::NEG_INFINITY,
                    upper: 0.0,
                },
                Interval::point(0.0),
            ],
            origins: vec![Conflicting::Inequality(0), Conflicting::Constraint(0)],
            boxes: limits.clone(),
            limits,
            integer: vec![false; 3],
        };
        assert_eq!(with_bounds(&form).limits[0].lower, 2.0);
        // Where it costs, it stays free.
        form.gradient[2] = 1.0;
        assert_eq!(with_bounds(&form).limits[0], Interval::ALL);
    }
}
