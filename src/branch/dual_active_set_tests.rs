//! A solve with many active rows ends with its call, and one without a point ends.

use super::super::relaxation::regularization;
use super::*;
use crate::error::Conflicting;
use crate::linalg::Sparse;
use crate::monitor::{CancelToken, Monitor};
use crate::test_random::Random;

/// The least square of `n` unknowns that are at least 1: all bounds become active.
fn crowded(n: usize) -> Form {
    let diagonal = (0..n as u32).map(|i| (i, i, 1.0));
    let limits = vec![
        Interval {
            lower: 1.0,
            upper: f64::INFINITY,
        };
        n
    ];
    Form {
        hessian: Sparse::from_triplets(n, n, diagonal).unwrap(),
        gradient: vec![0.0; n],
        constant: 0.0,
        rows: Sparse::from_triplets(0, n, std::iter::empty()).unwrap(),
        row_limits: Vec::new(),
        origins: Vec::new(),
        boxes: limits.clone(),
        limits,
        integer: vec![false; n],
    }
}

#[test]
fn a_solve_ends_with_its_call() {
    let form = crowded(400);
    let shared = Shared::new(&form, &regularization(&form)).unwrap();
    let solved = || {
        let mut solver = DualActiveSet::new(&form, &shared);
        (
            solver.solve(f64::INFINITY, u64::MAX / 2),
            solver.active().len(),
        )
    };
    assert_eq!(solved(), (Outcome::Optimal, 400));
    let token = CancelToken::new();
    token.cancel();
    let _watch = Monitor::default().cancel_token(token).watch();
    let (outcome, active) = solved();
    assert!(
        outcome == Outcome::Stopped && active < 400,
        "{outcome:?}, {active}"
    );
}

/// An oscillator that switches from -1 to 1 push for some times, with at most a third as many changes as times. The
/// unknowns are the states, two for each time; the switches; and the sizes of their changes, which have no curvature.
fn pushed(times: usize, random: &mut Random) -> Form {
    let within = |lower: f64, upper: f64| Interval { lower, upper };
    let stiffness = 0.1 * (0.5 + 2.5 * random.unit());
    let state = |t: usize| 2 * t as u32;
    let switch = |t: usize| (2 * (times + 1) + t) as u32;
    let change = |t: usize| (2 * (times + 1) + times + t) as u32;
    let (mut entries, mut sides) = (Vec::new(), Vec::new());
    let mut add = |row: &[(u32, f64)], limits: Interval| {
        entries.extend(row.iter().map(|&(j, a)| (sides.len() as u32, j, a)));
        sides.push(limits);
    };
    for i in 0..2 {
        add(&[(i, 1.0)], Interval::point(4.0 * random.unit() - 2.0));
    }
    for t in 0..times {
        let (x, v) = (state(t), state(t) + 1);
        add(
            &[(state(t + 1), 1.0), (x, -1.0), (v, -0.3)],
            Interval::point(0.0),
        );
        let pushes = [
            (state(t + 1) + 1, 1.0),
            (x, stiffness),
            (v, -0.95),
            (switch(t), -0.5),
        ];
        add(&pushes, Interval::point(0.0));
    }
    for t in 0..times - 1 {
        for sign in [1.0, -1.0] {
            let row = [(switch(t + 1), sign), (switch(t), -sign), (change(t), -1.0)];
            add(&row, within(f64::NEG_INFINITY, 0.0));
        }
    }
    let changes: Vec<(u32, f64)> = (0..times - 1).map(|t| (change(t), 1.0)).collect();
    add(&changes, within(f64::NEG_INFINITY, (times / 3) as f64));
    let mut limits = vec![within(-5.0, 5.0); 2 * (times + 1)];
    limits.extend(vec![within(-1.0, 1.0); times]);
    limits.extend(vec![within(0.0, 2.0); times - 1]);
    let n = limits.len();
    let weights = |j: u32| if j.is_multiple_of(2) { 2.0 } else { 0.2 };
    let squares = (2..2 * (times as u32 + 1)).map(|j| (j, j, weights(j)));
    let target = |j: usize| match j {
        j if j.is_multiple_of(2) && j <= 2 * times => -2.4 * (0.2 * j as f64 - 0.4).sin(),
        _ => 0.0,
    };
    Form {
        hessian: Sparse::from_triplets(n, n, squares).unwrap(),
        gradient: (0..n).map(target).collect(),
        constant: 0.0,
        rows: Sparse::from_triplets(sides.len(), n, entries.into_iter()).unwrap(),
        origins: (0..sides.len()).map(Conflicting::Inequality).collect(),
        row_limits: sides,
        boxes: limits.clone(),
        integer: (0..n)
            .map(|j| (2 * (times + 1)..3 * times + 2).contains(&j))
            .collect(),
        limits,
    }
}

#[test]
fn rows_that_depend_on_the_active_ones_do_not_become_active_by_rounding_errors() {
    let mut random = Random::new(3);
    let mut empty = 0;
    for _ in 0..100 {
        let times = 20;
        let form = pushed(times, &mut random);
        let shared = Shared::new(&form, &regularization(&form)).unwrap();
        let mut solver = DualActiveSet::new(&form, &shared);
        let most = 20 * (form.dim() + form.rows.rows() + 10) as u64;
        // Switches become fixed, each at random, until no point is left.
        for t in 0..times {
            let value = random.below(3) as f64 - 1.0;
            solver.set_limits(2 * (times + 1) + t, Interval::point(value));
            match solver.solve(f64::INFINITY, most) {
                Outcome::Optimal => {}
                Outcome::Infeasible(_) => {
                    empty += 1;
                    break;
                }
                outcome => panic!("{outcome:?} after {} iterations", solver.iterations),
            }
        }
    }
    assert!(empty > 50, "{empty}");
}
