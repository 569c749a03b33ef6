//! Properties of elimination that hold for every feasible system of continuous and integer unknowns.

use proptest::prelude::*;
use roundel::internals::eliminate::ReducedModel;
use roundel::{Error, Model, Problem, Triangle};

use super::exact::rank;
use super::{System, add_row, reduce, violation};

/// Sparse systems that a known point satisfies.
fn feasible() -> impl Strategy<Value = System> {
    (1usize..=12, 1usize..=12, 1usize..=14).prop_flat_map(|(integers, continuous, rows)| {
        let n = integers + continuous;
        let row = prop::collection::vec((0..n, -4i64..=4), 1..5);
        (
            prop::collection::vec(row, rows),
            prop::collection::vec(-9i64..=9, n),
        )
            .prop_map(move |(sparse, point)| {
                let mut rows = vec![vec![0; n]; sparse.len()];
                for (row, entries) in rows.iter_mut().zip(sparse) {
                    for (j, v) in entries {
                        row[j] += v;
                    }
                }
                let rhs = rows.iter().map(|row| dot(row, &point)).collect();
                System {
                    integers,
                    continuous,
                    rows,
                    rhs,
                }
            })
    })
}

fn dot(a: &[i64], b: &[i64]) -> i64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A point of the reduced unknowns, with integers where they are required.
fn some_point(reduced: &ReducedModel) -> Vec<f64> {
    let mut y: Vec<f64> = (0..reduced.dim())
        .map(|i| ((i * 7) % 5) as f64 - 2.0)
        .collect();
    for &c in reduced.continuous() {
        y[c as usize] *= 0.71;
    }
    y
}

fn dims(reduced: &ReducedModel) -> (usize, usize) {
    (reduced.integers().len(), reduced.continuous().len())
}

fn agree(a: &ReducedModel, b: &ReducedModel) -> bool {
    let close = |a: &f64, b: &f64| (a - b).abs() <= 1e-9 * (1.0 + a.abs());
    let (a, b) = (a.expansion(), b.expansion());
    a.matrix().indices() == b.matrix().indices()
        && a.matrix().offsets() == b.matrix().offsets()
        && a.matrix()
            .values()
            .iter()
            .zip(b.matrix().values())
            .all(|(a, b)| close(a, b))
        && a.offset().iter().zip(b.offset()).all(|(a, b)| close(a, b))
}

