//! Orderings, factors of both kinds (supernodal and simplicial), and solves with them.

use criterion::{BatchSize, Criterion};
use roundel::internals::linalg::{Cholesky, EliminationTree, Ldl, equilibrate, minimum_degree};

use crate::case::Case;

pub fn bench(criterion: &mut Criterion, case: &Case) {
    let mut group = criterion.benchmark_group(format!("{}/factors", case.family));
    let hessian = case.reduced.hessian();
    group.bench_function("scaling", |b| b.iter(|| equilibrate(hessian)));
    group.bench_function("minimum degree", |b| b.iter(|| minimum_degree(hessian)));
    let order = minimum_degree(hessian).expect("memory for an ordering");
    group.bench_function("elimination tree", |b| {
        b.iter(|| EliminationTree::new(hessian, &order))
    });
    group.bench_function("supernodal", |b| b.iter(|| Cholesky::new(hessian)));
    group.bench_function("simplicial", |b| b.iter(|| Ldl::new(hessian, &order)));
    group.bench_function("solve, all integers real", |b| {
        b.iter_batched(
            || case.reduced.gradient().to_vec(),
            |mut x| case.factor.solve(&mut x),
            BatchSize::LargeInput,
        )
    });
    group.finish();
}
