//! What is held loses no energy, and comes back to within all limits.

use super::*;
use crate::{Model, Problem};

fn form_of(problem: &Problem) -> Form {
    Form::of(problem, &Model::new(problem).unwrap()).unwrap()
}

/// `(y - 2 x - 1.4)^2` with integers `x >= 20` and `y >= -3`, and a row `y + x >= 50`.
fn from_some_step_on() -> Problem {
    let mut problem = Problem::new(2).unwrap();
    let infinite = f64::INFINITY;
    problem
        .add_least_squares(&[0, 1], &[-2.0, 1.0], 1.4, 1.0)
        .unwrap();
    problem
        .set_bounds(&[0, 1], &[20.0, -3.0], &[infinite; 2])
        .unwrap();
    problem
        .add_inequality(&[0, 1], &[1.0, 1.0], 50.0, infinite)
        .unwrap();
    problem.set_integers(&[0, 1]).unwrap();
    problem
}

#[test]
fn limits_that_hold_from_some_step_on_are_left_out() {
    let form = form_of(&from_some_step_on());
    let held = held(&form).unwrap().unwrap();
    assert!(
        held.form
            .row_limits
            .iter()
            .all(|sides| *sides == Interval::ALL)
    );
    assert_eq!((held.departures.len(), held.holds.len()), (1, 1));
    let (hold, direction) = (&held.holds[0], &held.holds[0].direction);
    assert_eq!(hold.held, 0);
    assert_eq!(held.form.limits, [Interval::point(0.0), Interval::ALL]);
    assert_eq!(direction[1].1, 2.0 * direction[0].1);
    // The way back ends at the first point within all limits, and the energy is the same everywhere.
    let point = vec![0.0, 1.0];
    let back = held.moved_back(point.clone());
    assert_eq!(back, [20.0, 41.0]);
    assert!((form.energy(&back) - form.energy(&point)).abs() < 1e-12);
    assert_eq!(held.moved(back), point);
    let within = vec![30.0, 61.0];
    assert_eq!(held.moved_back(within.clone()), within);
}

#[test]
fn a_ray_leaves_no_limit_that_was_left_out() {
    let form = form_of(&from_some_step_on());
    let held = held(&form).unwrap().unwrap();
    assert_eq!(held.ray_moved_back(vec![0.0, -1.0]), [0.5, 0.0]);
    assert_eq!(held.ray_moved_back(vec![0.0, 1.0]), [0.0, 1.0]);
}

/// `(2 y - 3 x)^2` is the same where x moves by 2 and y by 3.
#[test]
fn as_many_values_are_left_as_the_direction_moves_by() {
    let mut problem = Problem::new(2).unwrap();
    problem
        .add_least_squares(&[0, 1], &[-3.0, 2.0], 1.0, 1.0)
        .unwrap();
    problem.set_integers(&[0, 1]).unwrap();
    let held = held(&form_of(&problem)).unwrap().unwrap();
    let window = Interval {
        lower: 0.0,
        upper: 1.0,
    };
    assert_eq!(held.form.limits, [window, Interval::ALL]);
    assert_eq!(held.moved(vec![-7.0, 2.0]), [1.0, 14.0]);
    assert_eq!(held.moved(vec![8.0, 2.0]), [0.0, -10.0]);
    assert_eq!(held.moved_back(vec![1.0, 14.0]), [1.0, 14.0]);
}

#[test]
fn what_a_limit_holds_stays_as_it_is() {
    let mut bounded = from_some_step_on();
    bounded.set_bounds(&[1], &[-3.0], &[90.0]).unwrap();
    let mut in_row = from_some_step_on();
    in_row
        .add_inequality(&[0, 1], &[1.0, 1.0], -f64::INFINITY, 99.0)
        .unwrap();
    for problem in [bounded, in_row] {
        assert!(held(&form_of(&problem)).unwrap().is_none());
    }
}

/// Two chains that no row connects move apart.
#[test]
fn each_of_several_directions_holds_an_integer() {
    let mut problem = Problem::new(4).unwrap();
    for j in [0, 2] {
        problem
            .add_least_squares(&[j, j + 1], &[1.0, -1.0], 0.3, 1.0)
            .unwrap();
    }
    problem.set_integers(&[0, 1, 2, 3]).unwrap();
    let held = held(&form_of(&problem)).unwrap().unwrap();
    assert_eq!(held.holds.len(), 2);
    let moved = held.moved(vec![5.0, 6.0, -7.0, -9.0]);
    let differences = [moved[1] - moved[0], moved[3] - moved[2]];
    assert_eq!(differences, [1.0, -2.0]);
    let fixed = held
        .form
        .limits
        .iter()
        .filter(|limits| limits.width() == 0.0);
    assert_eq!(fixed.count(), 2);
}
