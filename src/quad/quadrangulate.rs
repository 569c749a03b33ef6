//! From a mesh to quads: [`quadrangulate`], by the options, and once more by others where they lose the
//! surface.

use super::apart::apart;
use super::by_component::Components;
use super::coverage::far;
use super::driver::by_options;
use super::final_error::is_final;
use super::rank::Rank;
use super::tries::Tries;
use super::{QuadOptions, Quadrangulation};
use crate::error::Result;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, Phase};

/// The share of a run that its first try takes; most need no other.
const FIRST: f64 = 0.97;

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
    let far = far(mesh);
    if !Rank::of(mesh, options, far, &best).is_good() {
        let mut tries = Tries::new(far, &monitor);
        let components = Components::new(mesh);
        if best.is_err() || components.count == 1 {
            best = tries.others(mesh, options, best);
        }
        if components.count > 1
            && let Ok(made) = best
        {
            best = Ok(apart(&mut tries, mesh, options, &components, made));
        }
    }
    run.end_call();
    // There is a result, whatever the caller wants.
    let _ = monitor().progress(Phase::Quads, 1.0);
    best
}
