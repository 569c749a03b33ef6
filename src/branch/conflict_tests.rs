//! The set that is named is small also where the search has fewer unknowns, or one order of choices.

use super::super::{hull, solve, symmetry};
use super::*;
use crate::error::Error;
use crate::monitor::CancelToken;
use crate::problem::Model;
use crate::search::Options;

/// The unknowns 0, 1 and 2 must not share more than 1 by twos, and share 1.6. The objective couples
/// them with `others`.
fn without_point(variables: usize, others: &[usize]) -> Problem {
    let mut problem = Problem::new(variables).unwrap();
    problem
        .set_bounds(&[0, 1, 2], &[0.0; 3], &[10.0; 3])
        .unwrap();
    let infinity = f64::INFINITY;
    for pair in [[0, 1], [0, 2], [1, 2]] {
        problem
            .add_inequality(&pair, &[1.0; 2], -infinity, 1.0)
            .unwrap();
    }
    problem
        .add_inequality(&[0, 1, 2], &[1.0; 3], 1.6, infinity)
        .unwrap();
    for j in 0..3 {
        problem.add_least_squares(&[j], &[1.0], 0.5, 1.0).unwrap();
    }
    for (k, &other) in others.iter().enumerate() {
        problem
            .add_least_squares(&[k % 3, other], &[1.0; 2], 0.5, 1.0)
            .unwrap();
    }
    // Couples the three.
    problem
        .add_least_squares(&[0, 1, 2], &[1.0; 3], 0.5, 1.0)
        .unwrap();
    problem
}

fn form_of(problem: &Problem) -> Form {
    let model = Model::new(problem).unwrap();
    Form::of(problem, &model).unwrap()
}

fn named(problem: &Problem) -> Vec<Conflicting> {
    let model = Model::new(problem).unwrap();
    let (options, mut monitor) = (Options::default(), Monitor::default());
    match solve(problem, &model, &options, None, None, None, &mut monitor) {
        Err(Error::Contradiction { elements, .. }) => elements,
        other => panic!("{other:?}"),
    }
}

/// Things that go to places that are alike.
#[test]
fn where_choices_may_change_places_the_set_is_small() {
    let (things, places) = (20, 4);
    let all: Vec<usize> = (3..3 + things * places).collect();
    let mut problem = without_point(3 + all.len(), &[]);
    for (thing, row) in all.chunks(places).enumerate() {
        problem.add_constraint(row, &[1.0; 4], 1.0).unwrap();
        for &j in row {
            problem
                .add_least_squares(&[thing % 3, j], &[1.0; 2], 0.5, 1.0)
                .unwrap();
        }
    }
    problem.set_binaries(&all).unwrap();
    assert!(symmetry::ordered(&form_of(&problem), None).is_some());
    let expected: Vec<Conflicting> = (0..4).map(Conflicting::Inequality).collect();
    assert_eq!(named(&problem), expected);
}

/// Unknowns with a copy for each of two choices.
#[test]
fn where_copies_are_left_out_the_set_is_small() {
    let groups = 20;
    let at = |group: usize| 3 + 5 * group;
    let others: Vec<usize> = (0..groups).map(at).collect();
    let mut problem = without_point(3 + 5 * groups, &others);
    for x in others {
        let (copies, choices) = ([x + 1, x + 2], [x + 3, x + 4]);
        let row = [x, copies[0], copies[1]];
        problem
            .add_constraint(&row, &[1.0, -1.0, -1.0], 0.0)
            .unwrap();
        problem.add_constraint(&choices, &[1.0; 2], 1.0).unwrap();
        problem.set_binaries(&choices).unwrap();
        problem
            .set_bounds(&copies, &[0.0; 2], &[f64::INFINITY; 2])
            .unwrap();
        for (copy, choice) in copies.into_iter().zip(choices) {
            problem
                .add_inequality(&[copy, choice], &[1.0, -8.0], f64::NEG_INFINITY, 0.0)
                .unwrap();
        }
    }
    assert!(hull::project(&form_of(&problem)).unwrap().is_some());
    let expected: Vec<Conflicting> = (0..4).map(Conflicting::Inequality).collect();
    assert_eq!(named(&problem), expected);
}

#[test]
fn the_naming_of_a_contradiction_ends_with_its_call() {
    let problem = without_point(3, &[]);
    let form = form_of(&problem);
    let members = [0, 1, 2];
    let going = Monitor::default();
    assert_eq!(of_root(&form, &going).len(), 4);
    assert_eq!(of_form(&form, &members, &going).len(), 4);
    let token = CancelToken::new();
    token.cancel();
    let over = Monitor::default().cancel_token(token);
    assert_eq!(of_root(&form, &over), []);
    // Nothing is left out: four rows, and the bounds of three unknowns.
    assert_eq!(of_form(&form, &members, &over).len(), 7);
}

#[test]
fn an_empty_range_alone_is_the_contradiction() {
    // A pin outside of the bounds of an integer, which rows couple with others.
    let mut problem = Problem::new(3).unwrap();
    problem.set_integers(&[0, 1, 2]).unwrap();
    problem
        .set_bounds(&[0, 1, 2], &[1.0, 0.0, 0.0], &[2.0, 1.0, 1.0])
        .unwrap();
    problem.pin(2, 2.0).unwrap();
    problem.add_inequality(&[1], &[2.0], 0.5, 2.0).unwrap();
    problem
        .add_inequality(&[0, 1], &[-5.0, 4.0], f64::NEG_INFINITY, 0.0)
        .unwrap();
    assert!(form_of(&problem).limits[2].is_empty());
    let named = of_form(&form_of(&problem), &[0, 1, 2], &Monitor::default());
    assert_eq!(named, [Conflicting::Bounds(2)]);
}
