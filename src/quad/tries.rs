//! Tries after the first: a mesh whose quads are not good, by other options.

use std::cell::Cell;

use super::by_options::by_options;
use super::coverage::denser;
use super::driver::Effort;
use super::rank::{Losses, Rank, has_features};
use super::{Count, QuadOptions, Quadrangulation};
use crate::error::{Error, Result};
use crate::extract::QuadMesh;
use crate::field::Guidance;
use crate::map::Sizing;
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, optional};

/// The angle of edges that become features where quads without features lose the surface: 40 degrees.
pub(super) const SHARP: f64 = 40.0 * std::f64::consts::PI / 180.0;

/// How many times as many quads are tried.
const MORE: f64 = 1.5;

/// The number of quads that is tried in any case, which a small part of a thin solid may need.
const ENOUGH: f64 = 500.0;

/// How many times as long curves of sharp edges have to be where quads along shorter ones do not conform.
const LONGER: f64 = 4.0;

/// How often quads are made smaller where they lose the surface.
const DENSER: usize = 3;

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

    /// The best of these results: the first try and, while none is good, those with sharp edges as features, with
    /// smaller quads where the first ones lose the surface, with fewer features, with the mesh as it is, and with more
    /// quads. Of those that are equally good the first is kept, or that with the fewest irregular vertices.
    pub(super) fn others(
        &mut self,
        mesh: &TriangleMesh,
        options: &QuadOptions,
        first: Result<Quadrangulation>,
    ) -> Result<Quadrangulation> {
        if mesh.face_count() > MOST_FACES {
            return first;
        }
        let losses = Losses::of(first.as_ref().ok());
        let rank = Rank::of(mesh, options, self.far, &first, losses);
        let mut again = as_tried_again(options);
        let mut best = Best {
            asked: options,
            made: first,
            rank,
            losses,
            options: again.clone(),
        };
        let incomplete = best.incomplete();
        if !has_features(mesh, &options.guidance) {
            let guidance = Guidance {
                feature_angle: Some(SHARP),
                ..again.guidance.clone()
            };
            let sharp = QuadOptions {
                guidance,
                ..again.clone()
            };
            self.improve(mesh, &sharp, &mut best);
        }
        if let Some(sharp_quads) = best.incomplete()
            && best.options.guidance.feature_angle != again.guidance.feature_angle
        {
            let sharp = best.options.clone();
            self.with_denser(mesh, &sharp, sharp_quads, &mut best);
        }
        if let Some(quads) = incomplete
            && (!best.rank.is_good() || best.rank.is_rougher_than(rank))
        {
            self.with_denser(mesh, &again, quads, &mut best);
        }
        if best.rank.does_not_conform()
            && let Some(longer) = with_longer_features(&again)
            && self.improve(mesh, &longer, &mut best).is_some()
        {
            again = longer;
        }
        if again.refine && losses == Losses::Least && !best.rank.is_good() {
            let unrefined = QuadOptions {
                refine: false,
                ..again.clone()
            };
            let before = best.rank;
            self.improve(mesh, &unrefined, &mut best);
            if best.rank < before
                && let Some(quads) = best.incomplete()
            {
                self.with_denser(mesh, &unrefined, quads, &mut best);
            }
        }
        for (k, finer) in finer(mesh, &best.options).iter().enumerate() {
            // Quads that conform on a mesh that was fine enough stay near the number that was asked for.
            let is_near = losses == Losses::Few && !best.rank.does_not_conform();
            if !best.rank.covers_too_little() || is_near && k > 0 {
                break;
            }
            self.improve(mesh, finer, &mut best);
        }
        best.made
    }

    /// Tries smaller and smaller quads where these ones lose the surface, while that loses no more.
    fn with_denser(
        &mut self,
        mesh: &TriangleMesh,
        options: &QuadOptions,
        (mut quads, mut rank): (QuadMesh, Rank),
        best: &mut Best<'_>,
    ) {
        let mut options = options.clone();
        for _ in 0..DENSER {
            options.density = denser(&quads, mesh, self.far, &options.density);
            match self.improve(mesh, &options, best) {
                Some((found, next)) if next.loses_no_more_than(rank) => {
                    (quads, rank) = (found, next)
                }
                _ => break,
            }
        }
    }

    /// Makes one more try, if there is work left, and returns its quads.
    fn improve(
        &mut self,
        mesh: &TriangleMesh,
        options: &QuadOptions,
        best: &mut Best<'_>,
    ) -> Option<(QuadMesh, Rank)> {
        if self.has_ended || self.work.get() == 0 {
            return None;
        }
        let found = self.one(mesh, options)?;
        let rank = Rank::of(mesh, best.asked, self.far, &found, best.losses);
        let quads = found.as_ref().ok().map(|made| made.quads.clone());
        if rank < best.rank {
            (best.made, best.rank, best.options) = (found, rank, options.clone());
        }
        quads.map(|quads| (quads, rank))
    }
}

