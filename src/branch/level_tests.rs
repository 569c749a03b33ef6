//! Directions are found whole, in sums of others, and not where something holds them.

use super::*;
use crate::{Model, Problem};

fn form_of(problem: &Problem) -> Form {
    Form::of(problem, &Model::new(problem).unwrap()).unwrap()
}

/// A chain of differences of integers, and a real number that lies `0.25` times the first of them behind.
fn chain(n: usize) -> Problem {
    let mut problem = Problem::new(n + 1).unwrap();
    for j in 1..n {
        problem
            .add_least_squares(&[j - 1, j], &[-1.0, 1.0], 0.4, 1.0)
            .unwrap();
    }
    problem
        .add_least_squares(&[0, n], &[-0.25, 1.0], 0.3, 1.0)
        .unwrap();
    problem.set_integers(&(0..n).collect::<Vec<_>>()).unwrap();
    problem
}

#[test]
fn differences_stay_when_all_move() {
    let form = form_of(&chain(4));
    let basis = forth_and_back(&form).unwrap();
    assert_eq!(basis.len(), 1);
    let by = basis[0][0].1;
    assert!(by.abs() == 1.0, "{by}");
    let all = [(0, by), (1, by), (2, by), (3, by), (4, 0.25 * by)];
    assert_eq!(basis[0], all);
    assert!(is_level(&form, &basis[0]));
    assert!(!is_level(&form, &vec![(0, 1.0), (1, 1.0)]));
}

#[test]
fn a_bound_a_row_and_a_slope_hold_a_direction() {
    let mut bounded = chain(4);
    bounded.set_bounds(&[2], &[-5.0], &[f64::INFINITY]).unwrap();
    let mut in_row = chain(4);
    in_row
        .add_inequality(&[1, 3], &[1.0, 1.0], 0.0, 9.0)
        .unwrap();
    let mut falling = chain(4);
    falling.add_linear(&[0.0, 0.0, 1.0, 0.0, 0.0]).unwrap();
    for problem in [bounded, in_row, falling] {
        assert_eq!(
            forth_and_back(&form_of(&problem)).unwrap(),
            Vec::<Direction>::new()
        );
    }
}

/// `x - 2 y >= -3` and `y - 3 x >= 1` hold further and further away for `(-1, -1)`, and for neither unknown alone.
#[test]
fn a_sum_of_directions_leads_away_from_what_none_does() {
    let mut problem = Problem::new(2).unwrap();
    let infinite = f64::INFINITY;
    problem
        .add_inequality(&[0, 1], &[1.0, -2.0], -3.0, infinite)
        .unwrap();
    problem
        .add_inequality(&[0, 1], &[-3.0, 1.0], 1.0, infinite)
        .unwrap();
    problem.set_integers(&[0, 1]).unwrap();
    let form = form_of(&problem);
    let leads_away = |d: &Direction| {
        let mut moves = [0.0; 2];
        d.iter().for_each(|&(j, d)| moves[j as usize] = d);
        let [x, y] = moves;
        x - 2.0 * y > 0.0 && y - 3.0 * x > 0.0
    };
    let found = away(&form).unwrap();
    assert!(found.iter().any(leads_away), "{found:?}");
    // With `x >= 0`, every direction leads to a row.
    problem.add_inequality(&[0], &[1.0], 0.0, infinite).unwrap();
    assert_eq!(away(&form_of(&problem)).unwrap(), Vec::<Direction>::new());
}

#[test]
fn steps_of_integers_are_whole() {
    let mut problem = Problem::new(3).unwrap();
    problem.add_constraint(&[0, 1], &[3.0, -2.0], 0.0).unwrap();
    problem.add_constraint(&[0, 2], &[1.0, -7.0], 0.0).unwrap();
    problem.set_integers(&[0, 1]).unwrap();
    let basis = forth_and_back(&form_of(&problem)).unwrap();
    let sign = basis[0][0].1.signum();
    assert_eq!(
        basis,
        [[(0, 2.0 * sign), (1, 3.0 * sign), (2, sign * 2.0 / 7.0)]]
    );
    // No multiple of the square root of two is whole.
    let mut problem = Problem::new(2).unwrap();
    problem
        .add_constraint(&[0, 1], &[2f64.sqrt(), -1.0], 0.0)
        .unwrap();
    problem.set_integers(&[0, 1]).unwrap();
    assert_eq!(
        forth_and_back(&form_of(&problem)).unwrap(),
        Vec::<Direction>::new()
    );
}

/// A tenth has no exact double: sums of tenths are zero but for rounding errors.
#[test]
fn rounding_errors_of_decimals_do_not_count() {
    assert_eq!(sum([0.1, 0.2, -0.3].into_iter()), 0.0);
    assert_ne!(0.1 + 0.2 - 0.3, 0.0);
    assert_ne!(sum([0.1, 0.2, -0.3 + 1e-12].into_iter()), 0.0);
}

#[test]
fn fractions_with_small_denominators_are_found() {
    for (numerator, denominator) in [
        (0.0, 1.0),
        (1.0, 3.0),
        (-22.0, 7.0),
        (355.0, 113.0),
        (-5.0, 1.0),
    ] {
        assert_eq!(
            fraction(numerator / denominator),
            Some((numerator, denominator))
        );
        assert_eq!(
            fraction(numerator / denominator + 1e-10),
            Some((numerator, denominator))
        );
    }
    assert_eq!(fraction(std::f64::consts::PI), None);
    assert_eq!(fraction(f64::NAN), None);
    assert_eq!(fraction(f64::INFINITY), None);
}
