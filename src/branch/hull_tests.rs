//! Forms with and without copies have the same least energy.

use super::super::tree::tests::least;
use super::*;
use crate::error::Conflicting;
use crate::linalg::Random;

const UP_TO_ZERO: Interval = Interval {
    lower: f64::NEG_INFINITY,
    upper: 0.0,
};

/// Places on a line, each pair of which is kept apart by one of two choices, by a convex hull with copies.
fn apart(places: u32, random: &mut Random) -> Form {
    let mut limits: Vec<Interval> = (0..places)
        .map(|_| Interval {
            lower: random.symmetric().max(0.0),
            upper: 8.0 + random.symmetric(),
        })
        .collect();
    let targets: Vec<f64> = (0..places)
        .map(|_| 4.0 + 3.0 * random.symmetric())
        .collect();
    let weights: Vec<f64> = (0..places).map(|_| 2.0 + random.symmetric()).collect();
    let mut integer = vec![false; places as usize];
    let mut entries = Vec::new();
    let mut sides = Vec::new();
    for i in 0..places {
        for j in 0..i {
            let first = limits.len() as u32;
            let (copies, choices) = ([first, first + 2], [first + 4, first + 5]);
            let positive = Interval {
                lower: 0.0,
                upper: f64::INFINITY,
            };
            limits.extend([positive; 4]);
            limits.extend(
                [Interval {
                    lower: 0.0,
                    upper: 1.0,
                }; 2],
            );
            integer.extend([false, false, false, false, true, true]);
            let mut row = |row: &[(u32, f64)], own: Interval| {
                let at = sides.len() as u32;
                entries.extend(row.iter().map(|&(j, a)| (at, j, a)));
                sides.push(own);
            };
            for (place, copy) in [(i, copies[0]), (j, copies[1])] {
                row(
                    &[(place, -1.0), (copy, 1.0), (copy + 1, 1.0)],
                    Interval::point(0.0),
                );
                for k in 0..2 {
                    let most = 8.0 + random.symmetric();
                    row(&[(copy + k, 1.0), (choices[k as usize], -most)], UP_TO_ZERO);
                }
            }
            let width = 1.5 + random.symmetric();
            row(
                &[(copies[0], 1.0), (copies[1], -1.0), (choices[0], width)],
                UP_TO_ZERO,
            );
            row(
                &[
                    (copies[0] + 1, -1.0),
                    (copies[1] + 1, 1.0),
                    (choices[1], width),
                ],
                UP_TO_ZERO,
            );
            row(
                &[(choices[0], 1.0), (choices[1], 1.0)],
                Interval::point(1.0),
            );
        }
    }
    let n = limits.len();
    let hessian = (0..places).map(|i| (i, i, 2.0 * weights[i as usize]));
    let mut gradient = vec![0.0; n];
    for (i, target) in targets.iter().enumerate() {
        gradient[i] = -2.0 * weights[i] * target;
    }
    Form {
        hessian: Sparse::from_triplets(n, n, hessian).unwrap(),
        gradient,
        constant: 0.0,
        rows: Sparse::from_triplets(sides.len(), n, entries.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        limits,
        integer,
    }
}

#[test]
fn the_least_energy_is_the_same_without_copies() {
    let mut random = Random::new(3);
    let mut solved = 0;
    for case in 0..60 {
        let form = apart(2 + case % 3, &mut random);
        let projected = project(&form).unwrap().expect("the form has copies");
        let pairs = form.integer.iter().filter(|i| **i).count() / 2;
        assert_eq!(form.dim() - projected.form.dim(), 4 * pairs);
        let (with, without) = (least(&form, None), least(&projected.form, None));
        let (Some((_, energy)), Some((point, other))) = (&with, &without) else {
            assert_eq!(with.is_some(), without.is_some());
            continue;
        };
        solved += 1;
        assert!(
            (energy - other).abs() < 1e-7 * energy.abs().max(1.0),
            "{energy} {other}"
        );
        let whole = projected.with_copies(point);
        assert!((form.energy(&whole) - other).abs() < 1e-9 * other.abs().max(1.0));
        for (value, sides) in form.rows.mul(&whole).iter().zip(&form.row_limits) {
            assert!(*value > sides.lower - 1e-7 && *value < sides.upper + 1e-7);
        }
    }
    assert!(solved > 30, "{solved}");
}

#[test]
fn copies_in_a_row_of_two_choices_stay() {
    let mut form = apart(2, &mut Random::new(1));
    let (rows, n) = (form.rows.rows(), form.dim());
    // One copy of each choice.
    let more = [(rows as u32, 2, 1.0), (rows as u32, 3, 1.0)];
    let entries: Vec<_> = form.rows.entries().chain(more).collect();
    form.rows = Sparse::from_triplets(rows + 1, n, entries.into_iter()).unwrap();
    form.row_limits.push(Interval::point(4.0));
    form.origins.push(Conflicting::Inequality(rows));
    assert!(project(&form).unwrap().is_none());
}
