//! A solve with many active rows ends with its call.

use super::super::relaxation::regularization;
use super::*;
use crate::linalg::Sparse;
use crate::monitor::{CancelToken, Monitor};

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
