//! Elimination of systems whose answer is known by hand.

use roundel::{Error, Problem};

use super::{System, reduce};

fn integers_only(rows: &[&[i64]], rhs: &[i64]) -> System {
    System {
        integers: rows[0].len(),
        continuous: 0,
        rows: rows.iter().map(|row| row.to_vec()).collect(),
        rhs: rhs.to_vec(),
    }
}

/// One constraint with real coefficients, in which all unknowns are integer.
fn fractional(row: &[f64], rhs: f64) -> Problem {
    let mut problem = Problem::new(row.len()).unwrap();
    let all: Vec<usize> = (0..row.len()).collect();
    problem.set_integers(&all).unwrap();
    problem.add_constraint(&all, row, rhs).unwrap();
    problem
}

#[test]
fn a_constraint_with_coprime_coefficients_removes_one_integer() {
    for (row, free) in [(&[2, 3][..], 1), (&[6, 10, 15], 2), (&[4, 6, 9, 25], 3)] {
        let reduced = integers_only(&[row], &[1]).reduce().unwrap();
        assert_eq!(reduced.integers().len(), free);
        assert_eq!(reduced.dim(), free);
    }
}

#[test]
fn a_common_factor_that_does_not_divide_the_right_side_is_reported_with_the_row() {
    let error = integers_only(&[&[1, 1], &[2, 4]], &[0, 3])
        .reduce()
        .unwrap_err();
    let expected = Error::NoIntegerSolution {
        constraint: 1,
        row: "2 x0 + 4 x1 = 3".into(),
    };
    assert_eq!(error, expected);
}

#[test]
fn fractional_coefficients_are_scaled_to_integers() {
    for (row, rhs) in [
        (&[0.5, 0.5][..], 1.0),
        (&[1.0 / 3.0, 2.0 / 3.0], 1.0),
        (&[0.1, 0.2, -0.3], 0.7),
        (&[1e-6, 3e-6], 4e-6),
        (&[2f64.sqrt(), 2f64.sqrt()], 3.0 * 2f64.sqrt()),
    ] {
        let reduced = reduce(&fractional(row, rhs)).unwrap();
        assert_eq!(reduced.integers().len(), row.len() - 1, "{row:?}");
        let x = reduced.expansion().expand(&vec![7.0; reduced.dim()]);
        let sum: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
        assert!((sum - rhs).abs() < 1e-12, "{row:?}");
        assert!(x.iter().all(|v| v.fract() == 0.0), "{row:?}");
    }
    let halves = reduce(&fractional(&[0.5, 1.5], 0.25)).unwrap_err();
    assert!(matches!(
        halves,
        Error::NoIntegerSolution { constraint: 0, .. }
    ));
}

#[test]
fn incommensurable_integer_coefficients_are_not_supported() {
    let error = reduce(&fractional(&[1.0, 2f64.sqrt()], 0.0)).unwrap_err();
    assert!(matches!(error, Error::NotSupported { index: Some(0), .. }));
}

#[test]
fn integers_coupled_by_continuous_unknowns_are_solved_exactly() {
    // 0.3 c + z0 = 0.1 and 0.9 c + 2 z1 + z2 = 0.3 leave 3 z0 = 2 z1 + z2, in any unit.
    for unit in [1.0, 1e-7, 1e6, 1e15, 1e20] {
        let mut problem = Problem::new(4).unwrap();
        problem.set_integers(&[1, 2, 3]).unwrap();
        problem.add_constraint(&[0, 1], &[0.3, 1.0], 0.1).unwrap();
        problem
            .add_constraint(&[0, 2, 3], &[0.9 * unit, 2.0 * unit, unit], 0.3 * unit)
            .unwrap();
        let reduced = reduce(&problem).unwrap();
        let counts = (reduced.integers().len(), reduced.continuous().len());
        assert_eq!(counts, (2, 0), "in units of {unit}");
        let x = reduced.expansion().expand(&[4.0, -3.0]);
        assert_eq!(3.0 * x[1], 2.0 * x[2] + x[3], "in units of {unit}");
    }
}

#[test]
fn integers_beyond_two_to_the_53_are_an_overflow_of_their_constraint() {
    let large = 3f64.powi(33);
    let mut problem = fractional(&[large, -2.0, 0.0, 0.0], 1.0);
    problem
        .add_constraint(&[1, 2], &[large, -2.0], 1.0)
        .unwrap();
    problem
        .add_constraint(&[2, 3], &[large, -2.0], 1.0)
        .unwrap();
    let error = reduce(&problem).unwrap_err();
    assert!(
        matches!(error, Error::Overflow { index: Some(_), .. }),
        "{error}"
    );
    let beyond = reduce(&fractional(&[1.0, 1.0], 1e16)).unwrap_err();
    assert!(matches!(beyond, Error::Overflow { index: Some(0), .. }));
}

#[test]
fn numbers_that_leave_the_range_of_doubles_are_an_overflow() {
    let mut problem = Problem::new(2).unwrap();
    problem
        .add_constraint(&[0, 1], &[1e-300, 1e-300], 1e300)
        .unwrap();
    let error = reduce(&problem).unwrap_err();
    assert!(matches!(error, Error::Overflow { index: Some(0), .. }));
}

#[test]
fn a_pin_that_breaks_a_constraint_reports_the_constraint() {
    let mut problem = Problem::new(3).unwrap();
    problem.add_constraint(&[1, 2], &[1.0, 1.0], 0.0).unwrap();
    problem.add_constraint(&[0, 1], &[1.0, 1.0], 3.0).unwrap();
    problem.pin(0, 1.0).unwrap();
    problem.pin(1, 1.0).unwrap();
    let expected = Error::Infeasible {
        constraint: 1,
        row: "x0 + x1 = 3".into(),
    };
    assert_eq!(reduce(&problem).unwrap_err(), expected);
    problem.pin(1, 2.0).unwrap();
    let reduced = reduce(&problem).unwrap();
    assert_eq!(reduced.expansion().expand(&[]), [1.0, 2.0, -2.0]);
}

#[test]
fn an_empty_row_holds_only_with_a_zero_right_side() {
    for (rhs, holds) in [(0.0, true), (1.0, false), (-1e-3, false)] {
        let mut problem = Problem::new(1).unwrap();
        problem.add_constraint(&[], &[], rhs).unwrap();
        problem.add_constraint(&[0, 0], &[1.0, -1.0], rhs).unwrap();
        assert_eq!(reduce(&problem).is_ok(), holds, "{rhs}");
    }
}

#[test]
fn the_guess_is_carried_over_to_the_reduced_unknowns() {
    // The elimination may choose any free unknowns. A guess that satisfies the constraint is reproduced.
    let mut problem = fractional(&[2.0, 3.0, 7.0], 1.0);
    problem.set_guess(&[4.0, 0.0, -1.0]).unwrap();
    let reduced = reduce(&problem).unwrap();
    let x = reduced.expansion().expand(reduced.guess());
    assert_eq!(x, [4.0, 0.0, -1.0]);
}
