//! From a mesh to quads: [`quadrangulate`], by the options, and again, by others or a component at a time,
//! where they do not conform or lose the surface.

use std::cell::Cell;

use super::apart::apart;
use super::by_component::Components;
use super::by_options::by_options;
use super::coverage::far;
use super::driver::Effort;
use super::final_error::is_final;
use super::mirrored::mirrored;
use super::pairs::Paired;
use super::rank::{Losses, Rank};
use super::tries::Tries;
use super::{QuadOptions, Quadrangulation};
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, Phase, may_continue, with_threads};

/// The share of a run that its first try takes; most need no other.
const FIRST: f64 = 0.97;

/// Turns a mesh into quads. `monitor` makes one watcher for each step.
///
/// [`is_conforming`](crate::extract::QuadMesh::is_conforming) tells whether the result consists of quads
/// only. Sharp edges that are too short for the quads are no features
/// ([`Guidance::for_quads`](crate::field::Guidance::for_quads)). Features that rounding puts on one line are
/// separated if the quads then conform. Extraction copes with nearly all folds. Untangling is tried only if its quads
/// do not conform or miss features, and the result is kept if it is better. If the quads still do not conform, and the
/// options give no size of details, the field is solved for again with larger details excluded. Small parts of the
/// mesh that are lost get smaller quads, and so does a mesh without any quads
/// ([`Sizing::Lengths`](crate::map::Sizing::Lengths)).
///
/// With [`Count::Exact`](super::Count::Exact) a number of quads is met within 1 %, or as nearly as a few maps of
/// other sizes come, unless the quads do not conform.
///
/// Where quads still do not conform, those around the folds of the map are made smaller, at most four times,
/// until there are more than four for each that was asked for. Where more than one triangle in twenty is folded,
/// that is tried before untangling.
///
/// A mesh is tried by other options if its quads do not conform; if it had to be refined, and they do not cover it or
/// miss features that were asked for; and if folds of its map were repaired, and they lose more than 3 % of it. It is
/// tried once more with its sharp edges as features, if the options give no angle; if its quads conform, up to three
/// times with smaller quads where they lose the surface; if they do not conform, once more with only those sharp
/// edges as features whose curves are four times as long; once more without refinement; once more with half as many
/// quads again as were asked for, and with 500, if that is needed to conform or to cover the surface. Quads that
/// cover the surface end these tries, unless sharp edges give them more than a quarter more irregular vertices. The
/// best result is kept, and of equal ones the one with the fewest irregular vertices. Of a mesh of several
/// components, only those are tried again whose quads do not conform, and then, if the surface is not covered, those
/// that do not cover theirs: each alone, as it is and in these ways, and their quads replace those of the first try
/// if they are better. These tries end when they have made fields, maps and quads of 1,200,000 triangles in all, or
/// what takes as long.
/// [`Quadrangulation::apart`] names the triangles of components that have quads of their own.
///
/// Where all of that leaves quads that do not conform, triangles of the component are paired, if it has at most 50,000
/// (`remacle2012`): its quads then conform. [`Quadrangulation::paired`] names these triangles. They are also paired
/// where more than a fifth of the surface is lost, if that gives at most twice as many quads as there are or as were
/// asked for.
///
/// Quads that do not conform even then are quads only, manifold and oriented: faces that contain a vertex twice
/// are dropped, those that are no quads are split, and all are cut apart at edges with more than two faces, or
/// with two that run the same way. Where nothing would be left, or the result could be taken for quads that
/// conform, they stay as they are.
///
/// With [`QuadOptions::mirror`] all of this holds for the part of the mesh on one side of the planes; the rest are
/// its mirror images, and the number of quads is that of all.
///
/// A caller who [finishes](crate::Flow::Finish) the run after the field's first solution gets the quads of the
/// best integers so far: nothing above is tried any more, and smoothing ends.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) if there are no quads of any size that was tried. Otherwise
/// those of [`solve_field`](crate::field::solve_field), [`solve`](crate::solve()),
/// [`mirror_planes`](crate::mesh::mirror::mirror_planes), [`Half::new`](crate::mesh::mirror::Half::new),
/// [`SeamlessProblem::with_features`](crate::map::SeamlessProblem::with_features),
/// [`untangle`](crate::untangle::untangle), [`extract`](crate::extract) and [`smooth`](crate::smooth::smooth).
pub fn quadrangulate<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    options.sizing.check(mesh)?;
    let options = &QuadOptions {
        guidance: (options.guidance).for_quads(options.sizing.edge_length(mesh)),
        ..options.clone()
    };
    if !options.mirror.is_empty() {
        return mirrored(mesh, options, monitor);
    }
    unmirrored(mesh, options, &monitor)
}

