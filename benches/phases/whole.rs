//! Adaptive rounding, the steps after a map, and all steps from a mesh to quads.

use criterion::{BatchSize, Criterion};
use roundel::extract::{IntegerGridMap, extract};
use roundel::field::{FieldProblem, curvature_constraints};
use roundel::map::{SeamlessOptions, SeamlessProblem};
use roundel::mesh::shape;
use roundel::quad::{QuadOptions, quadrangulate};
use roundel::smooth::{SmoothOptions, smooth};
use roundel::{Monitor, Options, Result, Strategy, solve};

use crate::case::TRIANGLES;

pub fn bench(criterion: &mut Criterion, threads: usize) {
    all(criterion, threads).expect("procedural shapes are valid");
}

fn all(criterion: &mut Criterion, threads: usize) -> Result<()> {
    let mesh = shape::by_name("genus-2", TRIANGLES)?;
    let mut group = criterion.benchmark_group(format!("whole, {threads} threads"));
    let problem = FieldProblem::new(&mesh, &curvature_constraints(&mesh, 0.05)?)?;
    let adaptive = Options {
        strategy: Strategy::Adaptive,
        ..Options::default()
    };
    group.bench_function("field, adaptive", |b| {
        b.iter(|| solve(problem.problem(), &adaptive))
    });
    let field = problem.field(&mesh, &solve(problem.problem(), &adaptive)?)?;
    let map = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads: 1000 })?;
    let solution = solve(map.problem(), &Options::default())?;
    let grid = IntegerGridMap::from_seamless(&mesh, &map.map(&mesh, &solution)?)?;
    group.bench_function("extraction", |b| {
        b.iter(|| extract(&mesh, &grid, &mut Monitor::default()))
    });
    let quads = extract(&mesh, &grid, &mut Monitor::default())?;
    group.bench_function("smoothing", |b| {
        b.iter_batched_ref(
            || quads.clone(),
            |quads| {
                let options = SmoothOptions::default();
                smooth(quads, &mesh, &options, &mut Monitor::default())
            },
            BatchSize::LargeInput,
        )
    });
    group.bench_function("mesh to quads", |b| {
        b.iter(|| quadrangulate(&mesh, &QuadOptions::default(), Monitor::default))
    });
    group.finish();
    Ok(())
}
