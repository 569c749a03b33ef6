//! The integer solutions before and after elimination, compared by enumeration.

use proptest::prelude::*;
use roundel::Error;
use roundel::internals::eliminate::ReducedModel;

use super::exact::{Verdict, rank, verdict};
use super::{System, box_points, violation};
use roundel::Model;

/// The largest absolute value of the integers that are enumerated.
const RADIUS: i64 = 4;

fn systems() -> impl Strategy<Value = System> {
    (1usize..=4, 0usize..=2, 1usize..=3).prop_flat_map(|(integers, continuous, rows)| {
        let n = integers + continuous;
        // Zeros are frequent, so that some rows have integers only.
        let coefficient = prop_oneof![2 => Just(0i64), 3 => -6i64..=6];
        let row = prop::collection::vec(coefficient, n);
        (
            prop::collection::vec(row, rows),
            prop::collection::vec(-8i64..=8, rows),
        )
            .prop_map(move |(rows, rhs)| System {
                integers,
                continuous,
                rows,
                rhs,
            })
    })
}

/// The integer point `y` of the reduced unknowns that expands to the integers `z`.
fn coordinates(reduced: &ReducedModel, z: &[i64]) -> Option<Vec<f64>> {
    let m = reduced.integers().len();
    let t = reduced.expansion();
    let column = |y: usize| reduced.integers().iter().position(|&i| i as usize == y);
    let mut rows = vec![vec![0i64; m + 1]; z.len()];
    for (i, row) in rows.iter_mut().enumerate() {
        for (y, v) in t.matrix().row(i) {
            row[column(y).expect("integers reach integers only")] = v as i64;
        }
        row[m] = z[i] - t.offset()[i] as i64;
    }
    // The columns are independent, so each coordinate has one candidate, found by elimination.
    let solve = |k: usize| {
        let mut order: Vec<usize> = (0..m).filter(|&j| j != k).collect();
        order.extend([k, m]);
        let permuted: Vec<Vec<i64>> = rows
            .iter()
            .map(|row| order.iter().map(|&j| row[j]).collect())
            .collect();
        let (rest, _) = super::exact::eliminate_columns(&permuted, m - 1);
        let row = rest.iter().find(|row| row[m - 1] != 0)?;
        (row[m] % row[m - 1] == 0).then(|| (row[m] / row[m - 1]) as f64)
    };
    let found: Option<Vec<f64>> = (0..m).map(solve).collect();
    let mut y = vec![0.0; reduced.dim()];
    for (&i, v) in reduced.integers().iter().zip(found?) {
        y[i as usize] = v;
    }
    let x = t.expand(&y);
    (0..z.len()).all(|i| x[i] == z[i] as f64).then_some(y)
}

/// Whether some continuous unknowns complete `z` to a solution.
fn completes(system: &System, z: &[i64]) -> bool {
    let side =
        |row: &[i64], d: i64| -> i64 { d - row.iter().zip(z).map(|(a, z)| a * z).sum::<i64>() };
    let left: Vec<Vec<i64>> = system
        .rows
        .iter()
        .map(|row| row[system.integers..].to_vec())
        .collect();
    let sides = system
        .rows
        .iter()
        .zip(&system.rhs)
        .map(|(row, &d)| side(row, d));
    if system.continuous == 0 {
        return sides.into_iter().all(|s| s == 0);
    }
    let both: Vec<Vec<i64>> = left
        .iter()
        .zip(sides)
        .map(|(row, s)| [row.as_slice(), &[s]].concat())
        .collect();
    rank(&left) == rank(&both)
}

proptest! {
    #[test]
    fn every_integer_solution_is_kept_and_none_is_invented(system in systems()) {
        let Ok(reduced) = system.reduce() else {
            prop_assert_ne!(verdict(&system), Verdict::Solvable);
            for z in box_points(system.integers, RADIUS) {
                prop_assert!(!completes(&system, &z), "{z:?} was lost");
            }
            return Ok(());
        };
        prop_assert_eq!(reduced.dim(), system.unknowns() - rank(&system.rows));
        for z in box_points(system.integers, RADIUS) {
            if completes(&system, &z) {
                prop_assert!(coordinates(&reduced, &z).is_some(), "{z:?} was lost");
            }
        }
        let model = Model::new(&system.problem().unwrap()).unwrap();
        for point in box_points(reduced.dim(), 2) {
            let mut y: Vec<f64> = point.iter().map(|&v| v as f64).collect();
            for &c in reduced.continuous() {
                y[c as usize] *= 0.37;
            }
            let x = reduced.expansion().expand(&y);
            prop_assert!(violation(&model, &x) < 1e-12);
            prop_assert!(x[..system.integers].iter().all(|v| v.fract() == 0.0));
        }
    }

    #[test]
    fn a_system_is_refused_exactly_when_it_has_no_solution(system in systems()) {
        let outcome = system.reduce();
        match verdict(&system) {
            Verdict::Solvable => prop_assert!(outcome.is_ok(), "{outcome:?}"),
            // Which of the two is found first depends on the order of the rows.
            Verdict::Contradictory => prop_assert!(matches!(
                outcome,
                Err(Error::Infeasible { .. } | Error::NoIntegerSolution { .. })
            ), "{outcome:?}"),
            Verdict::NotInIntegers => prop_assert!(
                matches!(outcome, Err(Error::NoIntegerSolution { .. })), "{outcome:?}"
            ),
        }
    }
}
