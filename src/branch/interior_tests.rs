//! The interior-point method and the dual active-set method agree.

use super::super::propagate::Propagator;
use super::super::relaxation::{Relaxation, Relaxed, regularization};
use super::super::shared::Shared;
use super::*;
use crate::error::Conflicting;
use crate::linalg::{Random, Sparse};
use crate::monitor::{CancelToken, Monitor};

/// Random squares of two unknowns each, equations, two-sided rows and bounds around a point.
fn random_form(n: u32, random: &mut Random) -> Form {
    let point: Vec<f64> = (0..n).map(|_| random.symmetric()).collect();
    let squares = (0..n).map(|i| (i, i, 1.5 + random.symmetric()));
    let mut hessian: Vec<_> = squares.collect();
    hessian.extend((1..n).map(|i| (i, i - 1, 0.2)));
    let (mut entries, mut sides) = (Vec::new(), Vec::new());
    for i in 0..n {
        let row = [i, (i + 7) % n, (3 * i + 1) % n].map(|j| (i, j, 2.0 * random.symmetric()));
        let value: f64 = row.iter().map(|(_, j, a)| a * point[*j as usize]).sum();
        entries.extend(row);
        sides.push(match i % 4 {
            0 if i < n / 2 => Interval::point(value),
            1 => Interval {
                lower: value - 0.1,
                upper: value + 0.2,
            },
            2 => Interval {
                lower: f64::NEG_INFINITY,
                upper: value,
            },
            _ => Interval {
                lower: value,
                upper: f64::INFINITY,
            },
        });
    }
    let limits: Vec<Interval> = (0..n as usize)
        .map(|j| match j % 5 {
            0 => Interval::point(point[j]),
            1 => Interval {
                lower: point[j],
                upper: point[j] + 1.0,
            },
            2 => Interval {
                lower: f64::NEG_INFINITY,
                upper: point[j] + 0.1,
            },
            _ => Interval::ALL,
        })
        .collect();
    let size = n as usize;
    Form {
        hessian: Sparse::from_triplets(size, size, hessian.into_iter()).unwrap(),
        gradient: (0..n).map(|_| 3.0 * random.symmetric()).collect(),
        constant: 1.0,
        rows: Sparse::from_triplets(sides.len(), size, entries.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        limits,
        integer: vec![false; size],
    }
}

fn inside(form: &Form) -> Ended {
    let mut boxes = form.limits.clone();
    Propagator::new(form)
        .all(form, &mut boxes, true, 5)
        .unwrap();
    solve(form, &form.limits, &boxes)
}

#[test]
fn both_methods_have_the_same_minimiser_and_bound() {
    let mut random = Random::new(9);
    for _ in 0..20 {
        let form = random_form(40, &mut random);
        let shared = Shared::new(&form, &regularization(&form)).unwrap();
        let bounds = [false, true].map(|is_inside| {
            let mut relaxation = Relaxation::new(&form, &shared);
            relaxation.interior = is_inside.then(|| Propagator::new(&form));
            match relaxation.solve(f64::INFINITY, &form.boxes) {
                Relaxed::Solved { bound } => (bound, relaxation.solver.point().to_vec()),
                other => panic!("{other:?}"),
            }
        });
        let [(first, expected), (second, found)] = &bounds;
        assert!((first - second).abs() < 1e-7, "{first} {second}");
        for (x, y) in expected.iter().zip(found) {
            assert!((x - y).abs() < 1e-5, "{x} {y}");
        }
        assert!(form.energy(expected) > second - 1e-9);
    }
}

#[test]
fn it_is_for_many_rows_that_are_sparse() {
    let mut random = Random::new(9);
    for (rows, is_chosen) in [(40, false), (ROWS as u32, true)] {
        let form = random_form(rows, &mut random);
        let shared = Shared::new(&form, &regularization(&form)).unwrap();
        let relaxation = Relaxation::new(&form, &shared);
        assert_eq!(relaxation.interior.is_some(), is_chosen, "{rows}");
    }
    let mut dense = random_form(ROWS as u32, &mut random);
    let all = (0..ROWS as u32).flat_map(|i| (0..50).map(move |j| (i, j, 1.0)));
    dense.rows = Sparse::from_triplets(ROWS, ROWS, all).unwrap();
    assert!(!is_for(&dense));
}

#[test]
fn rows_without_a_point_are_found() {
    let mut form = random_form(40, &mut Random::new(9));
    // The sum of three rows is far from what each of them allows.
    let entries: Vec<_> = form.rows.entries().collect();
    let sum = (2..5).flat_map(|i| form.rows.row(i).map(|(j, a)| (40, j as u32, a)));
    let all: Vec<_> = entries.into_iter().chain(sum).collect();
    let most: f64 = [form.row_limits[2].upper, form.row_limits[3].lower]
        .iter()
        .sum();
    let equation = form.row_limits[4].lower;
    form.row_limits[3] = Interval::point(form.row_limits[3].lower);
    form.row_limits.push(Interval {
        lower: most + equation + 5.0,
        upper: f64::INFINITY,
    });
    form.origins.push(Conflicting::Inequality(40));
    form.rows = Sparse::from_triplets(41, 40, all.into_iter()).unwrap();
    form.limits.fill(Interval {
        lower: -100.0,
        upper: 100.0,
    });
    assert!(matches!(
        solve(&form, &form.limits, &form.limits),
        Ended::Empty(_)
    ));
}

#[test]
fn a_solve_ends_with_its_call() {
    let form = random_form(40, &mut Random::new(9));
    assert!(matches!(inside(&form), Ended::Solved { .. }));
    let token = CancelToken::new();
    token.cancel();
    let _watch = Monitor::default().cancel_token(token).watch();
    assert!(matches!(inside(&form), Ended::Stopped));
}
