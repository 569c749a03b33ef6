//! From a mesh to quads: [`quadrangulate`], by the options, and once more by others where they lose the
//! surface.

use super::coverage::covers;
use super::driver::by_options;
use super::{QuadOptions, Quadrangulation};
use crate::error::{Error, Result};
use crate::field::Guidance;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, Phase, optional};

/// The angle of edges that become features where quads without features lose the surface: 40 degrees.
const SHARP: f64 = 40.0 * std::f64::consts::PI / 180.0;

/// The share of a run that its first try takes; most need no other.
const FIRST: f64 = 0.97;

/// Meshes of more faces are tried once.
const FACES: usize = 50_000;

/// Turns a mesh into quads. `monitor` makes one watcher for each step.
///
/// [`is_conforming`](crate::extract::QuadMesh::is_conforming) tells whether the result consists of quads
/// only. Features that rounding puts on one line are separated if the quads then conform. Extraction
/// copes with nearly all folds. Untangling is tried only if its quads do not conform, and the result is
/// kept if its quads conform or need fewer repairs. If the quads still do not conform, and the options
/// give no size of details, the field is solved for again with larger details excluded. Small parts of the
/// mesh that are lost get smaller quads, and so does a mesh without any quads
/// ([`Sizing::Lengths`](crate::map::Sizing::Lengths)).
///
/// If a mesh that had to be refined, or whose quads do not conform, is still not covered by quads that conform,
/// it is tried once more with its sharp edges as features, if the options give no angle, and once more
/// without refinement. The first of the best results is kept.
///
/// A caller who [finishes](crate::Flow::Finish) the run after the field's first solution gets the quads of the
/// best integers so far: nothing above is tried any more, and smoothing ends.
///
/// # Errors
/// [`Error::InvalidArgument`] if there are no quads of any size that was tried. Otherwise
/// those of [`solve_field`](crate::field::solve_field), [`solve`](crate::solve()),
/// [`SeamlessProblem::with_features`](crate::map::SeamlessProblem::with_features),
/// [`untangle`](crate::untangle::untangle), [`extract`](crate::extract) and [`smooth`](crate::smooth::smooth).
pub fn quadrangulate<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    let run = monitor().run();
    let monitor = || monitor().of_run(&run);
    let first = run.with_share([0.0, FIRST], || by_options(mesh, options, &monitor));
    let mut best = match first {
        Err(error) if is_final(&error) => return Err(error),
        first => first,
    };
    let mut rank = rank_of(mesh, &best);
    let tries = match mesh.face_count() > FACES {
        true => Vec::new(),
        false => others(mesh, options),
    };
    for other in tries {
        if rank == BEST {
            break;
        }
        let half = [0.0, 0.5].map(|part| run.share() + part * (1.0 - run.share()));
        let found = optional(&monitor, || {
            run.with_share(half, || by_options(mesh, &other, &monitor))
        });
        let found = match found {
            Ok(None) => break,
            Ok(Some(found)) => Ok(found),
            Err(error) => Err(error),
        };
        if found.as_ref().is_err_and(is_final) {
            break;
        }
        let found_rank = rank_of(mesh, &found);
        if found_rank < rank {
            (best, rank) = (found, found_rank);
        }
    }
    run.end_call();
    // There is a result, whatever the caller wants.
    let _ = monitor().progress(Phase::Quads, 1.0);
    best
}

/// Whether there are no quads, whether they do not conform, whether they do not cover the surface.
type Rank = (bool, bool, bool);

const BEST: Rank = (false, false, false);

fn rank_of(mesh: &TriangleMesh, made: &Result<Quadrangulation>) -> Rank {
    let Ok(made) = made else {
        return (true, true, true);
    };
    let conforms = made.quads.is_conforming();
    // Quads of a mesh that is fine enough are as large as they were asked to be.
    let covers = conforms && made.refined.is_none() || covers(&made.quads, mesh);
    (false, !conforms, !covers)
}

/// The errors that other options cannot avoid: those of the caller, and stops.
fn is_final(error: &Error) -> bool {
    !matches!(
        error,
        Error::Unbounded { .. }
            | Error::NotConvex { .. }
            | Error::Infeasible { .. }
            | Error::NoIntegerSolution { .. }
            | Error::NotFinite { .. }
            | Error::Overflow { .. }
    )
}

/// What else to try: sharp edges as features, and the mesh as it is.
fn others(mesh: &TriangleMesh, options: &QuadOptions) -> Vec<QuadOptions> {
    let mut others = Vec::new();
    if !has_features(mesh, &options.guidance) {
        let guidance = Guidance {
            feature_angle: Some(SHARP),
            ..options.guidance.clone()
        };
        others.push(QuadOptions {
            guidance,
            ..options.clone()
        });
    }
    if options.refine {
        others.push(QuadOptions {
            refine: false,
            ..options.clone()
        });
    }
    others
}

/// Whether the caller says which edges are features; those of the boundary do not count.
fn has_features(mesh: &TriangleMesh, guidance: &Guidance) -> bool {
    let is_inner = |&edge: &usize| mesh.edge(edge).second.is_some();
    guidance.feature_angle.is_some() || guidance.feature_edges.iter().any(is_inner)
}
