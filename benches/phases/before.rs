//! The phases from the problem to its relaxation.

use criterion::Criterion;
use roundel::internals::eliminate::eliminate;
use roundel::internals::linalg::RelaxedFactor;
use roundel::{Model, Monitor, Options, Strategy, solve};

use crate::case::Case;

pub fn bench(criterion: &mut Criterion, case: &Case) {
    let mut group = criterion.benchmark_group(format!("{}/before", case.family));
    group.bench_function("validate", |b| b.iter(|| Model::new(&case.problem)));
    let model = Model::new(&case.problem).expect("the case was validated");
    group.bench_function("eliminate", |b| {
        b.iter(|| eliminate(&model, &mut Monitor::default()))
    });
    let (hessian, gradient) = (case.reduced.hessian(), case.reduced.gradient());
    group.bench_function("relax: factor and solve", |b| {
        b.iter(|| {
            let factor = RelaxedFactor::new(hessian, case.reduced.integers())?;
            let rounding = || case.reduced.gradient_rounding(&model);
            factor.minimise(gradient, rounding, case.reduced.guess())
        })
    });
    let options = Options {
        strategy: Strategy::Relax,
        ..Options::default()
    };
    group.bench_function("relax: whole solve", |b| {
        b.iter(|| solve(&case.problem, &options))
    });
    group.finish();
}
