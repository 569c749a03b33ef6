//! The elimination of Bommes' thesis keeps the unknowns that the thesis says.

use roundel::Ordering;
use roundel::internals::eliminate::Elimination;
use roundel::{Model, Monitor, Problem};

/// The original unknowns that are also reduced unknowns.
fn kept(problem: &Problem, ordering: Ordering) -> Vec<usize> {
    let model = Model::new(problem).unwrap();
    let mut monitor = Monitor::default();
    let elimination = Elimination::new(&model, ordering, &mut monitor).unwrap();
    let reduced = elimination.reduce(&model, &mut monitor).unwrap();
    let point: Vec<f64> = (0..reduced.dim())
        .map(|k| (k as f64 + 2.0).sqrt())
        .collect();
    let x = reduced.expansion().expand(&point);
    (0..x.len()).filter(|&i| point.contains(&x[i])).collect()
}

#[test]
fn the_first_largest_continuous_unknown_is_eliminated_however_many_rows_contain_it() {
    let mut problem = Problem::new(6).unwrap();
    problem
        .add_constraint(&[0, 1, 2], &[1.0, -3.0, 3.0], 0.5)
        .unwrap();
    for other in [3, 4, 5] {
        let row = [0, 1, 2, other];
        problem
            .add_constraint(&row, &[0.0, 1.0, 1.0, 9.0], 1.0)
            .unwrap();
    }
    assert_eq!(kept(&problem, Ordering::LargestPivot), [0, 2]);
    assert_eq!(kept(&problem, Ordering::FillReducing), [1, 2]);
}

#[test]
fn a_continuous_unknown_and_then_the_first_unit_integer_are_eliminated() {
    let mut problem = Problem::new(7).unwrap();
    problem.set_integers(&[0, 1, 2, 3]).unwrap();
    problem
        .add_constraint(&[0, 1, 2], &[2.0, 1.0, 1.0], 4.0)
        .unwrap();
    for other in [4, 5] {
        let row = [1, 3, other];
        problem
            .add_constraint(&row, &[1.0, 1.0, 0.25], 0.5)
            .unwrap();
    }
    assert_eq!(kept(&problem, Ordering::LargestPivot), [0, 2, 3, 6]);
    assert_eq!(kept(&problem, Ordering::FillReducing), [0, 1, 3, 6]);
}

#[test]
fn the_largest_coefficient_of_a_long_row_is_eliminated() {
    let n = 100;
    let mut problem = Problem::new(n).unwrap();
    let all: Vec<usize> = (0..n).collect();
    let mut weights = vec![1.0; n];
    weights[n - 1] = 1.5;
    problem.add_constraint(&all, &weights, 3.0).unwrap();
    let expected: Vec<usize> = (0..n - 1).collect();
    assert_eq!(kept(&problem, Ordering::LargestPivot), expected);
}
