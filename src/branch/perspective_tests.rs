//! The reformulated form has the same energies at all points with integers, and a larger bound.

use super::super::form::Interval;
use super::super::tree::tests::least;
use super::*;
use crate::error::Conflicting;
use crate::linalg::Random;

fn within(lower: f64, upper: f64) -> Interval {
    Interval { lower, upper }
}

/// `x^2 - 2 x + cost z` with `0 <= x <= 2 z`.
fn switched(cost: f64) -> Form {
    let limits = vec![within(0.0, f64::INFINITY), within(0.0, 1.0)];
    let entries = [(0, 0, 1.0), (0, 1, -2.0)];
    Form {
        hessian: Sparse::from_triplets(2, 2, [(0, 0, 2.0)].into_iter()).unwrap(),
        gradient: vec![-2.0, cost],
        constant: 0.0,
        rows: Sparse::from_triplets(1, 2, entries.into_iter()).unwrap(),
        row_limits: vec![within(f64::NEG_INFINITY, 0.0)],
        origins: vec![Conflicting::Inequality(0)],
        boxes: limits.clone(),
        limits,
        integer: vec![false, true],
    }
}

/// Customers, each of which is served by some of the places that are open (facility location with squares), in the
/// order x of the first customer, x of the second one, and so on, then the binaries of the places. The share of each
/// second place may be negative: such places have rows for both sides.
fn places(customers: usize, places: usize, random: &mut Random) -> Form {
    let n = customers * places + places;
    let mut entries: Vec<(u32, u32, f64)> = Vec::new();
    let mut sides = Vec::new();
    let mut limits = Vec::new();
    for i in 0..customers {
        let all = (0..places).map(|j| (i * places + j) as u32);
        entries.extend(all.map(|x| (sides.len() as u32, x, 1.0)));
        sides.push(Interval::point(1.0));
        for j in 0..places {
            let (x, z) = ((i * places + j) as u32, (customers * places + j) as u32);
            let row = sides.len() as u32;
            entries.extend([(row, x, 1.0), (row, z, -1.0)]);
            sides.push(within(f64::NEG_INFINITY, 0.0));
            if j % 2 == 0 {
                limits.push(within(0.0, f64::INFINITY));
            } else {
                entries.extend([(row + 1, x, -2.0), (row + 1, z, -1.0)]);
                sides.push(within(f64::NEG_INFINITY, 0.0));
                limits.push(Interval::ALL);
            }
        }
    }
    limits.extend(vec![within(0.0, 1.0); places]);
    let positive = |random: &mut Random| 0.1 + random.symmetric().abs();
    let squares = (0..customers * places).map(|x| (x as u32, x as u32, positive(random)));
    let squares: Vec<_> = squares.collect();
    Form {
        hessian: Sparse::from_triplets(n, n, squares.into_iter()).unwrap(),
        gradient: (0..n)
            .map(|j| match j < customers * places {
                true => 0.2 * random.symmetric(),
                false => positive(random),
            })
            .collect(),
        constant: 0.5,
        rows: Sparse::from_triplets(sides.len(), n, entries.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        limits,
        integer: (0..n).map(|j| j >= customers * places).collect(),
    }
}

fn bound(form: &Form) -> f64 {
    let shared = Shared::new(form, &regularization(form)).unwrap();
    match Relaxation::new(form, &shared).solve(f64::INFINITY, &form.boxes) {
        Relaxed::Solved { bound } => bound,
        other => panic!("{other:?}"),
    }
}

fn of(form: &Form) -> Form {
    let monitor = &mut Monitor::default();
    let found = strengthened(form, monitor).unwrap();
    found.expect("a larger bound").form
}

#[test]
fn the_bound_is_that_of_the_perspective() {
    // `x^2 / z - 2 x + cost z` is least at `x = z`, and there it is `(cost - 1) z`.
    for cost in [1.5, 0.5] {
        let form = switched(cost);
        let expected = (cost - 1.0_f64).min(0.0);
        assert!(bound(&form) < expected - 0.05);
        let found = bound(&of(&form));
        assert!(
            found <= expected + 1e-9 && found > expected - 1e-3,
            "{found} {expected}"
        );
    }
}

#[test]
fn energies_stay_the_same_where_binaries_are_integers() {
    let mut random = Random::new(3);
    for _ in 0..20 {
        let form = places(3, 4, &mut random);
        let next = of(&form);
        for code in 0..16 {
            let open = |j: usize| f64::from(code >> j & 1);
            let share = |x: usize, random: &mut Random| open(x % 4) * random.symmetric();
            let mut x: Vec<f64> = (0..12).map(|x| share(x, &mut random)).collect();
            x.extend((0..4).map(open));
            let error = next.energy(&x) - form.energy(&x);
            assert!(error.abs() < 1e-13, "{error}");
        }
    }
}

#[test]
fn the_least_energy_stays_and_the_bound_comes_near_it() {
    let mut random = Random::new(4);
    let mut gaps = [0.0; 2];
    for _ in 0..20 {
        let form = places(4, 5, &mut random);
        let next = of(&form);
        let (_, energy) = least(&form, None).unwrap();
        let (point, again) = least(&next, None).unwrap();
        assert!((energy - again).abs() < 1e-8, "{energy} {again}");
        assert!((form.energy(&point) - energy).abs() < 1e-8);
        for (gap, form) in gaps.iter_mut().zip([&form, &next]) {
            let bound = bound(form);
            assert!(bound <= energy + 1e-9);
            *gap += energy - bound;
        }
    }
    assert!(gaps[1] < 0.3 * gaps[0], "{gaps:?}");
}

/// Least squares with at most two unknowns that are not zero, which Q couples.
fn subset(unknowns: usize, random: &mut Random) -> Form {
    let n = unknowns as u32;
    let rows: Vec<Vec<f64>> = (0..2 * n)
        .map(|_| (0..n).map(|_| random.symmetric()).collect())
        .collect();
    let product = |i: u32, j: u32| rows.iter().map(|r| r[i as usize] * r[j as usize]).sum();
    let pairs = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    let hessian: Vec<_> = pairs.map(|(i, j)| (i, j, product(i, j))).collect();
    let mut entries = Vec::new();
    for j in 0..n {
        entries.extend([(2 * j, j, 1.0), (2 * j, n + j, -3.0)]);
        entries.extend([(2 * j + 1, j, 1.0), (2 * j + 1, n + j, 3.0)]);
        entries.push((2 * n, n + j, 1.0));
    }
    let mut sides = Vec::new();
    for _ in 0..n {
        sides.extend([within(f64::NEG_INFINITY, 0.0), within(0.0, f64::INFINITY)]);
    }
    sides.push(within(f64::NEG_INFINITY, 2.0));
    let mut limits = vec![Interval::ALL; unknowns];
    limits.extend(vec![within(0.0, 1.0); unknowns]);
    let linear = (0..2 * n).map(|j| if j < n { 2.0 * random.symmetric() } else { 0.0 });
    Form {
        hessian: Sparse::from_triplets(2 * unknowns, 2 * unknowns, hessian.into_iter()).unwrap(),
        gradient: linear.collect(),
        constant: 0.0,
        rows: Sparse::from_triplets(sides.len(), 2 * unknowns, entries.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        limits,
        integer: (0..2 * n).map(|j| j >= n).collect(),
    }
}

#[test]
fn a_part_of_the_diagonal_is_enough_where_unknowns_are_coupled() {
    let mut random = Random::new(6);
    for _ in 0..20 {
        let form = subset(6, &mut random);
        let next = of(&form);
        let (_, energy) = least(&form, None).unwrap();
        let (point, again) = least(&next, None).unwrap();
        assert!((energy - again).abs() < 1e-8, "{energy} {again}");
        assert!((form.energy(&point) - energy).abs() < 1e-8);
        let bounds = [&form, &next].map(bound);
        assert!(
            bounds[0] < bounds[1] && bounds[1] <= energy + 1e-9,
            "{bounds:?} {energy}"
        );
    }
}

#[test]
fn a_square_that_is_not_switched_off_is_left_alone() {
    let mut form = switched(1.5);
    form.row_limits[0].upper = 0.5;
    assert!(links(&form).unwrap().is_empty());
    form = switched(1.5);
    form.limits[0].lower = -1.0;
    assert!(links(&form).unwrap().is_empty());
    form = switched(1.5);
    form.integer[1] = false;
    assert!(links(&form).unwrap().is_empty());
    assert_eq!(links(&switched(1.5)).unwrap().len(), 1);
}
