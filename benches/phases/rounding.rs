//! The update of the other unknowns after one integer is rounded, by each method.

use criterion::{BatchSize, Criterion};
use roundel::Options;
use roundel::internals::linalg::{
    Effort, FixedSolve, Ldl, LocalSolve, Wave, conjugate_gradient, minimum_degree,
};

use crate::case::Case;

pub fn bench(criterion: &mut Criterion, case: &Case) {
    let mut group = criterion.benchmark_group(format!("{}/one rounding", case.family));
    let (hessian, gradient) = (case.reduced.hessian(), case.reduced.gradient());
    let integers = case.reduced.integers();
    let (unknown, value) = case.rounded();
    let order = minimum_degree(hessian).expect("memory for an ordering");
    let options = Options::orientation_field();

    group.bench_function("exact: fix in the factor", |b| {
        b.iter_batched_ref(
            || Ldl::new(hessian, &order).expect("memory for a factor"),
            |ldl| {
                let mut solve = FixedSolve::new(ldl, &case.relaxed, integers)?;
                solve.fix(unknown, value);
                roundel::Result::Ok(solve.value(unknown))
            },
            BatchSize::LargeInput,
        )
    });
    group.bench_function("local: Gauss-Seidel", |b| {
        b.iter_batched_ref(
            || {
                LocalSolve::new(hessian, gradient, &case.relaxed, integers)
                    .expect("memory for a queue")
            },
            |local| {
                let (mut wave, updates) = (Wave::default(), options.gauss_seidel_updates);
                local.fix(unknown, value, &mut wave);
                let tolerance = options.gauss_seidel_tolerance;
                local.relax(&mut wave, tolerance, updates, |_| true)
            },
            BatchSize::LargeInput,
        )
    });
    let effort = Effort {
        iterations: options.cg_iterations,
        tolerance: options.cg_tolerance,
    };
    let mut held = vec![false; case.reduced.dim()];
    held[unknown as usize] = true;
    let mut start = case.relaxed.clone();
    start[unknown as usize] = value;
    group.bench_function("iterative: conjugate gradients", |b| {
        b.iter_batched_ref(
            || start.clone(),
            |point| {
                conjugate_gradient(
                    hessian,
                    gradient,
                    &case.factor,
                    &held,
                    point,
                    effort,
                    || true,
                )
            },
            BatchSize::LargeInput,
        )
    });
    group.finish();
}
