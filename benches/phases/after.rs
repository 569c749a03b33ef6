//! The phases after the integers are decided: continuous unknowns, expansion, verification.

use criterion::Criterion;
use roundel::internals::linalg::minimise_fixed;
use roundel::solve::verify;

use crate::case::Case;

pub fn bench(criterion: &mut Criterion, case: &Case) {
    let mut group = criterion.benchmark_group(format!("{}/after", case.family));
    let mut held = vec![false; case.reduced.dim()];
    let mut rounded = case.relaxed.clone();
    for &i in case.reduced.integers() {
        held[i as usize] = true;
        rounded[i as usize] = rounded[i as usize].round();
    }
    let (hessian, gradient) = (case.reduced.hessian(), case.reduced.gradient());
    group.bench_function("offer: continuous unknowns", |b| {
        b.iter(|| minimise_fixed(hessian, gradient, &held, &rounded))
    });
    group.bench_function("offer: energy", |b| {
        b.iter(|| case.reduced.energy(&rounded))
    });
    group.bench_function("expand", |b| {
        b.iter(|| case.reduced.expansion().expand(&rounded))
    });
    let values = case.reduced.expansion().expand(&rounded);
    group.bench_function("verify", |b| b.iter(|| verify(&case.problem, &values)));
    group.finish();
}
