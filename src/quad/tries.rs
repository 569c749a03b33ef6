//! Tries after the first: a mesh whose quads are not good, by other options.

use std::cell::Cell;

use super::driver::{Effort, by_options};
use super::rank::{Rank, has_features};
use super::{Count, QuadOptions, Quadrangulation};
use crate::error::{Error, Result};
use crate::field::Guidance;
use crate::map::Sizing;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, optional};

/// The angle of edges that become features where quads without features lose the surface: 40 degrees.
const SHARP: f64 = 40.0 * std::f64::consts::PI / 180.0;

/// How many times as many quads are tried.
const MORE: f64 = 1.5;

/// The number of quads that is tried in any case, which a small part of a thin solid may need.
const ENOUGH: f64 = 500.0;

/// Larger meshes are tried once.
const MOST_FACES: usize = 50_000;

/// What the tries may spend together, in faces whose field, map and quads are computed.
const WORK: u64 = 1_200_000;

/// What tries share.
pub(super) struct Tries<'a, M> {
    /// The distance from quads at which a point of the surface is lost.
    pub(super) far: f64,
    pub(super) monitor: &'a M,
    /// What may still be spent.
    work: Cell<u64>,
    /// Whether the caller wants what there is.
    has_ended: bool,
}

impl<'a, 'm, M: Fn() -> Monitor<'m>> Tries<'a, M> {
    pub(super) fn new(far: f64, monitor: &'a M) -> Self {
        Self::with_work(far, monitor, WORK)
    }

    /// Tries that may spend so much.
    pub(super) fn with_work(far: f64, monitor: &'a M, work: u64) -> Self {
        Tries {
            far,
            monitor,
            work: Cell::new(work),
            has_ended: false,
        }
    }

    /// What may still be spent.
    pub(super) fn left(&self) -> u64 {
        self.work.get()
    }

    /// Counts what other tries have spent, and whether they ended because the caller wants what there is.
    pub(super) fn count(&mut self, spent: u64, has_ended: bool) {
        self.work.set(self.left().saturating_sub(spent));
        self.has_ended |= has_ended;
    }

    /// Whether the caller wants what there is.
    pub(super) fn has_ended(&self) -> bool {
        self.has_ended
    }

    /// Whether there is work left for a component.
    pub(super) fn may_take(&self, part: &TriangleMesh) -> bool {
        !self.has_ended && part.face_count() as u64 <= self.work.get()
    }

    /// One try, which takes half of what is left of the run. `None` if the caller wants what there is, or if
    /// the call is stopped.
    pub(super) fn one(
        &mut self,
        mesh: &TriangleMesh,
        options: &QuadOptions,
    ) -> Option<Result<Quadrangulation>> {
        let (run, monitor) = ((self.monitor)().run(), self.monitor);
        let half = [0.0, 0.5].map(|part| run.share() + part * (1.0 - run.share()));
        let found = optional(monitor, || {
            run.with_share(half, || {
                by_options(mesh, options, Effort::Again, &self.work, monitor)
            })
        });
        match found.transpose() {
            Some(Err(Error::Cancelled | Error::TimeLimit | Error::OutOfMemory { .. })) => {
                self.has_ended = true;
                None
            }
            found => {
                self.has_ended = found.is_none();
                found
            }
        }
    }

    /// The first of the best results: the first try and, while none is good, those with sharp edges as
    /// features, with the mesh as it is, and with more quads.
    pub(super) fn others(
        &mut self,
        mesh: &TriangleMesh,
        options: &QuadOptions,
        first: Result<Quadrangulation>,
    ) -> Result<Quadrangulation> {
        let mut rank = Rank::of_first(mesh, options, self.far, &first);
        let may_lose = first.as_ref().map_or(true, |made| made.refined.is_some());
        let mut best = first;
        if mesh.face_count() > MOST_FACES {
            return best;
        }
        for other in others(mesh, options) {
            if rank.is_good() || self.has_ended || self.work.get() == 0 {
                break;
            }
            let Some(found) = self.one(mesh, &other) else {
                break;
            };
            let found_rank = Rank::of(mesh, options, self.far, &found, may_lose);
            if found_rank < rank {
                (best, rank) = (found, found_rank);
            }
        }
        best
    }
}

/// What else to try: sharp edges as features, the mesh as it is, more quads, and enough of them for any shape. Quads
/// that cover the surface count for more here than their number or where irregular vertices lie: numbers are not met,
/// and features have a clearance only where the caller gave one.
fn others(mesh: &TriangleMesh, options: &QuadOptions) -> Vec<QuadOptions> {
    let again = QuadOptions {
        guidance: Guidance {
            clearance: options.guidance.clearance.or(Some(0.0)),
            ..options.guidance.clone()
        },
        count: Count::About,
        ..options.clone()
    };
    let mut others = Vec::new();
    if !has_features(mesh, &options.guidance) {
        let guidance = Guidance {
            feature_angle: Some(SHARP),
            ..again.guidance.clone()
        };
        others.push(QuadOptions {
            guidance,
            ..again.clone()
        });
    }
    if options.refine {
        others.push(QuadOptions {
            refine: false,
            ..again.clone()
        });
    }
    let edge = options.sizing.edge_length(mesh);
    let asked = mesh.surface_area() / (edge * edge);
    let factors = [MORE, ENOUGH / asked].into_iter();
    let finer = factors
        .filter(|&more| more >= MORE)
        .map(|more| QuadOptions {
            sizing: finer(&options.sizing, more),
            ..again.clone()
        });
    others.extend(finer);
    others
}

/// The sizes with so many times as many quads.
fn finer(sizing: &Sizing, more: f64) -> Sizing {
    let shorter = |length: f64| length / more.sqrt();
    match sizing {
        Sizing::Quads(quads) => Sizing::Quads((more * *quads as f64).ceil() as usize),
        Sizing::EdgeLength(length) => Sizing::EdgeLength(shorter(*length)),
        Sizing::Graded { quads, lengths } => Sizing::Graded {
            quads: (more * *quads as f64).ceil() as usize,
            lengths: lengths.clone(),
        },
        Sizing::Lengths(lengths) => {
            Sizing::Lengths(lengths.iter().map(|pair| pair.map(shorter)).collect())
        }
    }
}
