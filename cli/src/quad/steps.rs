//! The steps from a mesh to quads, timed.

use std::time::Instant;

use roundel::mesh::TriangleMesh;
use roundel::mesh::features::FeatureGraph;
use roundel::quad::untangle::{UntangleOptions, Untangled, untangle};
use roundel::quad::{
    FieldProblem, IntegerGridMap, OrientationField, QuadMesh, SeamlessProblem, SmoothOptions,
    extract, smooth,
};
use roundel::{CancelToken, Options, Result, Solution, Strategy};

use super::Arguments;
use crate::progress::Progress;
use crate::{interrupt, mesh};

/// Quads, and how they were come by.
pub(super) struct Solved {
    pub(super) mesh: TriangleMesh,
    pub(super) solution: Solution,
    pub(super) options: Options,
    pub(super) untangled: Untangled,
    pub(super) quads: QuadMesh,
    pub(super) seconds: Seconds,
}

/// Wall-clock seconds a phase.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Seconds {
    pub(super) read: f64,
    pub(super) field: f64,
    pub(super) map: f64,
    pub(super) quads: f64,
    pub(super) smooth: f64,
}

/// Who watches, and may cancel.
struct Watch {
    progress: Progress,
    token: CancelToken,
}

impl Watch {
    fn monitor(&self) -> roundel::Monitor<'_> {
        self.progress.monitor().cancel_token(self.token.clone())
    }
}

pub(super) fn solve(arguments: &Arguments) -> Result<Solved> {
    let watch = Watch {
        token: interrupt::cancel_token()?,
        progress: Progress::start(),
    };
    let options = arguments.solver.over(Options::default())?;
    let mut seconds = Seconds::default();
    let mesh = timed(&mut seconds.read, || mesh::read(&arguments.mesh))?;
    let (field, features) = timed(&mut seconds.field, || {
        field(arguments, &mesh, &options, &watch)
    })?;
    let (solution, untangled) = timed(&mut seconds.map, || {
        map(arguments, &mesh, (&field, &features), &options, &watch)
    })?;
    watch.progress.say("quads");
    let mut quads = timed(&mut seconds.quads, || {
        let map = IntegerGridMap::from_seamless(&mesh, &untangled.map)?;
        extract(&mesh, &map, &watch.token)
    })?;
    if !arguments.no_smooth {
        watch.progress.say("smooth");
        timed(&mut seconds.smooth, || {
            smooth(&mut quads, &mesh, &SmoothOptions::default(), &watch.token)
        })?;
    }
    if let Some(path) = &arguments.out {
        quads.write_obj(path)?;
    }
    Ok(Solved {
        mesh,
        solution,
        options,
        untangled,
        quads,
        seconds,
    })
}

fn field(
    arguments: &Arguments,
    mesh: &TriangleMesh,
    options: &Options,
    watch: &Watch,
) -> Result<(OrientationField, FeatureGraph)> {
    let (guidance, features) = arguments.directions.of(mesh, 4)?;
    let follows = guidance.field_options(mesh, &features)?;
    let problem = FieldProblem::with_options(mesh, &follows)?;
    let options = Options {
        strategy: arguments.field_strategy,
        ..options.clone()
    };
    let solution = roundel::solve_with(problem.problem(), &options, watch.monitor())?;
    Ok((problem.field(mesh, &solution)?, features))
}

fn map(
    arguments: &Arguments,
    mesh: &TriangleMesh,
    (field, features): (&OrientationField, &FeatureGraph),
    options: &Options,
    watch: &Watch,
) -> Result<(Solution, Untangled)> {
    let sizing = arguments.sizing.of()?;
    let problem = SeamlessProblem::with_features(mesh, field, &sizing, features)?;
    let solution = roundel::solve_with(problem.problem(), options, watch.monitor())?;
    let map = problem.map(mesh, &solution)?;
    let untangled = match arguments.no_untangle || options.strategy == Strategy::Relax {
        true => Untangled::as_it_is(map),
        false => {
            let effort = UntangleOptions::default();
            untangle(mesh, &problem, &map, &effort, &mut watch.monitor())?
        }
    };
    Ok((solution, untangled))
}

fn timed<T>(seconds: &mut f64, step: impl FnOnce() -> T) -> T {
    let started = Instant::now();
    let result = step();
    *seconds = started.elapsed().as_secs_f64();
    result
}