proptest! {
    #[test]
    fn constraints_hold_and_the_rank_is_the_number_of_eliminated_unknowns(system in feasible()) {
        let reduced = system.reduce().unwrap();
        prop_assert_eq!(reduced.dim(), system.unknowns() - rank(&system.rows));
        let x = reduced.expansion().expand(&some_point(&reduced));
        let model = Model::new(&system.problem().unwrap()).unwrap();
        prop_assert!(violation(&model, &x) < 1e-9);
        prop_assert!(x[..system.integers].iter().all(|v| v.fract() == 0.0));
    }

    #[test]
    fn redundant_rows_change_nothing(system in feasible(), at in any::<prop::sample::Index>()) {
        let mut more = system.clone();
        let copied = at.index(system.rows.len());
        let sum = (0..system.unknowns()).map(|j| system.rows.iter().map(|row| row[j]).sum());
        more.rows.push(sum.collect());
        more.rhs.push(system.rhs.iter().sum());
        more.rows.push(system.rows[copied].iter().map(|v| -3 * v).collect());
        more.rhs.push(-3 * system.rhs[copied]);
        let again = more.reduce();
        // The rows are eliminated in another order, which rarely leads to numbers beyond 2^53.
        prop_assume!(!matches!(again, Err(Error::Overflow { .. })));
        let (reduced, again) = (system.reduce().unwrap(), again.unwrap());
        prop_assert_eq!(dims(&reduced), dims(&again));
        let model = Model::new(&more.problem().unwrap()).unwrap();
        let x = reduced.expansion().expand(&some_point(&reduced));
        prop_assert!(violation(&model, &x) < 1e-9);
    }

    #[test]
    fn a_contradiction_is_reported_with_one_of_its_rows(
        mut system in feasible(),
        off in prop_oneof![-5i64..=-1, 1i64..=5],
    ) {
        // Without integers, no row can fail for another reason.
        system.continuous += std::mem::take(&mut system.integers);
        let sum = (0..system.unknowns()).map(|j| system.rows.iter().map(|row| row[j]).sum());
        system.rows.push(sum.collect());
        system.rhs.push(system.rhs.iter().sum::<i64>() + off);
        let Err(Error::Infeasible { constraint, .. }) = system.reduce() else {
            return Err(TestCaseError::fail("the contradiction was not found"));
        };
        let mut without = system.rows.clone();
        without.remove(constraint);
        // A row is part of the contradiction if its coefficients depend on those of other rows.
        prop_assert_eq!(rank(&without), rank(&system.rows));
    }

    #[test]
    fn units_of_a_row_do_not_matter(system in feasible(), at in any::<prop::sample::Index>()) {
        let reduced = system.reduce().unwrap();
        let scaled = at.index(system.rows.len());
        for factor in [1e6, 1.0 / 3.0, -1e-9] {
            let mut problem = Problem::new(system.unknowns()).unwrap();
            problem.set_integers(&(0..system.integers).collect::<Vec<_>>()).unwrap();
            for (r, (row, &rhs)) in system.rows.iter().zip(&system.rhs).enumerate() {
                let factor = if r == scaled { factor } else { 1.0 };
                add_row(&mut problem, row, rhs, factor).unwrap();
            }
            prop_assert!(agree(&reduced, &reduce(&problem).unwrap()), "by {factor}");
        }
    }

    #[test]
    fn pins_act_as_constraints(system in feasible(), at in any::<prop::sample::Index>(), v in -3i64..=3) {
        let pinned = at.index(system.unknowns());
        let mut problem = system.problem().unwrap();
        problem.pin(pinned, v as f64).unwrap();
        let mut as_row = system.clone();
        let mut row = vec![0; system.unknowns()];
        row[pinned] = 1;
        as_row.rows.push(row);
        as_row.rhs.push(v);
        match (reduce(&problem), as_row.reduce()) {
            (Ok(pin), Ok(row)) => {
                prop_assert_eq!(dims(&pin), dims(&row));
                let x = pin.expansion().expand(&some_point(&pin));
                let model = Model::new(&as_row.problem().unwrap()).unwrap();
                prop_assert!(violation(&model, &x) < 1e-9);
                prop_assert_eq!(x[pinned], v as f64);
            }
            (Err(_), Err(_)) => {}
            (pin, row) => prop_assert!(false, "{pin:?} against {row:?}"),
        }
    }

    #[test]
    fn the_energy_is_that_of_the_expanded_point(
        system in feasible(),
        entries in prop::collection::vec((0usize..24, 0usize..24, -2.0..2.0), 0..60),
        linear in prop::collection::vec(-3.0..3.0, 24),
    ) {
        let n = system.unknowns();
        let mut problem = system.problem().unwrap();
        for (i, j, v) in entries {
            let (i, j) = (i % n, j % n);
            problem
                .add_quadratic_triplets(Triangle::Lower, &[i.max(j)], &[i.min(j)], &[v])
                .unwrap();
        }
        problem.add_linear(&linear[..n]).unwrap();
        problem.add_constant(11.0).unwrap();
        let model = Model::new(&problem).unwrap();
        let reduced = reduce(&problem).unwrap();
        let y = some_point(&reduced);
        let x = reduced.expansion().expand(&y);
        let (mut energy, mut size) = (model.constant(), model.constant().abs());
        for (x, (q, qx)) in x.iter().zip(model.gradient().iter().zip(model.hessian().mul_symmetric(&x))) {
            energy += x * (q + 0.5 * qx);
            size += (x * q).abs() + (0.5 * x * qx).abs();
        }
        let (value, terms) = reduced.energy(&y);
        prop_assert!((value - energy).abs() <= 1e-10 * size.max(terms), "{value} {energy}");
        for i in 0..reduced.dim() {
            prop_assert_eq!(reduced.hessian().row(i).last().map(|e| e.0), Some(i));
        }
    }
}