/// The quads of a mesh, without regard to its mirror planes.
///
/// # Errors
/// Those of [`quadrangulate`].
pub(super) fn unmirrored<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    with_threads(options.field.threads, || on_threads(mesh, options, monitor))
}

fn on_threads<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    let run = monitor().run();
    let monitor = || monitor().of_run(&run);
    let (_watch, _memory) = (monitor().watch(), mesh.watch_memory());
    may_continue()?;
    let components = Components::new(mesh);
    let effort = match components.count {
        1 => Effort::Full,
        _ => Effort::OfSeveral,
    };
    let unlimited = Cell::new(u64::MAX);
    let first = run.with_share([0.0, FIRST], || {
        by_options(mesh, options, effort, &unlimited, &monitor)
    });
    let mut best = match first {
        Err(error) if is_final(&error) => return Err(error),
        first => first,
    };
    let (far, losses) = (far(mesh), Losses::of(best.as_ref().ok()));
    let rank_of = |made: &Result<Quadrangulation>| Rank::of(mesh, options, far, made, losses);
    if !rank_of(&best).is_good() {
        let mut tries = Tries::new(far, &monitor);
        if best.is_err() || components.count == 1 {
            best = tries.others(mesh, options, best);
        }
        if components.count > 1 {
            best = best.map(|made| apart(&mut tries, mesh, options, &components, made));
        } else if let rank = rank_of(&best)
            && let Ok(made) = &mut best
            && Paired::are_better(mesh, options, rank, &made.quads)
            && !tries.has_ended()
            && let Some(paired) = Paired::new(mesh, options, &monitor)
        {
            paired.replace(made, mesh);
        }
    }
    if let Ok(made) = &mut best
        && let Some(cut) = cut_apart(&made.quads)
    {
        made.quads = cut;
    }
    run.end_call();
    // There is a result, whatever the caller wants.
    let _ = monitor().progress(Phase::Quads, 1.0);
    best
}

/// Quads that do not conform as manifold ones. `None` for those that conform, and where nothing would be left or
/// the result would seem to conform: the Euler characteristic may become right by chance.
fn cut_apart(quads: &QuadMesh) -> Option<QuadMesh> {
    if quads.is_conforming() {
        return None;
    }
    let mut cut = quads.clone();
    cut.make_manifold();
    (!cut.quads.is_empty() && !cut.is_conforming()).then_some(cut)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;
    use crate::monitor::spawned;

    /// Three quads at one edge. Cut apart, they have an Euler characteristic of three.
    fn book(expected_euler: i64) -> QuadMesh {
        let page = |k: u32| [[1.0, f64::from(k), 0.0], [1.0, f64::from(k), 1.0]];
        let spine = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let vertices = [spine, page(0), page(1), page(2)].concat();
        let quads = vec![[0, 2, 3, 1], [0, 4, 5, 1], [0, 6, 7, 1]];
        QuadMesh::from_quads(vertices, quads, expected_euler)
    }

    #[test]
    fn fields_are_tried_on_as_many_threads_as_are_allowed() {
        let mesh = by_name("genus-2", 6_000).unwrap();
        for (threads, started) in [(1, 0), (2, 1), (3, 2)] {
            let mut options = QuadOptions::default();
            options.field.threads = threads;
            options.map.threads = 1;
            let found = spawned(|| {
                quadrangulate(&mesh, &options, Monitor::default).unwrap();
            });
            assert!(
                found >= started && (threads > 1 || found == 0),
                "{threads}: {found}"
            );
        }
    }

    #[test]
    fn quads_that_are_cut_apart_never_seem_to_conform() {
        let cut = cut_apart(&book(1)).expect("three quads are left");
        assert_eq!((cut.quads.len(), cut.figures().euler), (3, 3));
        assert_eq!(cut.figures().bad_edges, 0);
        assert!(!cut.is_conforming());
        assert!(cut_apart(&book(3)).is_none());
    }

    #[test]
    fn quads_that_conform_stay_and_so_do_those_of_which_nothing_would_be_left() {
        let mut one = book(1);
        one.quads.truncate(1);
        one.vertices.truncate(4);
        one.origins.truncate(4);
        assert!(one.is_conforming() && cut_apart(&one).is_none());
        one.quads[0] = [0, 0, 1, 1];
        assert!(!one.is_conforming() && cut_apart(&one).is_none());
    }
}
