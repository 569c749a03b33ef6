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

/// Two limits in order, of which each may be infinite, near to each other or far away, often 0 and 1.
fn sides() -> impl Strategy<Value = (f64, f64)> {
    let limit = prop_oneof![
        number().prop_filter("a limit of files", |v| v.abs() < 1e20),
        moderate(),
        (-2i32..3).prop_map(f64::from),
        Just(f64::INFINITY),
    ];
    (limit.clone(), limit).prop_map(|(a, b)| match (a.is_finite(), b.is_finite()) {
        (true, true) => (a.min(b), a.max(b)),
        (false, _) => (f64::NEG_INFINITY, b),
        (_, false) => (a, b),
    })
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
            (vec((row(n, moderate()), sides()), 0..4), vec(sides(), 0..n)),
        )
    });
    let built = sized.prop_map(
        |(n, quadratic, linear, constant, squares, rows, integer, limits)| {
            let mut p = Problem::new(n).unwrap();
            for (i, j, v) in quadratic {
                // Readers refuse what is not convex: the diagonal dominates.
                let (rows, cols) = ([i.max(j), i, j], [i.min(j), i, j]);
                let (values, len) = match i == j {
                    true => ([v.abs(); 3], 1),
                    false => ([v, v.abs(), v.abs()], 3),
                };
                p.add_quadratic_triplets(
                    Triangle::Lower,
                    &rows[..len],
                    &cols[..len],
                    &values[..len],
                )
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
            let (inequalities, bounds) = limits;
            for (row, (lower, upper)) in &inequalities {
                let (indices, values, _) = split(row);
                p.add_inequality(&indices, &values, *lower, *upper).unwrap();
            }
            for (j, (lower, upper)) in bounds.into_iter().enumerate() {
                p.set_bounds(&[j], &[lower], &[upper]).unwrap();
            }
            p
        },
    );
    // A sum of duplicates may overflow, which is an error of the model and not of the file.
    built.prop_filter("a model", |p| Model::new(p).is_ok())
}

/// Everything that a problem holds except its least-squares rows, as bits.
pub fn fingerprint(problem: &Problem) -> Vec<u64> {
    bits(problem, true)
}

/// The same without entries of zero in rows, which LP files cannot hold.
pub fn fingerprint_without_zeros(problem: &Problem) -> Vec<u64> {
    bits(problem, false)
}

fn bits(problem: &Problem, zeros: bool) -> Vec<u64> {
    let model = Model::new(problem).unwrap();
    let mut all = vec![model.variables() as u64, model.constant().to_bits()];
    let entry = |i: u32, j: u32, v: f64| [u64::from(i), u64::from(j), v.to_bits()];
    all.extend(
        model
            .hessian()
            .entries()
            .flat_map(|(i, j, v)| entry(i, j, v)),
    );
    let rows = model.constraints().entries();
    let rows = rows.filter(|(_, _, v)| zeros || *v != 0.0);
    all.extend(rows.flat_map(|(i, j, v)| entry(i, j, v)));
    for numbers in [model.gradient(), model.constraint_rhs(), model.guess()] {
        all.extend(numbers.iter().map(|v| v.to_bits()));
    }
    all.extend(model.integer().iter().map(|&b| u64::from(b)));
    for pin in model.pinned().iter() {
        all.push(pin.map_or(u64::MAX, f64::to_bits));
    }
    for j in 0..problem.variables() {
        let (lower, upper) = problem.bounds(j).unwrap();
        all.extend([lower.to_bits(), upper.to_bits()]);
    }
    all.extend(one_sided(problem, zeros));
    all
}

/// The inequalities, each side as a row of its own, since MPS may need two rows for them.
fn one_sided(problem: &Problem, zeros: bool) -> Vec<u64> {
    let rows = problem.inequality_rows();
    let mut all = Vec::new();
    for i in 0..rows.len() {
        let mut sums = std::collections::BTreeMap::new();
        for (j, v) in rows.row(i) {
            *sums.entry(j).or_insert(0.0) += v;
        }
        sums.retain(|_, v| zeros || *v != 0.0);
        let sides = [rows.lower()[i], rows.upper()[i]];
        let limited = sides.iter().filter(|side| side.is_finite());
        for side in limited.chain(sides.iter().all(|s| s.is_infinite()).then_some(&sides[0])) {
            all.push(side.to_bits());
            all.extend(sums.iter().flat_map(|(&j, v)| [j as u64, v.to_bits()]));
        }
    }
    all
}
