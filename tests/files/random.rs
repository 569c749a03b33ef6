//! Random problems that use every kind of term, with numbers of all magnitudes.

use proptest::collection::vec;
use proptest::prelude::*;
use roundel::{Model, Problem, Triangle};

/// Finite numbers: simple ones, random bits, the extremes and both zeros.
pub fn number() -> impl Strategy<Value = f64> {
    let any_bits = any::<u64>().prop_map(f64::from_bits);
    prop_oneof![
        3 => (-4i32..5).prop_map(|k| f64::from(k) / 2.0),
        3 => -1e3..1e3f64,
        2 => any_bits.prop_filter("finite", |v| v.is_finite()),
        1 => Just(-0.0),
        1 => Just(f64::MIN_POSITIVE / 3.0),
        1 => Just(f64::MAX),
    ]
}

/// Numbers whose sums and squares do not overflow.
fn moderate() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), -1e3..1e3f64, -1e-9..1e-9f64]
}

fn row(n: usize, number: impl Strategy<Value = f64>) -> impl Strategy<Value = Row> {
    (vec((0..n, number), 0..5), moderate())
}

type Row = (Vec<(usize, f64)>, f64);

fn split(row: &Row) -> (Vec<usize>, Vec<f64>, f64) {
    let (indices, values) = row.0.iter().copied().unzip();
    (indices, values, row.1)
}

/// A problem that MPS can express: without pins and guess.
pub fn problem() -> impl Strategy<Value = Problem> {
    let sized = (1usize..9).prop_flat_map(|n| {
        (
            Just(n),
            vec((0..n, 0..n, number()), 0..12),
            vec(number(), n),
            number(),
            vec(row(n, moderate()), 0..4),
            vec(row(n, number()), 0..5),
            vec(any::<bool>(), n),
        )
    });
    let built = sized.prop_map(|(n, quadratic, linear, constant, squares, rows, integer)| {
        let mut p = Problem::new(n).unwrap();
        for (i, j, v) in quadratic {
            let (i, j) = (i.max(j), i.min(j));
            p.add_quadratic_triplets(Triangle::Lower, &[i], &[j], &[v])
                .unwrap();
        }
        p.add_linear(&linear).unwrap();
        p.add_constant(constant).unwrap();
        for square in &squares {
            let (indices, values, rhs) = split(square);
            p.add_least_squares(&indices, &values, rhs, 0.75).unwrap();
        }
        for row in &rows {
            let (indices, values, rhs) = split(row);
            p.add_constraint(&indices, &values, rhs).unwrap();
        }
        let integers: Vec<usize> = (0..n).filter(|&i| integer[i]).collect();
        p.set_integers(&integers).unwrap();
        p
    });
    // A sum of duplicates may overflow, which is an error of the model and not of the file.
    built.prop_filter("a model", |p| Model::new(p).is_ok())
}

/// Everything that a model holds except its least-squares rows, as bits.
pub fn fingerprint(problem: &Problem) -> Vec<u64> {
    let model = Model::new(problem).unwrap();
    let mut all = vec![model.variables() as u64, model.constant().to_bits()];
    for matrix in [model.hessian(), model.constraints()] {
        all.extend(matrix.offsets().iter().map(|&k| k as u64));
        all.extend(matrix.indices().iter().map(|&k| u64::from(k)));
        all.extend(matrix.values().iter().map(|v| v.to_bits()));
    }
    for numbers in [model.gradient(), model.constraint_rhs(), model.guess()] {
        all.extend(numbers.iter().map(|v| v.to_bits()));
    }
    all.extend(model.integer().iter().map(|&b| u64::from(b)));
    for pin in model.pinned() {
        all.push(pin.map_or(u64::MAX, f64::to_bits));
    }
    all
}
