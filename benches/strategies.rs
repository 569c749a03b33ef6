//! The time of each strategy on orientation fields and parametrizations of growing size.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use roundel::field::{FieldProblem, curvature_constraints};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::shape;
use roundel::{Options, Problem, Strategy, solve};

fn problems(triangles: usize) -> roundel::Result<[(&'static str, Problem); 2]> {
    let mesh = shape::by_name("genus-2", triangles)?;
    let field = FieldProblem::new(&mesh, &curvature_constraints(&mesh, 0.1)?)?;
    let solution = solve(field.problem(), &Options::orientation_field())?;
    let options = SeamlessOptions { quads: 1000 };
    let map = SeamlessProblem::new(&mesh, &field.field(&mesh, &solution)?, &options)?;
    Ok([
        ("field", field.problem().clone()),
        ("map", map.problem().clone()),
    ])
}

fn strategies(criterion: &mut Criterion) {
    for triangles in [2_000, 8_000] {
        for (family, problem) in problems(triangles).expect("procedural shapes are valid") {
            let mut group = criterion.benchmark_group(family);
            group.sample_size(10);
            for (strategy, threads) in Strategy::ALL
                .map(|s| (s, 1))
                .into_iter()
                .chain([(Strategy::Auto, 2)])
            {
                let options = Options {
                    strategy,
                    threads,
                    ..Options::default()
                };
                let name = format!("{}, {threads} threads", strategy.name());
                let id = BenchmarkId::new(name, triangles);
                group.bench_function(id, |b| b.iter(|| solve(&problem, &options)));
            }
            group.finish();
        }
    }
}

criterion_group!(benches, strategies);
criterion_main!(benches);
