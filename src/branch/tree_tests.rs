//! A node is empty only where a certificate shows it.

use super::*;
use crate::branch::presolve::Part;
use crate::branch::working_set::Ldl;
use crate::branch::{search_strengthened, with_point};
use crate::error::{Conflicting, Error};
use crate::linalg::Sparse;
use crate::problem::Problem;

/// The least energy of a form, and where it is. The search begins at `start`.
pub(in crate::branch) fn least(form: &Form, start: Option<Vec<f64>>) -> Option<(Vec<f64>, f64)> {
    let limits = Limits {
        inner: false,
        ..Limits::inner(u64::MAX)
    };
    let found = search(form, start, limits, &mut Monitor::default()).unwrap();
    assert!(found.is_complete, "{found:?}");
    found.best
}

/// The nodes of a search of the form as it is, and of one after it is strengthened.
pub(in crate::branch) fn nodes(form: &Form) -> [u64; 2] {
    let limits = Limits {
        inner: false,
        ..Limits::inner(u64::MAX)
    };
    let monitor = &mut Monitor::default();
    let found = [
        search(form, None, limits, monitor).unwrap(),
        search_strengthened(form, None, limits, monitor).unwrap(),
    ];
    found.map(|found| {
        assert!(found.is_complete);
        found.nodes
    })
}

/// The least square of two unknowns from 0 to 1 whose sum is at least 1, the first at most 0.2.
fn square() -> Form {
    let within = |lower: f64, upper: f64| Interval { lower, upper };
    let limits = vec![within(0.0, 0.2), within(0.0, 1.0)];
    Form {
        hessian: Sparse::from_triplets(2, 2, [(0, 0, 2.0), (1, 1, 2.0)].into_iter()).unwrap(),
        gradient: vec![0.0; 2],
        constant: 0.0,
        rows: Sparse::from_triplets(1, 2, [(0, 0, 1.0), (0, 1, 1.0)].into_iter()).unwrap(),
        row_limits: vec![within(1.0, f64::INFINITY)],
        origins: vec![Conflicting::Inequality(0)],
        boxes: limits.clone(),
        limits,
        integer: vec![false; 2],
    }
}

#[test]
fn a_node_that_is_empty_by_rounding_errors_alone_is_solved_again() {
    let form = square();
    let shared = Shared::new(&form, &regularization(&form)).unwrap();
    let mut monitor = Monitor::default();
    let mut tree = Tree::new(&form, &shared, Limits::inner(1), &mut monitor);
    let held = Active {
        row: 2,
        upper: false,
        multiplier: -1.0,
    };
    // The factor of the active row is far off.
    tree.relaxation.start_from(&[held]);
    tree.relaxation.solver.factor = Ldl::default();
    tree.relaxation.solver.factor.append(Vec::new(), 0.1);
    let wrong = tree.relaxation.solve(f64::INFINITY, &form.boxes);
    assert!(
        matches!(&wrong, Relaxed::Infeasible(rows) if tree.is_in_doubt(rows, &form.boxes)),
        "{wrong:?}"
    );
    let Relaxed::Solved { bound } = tree.solve(f64::INFINITY, &form.boxes) else {
        panic!("a point is left");
    };
    assert!(
        (bound - (0.2f64.powi(2) + 0.8f64.powi(2))).abs() < 1e-12,
        "{bound}"
    );
}

#[test]
fn without_a_point_a_search_is_complete_only_where_all_nodes_are_shown_to_be_empty() {
    let form = square();
    let shared = Shared::new(&form, &regularization(&form)).unwrap();
    let mut monitor = Monitor::default();
    for (done, is_complete) in [
        (f64::INFINITY, true),
        (f64::NEG_INFINITY, false),
        (1.0, false),
    ] {
        let mut tree = Tree::new(&form, &shared, Limits::inner(1), &mut monitor);
        tree.done = done;
        let found = tree.result();
        assert_eq!((found.is_complete, found.bound), (is_complete, done));
        let mut problem = Problem::new(2).unwrap();
        problem
            .add_inequality(&[0, 1], &[1.0; 2], 1.0, f64::INFINITY)
            .unwrap();
        let form = square();
        let part = Part {
            form,
            members: vec![0, 1],
        };
        let error = with_point(&problem, &[], &part, Ok(found), &monitor).unwrap_err();
        let in_doubt = Error::SearchLimit { what: "precision" };
        assert_eq!(error == in_doubt, !is_complete, "{error}");
    }
}
