//! The choice among several fields: the one whose map is least distorted.
//!
//! The best weight of curvature depends on the shape. Where curvature is clear everywhere, given
//! directions keep irregular vertices away from where the map would need them, and a field without any
//! guidance is often better. The relaxation of the map's problem shows this before any integer is
//! decided: its energy measures how far quads are from squares of one size. So several fields are tried
//! on meshes that are not large.

use std::time::Instant;

use super::QuadOptions;
use super::aim::aim;
use super::clearance::Clearance;
use super::final_error::is_final;
use super::outcome::Outcome;
use super::quadrangulation::timed;
use super::stated_map::MapData;
use super::stretch::Stretch;
use crate::error::{Error, Result};
use crate::field::{FieldOptions, Guidance, JumpsDecided, OrientationField, decide_jumps};
use crate::map::SeamlessProblem;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::{Monitor, Stage, optional, side_by_side};
use crate::solve::{Solution, Solver};

/// Another use of curvature.
struct Use {
    /// The number of faces with a fixed direction, for each quad.
    constrained_per_quad: f64,
    /// The factor of the weight of all other faces.
    weight: f64,
}

/// The uses that are tried besides that of the guidance, in this order.
const OTHERS: [Use; 4] = [
    Use {
        constrained_per_quad: 0.0,
        weight: 0.0,
    },
    Use {
        constrained_per_quad: 0.1,
        weight: 0.0,
    },
    Use {
        constrained_per_quad: 0.05,
        weight: 0.0,
    },
    Use {
        constrained_per_quad: 0.0,
        weight: 1.0,
    },
];

/// The most faces of all fields together; the first field has no limit. A mesh of 10,000 faces takes no
/// longer than one of 40,000.
const FACES: usize = 39_000;

/// A field, and the problem of the map that follows it.
pub(super) struct ChosenField {
    /// The guidance of the field.
    pub(super) options: FieldOptions,
    pub(super) field: OrientationField,
    pub(super) solution: Solution,
    pub(super) problem: SeamlessProblem,
    pub(super) solver: Solver,
    outcome: Outcome,
}

/// The best of the fields that may be tried, several at a time. The times of fields and maps are added to
/// `seconds`.
pub(super) fn choose_field<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    features: &FeatureGraph,
    monitor: &impl Fn() -> Monitor<'a>,
    off_features: bool,
    [of_field, of_map]: [&mut f64; 2],
) -> Result<ChosenField> {
    let (run, count) = (monitor().run(), field_count(mesh, options));
    let clearance = Clearance::new(mesh, options, features, off_features, &monitor())?;
    let stretch = Stretch::new(mesh, options)?;
    let all: Vec<QuadOptions> = std::iter::once(options.clone())
        .chain(others(mesh, options))
        .collect();
    let started = Instant::now();
    let found = side_by_side(
        count,
        monitor,
        |done| run.enter(Stage::Field, done, count),
        |k, monitor| {
            let shared = (features, &clearance, stretch.as_ref());
            let follow = || follow(mesh, &all[k], shared, count == 1, &monitor);
            if k == 0 {
                return follow().map(Some);
            }
            match optional(&monitor, follow) {
                // The guidance that the caller asked for works, so a failure of another one is no error.
                Err(error) if !is_final(&error) => Ok(None),
                other => other,
            }
        },
    )?;
    let (seconds, mut best) = (started.elapsed().as_secs_f64(), None::<Followed>);
    let mut spent = [0.0; 2];
    for found in found.into_iter().flatten() {
        spent = [0, 1].map(|k| spent[k] + found.seconds[k]);
        if best
            .as_ref()
            .is_none_or(|best| found.chosen.outcome < best.chosen.outcome)
        {
            best = Some(found);
        }
    }
    // Tasks at the same time share the seconds that passed.
    let scale = seconds / (spent[0] + spent[1]).max(f64::MIN_POSITIVE);
    *of_field += scale * spent[0];
    *of_map += scale * spent[1];
    best.map(|best| best.chosen).ok_or(Error::Cancelled)
}

/// The number of fields that are tried.
pub(super) fn field_count(mesh: &TriangleMesh, options: &QuadOptions) -> usize {
    1 + others(mesh, options).count()
}

/// The same guidance with other uses of curvature, as many as the size of the mesh allows.
fn others(mesh: &TriangleMesh, options: &QuadOptions) -> impl Iterator<Item = QuadOptions> {
    let given = &options.guidance;
    let follows = given.constrain_curvature > 0.0 || given.curvature_weight > 0.0;
    let count = match options.vary_curvature && follows && given.indices.is_none() {
        true => FACES / mesh.face_count().max(1),
        false => 0,
    };
    let edge = options.sizing.edge_length(mesh);
    let face = mesh.surface_area() / mesh.face_count() as f64;
    let of = move |other: &Use| QuadOptions {
        guidance: Guidance {
            constrain_curvature: (other.constrained_per_quad * face / (edge * edge)).min(1.0),
            curvature_weight: other.weight * given.curvature_weight,
            ..given.clone()
        },
        ..options.clone()
    };
    OTHERS.iter().take(count.saturating_sub(1)).map(of)
}

/// A field, and how long it and the relaxation of its map took.
struct Followed {
    chosen: ChosenField,
    seconds: [f64; 2],
}

/// The field that follows this guidance, and the problem of its map. Integers are decided for `is_only` in any case.
fn follow<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    (features, clearance, stretch): (&FeatureGraph, &Clearance, Option<&Stretch>),
    is_only: bool,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Followed> {
    let mut seconds = [0.0; 2];
    let [of_field, of_map] = &mut seconds;
    let regular = clearance.regular.clone();
    let mut field_options = options.guidance.options_with(mesh, features, regular)?;
    field_options.kept_turns = clearance.kept_turns.clone();
    field_options.lengths = options.sizing.vertex_lengths(mesh);
    let decided = timed(of_field, || {
        decide_jumps(mesh, &field_options, &options.field, monitor)
    })?;
    let map = MapData {
        mesh,
        sizing: &options.sizing,
        features,
        stretch,
        is_searched: is_only,
    };
    let (field, solution, (mut problem, mut solver)) = match decided {
        JumpsDecided::All(field, solution) => {
            let stated = timed(of_map, || map.state(&field))?;
            (field, solution, stated)
        }
        JumpsDecided::WithoutDetails(first, left) => {
            let options = (&field_options, &options.field);
            let seconds = [&mut *of_field, &mut *of_map];
            map.state_with_details((&first, *left), options, monitor, seconds)?
        }
    };
    let chosen = timed(of_map, || {
        let energy = aim(mesh, &mut problem, &mut solver, &options.sizing, monitor())?;
        Ok(ChosenField {
            outcome: Outcome::of_relaxation(energy, problem.cones().len()),
            options: field_options,
            field,
            solution,
            problem,
            solver,
        })
    })?;
    Ok(Followed { chosen, seconds })
}
