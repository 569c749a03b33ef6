//! Cuts hold at all points with integers, and cut off the minimiser.

use super::*;
use crate::error::Conflicting;
use crate::test_random::Random;

fn within(lower: f64, upper: f64) -> Interval {
    Interval { lower, upper }
}

/// A form without an objective.
fn form(rows: &[(&[(u32, f64)], Interval)], limits: Vec<Interval>, integer: Vec<bool>) -> Form {
    let n = limits.len();
    let entries = rows.iter().enumerate();
    let entries = entries.flat_map(|(i, (row, _))| row.iter().map(move |&(j, a)| (i as u32, j, a)));
    Form {
        hessian: Sparse::zeros(n, n),
        gradient: vec![0.0; n],
        constant: 0.0,
        rows: Sparse::from_triplets(rows.len(), n, entries).unwrap(),
        row_limits: rows.iter().map(|(_, sides)| *sides).collect(),
        origins: (0..rows.len()).map(Conflicting::Inequality).collect(),
        boxes: limits.clone(),
        limits,
        integer,
    }
}

/// What is left of a row after a point.
fn slack(cut: &Cut, x: &[f64]) -> f64 {
    let taken: f64 = cut.row.iter().map(|&(j, a)| a * x[j as usize]).sum();
    cut.side - taken
}

fn cuts(form: &Form, point: &[f64]) -> Vec<Cut> {
    let mut rounding = Rounding::new(form, point);
    let mut cuts = Vec::new();
    (0..form.rows.rows()).for_each(|i| rounding.separate(i, &mut cuts));
    cuts
}

#[test]
fn the_fraction_of_the_right_side_bounds_a_real() {
    // `z <= y + 2.5` implies `z <= 2 + 2 y`.
    let limits = vec![within(0.0, 9.0), within(0.0, 9.0)];
    let form = form(
        &[(&[(0, 1.0), (1, -1.0)], within(-99.0, 2.5))],
        limits,
        vec![true, false],
    );
    let cuts = cuts(&form, &[2.5, 0.0]);
    assert!(!cuts.is_empty());
    for cut in &cuts {
        let z = cut.row[0];
        assert_eq!(z.0, 0);
        for (x, left) in [([2.0, 0.0], 0.0), ([3.0, 0.5], 0.0), ([2.5, 0.0], -0.5)] {
            let scaled = slack(cut, &x) / z.1;
            assert!((scaled - left).abs() < 1e-12, "{cut:?}");
        }
    }
}

#[test]
fn what_is_stored_is_made() {
    // In two times, `x_1 = s_1 + 4`, `s_1 + x_2 = s_2 + 4`, `x_t <= 10 y_t`: what is made first is made at a time that
    // is on.
    let rows: [(&[(u32, f64)], Interval); 4] = [
        (&[(0, 1.0), (2, -1.0)], Interval::point(4.0)),
        (&[(1, 1.0), (2, 1.0), (3, -1.0)], Interval::point(4.0)),
        (&[(0, 1.0), (4, -10.0)], within(-10.0, 0.0)),
        (&[(1, 1.0), (5, -10.0)], within(-10.0, 0.0)),
    ];
    let mut limits = vec![within(0.0, 10.0); 4];
    limits.extend([within(0.0, 1.0); 2]);
    let integer = vec![false, false, false, false, true, true];
    let form = form(&rows, limits, integer);
    let point = [4.0, 4.0, 0.0, 0.0, 0.4, 0.4];
    let cuts = cuts(&form, &point);
    // `x_1 <= 4 y_1 + s_1` and `x_2 <= 4 y_2 + s_2`.
    for (x, is_cut) in [
        ([4.0, 4.0, 0.0, 0.0, 1.0, 1.0], false),
        ([8.0, 0.0, 4.0, 0.0, 1.0, 0.0], false),
        ([4.0, 4.0, 0.0, 0.0, 0.9, 1.0], true),
        ([4.0, 4.0, 0.0, 0.0, 1.0, 0.9], true),
    ] {
        let least = cuts
            .iter()
            .map(|cut| slack(cut, &x))
            .fold(f64::INFINITY, f64::min);
        assert_eq!(least < -1e-12, is_cut, "{x:?} {cuts:?}");
    }
}

#[test]
fn cuts_hold_at_all_points_with_integers() {
    let mut random = Random::new(5);
    let (mut made, mut tight) = (0, 0);
    for _ in 0..20_000 {
        let n = 4 + random.below(5);
        let integer: Vec<bool> = (0..n).map(|_| random.below(2) == 0).collect();
        let limits: Vec<Interval> = (0..n)
            .map(|_| {
                let lower = random.below(7) as f64 - 3.0;
                within(lower, lower + 1.0 + random.below(4) as f64)
            })
            .collect();
        // Points, many of which are at limits.
        let points: Vec<Vec<f64>> = (0..12)
            .map(|_| {
                let x = limits.iter().zip(&integer).map(|(limits, is_integer)| {
                    let x = limits.lower + limits.width() * random.unit();
                    match (is_integer, random.below(4)) {
                        (true, _) => x.round(),
                        (false, 0) => limits.lower,
                        (false, 1) => limits.upper,
                        (false, _) => x,
                    }
                });
                x.collect()
            })
            .collect();
        // Rows that they all satisfy, each as close as it can be.
        let rows: Vec<Vec<(u32, f64)>> = (0..3 + random.below(4))
            .map(|_| {
                let size = 2 + random.below(3);
                let mut row: Vec<(u32, f64)> = (0..size)
                    .map(|_| {
                        let a = match random.below(2) {
                            0 => random.below(9) as f64 - 4.5,
                            _ => 10.0 * random.unit() - 5.0,
                        };
                        (random.below(n) as u32, a)
                    })
                    .collect();
                row.sort_by_key(|(j, _)| *j);
                row.dedup_by_key(|(j, _)| *j);
                row
            })
            .collect();
        let sided: Vec<(&[(u32, f64)], Interval)> = rows
            .iter()
            .map(|row| {
                let value = |x: &Vec<f64>| row.iter().map(|&(j, a)| a * x[j as usize]).sum::<f64>();
                let values = points.iter().map(value);
                let upper = values.clone().fold(f64::NEG_INFINITY, f64::max);
                let lower = match random.below(2) {
                    0 => values.fold(f64::INFINITY, f64::min),
                    _ => f64::NEG_INFINITY,
                };
                (&row[..], within(lower, upper))
            })
            .collect();
        let form = form(&sided, limits.clone(), integer);
        let relaxed: Vec<f64> = (0..n)
            .map(|j| {
                let weight = random.unit();
                weight * points[0][j] + (1.0 - weight) * points[1][j]
            })
            .collect();
        for cut in cuts(&form, &relaxed) {
            made += 1;
            assert!(slack(&cut, &relaxed) < -FAR * 0.1, "{cut:?}");
            let least = points
                .iter()
                .map(|x| slack(&cut, x))
                .fold(f64::INFINITY, f64::min);
            assert!(least > -1e-9, "{least} {cut:?} {form:?}");
            tight += usize::from(least < 1e-9);
        }
    }
    assert!(made > 1000 && tight > 100, "{made} {tight}");
}