/// The best result so far.
struct Best<'a> {
    /// What the caller asked for.
    asked: &'a QuadOptions,
    made: Result<Quadrangulation>,
    rank: Rank,
    /// How much of the surface quads may lose.
    losses: Losses,
    /// Its options, or those of tries after the first.
    options: QuadOptions,
}

impl Best<'_> {
    /// The quads, if they conform but lose some of the surface.
    fn incomplete(&self) -> Option<(QuadMesh, Rank)> {
        let made = self.made.as_ref().ok();
        made.filter(|_| self.rank.loses())
            .map(|made| (made.quads.clone(), self.rank))
    }
}

/// The options of all tries after the first. Quads that cover the surface count for more here than their number or
/// where irregular vertices lie: numbers are not met, and features have a clearance only where the caller gave one.
fn as_tried_again(options: &QuadOptions) -> QuadOptions {
    QuadOptions {
        guidance: Guidance {
            clearance: options.guidance.clearance.or(Some(0.0)),
            ..options.guidance.clone()
        },
        count: Count::About,
        ..options.clone()
    }
}

/// The same where only sharp edges of longer curves are features.
fn with_longer_features(again: &QuadOptions) -> Option<QuadOptions> {
    let guidance = &again.guidance;
    let (_, length) = (guidance.feature_angle?, guidance.feature_length?);
    (length > 0.0).then(|| QuadOptions {
        guidance: Guidance {
            feature_length: Some(LONGER * length),
            ..guidance.clone()
        },
        ..again.clone()
    })
}

/// What is tried last: more quads, and enough of them for any shape.
fn finer(mesh: &TriangleMesh, again: &QuadOptions) -> Vec<QuadOptions> {
    let edge = again.sizing.edge_length(mesh);
    let asked = mesh.surface_area() / (edge * edge);
    let factors = [MORE, ENOUGH / asked].into_iter();
    let finer = factors.filter(|&more| more >= MORE);
    let finer = finer.map(|more| QuadOptions {
        sizing: smaller(&again.sizing, more),
        ..again.clone()
    });
    finer.collect()
}

/// The sizes with so many times as many quads.
pub(super) fn smaller(sizing: &Sizing, more: f64) -> Sizing {
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

#[cfg(test)]
mod tests {
    use super::super::coverage::{far, lost};
    use super::super::quadrangulate;
    use super::*;
    use crate::mesh::shape::by_name;

    fn about(quads: usize) -> QuadOptions {
        QuadOptions {
            sizing: Sizing::Quads(quads),
            count: Count::About,
            ..QuadOptions::default()
        }
    }

    /// The first quads do not conform. Half as many again do, and 500 are not tried.
    #[test]
    fn few_quads_that_conform_are_not_followed_by_many() {
        let mesh = by_name("genus-5", 2_000).unwrap();
        let made = quadrangulate(&mesh, &about(20), Monitor::default).unwrap();
        assert!(made.quads.is_conforming() && made.quads.quads.len() < 200);
    }

    /// Quads that are too large for the tubes cut parts of them off. Others are nearer, and not many times as many.
    #[test]
    fn quads_that_lose_by_repairs_are_tried_again_near_their_number() {
        let mesh = by_name("genus-5", 2_000).unwrap();
        let options = about(60);
        let first = by_options(
            &mesh,
            &options,
            Effort::Full,
            &Cell::new(u64::MAX),
            &Monitor::default,
        );
        let of =
            |made: &Result<Quadrangulation>| lost(&made.as_ref().unwrap().quads, &mesh, far(&mesh));
        let (before, count) = (of(&first), first.as_ref().unwrap().quads.quads.len());
        assert!(before > Losses::Few.largest() && first.as_ref().unwrap().quads.repaired > 0);
        let best = Tries::new(far(&mesh), &Monitor::default).others(&mesh, &options, first);
        assert!(of(&best) < 0.7 * before, "{} of {before}", of(&best));
        let quads = &best.as_ref().unwrap().quads;
        assert!(quads.is_conforming() && quads.quads.len() < 2 * count.max(60));
    }

    #[test]
    fn curves_of_sharp_edges_have_to_be_longer_where_there_is_an_angle_and_a_length() {
        let mut options = QuadOptions::default();
        options.guidance.feature_angle = Some(SHARP);
        assert!(with_longer_features(&options).is_none());
        options.guidance.feature_length = Some(0.0);
        assert!(with_longer_features(&options).is_none());
        options.guidance.feature_length = Some(0.5);
        let longer = with_longer_features(&options).unwrap();
        assert_eq!(longer.guidance.feature_length, Some(2.0));
        options.guidance.feature_angle = None;
        assert!(with_longer_features(&options).is_none());
    }
}
